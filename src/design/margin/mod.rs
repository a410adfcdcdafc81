//! Fatigue margin of the crank over the speed range: bending of the webs, which no absorber changes, with the torque of the shafts, which it does.
//!
//! At a speed and spot the cycle of stress has amplitude sqrt(b_a² + 3 t_a²) and mean sqrt(b_m² + 3 t_m²), each from the extremes over the working cycle,
//! whatever their phase \[Villalva 2014\] eqs. (7.29), (7.30), \[IACS UR M53\] section 5: never below the stress that phase would leave.
//! A web and its two fillets carry the torque of the shaft on their side; the pin itself carries the mean of both sides, so this is on the safe side.

mod bending;
pub mod loads;

use crate::chain::Chain;
use crate::engine::Engine;
use crate::fatigue::{ClassRule, Criterion, Cycle, Strength, class_rules, endurance};
use crate::numerics::nearest;
use crate::numerics::synthesis::Extremes;
use crate::shaft::notch::{Factors, Formulas};
use crate::shaft::{Concentration, Crank, Place, section};

/// A way to judge a cycle of stress.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MarginCriterion {
    /// Amplitude and mean, with the factors that the study gives to its fillets.
    MeanStress(Criterion),
    /// The class societies' rule, with its own factors and its own bending: one throw between two bearings, statically determinate.
    IacsM53,
}

impl MarginCriterion {
    /// The word used in studies and tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::MeanStress(c) => c.name(),
            Self::IacsM53 => "iacs_m53",
        }
    }

    /// Column of the smallest margin in tables.
    pub fn column(self) -> &'static str {
        match self {
            Self::MeanStress(Criterion::Goodman) => "margin_goodman",
            Self::MeanStress(Criterion::Soderberg) => "margin_soderberg",
            Self::MeanStress(Criterion::Gerber) => "margin_gerber",
            Self::MeanStress(Criterion::AsmeElliptic) => "margin_asme_elliptic",
            Self::MeanStress(Criterion::Langer) => "margin_langer",
            Self::IacsM53 => "margin_iacs_m53",
        }
    }

    /// Least acceptable margin, where the criterion names one.
    pub fn acceptable(self) -> Option<f64> {
        (self == Self::IacsM53).then_some(class_rules::ACCEPTABLE)
    }
}

/// Where the factors of a fillet come from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FactorSource {
    /// Given, of the nominal stress in the round section of pin or journal.
    Given {
        /// Of bending.
        bending: f64,
        /// Of torsion.
        torsion: f64,
    },
    /// Formulas; bending on the section of the web.
    Formulas(Formulas),
}

/// Fillets of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct FilletSpec {
    /// Name in tables; where it stands for all throws, their numbers are added.
    pub name: String,
    /// One throw (from 0), or all.
    pub throw: Option<usize>,
    /// Crankpin or journal.
    pub place: Place,
    /// Its factors.
    pub factors: FactorSource,
}

/// What a study says of fatigue.
#[derive(Debug, Clone, PartialEq)]
pub struct FatigueSpec {
    /// At least one.
    pub criteria: Vec<MarginCriterion>,
    /// Of the part, endurance factors included.
    pub strength: Strength,
    /// Whether factors are lessened by the notch sensitivity of the material.
    pub notch_sensitivity: bool,
    /// At least one.
    pub fillets: Vec<FilletSpec>,
    /// Of the class rule.
    pub rule: ClassRule,
}

/// A fillet (or oil bore) of one web.
#[derive(Debug, Clone, PartialEq)]
pub struct Spot {
    /// Name with the number of the throw.
    pub name: String,
    /// From 0.
    pub throw: usize,
    /// Whether it is on the web behind the crankpin.
    pub rear: bool,
    /// Place.
    pub place: Place,
    /// The shaft whose torque it carries.
    pub shaft: usize,
    /// Local bending stress per moment in the plane of the throw, 1/m³, and per tangential one (oil bores).
    bending: [f64; 2],
    /// Local stress per radial force, 1/m².
    radial: f64,
    /// Local shear stress per torque, 1/m³.
    torsion: f64,
    /// Of the class rule: allowable amplitude, Pa.
    allowable: Option<f64>,
}

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
    rule: ClassRule,
    /// Squares of the speeds, rpm².
    squares: Vec<f64>,
    /// Local bending stress at each speed (rows) and spot, Pa.
    bending: Vec<Vec<Cycle>>,
    /// Mean torque of each shaft at each speed (rows), N m.
    mean_torque: Vec<Vec<f64>>,
}

