//! How much of its strength every spot uses, at any speed, under the torque that a design leaves.

use super::{Family, FatigueSpec, MarginCriterion, MeanBending, Spot, bending, spots::spots};
use crate::chain::Chain;
use crate::engine::Engine;
use crate::fatigue::{ClassRule, Cycle, Strength, class_rules};
use crate::numerics::nearest;
use crate::numerics::synthesis::Extremes;
use crate::shaft::{Crank, Place};

/// A spot with what it bears.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Used {
    /// Index of the spot.
    pub spot: usize,
    /// Share of the strength that is used: the inverse of the margin.
    pub value: f64,
    /// Its derivatives by half peak-to-peak and middle of the torque, 1/(N m).
    pub slopes: (f64, f64),
    /// The cycle of equivalent stress.
    pub cycle: Cycle,
}

/// Everything of a crank's margin that no absorber changes.
#[derive(Debug, Clone)]
pub struct Margin {
    /// Criteria, in the study's order.
    pub criteria: Vec<MarginCriterion>,
    /// Fillets for criteria of mean stress, then those of the class rule.
    pub spots: Vec<Spot>,
    strength: Strength,
    mean_bending: MeanBending,
    rule: ClassRule,
    /// Squares of the speeds, rpm².
    squares: Vec<f64>,
    /// Local bending stress at each speed (rows) and spot, Pa.
    bending: Vec<Vec<Cycle>>,
    /// Mean torque of each shaft at each speed (rows), N m.
    mean_torque: Vec<Vec<f64>>,
    /// Spots of each shaft, by family.
    of_shaft: Vec<[Vec<usize>; 3]>,
}

/// A speed in the table: rows on both sides, and the fraction of the way between them.
#[derive(Debug, Clone, Copy)]
struct At {
    low: usize,
    high: usize,
    fraction: f64,
}

impl At {
    fn between(self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.fraction
    }
}

impl Margin {
    /// For the speeds (ascending, rpm) of a sweep; between them bending is linear in the square of the speed, the chord of a curve that bends upwards.
    /// Nothing where the torque comes from a table or a throw has no shaft beside it.
    pub fn new(engine: &Engine, chain: &Chain, crank: &Crank, spec: &FatigueSpec, speeds_rpm: &[f64]) -> Option<Self> {
        let spots = spots(chain, crank, spec)?;
        let (bending, mean_torque) = bending::table(engine, chain, crank, &spots, speeds_rpm)?;
        let own =
            |shaft: usize, family: Family| (0..spots.len()).filter(|i| spots[*i].shaft == shaft && spots[*i].family == family).collect();
        let of_shaft = (0..chain.len() - 1).map(|s| Family::ALL.map(|family| own(s, family))).collect();
        Some(Self {
            criteria: spec.criteria.clone(),
            spots,
            strength: spec.strength,
            mean_bending: spec.mean_bending,
            rule: spec.rule,
            squares: speeds_rpm.iter().map(|s| s * s).collect(),
            bending,
            mean_torque,
            of_shaft,
        })
    }

    /// Whether a criterion is the class societies' rule.
    pub fn is_class_rule(&self, criterion: usize) -> bool {
        self.criteria[criterion].is_class_rule()
    }

    /// Whether a spot is judged by a criterion.
    pub fn judges(&self, criterion: usize, spot: usize) -> bool {
        self.criteria[criterion].family() == self.spots[spot].family
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

    /// A spot under a torque with these extremes at a speed.
    pub fn used(&self, criterion: usize, spot: usize, speed_rpm: f64, torque: &Extremes) -> Used {
        self.used_at(criterion, spot, self.place(speed_rpm), torque)
    }

    fn used_at(&self, criterion: usize, spot: usize, at: At, torque: &Extremes) -> Used {
        let s = &self.spots[spot];
        let (low, high) = (&self.bending[at.low][spot], &self.bending[at.high][spot]);
        let bending = Cycle { amplitude: at.between(low.amplitude, high.amplitude), mean: at.between(low.mean, high.mean) };
        let mean_torque = at.between(self.mean_torque[at.low][s.shaft], self.mean_torque[at.high][s.shaft]);
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
            return Used { spot, value: stress / allowable, slopes: (slope * s.torsion / allowable, 0.0), cycle };
        }
        let (amplitude, of_amplitude) = mises(bending.amplitude, twisting.amplitude);
        let pulling = if self.mean_bending == MeanBending::Signed { bending.mean.max(0.0) } else { bending.mean };
        let (mean, of_mean) = mises(pulling, twisting.mean);
        let cycle = Cycle { amplitude, mean };
        let MarginCriterion::MeanStress(line) = self.criteria[criterion] else { unreachable!("spots of the class rule have a strength") };
        let (value, by_amplitude, by_mean) = line.utilisation(cycle, self.strength);
        Used { spot, value, slopes: (by_amplitude * of_amplitude * s.torsion, by_mean * of_mean * s.torsion), cycle }
    }

    /// The spot of a shaft that is used most.
    pub fn most_used(&self, criterion: usize, shaft: usize, speed_rpm: f64, torque: &Extremes) -> Option<Used> {
        let at = self.place(speed_rpm);
        let own = self.of_shaft[shaft][self.criteria[criterion].family() as usize].iter();
        own.map(|i| self.used_at(criterion, *i, at, torque)).reduce(|m, u| if u.value > m.value { u } else { m })
    }

    /// At least as much as the shaft can be used where the torque has no more than this half peak-to-peak value, and its middle no larger size.
    pub fn at_most(&self, criterion: usize, shaft: usize, speed_rpm: f64, half_peak_to_peak: f64, middle: f64) -> f64 {
        let worst = |middle: f64| {
            let torque = Extremes { half_peak_to_peak, middle, ..Extremes::default() };
            self.most_used(criterion, shaft, speed_rpm, &torque).map_or(0.0, |u| u.value)
        };
        worst(middle).max(worst(-middle))
    }
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
