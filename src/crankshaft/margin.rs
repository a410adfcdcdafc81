//! How much of its strength every location uses, at any speed, under the torque that a design leaves.

use super::critical_locations::locations;
use super::speed_table::At;
use super::stress_histories::Histories;
use super::{Crank, CriticalLocation, Family, FatigueSpec, Known, MarginCriterion, MeanBending, Place, bending};
use crate::drivetrain::Chain;
use crate::engine::Engine;
use crate::fatigue::{ClassRule, Cycle, Strength, class_rules, multiaxial};
use crate::numerics::synthesis::Extremes;
use crate::numerics::{C64, nearest};
use std::rc::Rc;

/// The vibratory torque of a shaft at a speed, N m.
#[derive(Debug, Clone, Copy)]
pub struct Torque<'a> {
    /// Its extremes over the cycle: enough for criteria of amplitude and mean.
    pub extremes: Extremes,
    /// Its orders, for multiaxial criteria.
    pub phasors: &'a [C64],
}

/// A location with what it bears.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Used {
    /// Index of the location.
    pub location: usize,
    /// Share of the strength that is used: the inverse of the margin.
    pub value: f64,
    /// Its derivatives by half peak-to-peak and middle of the torque, 1/(N m); none by a multiaxial criterion, which asks for the whole torque.
    pub slopes: (f64, f64),
    /// The cycle of equivalent stress; of a multiaxial criterion the shear stress that is held against the torsion limit, without a mean.
    pub cycle: Cycle,
}

/// Everything of a crank's margin that no absorber changes.
#[derive(Debug, Clone)]
pub struct Margin {
    /// Criteria, in the study's order.
    pub criteria: Vec<MarginCriterion>,
    /// Fillets for criteria of mean stress and multiaxial ones (with factors, and with stresses per unit load, as the study lists them), then those of the class rule.
    pub locations: Vec<CriticalLocation>,
    strength: Strength,
    mean_bending: MeanBending,
    rule: ClassRule,
    /// Squares of the speeds, rpm².
    squares: Vec<f64>,
    /// Local bending stress at each speed (rows) and location, Pa.
    bending: Vec<Vec<Cycle>>,
    /// Mean torque of each shaft at each speed (rows), N m.
    mean_torque: Vec<Vec<f64>>,
    /// Critical locations of each shaft, by family.
    of_shaft: Vec<[Vec<usize>; 4]>,
    /// For multiaxial criteria.
    histories: Option<Histories>,
}

impl Margin {
    /// For the speeds (ascending, rpm) of a sweep and the harmonics of its torque in the cycle; between speeds bending is linear in the square of the speed, the chord of a curve that bends upwards.
    /// Nothing where the torque comes from a table or a throw has no shaft beside it.
    pub fn new(engine: &Engine, chain: &Chain, crank: &Crank, spec: &FatigueSpec, speeds_rpm: &[f64], harmonics: &[u32]) -> Option<Self> {
        let locations = locations(chain, crank, spec)?;
        let multiaxial = spec.criteria.iter().any(|c| matches!(c, MarginCriterion::Multiaxial(_)));
        let table = bending::table(engine, chain, crank, &locations, speeds_rpm, multiaxial)?;
        let histories = spec.limits.filter(|_| multiaxial).map(|limits| Histories::new(limits, harmonics, &locations, table.histories));
        let own = |shaft: usize, family: Family| {
            (0..locations.len()).filter(|i| locations[*i].shaft == shaft && locations[*i].family == family).collect()
        };
        let of_shaft = (0..chain.len() - 1).map(|s| Family::ALL.map(|family| own(s, family))).collect();
        Some(Self {
            criteria: spec.criteria.clone(),
            locations,
            strength: spec.strength,
            mean_bending: spec.mean_bending,
            rule: spec.rule,
            squares: speeds_rpm.iter().map(|s| s * s).collect(),
            bending: table.bending,
            mean_torque: table.mean_torque,
            of_shaft,
            histories,
        })
    }

