//! What the path of a location does not exceed, without its history: by the ranges of its bending and torque, whatever their phase, and by what is known at another speed, from which it
//! differs by no more than its loads do.

use super::loads::Section;
use super::speed_table::At;
use super::unit_load_bounds::{BentWeb, UnitPoint};
use super::unsurpassed::unsurpassed;
use super::{CriticalLocation, Family};
use crate::fatigue::multiaxial::bound::Within;
use crate::fatigue::multiaxial::history::deviator_of;
use crate::fatigue::multiaxial::invariants::Invariants;
use crate::fatigue::multiaxial::{History, papadopoulos};
use rayon::prelude::*;

/// What a nominal state bears by bending alone at a speed.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Bent {
    sqrt_j2_amplitude: f64,
    low: f64,
    high: f64,
    normal: f64,
    /// The changes of its stress from row to row, each the largest over the cycle, added up from the first row.
    travelled: f64,
}

/// What a nominal state bears by a torque of 1 N m.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Twisted {
    sqrt_j2: f64,
    normal: f64,
}

/// What kind of location it is, and its place among those of its kind.
#[derive(Debug, Clone, Copy)]
enum Kind {
    Nominal(usize),
    Unit(usize),
}

/// Of all locations at the speeds of a sweep.
#[derive(Debug, Clone)]
pub(super) struct PathBounds {
    /// By location.
    kinds: Vec<Kind>,
    /// By speed and nominal location.
    bent: Vec<Vec<Bent>>,
    /// By nominal location.
    twisted: Vec<Twisted>,
    /// Locations with stresses per unit load.
    points: Vec<UnitPoint>,
    /// By speed and web, where there are such points.
    webs: Vec<Vec<BentWeb>>,
}

impl PathBounds {
    /// From the loads of the sections at each speed.
    pub fn new(locations: &[CriticalLocation], sections: &[Vec<Section>]) -> Self {
        // the class rule asks for no paths: its locations are the last
        let paths = |l: &CriticalLocation| matches!(l.family, Family::Nominal | Family::UnitLoads);
        let locations = &locations[..locations.iter().rposition(paths).map_or(0, |last| last + 1)];
        let (mut kinds, mut nominal, mut points) = (Vec::new(), Vec::new(), Vec::new());
        for location in locations {
            match &location.unit_loads {
                Some(units) => {
                    kinds.push(Kind::Unit(points.len()));
                    points.push(UnitPoint::of(location, units));
                }
                None => {
                    kinds.push(Kind::Nominal(nominal.len()));
                    nominal.push(location);
                }
            }
        }
        let row = |i: usize| {
            let bent_of = |location: &&CriticalLocation| {
                let own = location.web();
                bent(location, &sections[i][own], i.checked_sub(1).map(|before| &sections[before][own]))
            };
            nominal.iter().map(bent_of).collect()
        };
        let mut bent: Vec<Vec<Bent>> = (0..sections.len()).into_par_iter().map(row).collect();
        for i in 1..bent.len() {
            let (done, left) = bent.split_at_mut(i);
            left[0].iter_mut().zip(&done[i - 1]).for_each(|(own, before)| own.travelled += before.travelled);
        }
        let twisted = nominal.iter().map(|l| twisted(l)).collect();
        let of_webs = |webs: &Vec<Section>| webs.iter().map(|s| BentWeb::of(s.each_ref().map(Vec::as_slice))).collect();
        let webs = if points.is_empty() { Vec::new() } else { sections.par_iter().map(of_webs).collect() };
        Self { kinds, bent, twisted, points, webs }
    }

    /// A location with stresses per unit load.
    pub(super) fn point(&self, location: usize) -> Option<&UnitPoint> {
        match self.kinds[location] {
            Kind::Unit(i) => self.points.get(i),
            Kind::Nominal(_) => None,
        }
    }

    /// Under a torque of this half peak-to-peak value, and of no larger size than `largest`.
    pub(super) fn by_ranges(&self, location: usize, at: At, half_peak_to_peak: f64, largest: f64) -> Within {
        let nominal = match self.kinds[location] {
            Kind::Unit(i) => return self.points[i].by_ranges([&self.webs[at.low], &self.webs[at.high]], at, half_peak_to_peak, largest),
            Kind::Nominal(i) => i,
        };
        let (low, high) = (&self.bent[at.low][nominal], &self.bent[at.high][nominal]);
        let per_torque = &self.twisted[nominal];
        let twisted = per_torque.sqrt_j2 * half_peak_to_peak;
        let bent = at.between(low.sqrt_j2_amplitude, high.sqrt_j2_amplitude);
        let bent_hydrostatic = (at.between(low.low, high.low), at.between(low.high, high.high));
        let normal = at.between(low.normal, high.normal) + per_torque.normal * largest;
        // deviators of bending and torsion of a nominal state are at right angles: their box has this ball
        let radius = (bent * bent + twisted * twisted).sqrt();
        let (least, most) = (3.0 * bent_hydrostatic.0, 3.0 * bent_hydrostatic.1);
        Within {
            sqrt_j2_amplitude: radius,
            shear: radius,
            mean_shear: papadopoulos::at_most(3f64.sqrt() * bent, twisted),
            hydrostatic: bent_hydrostatic,
            // the circle reaches over the normal stress on both sides of its centre
            middle: Some(((most - 3f64.sqrt() * radius).max(least), (least + 3f64.sqrt() * radius).min(most))),
            normal,
        }
    }

