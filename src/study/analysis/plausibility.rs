//! Inputs that are possible but unlikely: most often a wrong unit or a wrong dimension.

use crate::absorber::two_stage::CARRIED;
use crate::drivetrain::Station;
use crate::engine::excitation::Audit;
use crate::engine::{Geometry, Pressure, Source};
use crate::fatigue::shaft_rules::ShaftRule;
use crate::input::{LimitSpec, Size, Study};
use crate::units::{HZ_PER_RAD_PER_S, HZ_PER_RPM, M_PER_MM, PA_PER_BAR, PA_PER_MPA};

/// Something unlikely.
#[derive(Debug, Clone, PartialEq)]
#[doc(hidden)]
pub enum Implausible {
    /// Peak pressure of the cylinder, bar absolute.
    PeakPressure {
        /// rpm.
        speed_rpm: f64,
        /// bar.
        bar: f64,
    },
    /// Indicated mean pressure, bar.
    MeanPressure {
        /// rpm.
        speed_rpm: f64,
        /// bar.
        bar: f64,
    },
    /// Mean piston speed at the highest speed of the study, m/s.
    PistonSpeed {
        /// rpm.
        speed_rpm: f64,
        /// m/s.
        metres_per_second: f64,
    },
    /// Bore, mm.
    Bore(f64),
    /// Stroke over bore.
    Stroke {
        /// Stroke, mm.
        stroke_mm: f64,
        /// Over the bore.
        over_bore: f64,
    },
    /// Crank radius over rod length.
    RodRatio(f64),
    /// A torque or pressure known at one speed, rpm, that is taken for a range.
    OneSpeed {
        /// What is known.
        of: Known,
        /// rpm.
        speed_rpm: f64,
    },
    /// A torque or pressure known over a part of the speeds, that is held at its ends.
    Held {
        /// What is known.
        of: Known,
        /// From and to, rpm.
        known_rpm: (f64, f64),
        /// Of the study, rpm.
        study_rpm: (f64, f64),
    },
    /// Piston, kg, over the cube of the bore, kg/m³.
    PistonMass {
        /// kg.
        mass: f64,
        /// kg/m³.
        over_cube: f64,
    },
    /// Indicated mean pressure over the peak.
    Fullness {
        /// rpm.
        speed_rpm: f64,
        /// The ratio.
        ratio: f64,
    },
    /// Twist of the softest shaft between throws by the gas force of one cylinder at its peak, rad.
    Windup(f64),
    /// A ring that may be larger, kg m², than all inertias of the chain together, kg m².
    Ring {
        /// Of the ring.
        ring: f64,
        /// Of the chain.
        chain: f64,
    },
    /// Cylinders that fire in part of the cycle only: the longest pause, degrees, and that of even firing.
    Firing {
        /// Degrees.
        longest: f64,
        /// Degrees.
        even: f64,
    },
    /// A throw whose inertia, kg m², is far from what its reciprocating masses ask for, m r², kg m².
    ThrowInertia {
        /// Index of its station.
        station: usize,
        /// Of the station by throw, kg m².
        inertia: f64,
        /// Of the reciprocating masses, all cylinders of a throw, kg m².
        reciprocating: f64,
    },
    /// A chain without damping in a design without absorber.
    Undamped,
    /// Lowest natural frequency of the chain, Hz.
    NaturalFrequency(f64),
    /// Damping ratio of a mode of the chain, from 0.
    DampingRatio {
        /// Index among elastic modes.
        mode: usize,
        /// Share of critical.
        ratio: f64,
    },
    /// A limit by a society's rule, which ends below the highest speed of the study.
    RuleEnds {
        /// In words.
        limit: String,
        /// Where it ends, rpm.
        end_rpm: f64,
        /// Highest speed of the study, rpm.
        highest_rpm: f64,
    },
    /// A limit by IACS UR M68 that counts a tensile strength which it has for alloy steel alone.
    TensileStrength {
        /// In words.
        limit: String,
        /// MPa.
        mpa: f64,
    },
    /// A limit by a society's rule, whose rated speed the study does not reach.
    RatedSpeed {
        /// In words.
        limit: String,
        /// Of the crankshaft, rpm.
        rated_rpm: f64,
        /// Highest speed of the study, rpm.
        highest_rpm: f64,
    },
    /// Frequency of a given ring on its held hub over the nearest natural frequency of the chain.
    Tuning {
        /// Name of the design.
        design: String,
        /// Index of the absorber.
        absorber: usize,
        /// The ratio.
        ratio: f64,
    },
}

