//! What the path of a location does not exceed, without its history: by the ranges of its bending and torque, whatever their phase, and by what is known at another speed, from which it
//! differs by no more than its loads do.

use super::loads::Section;
use super::speed_table::At;
use super::unsurpassed::unsurpassed;
use super::{CriticalLocation, Family};
use crate::fatigue::multiaxial::bound::Within;
use crate::fatigue::multiaxial::history::deviator_of;
use crate::fatigue::multiaxial::invariants::Invariants;
use crate::fatigue::multiaxial::{History, papadopoulos};
use rayon::prelude::*;

/// What a location bears by bending alone at a speed.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Bent {
    sqrt_j2_amplitude: f64,
    /// Of stresses per unit load only: those of a nominal state follow from the amplitude.
    mean_shear: f64,
    low: f64,
    high: f64,
    normal: f64,
    /// Of a nominal state: the changes of its stress from row to row, each the largest over the cycle, added up from the first row.
    travelled: f64,
}

/// What a location bears by a torque of 1 N m.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Twisted {
    /// Whether its state is a nominal one.
    nominal: bool,
    sqrt_j2: f64,
    hydrostatic: f64,
    normal: f64,
}

/// Of all locations at the speeds of a sweep.
#[derive(Debug, Clone)]
pub(super) struct PathBounds {
    /// By speed and location.
    bent: Vec<Vec<Bent>>,
    /// By location.
    twisted: Vec<Twisted>,
}

impl PathBounds {
    /// From the loads of the sections at each speed.
    pub fn new(locations: &[CriticalLocation], sections: &[Vec<Section>]) -> Self {
        // the class rule asks for no paths: its locations are the last
        let paths = |l: &CriticalLocation| matches!(l.family, Family::Nominal | Family::UnitLoads);
        let locations = &locations[..locations.iter().rposition(paths).map_or(0, |last| last + 1)];
        let row = |i: usize| {
            let of = |location: &CriticalLocation| {
                let own = location.web();
                bent(location, &sections[i][own], i.checked_sub(1).map(|before| &sections[before][own]))
            };
            locations.iter().map(of).collect()
        };
        let mut bent: Vec<Vec<Bent>> = (0..sections.len()).into_par_iter().map(row).collect();
        for i in 1..bent.len() {
            let (done, left) = bent.split_at_mut(i);
            left[0].iter_mut().zip(&done[i - 1]).for_each(|(own, before)| own.travelled += before.travelled);
        }
        Self { bent, twisted: locations.iter().map(twisted).collect() }
    }

    /// Under a torque of this half peak-to-peak value, and of no larger size than `largest`.
    pub(super) fn by_ranges(&self, location: usize, at: At, half_peak_to_peak: f64, largest: f64) -> Within {
        let (low, high) = (&self.bent[at.low][location], &self.bent[at.high][location]);
        let per_torque = &self.twisted[location];
        let (twisted, hydrostatic) = (per_torque.sqrt_j2 * half_peak_to_peak, per_torque.hydrostatic * largest);
        let bent = at.between(low.sqrt_j2_amplitude, high.sqrt_j2_amplitude);
        let bent_hydrostatic = (at.between(low.low, high.low), at.between(low.high, high.high));
        let normal = at.between(low.normal, high.normal) + per_torque.normal * largest;
        if !per_torque.nominal {
            return Within {
                sqrt_j2_amplitude: bent + twisted,
                // half ranges of a sum are no larger than the sum of those of its parts, nor is the root of their mean square
                mean_shear: at.between(low.mean_shear, high.mean_shear) + twisted,
                hydrostatic: (bent_hydrostatic.0 - hydrostatic, bent_hydrostatic.1 + hydrostatic),
                middle: None,
                normal,
            };
        }
        // deviators of bending and torsion of a nominal state are at right angles: their box has this ball
        let radius = (bent * bent + twisted * twisted).sqrt();
        let (least, most) = (3.0 * bent_hydrostatic.0, 3.0 * bent_hydrostatic.1);
        Within {
            sqrt_j2_amplitude: radius,
            mean_shear: papadopoulos::at_most(3f64.sqrt() * bent, twisted),
            hydrostatic: bent_hydrostatic,
            // the circle reaches over the normal stress on both sides of its centre
            middle: Some(((most - 3f64.sqrt() * radius).max(least), (least + 3f64.sqrt() * radius).min(most))),
            normal,
        }
    }

