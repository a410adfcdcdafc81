//! What a study assumes of its engine, a line each: said wherever results are.

use super::table::{significant, table};
use crate::analysis::reciprocating::frequencies;
use crate::analysis::{DutyOfDesign, Results};
use crate::engine::{Pressure, Source};
use crate::input::Study;
use crate::units::DEG_PER_RAD;
use std::fmt::Write;

/// A mode whose frequency changes by more than so many times that of the lowest is told of, too.
const MUCH_MORE: f64 = 1.5;

/// Whether the chain holds the mean inertia of the reciprocating masses, and what that does; nothing where the torque comes from a table.
#[doc(hidden)]
pub fn reciprocating(study: &Study) -> Option<String> {
    let f = frequencies(study)?;
    let shares: Vec<f64> = f.with.iter().zip(&f.without).map(|(with, without)| 100.0 * (1.0 - with / without)).collect();
    let (each, share) = (significant(f.each, 4), shares[0]);
    // inertia lowers every frequency: anything else is rounding, of a frequency near zero
    let is_known = (-0.05..=100.0).contains(&share);
    // of an engine that hangs on soft springs, a dual-mass flywheel, the lowest mode hardly moves the cranks
    let others = shares.iter().enumerate().skip(1).filter(|(_, other)| **other > MUCH_MORE * share);
    let others: String = others.map(|(i, other)| format!(", f{} by {other:.1} %", i + 1)).collect();
    let said = match study.reciprocating {
        r if r.stated => "stated in the engine file",
        r if r.mean => "the default of inertias that follow from dimensions",
        _ => "the default of inertias that are given",
    };
    Some(if !is_known {
        let (value, done) = if study.reciprocating.mean { ("mean", "added") } else { ("none", "left out") };
        format!(
            "reciprocating_inertia = \"{value}\" ({said}): {each} kg m² a cylinder are {done}; f1 is too near to zero to tell what that does"
        )
    } else if study.reciprocating.mean {
        format!("reciprocating_inertia = \"mean\" ({said}): {each} kg m² a cylinder are added, which lowers f1 by {share:.1} %{others}")
    } else {
        format!(
            "reciprocating_inertia = \"none\" ({said}): {each} kg m² a cylinder are left out; \"mean\" would lower f1 by {share:.1} %{others}"
        )
    })
}

/// Which pressure bends the crank; nothing where there is one only.
pub(crate) fn crank_pressure(study: &Study) -> Option<String> {
    let (Some(_), Some(_)) = (&study.crank, &study.fatigue) else { return None };
    let Source::Cylinder { pressure: Pressure::Otto(otto), .. } = &study.engine.source else { return None };
    let scale = significant(otto.pressure_scale, 4);
    Some(match study.crank_engine {
        Some(_) => format!(
            "The crank bears the pressure and the mean torque of the brake curve; the excitation has {scale} of it (pressure_scale)."
        ),
        None => format!(
            "The crank bears the pressure of the excitation, {scale} of that of the brake curve: margins may be on the unsafe side."
        ),
    })
}

/// The designs over the duty; empty without one.
#[doc(hidden)]
pub fn duty(results: &Results) -> String {
    let Some(first) = results.duty.first() else { return String::new() };
    let numbers: Vec<String> = (1..=first.points.len()).map(|n| format!("point {n}")).collect();
    let header: Vec<&str> = ["design", "mean heat/W"].into_iter().chain(numbers.iter().map(String::as_str)).collect();
    let row = |d: &DutyOfDesign| -> Vec<String> {
        let twists = d.points.iter().map(|p| significant(p.twist * DEG_PER_RAD, 4));
        [d.design.clone(), significant(d.mean_power(), 3)].into_iter().chain(twists).collect()
    };
    let rows: Vec<Vec<String>> = results.duty.iter().map(row).collect();
    let mut text = format!("Duty: twist/° at each point, mean heat of the absorbers over all:\n{}", table(&header, &rows));
    for (n, r) in first.points.iter().enumerate() {
        let p = r.point;
        let _ = writeln!(
            text,
            "  point {}: {} rpm, {:.0} % of full load, {:.0} % of the time",
            n + 1,
            p.speed_rpm,
            100.0 * p.load_fraction,
            100.0 * p.share
        );
    }
    text
}