/// What an engine file tells over speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[doc(hidden)]
pub enum Known {
    /// Pressure traces.
    Pressure,
    /// A curve of torque, power or mean pressure.
    Curve,
    /// Harmonics of the torque.
    Harmonics,
}

/// bar.
const PEAK: std::ops::RangeInclusive<f64> = 5.0..=400.0;
/// bar; from part load to the highest of large two-strokes and racing engines.
const MEAN: std::ops::RangeInclusive<f64> = 0.0..=40.0;
/// m/s.
const PISTON_SPEED: f64 = 30.0;
/// Share of a speed by which another may differ and be called the same.
const NEAR: f64 = 0.05;
/// Speeds this near are the same, rpm.
const SAME_SPEED: f64 = 1e-9;
/// kg/m³: cars have 1000 to 1500, crossheads with their rods up to 10000.
const PISTON: std::ops::RangeInclusive<f64> = 100.0..=30_000.0;
/// Of the peak: 0.1 to 0.25 where burning begins near dead centre.
const FULLNESS: f64 = 0.32;
/// Longest pause between firings over that of even firing: parallel twins at 180 degrees have 1.5, cylinders that fire in pairs up to 1.9.
const PAUSE: f64 = 1.95;
/// rad: cranks of cars have a hundredth.
const WINDUP: f64 = 0.15;
/// mm.
const BORE: f64 = 20.0;
/// Engines for cars have 0.7 to 1.3, slow two-strokes up to 5 with crossheads.
const STROKE: std::ops::RangeInclusive<f64> = 0.3..=5.5;
/// Above one half a rod meets the liner; below a tenth it is needlessly long.
const ROD_RATIO: std::ops::RangeInclusive<f64> = 0.1..=0.5;
/// Hz.
const FREQUENCY: std::ops::RangeInclusive<f64> = 1.0..=10_000.0;
/// Of critical: shafts have 0.005 to 0.05.
const DAMPING: f64 = 0.2;
/// Inertia of a throw over m r² of its reciprocating masses: shipped engines have 1.2 to 3.9.
const THROW: std::ops::RangeInclusive<f64> = 0.4..=60.0;
/// Pa.
const OF_ANY_STEEL: f64 = 600.0 * PA_PER_MPA;
/// Optima lie between one half and three.
const TUNING: std::ops::RangeInclusive<f64> = 0.1..=10.0;