    /// Of a nominal state whose path stays within `known` at another speed, under a torque that nowhere differs by more than so many N m.
    pub(super) fn by_another(&self, location: usize, (at, other): (At, At), known: &Within, change: f64) -> Within {
        let travelled = |at: At| at.between(self.bent[at.low][location].travelled, self.bent[at.high][location].travelled);
        let (bending, shear) = ((travelled(at) - travelled(other)).abs(), self.twisted[location].sqrt_j2 * change);
        let (low, high) = known.hydrostatic;
        // points move no farther than this, and the radius of the smallest ball changes by no more
        let moved = (bending * bending / 3.0 + shear * shear).sqrt();
        // the old centre with the larger radius holds the new points: their own centre is no farther off than the root of the difference of squares
        let (larger, smaller) = (known.sqrt_j2_amplitude + moved, (known.sqrt_j2_amplitude - moved).max(0.0));
        let off = (3.0 * (larger * larger - smaller * smaller)).sqrt();
        Within {
            sqrt_j2_amplitude: larger,
            // the root of the mean square of half ranges is a norm
            mean_shear: known.mean_shear + papadopoulos::at_most(bending, shear),
            hydrostatic: (low - bending / 3.0, high + bending / 3.0),
            middle: known.middle.map(|(least, most)| (least - off, most + off)),
            normal: known.normal + (bending * bending + 2.0 * shear * shear).sqrt(),
        }
    }

    /// By the row below a speed and by shaft: locations of multiaxial criteria that no other one surpasses between the row and the next, whatever the torque.
    pub(super) fn leading(&self, of_shaft: &[[Vec<usize>; 4]]) -> Vec<Vec<Vec<usize>>> {
        let of_kind = |low: usize, list: &[usize]| -> Vec<usize> {
            let rows = [&self.bent[low], &self.bent[(low + 1).min(self.bent.len() - 1)]];
            let surpasses = |a: usize, b: usize| {
                let more = self.twisted[a].holds(&self.twisted[b]) && rows.iter().all(|row| row[a].holds(&row[b]));
                // of two alike the first
                more && (a < b || self.twisted[a] != self.twisted[b] || rows.iter().any(|row| row[a] != row[b]))
            };
            unsurpassed(list, surpasses)
        };
        let of = |low: usize, families: &[Vec<usize>; 4]| -> Vec<usize> {
            [Family::Nominal, Family::UnitLoads].iter().flat_map(|f| of_kind(low, &families[*f as usize])).collect()
        };
        (0..self.bent.len()).into_par_iter().map(|low| of_shaft.iter().map(|families| of(low, families)).collect()).collect()
    }
}

impl Twisted {
    /// Whether it bears at least as much as another in every respect.
    fn holds(&self, other: &Self) -> bool {
        self.sqrt_j2 >= other.sqrt_j2 && self.hydrostatic >= other.hydrostatic && self.normal >= other.normal
    }
}

impl Bent {
    /// Whether it bears at least as much as another in every respect.
    fn holds(&self, other: &Self) -> bool {
        let amplitudes = self.sqrt_j2_amplitude >= other.sqrt_j2_amplitude && self.mean_shear >= other.mean_shear;
        amplitudes && self.low <= other.low && self.high >= other.high && self.normal >= other.normal
    }
}

fn twisted(location: &CriticalLocation) -> Twisted {
    let stress = location.unit_loads.map_or([0.0, 0.0, 0.0, location.torsion, 0.0, 0.0], |u| u.torque);
    Twisted {
        nominal: location.unit_loads.is_none(),
        sqrt_j2: deviator_of(&stress).iter().map(|d| d * d).sum::<f64>().sqrt(),
        hydrostatic: ((stress[0] + stress[1] + stress[2]) / 3.0).abs(),
        normal: size(&stress),
    }
}

fn bent(location: &CriticalLocation, section: &Section, before: Option<&Section>) -> Bent {
    let nominal = |m: f64, v: f64| location.bending[0] * m + location.radial * v;
    let mut travelled = 0.0;
    let history = match &location.unit_loads {
        Some(u) => {
            let tensor = |j: usize| -> [f64; 6] {
                std::array::from_fn(|c| u.moment[c] * section[0][j] + u.tangential[c] * section[1][j] + u.shear[c] * section[2][j])
            };
            History::new((0..section[0].len()).map(tensor))
        }
        None => {
            let path = section[0].iter().zip(&section[2]).map(|(m, v)| nominal(*m, *v));
            let (low, high) = path.fold((f64::INFINITY, f64::NEG_INFINITY), |m, b| (m.0.min(b), m.1.max(b)));
            if let Some(before) = before {
                let change = |j: usize| nominal(section[0][j] - before[0][j], section[2][j] - before[2][j]).abs();
                travelled = (0..section[0].len()).map(change).fold(0.0, f64::max);
            }
            History::plane_state(vec![low, high], vec![0.0; 2])
        }
    };
    let i = Invariants::of(&history);
    Bent {
        sqrt_j2_amplitude: i.sqrt_j2_amplitude,
        mean_shear: if location.unit_loads.is_some() { papadopoulos::mean_shear(&history) } else { 0.0 },
        low: i.hydrostatic_mean - i.hydrostatic_amplitude,
        high: i.hydrostatic_max(),
        normal: (0..history.len()).map(|j| size(&history.tensor(j))).fold(0.0, f64::max),
        travelled,
    }
}

/// Frobenius norm of a tensor: no normal stress is larger.
fn size(t: &[f64; 6]) -> f64 {
    (t[..3].iter().map(|s| s * s).sum::<f64>() + 2.0 * t[3..].iter().map(|s| s * s).sum::<f64>()).sqrt()
}