    /// Of a nominal state whose path stays within `known` at another speed, under a torque that nowhere differs by more than so many N m.
    pub(super) fn by_another(&self, location: usize, (at, other): (At, At), known: &Within, change: f64) -> Within {
        let Kind::Nominal(nominal) = self.kinds[location] else { unreachable!("only nominal states have outlines") };
        let travelled = |at: At| at.between(self.bent[at.low][nominal].travelled, self.bent[at.high][nominal].travelled);
        let (bending, shear) = ((travelled(at) - travelled(other)).abs(), self.twisted[nominal].sqrt_j2 * change);
        let (low, high) = known.hydrostatic;
        // points move no farther than this, and the radius of the smallest ball changes by no more
        let moved = (bending * bending / 3.0 + shear * shear).sqrt();
        // the old centre with the larger radius holds the new points: their own centre is no farther off than the root of the difference of squares
        let (larger, smaller) = (known.sqrt_j2_amplitude + moved, (known.sqrt_j2_amplitude - moved).max(0.0));
        let off = (3.0 * (larger * larger - smaller * smaller)).sqrt();
        Within {
            sqrt_j2_amplitude: larger,
            shear: larger,
            // the root of the mean square of half ranges is a norm
            mean_shear: known.mean_shear + papadopoulos::at_most(bending, shear),
            hydrostatic: (low - bending / 3.0, high + bending / 3.0),
            middle: known.middle.map(|(least, most)| (least - off, most + off)),
            normal: known.normal + (bending * bending + 2.0 * shear * shear).sqrt(),
        }
    }

    /// By the row below a speed and by shaft: nominal states that no other one surpasses between the row and the next, whatever the torque.
    pub(super) fn leading(&self, of_shaft: &[[Vec<usize>; 4]]) -> Vec<Vec<Vec<usize>>> {
        let column = |location: usize| match self.kinds[location] {
            Kind::Nominal(i) | Kind::Unit(i) => i,
        };
        let of_nominal = |low: usize, list: &[usize]| -> Vec<usize> {
            let rows = [&self.bent[low], &self.bent[(low + 1).min(self.bent.len() - 1)]];
            let surpasses = |a: usize, b: usize| {
                let (i, j) = (column(a), column(b));
                let more = self.twisted[i].holds(&self.twisted[j]) && rows.iter().all(|row| row[i].holds(&row[j]));
                // of two alike the first
                more && (a < b || self.twisted[i] != self.twisted[j] || rows.iter().any(|row| row[i] != row[j]))
            };
            unsurpassed(list, surpasses)
        };
        let unsurpassed_nominal = |low: usize, families: &[Vec<usize>; 4]| of_nominal(low, &families[Family::Nominal as usize]);
        (0..self.bent.len())
            .into_par_iter()
            .map(|low| of_shaft.iter().map(|families| unsurpassed_nominal(low, families)).collect())
            .collect()
    }
}

impl Twisted {
    /// Whether it bears at least as much as another in every respect.
    fn holds(&self, other: &Self) -> bool {
        self.sqrt_j2 >= other.sqrt_j2 && self.normal >= other.normal
    }
}

impl Bent {
    /// Whether it bears at least as much as another in every respect.
    fn holds(&self, other: &Self) -> bool {
        self.sqrt_j2_amplitude >= other.sqrt_j2_amplitude && self.low <= other.low && self.high >= other.high && self.normal >= other.normal
    }
}

fn twisted(location: &CriticalLocation) -> Twisted {
    let stress = [0.0, 0.0, 0.0, location.torsion, 0.0, 0.0];
    Twisted { sqrt_j2: deviator_of(&stress).iter().map(|d| d * d).sum::<f64>().sqrt(), normal: size(&stress) }
}

fn bent(location: &CriticalLocation, section: &Section, before: Option<&Section>) -> Bent {
    let nominal = |m: f64, v: f64| location.bending[0] * m + location.radial * v;
    let path = section[0].iter().zip(&section[2]).map(|(m, v)| nominal(*m, *v));
    let (low, high) = path.fold((f64::INFINITY, f64::NEG_INFINITY), |m, b| (m.0.min(b), m.1.max(b)));
    let change = |before: &Section| {
        let change_at = |j: usize| nominal(section[0][j] - before[0][j], section[2][j] - before[2][j]).abs();
        (0..section[0].len()).map(change_at).fold(0.0, f64::max)
    };
    let history = History::plane_state(vec![low, high], vec![0.0; 2]);
    let i = Invariants::of(&history);
    Bent {
        sqrt_j2_amplitude: i.sqrt_j2_amplitude,
        low: i.hydrostatic_mean - i.hydrostatic_amplitude,
        high: i.hydrostatic_max(),
        normal: (0..history.len()).map(|j| size(&history.tensor(j))).fold(0.0, f64::max),
        travelled: before.map_or(0.0, change),
    }
}

/// Frobenius norm of a tensor: no normal stress is larger.
fn size(t: &[f64; 6]) -> f64 {
    (t[..3].iter().map(|s| s * s).sum::<f64>() + 2.0 * t[3..].iter().map(|s| s * s).sum::<f64>()).sqrt()
}
