//! Tables of the engine file: measured pressure traces and torque harmonics.

use super::table::Table;
use crate::engine::Order;
use crate::engine::pressure::Measured;
use crate::input::error::InputError;
use crate::numerics::C64;
use crate::units::{PA_PER_BAR, RAD_PER_DEG};
use std::path::Path;

/// `crank_deg` from firing dead centre over a whole cycle, then a column `<speed>_rpm_bar` a speed, absolute.
///
/// # Errors
/// [`InputError`] with row and column.
pub(crate) fn pressure_traces(path: &Path, cycle_deg: f64) -> Result<Measured, InputError> {
    let table = Table::read(path)?;
    let rows = table.numbers()?;
    let angle = table.column("crank_deg")?;
    let mut traces: Vec<(f64, usize)> = Vec::new();
    for (i, name) in table.header.iter().enumerate().filter(|(i, _)| *i != angle) {
        let speed = name.strip_suffix("_rpm_bar").and_then(|s| s.parse::<f64>().ok()).filter(|s| s.is_finite() && *s > 0.0);
        match speed {
            Some(speed) if traces.iter().any(|t| t.0 == speed) => {
                return Err(table.at(1, i, format!("found a second trace for {speed} rpm")));
            }
            Some(speed) => traces.push((speed, i)),
            None => return Err(table.at(1, i, format!("found column `{name}`, expected a name like `1600_rpm_bar`"))),
        }
    }
    if traces.is_empty() {
        return Err(table.whole("found no pressure column, expected one a speed, named like `1600_rpm_bar`".into()));
    }
    traces.sort_by(|a, b| a.0.total_cmp(&b.0));
    if rows.len() < 24 {
        return Err(table.whole(format!("found {} rows, expected at least 24 over a cycle", rows.len())));
    }
    let crank_deg: Vec<f64> = rows.iter().map(|r| r.1[angle]).collect();
    for (pair, row) in crank_deg.windows(2).zip(&rows[1..]) {
        if pair[1] <= pair[0] {
            return Err(table.at(row.0, angle, format!("found {} after {}, expected ascending angles", pair[1], pair[0])));
        }
    }
    let widest = crank_deg.windows(2).map(|w| w[1] - w[0]).fold(0.0, f64::max);
    let span = crank_deg[crank_deg.len() - 1] - crank_deg[0];
    let last = rows[rows.len() - 1].0;
    if span > cycle_deg + 1e-6 || span + 1.5 * widest < cycle_deg {
        return Err(table.at(
            last,
            angle,
            format!("found a cycle of {span} degrees, expected {cycle_deg} (with or without its last angle)"),
        ));
    }
    let mut pressure = Vec::new();
    for &(_, column) in &traces {
        if let Some(row) = rows.iter().find(|r| r.1[column] <= 0.0) {
            return Err(table.at(row.0, column, format!("found {}, expected an absolute pressure above zero", row.1[column])));
        }
        pressure.push(rows.iter().map(|r| r.1[column] * PA_PER_BAR).collect());
    }
    Ok(Measured { speeds_rpm: traces.iter().map(|t| t.0).collect(), crank_deg, pressure })
}

/// `order, amplitude_n_m, phase_deg`: torque of a whole throw, A cos(n theta + phase) from the firing of its first cylinder.
///
/// # Errors
/// [`InputError`] with row and column.
pub(crate) fn torque_harmonics(path: &Path, strokes: u32) -> Result<Vec<(Order, C64)>, InputError> {
    let table = Table::read(path)?;
    let rows = table.numbers()?;
    let (order, amplitude, phase) = (table.column("order")?, table.column("amplitude_n_m")?, table.column("phase_deg")?);
    if let Some(i) = (0..table.header.len()).find(|i| ![order, amplitude, phase].contains(i)) {
        return Err(table.at(1, i, format!("found column `{}`, expected `order`, `amplitude_n_m` and `phase_deg` only", table.header[i])));
    }
    let step = 4 / strokes;
    let mut harmonics: Vec<(Order, C64)> = Vec::new();
    for (row, cells) in &rows {
        let twice = 2.0 * cells[order];
        let whole = twice.fract() == 0.0 && (1.0..=2000.0).contains(&twice) && (twice as u32).is_multiple_of(step);
        if !whole {
            let expected = if strokes == 4 { "a half or whole order from 0.5" } else { "a whole order from 1" };
            return Err(table.at(*row, order, format!("found {}, expected {expected}", cells[order])));
        }
        if cells[amplitude] < 0.0 {
            return Err(table.at(*row, amplitude, format!("found {}, expected at least zero", cells[amplitude])));
        }
        let o = Order::from_twice(twice as u32);
        if harmonics.iter().any(|h| h.0 == o) {
            return Err(table.at(*row, order, format!("found order {o} a second time")));
        }
        harmonics.push((o, C64::from_polar(cells[amplitude], cells[phase] * RAD_PER_DEG)));
    }
    if harmonics.is_empty() {
        return Err(table.whole("found no row, expected at least one harmonic".into()));
    }
    harmonics.sort_by_key(|h| h.0);
    Ok(harmonics)
}