/// What is unlikely in a study; `audit`: of its pressure.
#[doc(hidden)]
pub fn implausible(study: &Study, audit: &[Audit]) -> Vec<Implausible> {
    let mut found = Vec::new();
    // the worst speed speaks for all
    let worst = |value: fn(&Audit) -> f64, likely: std::ops::RangeInclusive<f64>| {
        let away = |a: &Audit| (value(a) - likely.end()).max(likely.start() - value(a));
        audit.iter().filter(|a| away(a) > 0.0).max_by(|a, b| away(a).total_cmp(&away(b))).map(|a| (a.speed_rpm, value(a)))
    };
    found.extend(worst(|a| a.peak_pressure / PA_PER_BAR, PEAK).map(|(speed_rpm, bar)| Implausible::PeakPressure { speed_rpm, bar }));
    found.extend(
        worst(|a| a.indicated_mean_pressure / PA_PER_BAR, MEAN).map(|(speed_rpm, bar)| Implausible::MeanPressure { speed_rpm, bar }),
    );
    if let Source::Cylinder { geometry, .. } = &study.engine.source {
        let fullness = |a: &Audit| a.indicated_mean_pressure / a.peak_pressure;
        let full = audit.iter().max_by(|a, b| fullness(a).total_cmp(&fullness(b))).filter(|a| fullness(a) > FULLNESS);
        found.extend(full.map(|a| Implausible::Fullness { speed_rpm: a.speed_rpm, ratio: fullness(a) }));
        found.extend(windup(study, geometry, audit).filter(|twist| *twist > WINDUP).map(Implausible::Windup));
        found.extend(
            pause(study).filter(|(longest, even)| *longest > PAUSE * even).map(|(longest, even)| Implausible::Firing { longest, even }),
        );
        found.extend(throw_inertia(study));
        found.extend(beyond_what_is_known(study));
        found.extend(of_cylinder(geometry, study.speeds_rpm.iter().copied().fold(0.0, f64::max)));
    }
    if let Source::Harmonics(_) = &study.engine.source {
        found.extend(beyond_what_is_known(study));
    }
    let modes: Vec<usize> = study.modes.elastic().collect();
    let frequencies: Vec<f64> = modes.iter().map(|m| study.modes.omega[*m] * HZ_PER_RAD_PER_S).collect();
    let lowest = frequencies.first().copied();
    found.extend(lowest.filter(|f| !FREQUENCY.contains(f)).map(Implausible::NaturalFrequency));
    let damped = modes.iter().enumerate().map(|(mode, m)| (mode, study.modes.damping_ratio(*m))).find(|(_, ratio)| *ratio > DAMPING);
    found.extend(damped.map(|(mode, ratio)| Implausible::DampingRatio { mode, ratio }));
    found.extend(rings(study));
    let highest_rpm = study.speeds_rpm[study.speeds_rpm.len() - 1];
    found.extend(study.limits.iter().filter_map(|limit| rule_ends(limit, highest_rpm)));
    found.extend(study.limits.iter().filter_map(|limit| not_reached(limit, highest_rpm)));
    found.extend(study.limits.iter().filter_map(strong));
    let stations = &study.chain.stations;
    let damps = stations.iter().any(|s| s.damping_to_ground > 0.0 || s.damping_to_next > 0.0 || s.loss_factor_to_next > 0.0);
    if !damps && study.designs.iter().any(|d| d.absorbers.is_empty()) {
        found.push(Implausible::Undamped);
    }
    for design in &study.designs {
        for (absorber, m) in design.absorbers.iter().enumerate() {
            let Some(stiffness) = m.absorber.stiffness().filter(|k| *k > 0.0) else { continue };
            if m.absorber.value(CARRIED.key).is_some_and(|torque| torque > 0.0) {
                continue;
            }
            // a low mode of a shafting, say, is none of a damper that the crank has
            let own = (stiffness / m.absorber.ring_inertia()).sqrt() * HZ_PER_RAD_PER_S;
            let far = |f: &f64| (own / f).max(f / own);
            let Some(ratio) = frequencies.iter().min_by(|a, b| far(a).total_cmp(&far(b))).map(|f| own / f) else { continue };
            if ratio.is_finite() && !TUNING.contains(&ratio) {
                found.push(Implausible::Tuning { design: design.name.clone(), absorber, ratio });
            }
        }
    }
    found
}

/// The station of throws whose inertia is farthest from the reciprocating masses of its cylinders, where that is too far.
fn throw_inertia(study: &Study) -> Option<Implausible> {
    let per_cylinder = 2.0 * study.engine.reciprocating_inertia()?;
    let reciprocating = per_cylinder * study.engine.layout.rods_per_throw as f64;
    let inertia_per_throw = |(station, s): (usize, &Station)| (!s.throws.is_empty()).then(|| (station, s.inertia / s.throws.len() as f64));
    let far = |inertia: f64| {
        let ratio = inertia / reciprocating;
        (ratio / THROW.end()).max(THROW.start() / ratio)
    };
    let all = study.chain.stations.iter().enumerate().filter_map(inertia_per_throw).filter(|(_, inertia)| far(*inertia) > 1.0);
    let (station, inertia) = all.max_by(|a, b| far(a.1).total_cmp(&far(b.1)))?;
    Some(Implausible::ThrowInertia { station, inertia, reciprocating })
}

/// A limit by a rule, where the speeds of the study go on beyond that: the last corner of its curve is where it ends.
fn rule_ends(limit: &LimitSpec, highest_rpm: f64) -> Option<Implausible> {
    limit.rule.as_ref()?;
    let end_rpm = limit.of.measure.within.factors.last()?.0;
    (end_rpm < highest_rpm).then(|| Implausible::RuleEnds { limit: limit.words.clone(), end_rpm, highest_rpm })
}

/// A limit by a rule whose rated speed the study does not reach, by more than the digits it is written with.
fn not_reached(limit: &LimitSpec, highest_rpm: f64) -> Option<Implausible> {
    let rated_rpm = limit.rule.as_ref()?.rated_rpm;
    let is_above = rated_rpm > highest_rpm * (1.0 + NEAR);
    is_above.then(|| Implausible::RatedSpeed { limit: limit.words.clone(), rated_rpm, highest_rpm })
}

