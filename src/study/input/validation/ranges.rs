//! Speeds, orders and load of a study against what the engine file has.

use crate::crankshaft::stations_of_throws;
use crate::drivetrain::Chain;
use crate::engine::{Engine, Order, Source};
use crate::input::error::{At, Check};
use crate::input::schema::fatigue::RawFatigue;
use crate::input::schema::study::{RawSpeeds, RawStudy};

/// More points than this in a sweep would take gigabytes: a mistake in the file.
pub(crate) const MOST_POINTS: f64 = 5e6;
/// More speeds than this are a mistake, too.
const MOST_SPEEDS: f64 = 200_000.0;

pub fn speeds(check: &mut Check, study: &RawStudy) -> Vec<f64> {
    speeds_of(check, &study.speed_rpm)
}

/// Ascending speeds, at least one, rpm.
pub(super) fn speeds_of(check: &mut Check, range: &At<RawSpeeds>) -> Vec<f64> {
    let raw = range.get_ref();
    let before = check.mistakes.len();
    let (from, to, step) = (check.positive(&raw.from), check.positive(&raw.to), check.positive(&raw.step));
    if to < from {
        check.wrong(&raw.to, format!("found an empty speed range, {from} to {to} rpm, expected `to` of at least `from`"));
    }
    let steps = ((to - from) / step + 1e-9).floor();
    if steps.is_finite() && steps > MOST_SPEEDS {
        check.wrong(&raw.step, format!("found a step of {step} rpm, which makes {steps} speeds, expected at most {MOST_SPEEDS}"));
    }
    if check.mistakes.len() > before {
        return vec![from];
    }
    let mut speeds: Vec<f64> = (0..=steps as usize).map(|i| from + i as f64 * step).collect();
    let last = speeds[speeds.len() - 1];
    // the highest speed belongs to the range even where the step does not meet it
    if to - last > 1e-6 * step {
        speeds.push(to);
    }
    speeds
}

/// A margin needs the torque beside every throw.
pub(crate) fn check_throws(check: &mut Check, fatigue: &At<RawFatigue>, chain: &Chain) {
    let throws = chain.stations.iter().map(|s| s.throws.len()).sum();
    let found = if chain.len() == 1 || chain.stations.iter().any(|s| s.throws.len() > 1) {
        "found [fatigue] for a chain with several throws on a station or without shafts, expected a station for each throw"
    } else if stations_of_throws(chain, throws).is_none() {
        "found [fatigue] for a chain whose throws do not follow each other, expected them in the order of their numbers"
    } else {
        let falls = stations_of_throws(chain, throws).is_some_and(|s| s.windows(2).any(|p| p[0] > p[1]));
        if let Some(at) = fatigue.get_ref().torsion_case.as_ref().filter(|_| falls) {
            let words = "found a torsion case for a chain that leads from the last throw to the first, expected the other way: its torques are summed up to the last throw";
            check.wrong(at, words);
        }
        return;
    };
    check.wrong(fatigue, found);
}

pub(crate) fn check_orders(check: &mut Check, study: &RawStudy, engine: &Engine, limit: f64) {
    let some = match &engine.source {
        Source::Cylinder { .. } => !Order::up_to(limit, engine.strokes).is_empty(),
        Source::Harmonics(table) => table.masses.is_some() || table.harmonics.iter().any(|(o, c)| o.value() <= limit && c.norm() > 0.0),
    };
    if !some {
        let message = format!("found no order of the torque up to {limit}, expected at least one that is not zero");
        match &study.order_limit {
            Some(o) => check.wrong(o, message),
            None => check.wrong(&study.engine, message),
        }
    }
}

/// The lowest and highest speed at which the engine file tells the torque or pressure, rpm; None where it does not depend on speed. Several speeds must meet the study's:
/// beyond them the values at their ends are held.
pub(crate) fn known_speeds(check: &mut Check, study: &RawStudy, engine: &Engine, speeds: &[f64]) -> Option<(f64, f64)> {
    let table = match &engine.source {
        Source::Cylinder { pressure, .. } => pressure.speeds_rpm().to_vec(),
        Source::Harmonics(table) => table.speeds_rpm(),
    };
    let (low, high) = (*table.first()?, *table.last()?);
    let (first, last) = (speeds[0], speeds[speeds.len() - 1]);
    if table.len() > 1 && (last < low || first > high) {
        check.wrong(
            &study.speed_rpm,
            format!(
                "found {first} to {last} rpm, expected a range that meets the torque or pressure table of the engine, {low} to {high} rpm"
            ),
        );
    }
    Some((low, high))
}
