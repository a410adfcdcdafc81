//! Load of the engine: a share of full load, over speed, and the points of a duty.

use crate::engine::load::LARGEST_LOAD;
use crate::engine::{Engine, Load, Source};
use crate::input::error::{At, Check};
use crate::input::schema::bounds::{LOAD, SHARE_OF_TIME, from_to};
use crate::input::schema::study::{RawDuty, RawPartLoad, RawStudy};

/// Shares of a duty add up to one this closely.
const SUM: f64 = 1e-6;

/// A point at which the engine runs for a share of its time.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct DutyPoint {
    /// rpm.
    pub speed_rpm: f64,
    /// Share of full load, 0 to 1.2.
    pub load_fraction: f64,
    /// Share of the time.
    pub share: f64,
}

fn share_of_full_load(check: &mut Check, raw: &At<f64>) -> f64 {
    let x = *raw.get_ref();
    if (2.0..=100.0 * LARGEST_LOAD).contains(&x) {
        let words = format!("found {x}, expected {}", LOAD.expected());
        check.wrong_with_help(raw, words, format!("a fraction, not per cent: {x} % is {}", x / 100.0));
        return 1.0;
    }
    check.within(raw, &LOAD)
}

/// Puts the engine at the load of the study.
pub(super) fn apply(check: &mut Check, study: &RawStudy, engine: &mut Engine, speeds: &[f64]) {
    let range = (speeds[0], speeds[speeds.len() - 1]);
    if let Some(fraction) = &study.load_fraction {
        if let Some(part) = &study.part_load {
            check.wrong(part, "found [part_load] beside `load_fraction`, expected one of them");
            return;
        }
        let load = Load::constant(share_of_full_load(check, fraction));
        set(check, fraction, engine, (&load, range));
    } else if let Some(part) = &study.part_load {
        let load = over_speed(check, part.get_ref());
        set(check, part, engine, (&load, range));
    }
}

fn over_speed(check: &mut Check, raw: &RawPartLoad) -> Load {
    let before = check.mistakes.len();
    let speeds_rpm = check.ascending(&raw.speed_rpm);
    let fraction: Vec<f64> = raw.fraction.get_ref().iter().map(|f| share_of_full_load(check, f)).collect();
    if fraction.len() != speeds_rpm.len() {
        let words = format!("found {} values, expected one for each of the {} speeds", fraction.len(), speeds_rpm.len());
        check.wrong(&raw.fraction, words);
    }
    // a mistake stops the study: full load is as good as any other
    if check.mistakes.len() > before { Load::constant(1.0) } else { Load { speeds_rpm, fraction } }
}

fn set<T>(check: &mut Check, at: &At<T>, engine: &mut Engine, (load, range): (&Load, (f64, f64))) {
    match &mut engine.source {
        Source::Cylinder { pressure, .. } => match pressure.at_load(load, range) {
            Some(part) => *pressure = part,
            None => {
                check.wrong(at, "found a load outside those of the measured traces, expected columns like `1600_rpm_50_percent_bar` for it")
            }
        },
        Source::Harmonics(_) => check.wrong(at, "found a load with torque harmonics, expected it with a cylinder pressure only"),
    }
}

/// The duty: points within the study's speeds, whose shares add up to one.
pub(super) fn duty(check: &mut Check, study: &RawStudy, engine: &Engine, speeds: &[f64]) -> Vec<DutyPoint> {
    let points: Vec<DutyPoint> = study.duty.iter().map(|raw| point(check, raw, engine, speeds)).collect();
    if let Some(first) = study.duty.first() {
        let sum: f64 = points.iter().map(|p| p.share).sum();
        if (sum - 1.0).abs() > SUM {
            check.wrong(&first.share, format!("found shares of the duty that add up to {sum}, expected 1"));
        }
        if study.load_fraction.is_some() || study.part_load.is_some() {
            check.wrong(&first.load_fraction, "found [[duty]] beside a load of the whole study, expected one of them");
        }
    }
    points
}

fn point(check: &mut Check, raw: &RawDuty, engine: &Engine, speeds: &[f64]) -> DutyPoint {
    let (low, high) = (speeds[0], speeds[speeds.len() - 1]);
    let load_fraction = share_of_full_load(check, &raw.load_fraction);
    let reached = match &engine.source {
        Source::Cylinder { pressure, .. } => pressure.at_load(&Load::constant(load_fraction), (low, high)).is_some(),
        Source::Harmonics(_) => false,
    };
    if !reached {
        check.wrong(
            &raw.load_fraction,
            "found a load that this torque does not have, expected measured traces on both sides of it, in columns like `1600_rpm_50_percent_bar`, or a cycle",
        );
    }
    DutyPoint {
        speed_rpm: check.within(&raw.speed_rpm, &from_to("a speed of the study,", low, high, " rpm")),
        load_fraction,
        share: check.within(&raw.share, &SHARE_OF_TIME),
    }
}
