//! How much of its strength every location uses, at any speed, under the torque that a design leaves.

use super::critical_locations::locations;
use super::speed_table::At;
use super::stress_histories::{Histories, Path};
use super::unsurpassed::unsurpassed;
use super::{Crank, CriticalLocation, Family, FatigueSpec, Known, MarginCriterion, MeanBending, Place, bending};
use crate::drivetrain::Chain;
use crate::engine::Engine;
use crate::fatigue::{ClassRule, Cycle, Strength, class_rules, multiaxial};
use crate::numerics::synthesis::Extremes;
use crate::numerics::{C64, table_lookup};

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
    /// rpm.
    speeds: Vec<f64>,
    /// Local bending stress at each speed (rows) and column, Pa.
    bending: Vec<Vec<Cycle>>,
    /// Column of each location; none of those with stresses per unit load, which no criterion of nominal stress judges.
    columns: Vec<Option<usize>>,
    /// Mean torque of each shaft at each speed (rows), N m.
    mean_torque: Vec<Vec<f64>>,
    /// Critical locations of each shaft, by family.
    of_shaft: Vec<[Vec<usize>; 4]>,
    /// Those of them that another one does not surpass, whatever the torque: by the row below a speed and the shaft.
    leading: Vec<Vec<[Vec<usize>; 4]>>,
    /// The same of nominal states for multiaxial criteria.
    leading_paths: Vec<Vec<Vec<usize>>>,
    /// For multiaxial criteria.
    pub(super) histories: Option<Histories>,
    /// What no share of strength is above, by criterion, shaft and row below a speed: without torque, and per N m.
    rough: Vec<Vec<Vec<(f64, f64)>>>,
}

/// A torque, N m, beside which all bending and all constants of a rule are nothing.
const HUGE: f64 = 1e12;

impl Margin {
    /// For the speeds (ascending, rpm) of a sweep and the harmonics of its torque in the cycle; between speeds bending is linear in the square of the speed, the chord of a curve that bends upwards.
    /// Nothing where the torque comes from a table or a throw has no shaft beside it.
    pub fn new(engine: &Engine, chain: &Chain, crank: &Crank, spec: &FatigueSpec, speeds_rpm: &[f64], harmonics: &[u32]) -> Option<Self> {
        Self::with_webs((engine, chain, crank), spec, speeds_rpm, harmonics, None)
    }

    /// The same with other loads of the webs than those of a continuous beam. The class rule bends one throw by itself, whatever these are.
    #[doc(hidden)]
    pub fn with_webs(
        (engine, chain, crank): (&Engine, &Chain, &Crank),
        spec: &FatigueSpec,
        speeds_rpm: &[f64],
        harmonics: &[u32],
        webs: Option<bending::OtherWebs>,
    ) -> Option<Self> {
        let locations = locations(chain, crank, spec)?;
        let multiaxial = spec.criteria.iter().any(|c| matches!(c, MarginCriterion::Multiaxial(_)));
        let table = bending::table((engine, chain, crank), &locations, (speeds_rpm, webs), multiaxial)?;
        let histories = spec.limits.filter(|_| multiaxial).map(|limits| Histories::new(limits, harmonics, &locations, table.histories));
        let locations_of = |shaft: usize, family: Family| {
            (0..locations.len()).filter(|i| locations[*i].shaft == shaft && locations[*i].family == family).collect()
        };
        let of_shaft: Vec<[Vec<usize>; 4]> = (0..chain.len() - 1).map(|s| Family::ALL.map(|family| locations_of(s, family))).collect();
        let leading = leading(&locations, &of_shaft, (&table.bending, &table.columns));
        let leading_paths = histories.as_ref().map_or_else(Vec::new, |h| h.bounds.leading(&of_shaft));
        let mut margin = Self {
            criteria: spec.criteria.clone(),
            locations,
            strength: spec.strength,
            mean_bending: spec.mean_bending,
            rule: spec.rule,
            speeds: speeds_rpm.to_vec(),
            bending: table.bending,
            columns: table.columns,
            mean_torque: table.mean_torque,
            of_shaft,
            leading,
            leading_paths,
            histories,
            rough: Vec::new(),
        };
        margin.rough = (0..margin.criteria.len()).map(|c| (0..chain.len() - 1).map(|s| margin.rough_of(c, s)).collect()).collect();
        Some(margin)
    }