impl Margin {
    /// For the speeds (ascending, rpm) of a sweep; between them bending is linear in the square of the speed, the chord of a curve that bends upwards.
    /// Nothing where the torque comes from a table or a throw has no shaft beside it.
    pub fn new(engine: &Engine, chain: &Chain, crank: &Crank, spec: &FatigueSpec, speeds_rpm: &[f64]) -> Option<Self> {
        let spots = spots(chain, crank, spec)?;
        let (bending, mean_torque) = bending::table(engine, chain, crank, &spots, speeds_rpm)?;
        Some(Self {
            criteria: spec.criteria.clone(),
            spots,
            strength: spec.strength,
            rule: spec.rule,
            squares: speeds_rpm.iter().map(|s| s * s).collect(),
            bending,
            mean_torque,
        })
    }

    /// Whether a criterion is the class societies' rule.
    pub fn is_class_rule(&self, criterion: usize) -> bool {
        self.criteria[criterion] == MarginCriterion::IacsM53
    }

    /// Whether a spot is judged by a criterion.
    pub fn judges(&self, criterion: usize, spot: usize) -> bool {
        self.is_class_rule(criterion) == self.spots[spot].allowable.is_some()
    }

    /// Mean torque of every shaft at a speed, N m.
    pub fn mean_torque(&self, speed_rpm: f64) -> Vec<f64> {
        let (i, next, fraction) = self.place(speed_rpm);
        self.mean_torque[i].iter().zip(&self.mean_torque[next]).map(|(a, b)| a + (b - a) * fraction).collect()
    }

    /// Rows of the table on both sides of a speed, and the fraction of the way between them.
    fn place(&self, speed_rpm: f64) -> (usize, usize, f64) {
        if self.squares.len() == 1 {
            return (0, 0, 0.0);
        }
        let (i, fraction) = nearest::interval(&self.squares, speed_rpm * speed_rpm);
        (i, i + 1, fraction)
    }

    /// A spot under a torque with these extremes at a speed.
    pub fn used(&self, criterion: usize, spot: usize, speed_rpm: f64, torque: &Extremes) -> Used {
        let (i, next, fraction) = self.place(speed_rpm);
        let between = |a: f64, b: f64| a + (b - a) * fraction;
        let s = &self.spots[spot];
        let (low, high) = (&self.bending[i][spot], &self.bending[next][spot]);
        let bending = Cycle { amplitude: between(low.amplitude, high.amplitude), mean: between(low.mean, high.mean) };
        let mean_torque = between(self.mean_torque[i][s.shaft], self.mean_torque[next][s.shaft]);
        let twisting = Cycle { amplitude: torque.half_peak_to_peak * s.torsion, mean: (torque.middle + mean_torque) * s.torsion };
        if let Some(allowable) = s.allowable {
            let (stress, slope) = match s.place {
                Place::OilBore => bore(bending.amplitude, twisting.amplitude),
                _ => {
                    let stress = self.rule.fillet_stress(bending.amplitude, twisting.amplitude);
                    (stress, 3.0 * twisting.amplitude / stress)
                }
            };
            let cycle = Cycle { amplitude: stress, mean: 0.0 };
            return Used { spot, value: stress / allowable, slopes: (slope * s.torsion / allowable, 0.0), cycle };
        }
        let (amplitude, of_amplitude) = mises(bending.amplitude, twisting.amplitude);
        let (mean, of_mean) = mises(bending.mean, twisting.mean);
        let cycle = Cycle { amplitude, mean };
        let MarginCriterion::MeanStress(line) = self.criteria[criterion] else { unreachable!("spots of the class rule have a strength") };
        let (value, by_amplitude, by_mean) = line.utilisation(cycle, self.strength);
        Used { spot, value, slopes: (by_amplitude * of_amplitude * s.torsion, by_mean * of_mean * s.torsion), cycle }
    }

    /// The spot of a shaft that is used most.
    pub fn most_used(&self, criterion: usize, shaft: usize, speed_rpm: f64, torque: &Extremes) -> Option<Used> {
        let own = (0..self.spots.len()).filter(|i| self.spots[*i].shaft == shaft && self.judges(criterion, *i));
        own.map(|i| self.used(criterion, i, speed_rpm, torque)).reduce(|m, u| if u.value > m.value { u } else { m })
    }

