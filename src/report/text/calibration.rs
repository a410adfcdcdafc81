//! What is printed of a calibration.

use super::table::{significant, table};
use crate::analysis::Calibration;
use crate::analysis::calibrate::Known;
use crate::input::Study;
use crate::units::DEG_PER_RAD;
use std::fmt::Write;

/// In words, how well an input is known.
pub fn known(known: Known) -> &'static str {
    match known {
        Known::Yes => "identified",
        Known::AtBound => "on its bound",
        Known::NotIdentified => "NOT identified by these rows",
        Known::NoFreedom => "as many inputs as rows",
    }
}

/// Inputs with standard errors and correlations, what was held, and how well the rows fit.
pub fn calibration(study: &Study, c: &Calibration) -> String {
    let error = |e: Option<f64>| match e {
        Some(e) if e.is_finite() => significant(e, 2),
        Some(_) => "infinite".into(),
        None => "-".into(),
    };
    let rows: Vec<Vec<String>> = c
        .inputs
        .iter()
        .map(|i| {
            vec![
                i.free.input.key().to_owned(),
                format!("{}{}", significant(i.free.start, 4), if i.free.varies { " (mean)" } else { "" }),
                significant(i.value, 4),
                error(i.standard_error),
                format!("{} to {}", i.free.lower, i.free.upper),
                known(i.known).to_owned(),
            ]
        })
        .collect();
    let mut text = format!("Calibrated:\n{}", table(&["input", "in file", "fitted", "std. error", "bounds", ""], &rows));
    let (before, after) = c.rms();
    let before = before * DEG_PER_RAD;
    let before = if before < 90.0 { format!("{before:.4}°") } else { "beyond 90°".into() };
    let deviation = c.statistics.deviation.map_or_else(String::new, |s| format!(", standard deviation {:.4}°", s * DEG_PER_RAD));
    // writing to a string cannot fail
    let _ = writeln!(
        text,
        "  against {} amplitudes: root mean square off by {before} before, {:.4}° after{deviation}; {} of {} starts agree",
        c.rows.len(),
        after * DEG_PER_RAD,
        c.agreeing.0,
        c.agreeing.1
    );
    for (i, a) in c.inputs.iter().enumerate() {
        for (j, b) in c.inputs.iter().enumerate().skip(i + 1) {
            if let Some(r) = c.statistics.correlation[i][j] {
                let _ = writeln!(text, "  correlation of {} and {}: {r:.2}", a.free.input.key(), b.free.input.key());
            }
        }
    }
    for (a, b, _) in c.alike() {
        let _ = writeln!(text, "  {} and {} cannot be told apart by these rows: hold one of them", a.key(), b.key());
    }
    for i in c.inputs.iter().filter(|i| i.known == Known::NotIdentified) {
        let _ = writeln!(text, "  {} is not identified: its standard error is as large as itself or its bounds", i.free.input.key());
    }
    if !c.by_hand.is_empty() {
        let held: Vec<String> = c.by_hand.iter().map(|(i, v)| format!("{} {}", i.key(), significant(*v, 4))).collect();
        let _ = writeln!(text, "  tuned by hand beforehand, and held: {}", held.join(", "));
    }
    let excluded = study.calibrate.as_ref().map_or(&[][..], |s| &s.excluded);
    if let (false, Some(published)) = (excluded.is_empty(), &study.published) {
        let row = |i: &usize| {
            let a = &published.amplitudes[*i];
            format!("order {} of {} at {} rpm", a.order, study.designs[a.design].name, a.speed_rpm)
        };
        let _ = writeln!(text, "  excluded: {}", excluded.iter().map(row).collect::<Vec<_>>().join(", "));
    }
    text
}