    /// Whether a criterion is the class societies' rule.
    pub(crate) fn is_class_rule(&self, criterion: usize) -> bool {
        self.criteria[criterion].is_class_rule()
    }

    /// Whether a criterion asks for the whole torque, not only its extremes.
    pub(crate) fn is_multiaxial(&self, criterion: usize) -> bool {
        matches!(self.criteria[criterion], MarginCriterion::Multiaxial(_))
    }

    /// Whether the share that is used has ridges: Dang Van's sums take distances to the centre of a ball, which moves abruptly.
    pub(crate) fn has_ridges(&self, criterion: usize) -> bool {
        let by = self.criteria[criterion];
        [multiaxial::Criterion::DangVanPlane, multiaxial::Criterion::DangVanMesoscopic].map(MarginCriterion::Multiaxial).contains(&by)
    }

    /// Whether a location is judged by a criterion.
    pub fn judges(&self, criterion: usize, location: usize) -> bool {
        self.criteria[criterion].families().contains(&self.locations[location].family)
    }

    /// Mean torque of every shaft at a speed, N m.
    pub fn mean_torque(&self, speed_rpm: f64) -> Vec<f64> {
        let at = self.place(speed_rpm);
        self.mean_torque[at.low].iter().zip(&self.mean_torque[at.high]).map(|(a, b)| at.between(*a, *b)).collect()
    }

    fn place(&self, speed_rpm: f64) -> At {
        if self.squares.len() == 1 {
            return At { low: 0, high: 0, fraction: 0.0 };
        }
        let (low, fraction) = nearest::interval(&self.squares, speed_rpm * speed_rpm);
        At { low, high: low + 1, fraction }
    }

    /// A location under a torque at a speed.
    pub fn used(&self, criterion: usize, location: usize, speed_rpm: f64, torque: &Torque) -> Used {
        let at = self.place(speed_rpm);
        match self.multiaxial(criterion) {
            Some((_, histories)) => {
                let whole = histories.torque(torque.phasors, self.mean_at(at, self.locations[location].shaft));
                self.of_history(histories, location, self.shares(histories, location, at, &whole)[criterion])
            }
            None => self.used_at(criterion, location, at, &torque.extremes),
        }
    }

    /// All locations of a shaft under its torque at a speed by all criteria that judge them, with the index of the criterion: by criterion, then as they are listed.
    pub(crate) fn used_by_all(&self, shaft: usize, speed_rpm: f64, torque: &Torque) -> Vec<(usize, Used)> {
        let at = self.place(speed_rpm);
        let whole = self.histories.as_ref().map(|h| h.torque(torque.phasors, self.mean_at(at, shaft)));
        let mut shares: Vec<Option<Rc<[f64]>>> = vec![None; self.locations.len()];
        let mut list = Vec::new();
        for criterion in 0..self.criteria.len() {
            for location in self.spots_of(criterion, shaft) {
                let used = match (self.multiaxial(criterion), &whole) {
                    (Some((_, histories)), Some(whole)) => {
                        let own = shares[location].get_or_insert_with(|| self.shares(histories, location, at, whole));
                        self.of_history(histories, location, own[criterion])
                    }
                    _ => self.used_at(criterion, location, at, &torque.extremes),
                };
                list.push((criterion, used));
            }
        }
        list
    }

    /// The same by the whole history, without its corners; nothing by a criterion that asks for no history.
    pub(crate) fn used_by_whole_history(&self, criterion: usize, location: usize, speed_rpm: f64, torque: &Torque) -> Option<f64> {
        let (by, histories) = self.multiaxial(criterion)?;
        let at = self.place(speed_rpm);
        let whole = histories.torque(torque.phasors, self.mean_at(at, self.locations[location].shaft));
        histories.used(&[by], &histories.whole(&self.locations[location], at, &whole)).pop()
    }