    /// What no share of strength on a shaft is above, by the row below a speed: without torque, and per N m of its half range and its middle. Stresses of bending and torsion add up to no more than their sum, shares of strength
    /// by amplitude and mean are gauges of convex sets, and between rows bending and mean torque lie on chords: the sum of the two is a bound.
    fn rough_of(&self, criterion: usize, shaft: usize) -> Vec<(f64, f64)> {
        if self.is_multiaxial(criterion) {
            return Vec::new();
        }
        let last = self.bending.len() - 1;
        let of_row = |low: usize| {
            let leading = || self.criteria[criterion].families().iter().flat_map(|f| &self.leading[low][shaft][*f as usize]).copied();
            let still = |row: usize, i: usize| {
                let bending = self.columns[i].map_or(Cycle { amplitude: 0.0, mean: 0.0 }, |column| self.bending[row][column]);
                self.share_of(criterion, i, bending, (0.0, self.mean_torque[row][shaft].abs()))
            };
            let rows = [low, (low + 1).min(last)];
            let without = leading().flat_map(|i| rows.map(|row| still(row, i))).fold(0.0, f64::max);
            let none = Cycle { amplitude: 0.0, mean: 0.0 };
            let slope = leading().map(|i| self.share_of(criterion, i, none, (HUGE, HUGE)) / HUGE).fold(0.0, f64::max);
            // rounding
            (without * (1.0 + 1e-9), slope * (1.0 + 1e-9))
        };
        (0..=last).map(of_row).collect()
    }

    /// A bound of [`Self::at_most`] for both of its torques at most `size`; infinite for a multiaxial criterion and beside the range of speeds.
    pub(crate) fn rough_bound(&self, criterion: usize, shaft: usize, speed_rpm: f64, size: f64) -> f64 {
        let (at, rows) = (self.place(speed_rpm), &self.rough[criterion][shaft]);
        if rows.is_empty() || !(0.0..=1.0).contains(&at.fraction) {
            return f64::INFINITY;
        }
        let (without, slope) = rows[at.low];
        without + slope * size
    }

    /// What a torque adds to the share of strength of a shaft at a speed, at most, per N m of its half range and its middle; infinite for a multiaxial criterion.
    pub(crate) fn used_per_torque(&self, criterion: usize, shaft: usize, speed_rpm: f64) -> f64 {
        self.rough[criterion][shaft].get(self.place(speed_rpm).low).map_or(f64::INFINITY, |row| row.1)
    }

    /// Whether a criterion is the class societies' rule.
    #[doc(hidden)]
    pub fn is_class_rule(&self, criterion: usize) -> bool {
        self.criteria[criterion].is_class_rule()
    }

    /// Whether a criterion asks for the whole torque, not only its extremes.
    #[doc(hidden)]
    pub fn is_multiaxial(&self, criterion: usize) -> bool {
        matches!(self.criteria[criterion], MarginCriterion::Multiaxial(_))
    }