/// A limit by the rule for propulsion shafts with more strength than it counts of carbon steel and of propeller shafts \[IACS UR M68, 3\].
fn strong(limit: &LimitSpec) -> Option<Implausible> {
    match limit.rule.as_ref()?.rule {
        ShaftRule::Propulsion { tensile, .. } if tensile > OF_ANY_STEEL => {
            Some(Implausible::TensileStrength { limit: limit.words.clone(), mpa: tensile / PA_PER_MPA })
        }
        _ => None,
    }
}

/// A study whose speeds the engine file does not cover.
fn beyond_what_is_known(study: &Study) -> Option<Implausible> {
    let (low, high) = study.known_rpm?;
    let study_rpm = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    let of = match &study.engine.source {
        Source::Harmonics(_) => Known::Harmonics,
        Source::Cylinder { pressure: Pressure::Measured(_), .. } => Known::Pressure,
        Source::Cylinder { .. } => Known::Curve,
    };
    if low == high {
        let is_far = study.speeds_rpm.iter().any(|s| (s / low - 1.0).abs() > NEAR);
        return is_far.then_some(Implausible::OneSpeed { of, speed_rpm: low });
    }
    let is_beyond = study_rpm.0 < low - SAME_SPEED || study_rpm.1 > high + SAME_SPEED;
    is_beyond.then_some(Implausible::Held { of, known_rpm: (low, high), study_rpm })
}

/// The longest pause between firings and that of even firing, degrees; nothing of one cylinder.
fn pause(study: &Study) -> Option<(f64, f64)> {
    let cycle = study.engine.cycle_deg();
    let mut firing: Vec<f64> = study.engine.layout.firing_deg.iter().map(|f| f.rem_euclid(cycle)).collect();
    firing.sort_by(f64::total_cmp);
    let last = cycle - firing.last()? + firing.first()?;
    let longest = firing.windows(2).map(|w| w[1] - w[0]).fold(last, f64::max);
    (firing.len() > 1).then(|| (longest, cycle / firing.len() as f64))
}

/// The largest ring that an optimum may have, where it is larger than the chain.
fn rings(study: &Study) -> Option<Implausible> {
    let chain = study.chain.total_inertia();
    let largest = |size: &Size| match size {
        Size::Between(_, most) => *most,
        Size::Each(list) => list.iter().copied().fold(0.0, f64::max),
    };
    let ring = study.optimise.iter().flat_map(|o| &o.absorbers).map(|a| largest(&a.size)).fold(0.0, f64::max);
    (ring > chain).then_some(Implausible::Ring { ring, chain })
}

/// Twist of the softest shaft from a throw to the next station with one by the gas force of a cylinder at its peak on the crank radius, rad.
fn windup(study: &Study, geometry: &Geometry, audit: &[Audit]) -> Option<f64> {
    let peak = audit.iter().map(|a| a.peak_pressure).fold(0.0, f64::max);
    let torque = peak * geometry.piston_area() * geometry.slider_crank.crank_radius;
    let between = study.chain.stations.windows(2).filter(|s| !s[0].throws.is_empty() && !s[1].throws.is_empty());
    let softest = between.map(|s| s[0].stiffness_to_next).filter(|k| *k > 0.0).fold(f64::INFINITY, f64::min);
    (study.chain.is_row() && softest.is_finite()).then_some(torque / softest)
}

fn of_cylinder(g: &Geometry, speed_rpm: f64) -> Vec<Implausible> {
    let mut found = Vec::new();
    let (stroke, bore) = (2.0 * g.slider_crank.crank_radius, g.bore);
    let metres_per_second = 2.0 * stroke * speed_rpm * HZ_PER_RPM;
    if metres_per_second > PISTON_SPEED {
        found.push(Implausible::PistonSpeed { speed_rpm, metres_per_second });
    }
    if bore < BORE * M_PER_MM {
        found.push(Implausible::Bore(bore / M_PER_MM));
    }
    if !STROKE.contains(&(stroke / bore)) {
        found.push(Implausible::Stroke { stroke_mm: stroke / M_PER_MM, over_bore: stroke / bore });
    }
    let over_cube = g.piston_mass / bore.powi(3);
    if g.piston_mass > 0.0 && !PISTON.contains(&over_cube) {
        found.push(Implausible::PistonMass { mass: g.piston_mass, over_cube });
    }
    let ratio = g.slider_crank.crank_radius / g.slider_crank.rod_length;
    if !ROD_RATIO.contains(&ratio) {
        found.push(Implausible::RodRatio(ratio));
    }
    found
}