    /// Share of the strength that a location uses by each criterion that asks for its path; zero by the others.
    fn shares(&self, histories: &Histories, location: usize, at: At, torque: &[f64]) -> Rc<[f64]> {
        let path = histories.path(&self.locations[location], at, torque);
        let multiaxial = |c: &MarginCriterion| if let MarginCriterion::Multiaxial(c) = c { Some(*c) } else { None };
        let asked: Vec<multiaxial::Criterion> = self.criteria.iter().filter_map(multiaxial).collect();
        let mut used = histories.used(&asked, &path).into_iter();
        self.criteria.iter().map(|c| multiaxial(c).and_then(|_| used.next()).unwrap_or(0.0)).collect()
    }

    fn of_history(&self, histories: &Histories, location: usize, value: f64) -> Used {
        Used { location, value, slopes: (0.0, 0.0), cycle: Cycle { amplitude: histories.equivalent(value), mean: 0.0 } }
    }

    fn multiaxial(&self, criterion: usize) -> Option<(multiaxial::Criterion, &Histories)> {
        match (self.criteria[criterion], &self.histories) {
            (MarginCriterion::Multiaxial(c), Some(histories)) => Some((c, histories)),
            _ => None,
        }
    }

    fn mean_at(&self, at: At, shaft: usize) -> f64 {
        at.between(self.mean_torque[at.low][shaft], self.mean_torque[at.high][shaft])
    }

    fn used_at(&self, criterion: usize, location: usize, at: At, torque: &Extremes) -> Used {
        let s = &self.locations[location];
        let (low, high) = (&self.bending[at.low][location], &self.bending[at.high][location]);
        let bending = Cycle { amplitude: at.between(low.amplitude, high.amplitude), mean: at.between(low.mean, high.mean) };
        let mean_torque = self.mean_at(at, s.shaft);
        let twisting = Cycle { amplitude: torque.half_peak_to_peak * s.torsion, mean: (torque.middle + mean_torque) * s.torsion };
        if let Some(allowable) = s.allowable {
            let (stress, slope) = match s.place {
                Place::OilBore => bore(bending.amplitude, twisting.amplitude),
                _ => {
                    let stress = self.rule.fillet_stress(bending.amplitude, twisting.amplitude);
                    (stress, if stress > 0.0 { 3.0 * twisting.amplitude / stress } else { 0.0 })
                }
            };
            let cycle = Cycle { amplitude: stress, mean: 0.0 };
            return Used { location, value: stress / allowable, slopes: (slope * s.torsion / allowable, 0.0), cycle };
        }
        let (amplitude, of_amplitude) = mises(bending.amplitude, twisting.amplitude);
        let pulling = if self.mean_bending == MeanBending::Signed { bending.mean.max(0.0) } else { bending.mean };
        let (mean, of_mean) = mises(pulling, twisting.mean);
        let cycle = Cycle { amplitude, mean };
        let MarginCriterion::MeanStress(line) = self.criteria[criterion] else {
            unreachable!("the class rule has a strength, multiaxial criteria a history")
        };
        let (value, by_amplitude, by_mean) = line.utilisation(cycle, self.strength);
        Used { location, value, slopes: (by_amplitude * of_amplitude * s.torsion, by_mean * of_mean * s.torsion), cycle }
    }

    /// Critical locations of a shaft that a criterion judges.
    pub(crate) fn spots_of(&self, criterion: usize, shaft: usize) -> impl Iterator<Item = usize> {
        self.criteria[criterion].families().iter().flat_map(move |f| self.of_shaft[shaft][*f as usize].iter().copied())
    }

    /// The location of a shaft that is used most.
    pub fn most_used(&self, criterion: usize, shaft: usize, speed_rpm: f64, torque: &Torque) -> Option<Used> {
        self.most_used_above(criterion, shaft, speed_rpm, torque, (1.0, 0.0), None)
    }

