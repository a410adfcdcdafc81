//! Tables of the engine file: measured pressure traces and torque harmonics.

use super::table::Table;
use super::trace::fault;
use crate::engine::load::LARGEST_LOAD;
use crate::engine::pressure::{Measured, PartLoad};
use crate::engine::{HarmonicTable, Order};
use crate::input::error::InputError;
use crate::input::import::unit::{ANGLE, PRESSURE, known, parts, scale};
use crate::input::import::words;
use crate::numerics::C64;
use crate::units::{PA_PER_BAR, RAD_PER_DEG};
use std::path::Path;

/// Full load, per cent.
const FULL: f64 = 100.0;

/// Speed and load, per cent, of a column of pressures.
fn speed_and_load(name: &str) -> Option<(f64, f64)> {
    let (speed, rest) = name.strip_suffix("_bar")?.split_once("_rpm")?;
    let load = if rest.is_empty() { "100" } else { rest.strip_prefix('_')?.strip_suffix("_percent")? };
    let (speed, load) = (speed.parse::<f64>().ok()?, load.parse::<f64>().ok()?);
    (speed.is_finite() && speed > 0.0 && (0.0..=100.0 * LARGEST_LOAD).contains(&load)).then_some((speed, load))
}

/// What a head says of traces in other words: the angle of the crank, or a pressure with its speed and load.
fn said(head: &str) -> Option<(String, f64)> {
    // more than one column in a cell: what separates them is another sign
    if head.contains(['\t', ';', ',']) {
        return None;
    }
    if speed_and_load(head).is_some() {
        return Some((head.to_owned(), 1.0));
    }
    let (words, unit) = parts(head);
    let unit = unit.filter(|_| scale(&words).is_none())?;
    if let (Some((speed, load)), Some(factor)) = (words::speed_and_load(&words), known(PRESSURE.0, &unit)) {
        let key = if load == FULL { format!("{speed}_rpm_bar") } else { format!("{speed}_rpm_{load}_percent_bar") };
        return (words::not_absolute(head).is_none() && speed_and_load(&key).is_some()).then_some((key, factor));
    }
    let factor = known(ANGLE.0, &unit).filter(|_| words::is_angle(&words) && words::not_from_firing(head).is_none())?;
    Some(("crank_deg".to_owned(), factor))
}

/// `crank_deg` from firing dead centre over a whole cycle, then a column `<speed>_rpm_bar` a speed, absolute, at full load; at part load
/// `<speed>_rpm_<load>_percent_bar`, every load at the same speeds.
///
/// # Errors
/// [`InputError`] with row and column.
pub(crate) fn pressure_traces(path: &Path, cycle_deg: f64) -> Result<Measured, InputError> {
    let table = Table::read_said(path, &["crank_deg"], &said)?;
    let Some(angle) = table.optional("crank_deg") else {
        let expected = "`crank_deg` and a column a speed, named like `1600_rpm_bar`, among them";
        return Err(table.at_head(0, format!("found columns {}, expected {expected}", table.all_columns())));
    };
    let rows = table.numbers()?;
    let mut traces: Vec<((f64, f64), usize)> = Vec::new();
    for (i, name) in table.header.iter().enumerate().filter(|(i, _)| *i != angle) {
        match speed_and_load(name) {
            Some(point) if traces.iter().any(|t| t.0 == point) => {
                return Err(table.at_head(i, format!("found a second trace for {} rpm", point.0)));
            }
            Some(point) => traces.push((point, i)),
            None => {
                if let Some(fault) = words::not_absolute(name) {
                    let found = format!("found column `{name}`, expected {}", fault.expected);
                    return Err(table.at_head_with_help(i, found, fault.help.into()));
                }
                let expected = "expected a name like `1600_rpm_bar` or, at part load, `1600_rpm_50_percent_bar` (0 to 120)";
                return Err(table.at_head(i, format!("found column `{name}`, {expected}")));
            }
        }
    }
    if traces.is_empty() {
        return Err(table.whole("found no pressure column, expected one a speed, named like `1600_rpm_bar`".into()));
    }
    traces.sort_by(|a, b| a.0.0.total_cmp(&b.0.0));
    let crank_deg: Vec<f64> = rows.iter().map(|r| r.1[angle]).collect();
    let columns: Vec<Vec<f64>> = traces.iter().map(|t| rows.iter().map(|r| r.1[t.1]).collect()).collect();
    if let Some(fault) = fault(&crank_deg, &columns, cycle_deg) {
        let column = fault.trace.map_or(angle, |t| traces[t].1);
        return Err(fault.row.map_or_else(|| table.whole(fault.message.clone()), |r| table.at(rows[r].0, column, fault.message.clone())));
    }
    let of_load = |percent: f64| traces.iter().filter(move |t| t.0.1 == percent);
    let pressure = |percent: f64| of_load(percent).map(|t| rows.iter().map(|r| r.1[t.1] * PA_PER_BAR).collect()).collect();
    let speeds_rpm: Vec<f64> = of_load(FULL).map(|t| t.0.0).collect();
    let mut loads: Vec<f64> = traces.iter().map(|t| t.0.1).filter(|load| *load != FULL).collect();
    loads.sort_by(f64::total_cmp);
    loads.dedup();
    for percent in &loads {
        let own: Vec<f64> = of_load(*percent).map(|t| t.0.0).collect();
        if own != speeds_rpm {
            let message =
                format!("found {} speeds at {percent} per cent of load, expected the {} of full load", own.len(), speeds_rpm.len());
            return Err(table.whole(message));
        }
    }
    let part_load = loads.into_iter().map(|percent| PartLoad { load: percent / FULL, pressure: pressure(percent) }).collect();
    Ok(Measured { speeds_rpm, crank_deg, pressure: pressure(FULL), part_load })
}