    /// Whether the share that is used has ridges.
    pub(crate) fn has_ridges(&self, criterion: usize) -> bool {
        matches!(self.criteria[criterion], MarginCriterion::Multiaxial(c) if c.has_ridges())
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

    pub(super) fn place(&self, speed_rpm: f64) -> At {
        if self.speeds.len() == 1 {
            return At { low: 0, high: 0, fraction: 0.0 };
        }
        let low = table_lookup::in_nearly_even(&self.speeds, speed_rpm);
        let [below, above] = [self.speeds[low], self.speeds[low + 1]].map(|s| s * s);
        At { low, high: low + 1, fraction: (speed_rpm * speed_rpm - below) / (above - below) }
    }

    /// A location under a torque at a speed.
    pub fn used(&self, criterion: usize, location: usize, speed_rpm: f64, torque: &Torque) -> Used {
        let at = self.place(speed_rpm);
        match self.multiaxial(criterion) {
            Some((word, histories)) => {
                let whole = histories.torque(torque.phasors, self.mean_at(at, self.locations[location].shaft));
                let share = histories.shares(&[word], &histories.path(&self.locations[location], at, &whole))[0];
                multiaxially(histories, location, share)
            }
            None => self.used_at(criterion, location, at, &torque.extremes),
        }
    }

    /// The same by the whole history, without its corners; nothing by a criterion that asks for no history.
    #[doc(hidden)]
    pub fn used_by_whole_history(&self, criterion: usize, location: usize, speed_rpm: f64, torque: &Torque) -> Option<f64> {
        let (by, histories) = self.multiaxial(criterion)?;
        let at = self.place(speed_rpm);
        let whole = histories.torque(torque.phasors, self.mean_at(at, self.locations[location].shaft));
        histories.shares(&[by], &Path::General(histories.whole(&self.locations[location], at, &whole))).pop()
    }

    pub(super) fn multiaxial(&self, criterion: usize) -> Option<(multiaxial::Criterion, &Histories)> {
        match (self.criteria[criterion], &self.histories) {
            (MarginCriterion::Multiaxial(c), Some(histories)) => Some((c, histories)),
            _ => None,
        }
    }

    pub(super) fn mean_at(&self, at: At, shaft: usize) -> f64 {
        at.between(self.mean_torque[at.low][shaft], self.mean_torque[at.high][shaft])
    }

    fn used_at(&self, criterion: usize, location: usize, at: At, torque: &Extremes) -> Used {
        let s = &self.locations[location];
        let bending = self.bending_at(location, at);
        let mean_torque = self.mean_at(at, s.shaft);
        let twisting = Cycle { amplitude: torque.half_peak_to_peak * s.torsion, mean: (torque.middle + mean_torque) * s.torsion };
        if let Some(allowable) = s.allowable {
            let (stress, slope) = self.rule_stress(s.place, bending.amplitude, twisting.amplitude);
            let cycle = Cycle { amplitude: stress, mean: 0.0 };
            return Used { location, value: stress / allowable, slopes: (slope * s.torsion / allowable, 0.0), cycle };
        }
        let (cycle, (of_amplitude, of_mean)) = self.equivalent(bending, twisting);
        let MarginCriterion::MeanStress(line) = self.criteria[criterion] else {
            unreachable!("the class rule has a strength, multiaxial criteria a history")
        };
        let (value, by_amplitude, by_mean) = line.utilisation(cycle, self.strength);
        Used { location, value, slopes: (by_amplitude * of_amplitude * s.torsion, by_mean * of_mean * s.torsion), cycle }
    }

    /// Critical locations of a shaft that a criterion judges.
    #[doc(hidden)]
    pub fn spots_of(&self, criterion: usize, shaft: usize) -> impl Iterator<Item = usize> {
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
        if self.is_multiaxial(criterion) {
            return self.most_used_path(criterion, (shaft, speed_rpm), torque, (rise, wanted), known);
        }
        let larger = |m: Used, u: Used| if u.value > m.value { u } else { m };
        self.spots_of(criterion, shaft).map(|i| self.used_at(criterion, i, at, &torque.extremes)).reduce(larger)
    }

    /// At least as much as the shaft can be used where the torque has no more than this half peak-to-peak value, and its middle no larger size.
    pub fn at_most(&self, criterion: usize, shaft: usize, speed_rpm: f64, half_peak_to_peak: f64, middle: f64) -> f64 {
        let mut most = 0.0;
        self.any_bound((criterion, shaft), speed_rpm, (half_peak_to_peak, middle), |bound| {
            most = f64::max(most, bound);
            false
        });
        most
    }

    /// Whether the bound of any location, of which [`Self::at_most`] is the largest, is as asked; those behind the first that is are not found.
    pub(crate) fn any_bound(
        &self,
        (criterion, shaft): (usize, usize),
        speed_rpm: f64,
        (half_peak_to_peak, middle): (f64, f64),
        mut is: impl FnMut(f64) -> bool,
    ) -> bool {
        let at = self.place(speed_rpm);
        if let Some((word, histories)) = self.multiaxial(criterion) {
            let largest = self.mean_at(at, shaft).abs() + middle.abs() + half_peak_to_peak;
            let bound = |i: usize| histories.at_most(word, &histories.bounds.by_ranges(i, at, half_peak_to_peak, largest));
            let points = &self.of_shaft[shaft][Family::UnitLoads as usize];
            return self.leading_paths[at.low][shaft].iter().chain(points).any(|i| is(bound(*i) * (1.0 + ROUNDING)));
        }
        // the size of the mean counts: with the sign of the mean torque it is the largest
        let torque = (half_peak_to_peak, middle.abs() + self.mean_at(at, shaft).abs());
        let families = self.criteria[criterion].families().iter();
        let mut leading = families.flat_map(|f| &self.leading[at.low][shaft][*f as usize]);
        leading.any(|i| is(self.share_at(criterion, *i, at, torque)))
    }

    /// Share of the strength that a location uses under a torque of this half peak-to-peak value and mean; not by a multiaxial criterion.
    fn share_at(&self, criterion: usize, location: usize, at: At, (half_peak_to_peak, mean_torque): (f64, f64)) -> f64 {
        self.share_of(criterion, location, self.bending_at(location, at), (half_peak_to_peak, mean_torque))
    }

    /// The same under a cycle of bending.
    pub(super) fn share_of(&self, criterion: usize, location: usize, bending: Cycle, (half_peak_to_peak, mean_torque): (f64, f64)) -> f64 {
        let s = &self.locations[location];
        let twisting = Cycle { amplitude: half_peak_to_peak * s.torsion, mean: mean_torque * s.torsion };
        match (s.allowable, self.criteria[criterion]) {
            (Some(allowable), _) => self.rule_stress(s.place, bending.amplitude, twisting.amplitude).0 / allowable,
            (None, MarginCriterion::MeanStress(line)) => line.utilisation(self.equivalent(bending, twisting).0, self.strength).0,
            (None, _) => 0.0,
        }
    }

    fn bending_at(&self, location: usize, at: At) -> Cycle {
        let Some(column) = self.columns[location] else { return Cycle { amplitude: 0.0, mean: 0.0 } };
        let (low, high) = (&self.bending[at.low][column], &self.bending[at.high][column]);
        Cycle { amplitude: at.between(low.amplitude, high.amplitude), mean: at.between(low.mean, high.mean) }
    }

    /// Stress by the class rule, and its derivative by that of torsion.
    fn rule_stress(&self, place: Place, bending: f64, torsion: f64) -> (f64, f64) {
        if place == Place::OilBore {
            return bore(bending, torsion);
        }
        let stress = self.rule.fillet_stress(bending, torsion);
        (stress, if stress > 0.0 { 3.0 * torsion / stress } else { 0.0 })
    }

    /// Cycle of equivalent stress, and its derivatives by those of torsion.
    fn equivalent(&self, bending: Cycle, twisting: Cycle) -> (Cycle, (f64, f64)) {
        let (amplitude, of_amplitude) = mises(bending.amplitude, twisting.amplitude);
        let pulling = if self.mean_bending == MeanBending::Signed { bending.mean.max(0.0) } else { bending.mean };
        let (mean, of_mean) = mises(pulling, twisting.mean);
        (Cycle { amplitude, mean }, (of_amplitude, of_mean))
    }
}

/// Of each shaft, by the row below a speed: locations of nominal stress that no other one of their kind surpasses in torsion, and in bending at both rows round the speed.
fn leading(
    locations: &[CriticalLocation],
    of_shaft: &[[Vec<usize>; 4]],
    (bending, columns): (&[Vec<Cycle>], &[Option<usize>]),
) -> Vec<Vec<[Vec<usize>; 4]>> {
    let surpasses = |rows: &[&Vec<Cycle>], a: usize, b: usize| {
        let (Some(i), Some(j)) = (columns[a], columns[b]) else { return false };
        let (own, other) = (&locations[a], &locations[b]);
        let more = rows.iter().all(|row| row[i].amplitude >= row[j].amplitude && row[i].mean >= row[j].mean && row[j].mean >= 0.0);
        let alike = own.place == other.place && own.allowable == other.allowable;
        let same = rows.iter().all(|row| row[i] == row[j]) && own.torsion == other.torsion;
        alike && more && own.torsion.abs() >= other.torsion.abs() && (!same || a < b)
    };
    let remaining_at = |low: usize| {
        let rows = [&bending[low], &bending[(low + 1).min(bending.len() - 1)]];
        // stresses per unit load are no business of the criteria that ask this
        let remaining = |family: Family, list: &Vec<usize>| match family {
            Family::UnitLoads => Vec::new(),
            _ => unsurpassed(list, |a, b| surpasses(&rows, a, b)),
        };
        of_shaft.iter().map(|families| Family::ALL.map(|f| remaining(f, &families[f as usize]))).collect()
    };
    (0..bending.len()).map(remaining_at).collect()
}

/// Bounds are as right as this: samples of a torque may exceed its extremes by rounding, and the mean shear is a quadrature.
pub(super) const ROUNDING: f64 = 1e-3;

/// A location by a multiaxial criterion, of the share that it uses.
pub(super) fn multiaxially(histories: &Histories, location: usize, share: f64) -> Used {
    Used { location, value: share, slopes: (0.0, 0.0), cycle: Cycle { amplitude: histories.equivalent(share), mean: 0.0 } }
}

/// Equivalent stress and its derivative by the shear stress.
fn mises(bending: f64, torsion: f64) -> (f64, f64) {
    let stress = (bending * bending + 3.0 * torsion * torsion).sqrt();
    (stress, if stress > 0.0 { 3.0 * torsion / stress } else { 0.0 })
}

fn bore(bending: f64, torsion: f64) -> (f64, f64) {
    let root = (bending * bending + 2.25 * torsion * torsion).sqrt();
    (class_rules::bore_stress(bending, torsion), if root > 0.0 { 1.5 * torsion / root } else { 0.0 })
}