    /// At least as much as the shaft can be used where the magnitudes of its orders add up to `sum`: half peak-to-peak and middle stay below it.
    pub fn bound(&self, criterion: usize, shaft: usize, speed_rpm: f64, sum: f64) -> f64 {
        let worst = |middle: f64| {
            let torque = Extremes { half_peak_to_peak: sum, middle, ..Extremes::default() };
            self.most_used(criterion, shaft, speed_rpm, &torque).map_or(0.0, |u| u.value)
        };
        worst(sum).max(worst(-sum))
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

/// Shafts whose torque the webs of the crank carry.
pub fn shafts(chain: &Chain, throws: usize) -> Vec<usize> {
    let mut shafts: Vec<usize> = (0..throws).filter_map(|t| shafts_beside(chain, t)).flatten().collect();
    shafts.sort_unstable();
    shafts.dedup();
    shafts
}

/// The shafts before and behind each throw; a throw at an end of the chain has the one beside it on both sides.
fn shafts_beside(chain: &Chain, throw: usize) -> Option<[usize; 2]> {
    let station = chain.stations.iter().position(|s| s.throws.contains(&throw))?;
    let last = chain.len().checked_sub(2)?;
    Some([station.saturating_sub(1).min(last), station.min(last)])
}

fn spots(chain: &Chain, crank: &Crank, spec: &FatigueSpec) -> Option<Vec<Spot>> {
    let mut list = Vec::new();
    let mean_stress = spec.criteria.iter().any(|c| *c != MarginCriterion::IacsM53);
    let notch = crank.notch();
    let sensitive = |factor: f64, radius: f64, torsion: bool| {
        let q = if spec.notch_sensitivity { endurance::notch_sensitivity(radius, spec.strength.tensile, torsion) } else { 1.0 };
        endurance::fatigue_factor(factor, q)
    };
    let torsion = |place: Place| match place {
        Place::Journal => section::torsion(crank.journal_diameter, crank.journal_bore),
        _ => section::torsion(crank.pin_diameter, crank.pin_bore),
    };
    let web = section::web_bending(crank.web_breadth, crank.bearing_web());
    let compression = section::web_compression(crank.web_breadth, crank.bearing_web());
    for fillet in spec.fillets.iter().filter(|_| mean_stress) {
        let (radius, round) = match fillet.place {
            Place::Journal => (crank.journal_fillet, section::bending(crank.journal_diameter, crank.journal_bore)),
            _ => (crank.pin_fillet, section::bending(crank.pin_diameter, crank.pin_bore)),
        };
        let (nominal, factors) = match fillet.factors {
            FactorSource::Given { bending, torsion } => (round, Factors { bending, radial: 0.0, torsion }),
            FactorSource::Formulas(formulas) => {
                let all = Concentration::new(&notch, formulas);
                (web, if fillet.place == Place::Journal { all.journal } else { all.crankpin })
            }
        };
        let throws = fillet.throw.map_or(0..crank.throws(), |t| t..t + 1);
        for throw in throws {
            for (rear, shaft) in shafts_beside(chain, throw)?.into_iter().enumerate() {
                list.push(Spot {
                    name: if fillet.throw.is_some() { fillet.name.clone() } else { format!("{}_{}", fillet.name, throw + 1) },
                    throw,
                    rear: rear == 1,
                    place: fillet.place,
                    shaft,
                    bending: [nominal * sensitive(factors.bending, radius, false), 0.0],
                    radial: compression * factors.radial,
                    torsion: torsion(fillet.place) * sensitive(factors.torsion, radius, true),
                    allowable: None,
                });
            }
        }
    }
    if spec.criteria.contains(&MarginCriterion::IacsM53) {
        let all = Concentration::new(&notch, Formulas::IacsM53);
        let mut places = vec![(Place::Crankpin, all.crankpin, [web, 0.0], crank.pin_diameter, crank.pin_fillet)];
        places.push((Place::Journal, all.journal, [web, 0.0], crank.journal_diameter, crank.journal_fillet));
        if let (Some(factors), Some(bore)) = (all.oil_bore, crank.oil_bore) {
            let pin = section::bending(crank.pin_diameter, crank.pin_bore);
            let planes = [pin * bore.angle.cos(), pin * bore.angle.sin()];
            places.push((Place::OilBore, factors, planes, crank.pin_diameter, 0.5 * bore.diameter));
        }
        for throw in 0..crank.throws() {
            for (place, factors, nominal, diameter, radius) in &places {
                for (rear, shaft) in shafts_beside(chain, throw)?.into_iter().enumerate() {
                    list.push(Spot {
                        name: format!("{}_{}", place.name(), throw + 1),
                        throw,
                        rear: rear == 1,
                        place: *place,
                        shaft,
                        bending: nominal.map(|n| n * factors.bending),
                        radial: compression * factors.radial,
                        torsion: torsion(*place) * factors.torsion,
                        allowable: Some(spec.rule.fatigue_strength(*diameter, *radius, *place == Place::OilBore)),
                    });
                }
            }
        }
    }
    Some(list)
}