/// `order, amplitude_n_m, phase_deg`: torque of a whole throw (or of the gas on a cylinder), A cos(n theta + phase) from the firing of its first cylinder. With
/// a column `speed_rpm` it varies with speed: the same orders at each.
///
/// # Errors
/// [`InputError`] with row and column.
pub(crate) fn torque_harmonics(path: &Path, strokes: u32) -> Result<HarmonicTable, InputError> {
    let table = Table::read(path, &["order", "amplitude_n_m", "phase_deg"])?;
    let rows = table.numbers()?;
    let (order, amplitude, phase) = (table.column("order")?, table.column("amplitude_n_m")?, table.column("phase_deg")?);
    let speed = table.optional("speed_rpm");
    if let Some(i) = (0..table.header.len()).find(|i| ![order, amplitude, phase].contains(i) && speed != Some(*i)) {
        let found = &table.header[i];
        return Err(
            table.at_head(i, format!("found column `{found}`, expected `order`, `amplitude_n_m`, `phase_deg` and `speed_rpm` only"))
        );
    }
    let step = 4 / strokes;
    let mut speeds: Vec<(f64, Vec<(Order, C64)>)> = Vec::new();
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
        let at = speed.map_or(0.0, |s| cells[s]);
        if let Some(column) = speed.filter(|_| at <= 0.0) {
            return Err(table.at(*row, column, format!("found {at}, expected a speed above zero")));
        }
        let place = speeds.iter().position(|s| s.0 == at).unwrap_or_else(|| {
            speeds.push((at, Vec::new()));
            speeds.len() - 1
        });
        let harmonics = &mut speeds[place].1;
        let o = Order::from_twice(twice as u32);
        if harmonics.iter().any(|h| h.0 == o) {
            return Err(table.at(*row, order, format!("found order {o} a second time")));
        }
        harmonics.push((o, C64::from_polar(cells[amplitude], cells[phase] * RAD_PER_DEG)));
    }
    speeds.sort_by(|a, b| a.0.total_cmp(&b.0));
    speeds.iter_mut().for_each(|s| s.1.sort_by_key(|h| h.0));
    let Some((_, first)) = speeds.first() else { return Err(table.whole("found no row, expected at least one harmonic".into())) };
    let harmonics = first.clone();
    if let Some((other, _)) = speeds.iter().find(|s| !s.1.iter().map(|h| h.0).eq(harmonics.iter().map(|h| h.0))) {
        return Err(table.whole(format!("found other orders at {other} rpm than at {} rpm, expected the same at every speed", speeds[0].0)));
    }
    // one speed is known to be one
    let over_speed = speeds.into_iter().filter(|_| speed.is_some()).map(|(s, list)| (s, list.into_iter().map(|h| h.1).collect())).collect();
    Ok(HarmonicTable { harmonics, over_speed, masses: None })
}