    /// The same among those that may be used as much as `wanted` where the torque is up to `rise` times as large; by criteria of extremes among all. `known`: of the design.
    pub(crate) fn most_used_above(
        &self,
        criterion: usize,
        shaft: usize,
        speed_rpm: f64,
        torque: &Torque,
        (rise, wanted): (f64, f64),
        known: Option<&Known>,
    ) -> Option<Used> {
        let at = self.place(speed_rpm);
        let larger = |m: Used, u: Used| if u.value > m.value { u } else { m };
        let Some((word, histories)) = self.multiaxial(criterion) else {
            return self.spots_of(criterion, shaft).map(|i| self.used_at(criterion, i, at, &torque.extremes)).reduce(larger);
        };
        let mean = self.mean_at(at, shaft);
        let Extremes { half_peak_to_peak, middle, .. } = torque.extremes;
        let bound = |i: usize, rise: f64| {
            let largest = mean.abs() + rise * (middle.abs() + half_peak_to_peak);
            histories.at_most(word, (i, &self.locations[i]), at, rise * half_peak_to_peak, largest) * (1.0 + ROUNDING)
        };
        // those that may be used most first: the others need no history then
        let able = self.spots_of(criterion, shaft).filter(|i| bound(*i, rise) >= wanted);
        let mut locations: Vec<(f64, usize)> = able.map(|i| (bound(i, 1.0), i)).collect();
        locations.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut whole: Option<Vec<f64>> = None;
        let mut most: Option<Used> = None;
        for (bound, location) in locations {
            if most.is_some_and(|m| bound < m.value) {
                break;
            }
            let mut find = || {
                let whole = whole.get_or_insert_with(|| histories.torque(torque.phasors, mean));
                self.shares(histories, location, at, whole)
            };
            let shares = match known {
                Some(known) => known.shares(location, speed_rpm, find),
                None => find(),
            };
            let used = self.of_history(histories, location, shares[criterion]);
            most = Some(most.map_or(used, |m| larger(m, used)));
        }
        most
    }

    /// At least as much as the shaft can be used where the torque has no more than this half peak-to-peak value, and its middle no larger size.
    pub fn at_most(&self, criterion: usize, shaft: usize, speed_rpm: f64, half_peak_to_peak: f64, middle: f64) -> f64 {
        let at = self.place(speed_rpm);
        if let Some((word, histories)) = self.multiaxial(criterion) {
            let largest = self.mean_at(at, shaft).abs() + middle.abs() + half_peak_to_peak;
            let bound = |i: usize| histories.at_most(word, (i, &self.locations[i]), at, half_peak_to_peak, largest);
            return self.spots_of(criterion, shaft).map(bound).fold(0.0, f64::max) * (1.0 + ROUNDING);
        }
        // the size of the mean counts: with the sign of the mean torque it is the largest
        let torque = Extremes { half_peak_to_peak, middle: middle.copysign(self.mean_at(at, shaft)), ..Extremes::default() };
        self.spots_of(criterion, shaft).map(|i| self.used_at(criterion, i, at, &torque).value).fold(0.0, f64::max)
    }
}

/// Bounds are as right as this: samples of a torque may exceed its extremes by rounding, and the mean shear is a quadrature.
const ROUNDING: f64 = 1e-3;

/// Equivalent stress and its derivative by the shear stress.
fn mises(bending: f64, torsion: f64) -> (f64, f64) {
    let stress = (bending * bending + 3.0 * torsion * torsion).sqrt();
    (stress, if stress > 0.0 { 3.0 * torsion / stress } else { 0.0 })
}

fn bore(bending: f64, torsion: f64) -> (f64, f64) {
    let root = (bending * bending + 2.25 * torsion * torsion).sqrt();
    (class_rules::bore_stress(bending, torsion), if root > 0.0 { 1.5 * torsion / root } else { 0.0 })
}
