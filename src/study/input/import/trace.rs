//! Pressure over the angle of the crank, a file a speed: a column of angles and one of pressures, with units in the header.

use super::sheet::Sheet;
use super::unit::{ANGLE, PRESSURE, Units, known, parts};
use super::words::{is_angle, is_pressure, not_absolute, not_from_firing};
use crate::input::error::InputError;
use crate::input::tables::fault;
use std::path::PathBuf;

/// Of the cycle of the engine that is written, degrees.
const CYCLE: f64 = 720.0;

/// Traces over the same angles.
#[derive(Debug, Clone, Default, PartialEq)]
#[doc(hidden)]
pub struct FoundTraces {
    /// Degrees.
    pub angles: Vec<f64>,
    /// Speed, rpm, and pressure at each angle, bar.
    pub traces: Vec<(f64, Vec<f64>)>,
}

/// How many of an angle and a pressure are among the heads of a row.
fn knows(cells: &[&str]) -> usize {
    let any = |is: fn(&str) -> bool| usize::from(cells.iter().any(|cell| is(&parts(cell).0)));
    any(is_angle) + any(is_pressure)
}

/// Reads a file a speed.
///
/// # Errors
/// [`InputError`] at the cell that is not understood or that makes them no traces, or where angles differ from those of the first file.
#[doc(hidden)]
pub fn traces(files: &[(f64, PathBuf)]) -> Result<FoundTraces, InputError> {
    let mut found = FoundTraces::default();
    for (speed, path) in files {
        let mut sheet = Sheet::read(path, &knows)?;
        let (angle, pressure) = (column(&sheet, is_angle, ANGLE)?, column(&sheet, is_pressure, PRESSURE)?);
        if angle.0 == pressure.0 {
            return Err(sheet.lacks(PRESSURE.1));
        }
        for (column, faulty) in [(pressure.0, not_absolute as fn(&str) -> _), (angle.0, not_from_firing)] {
            let head = &sheet.heads()[column];
            if let Some(fault) = faulty(head) {
                let message = format!("found `{}`, expected {}", head.trim(), fault.expected);
                return Err(sheet.at_head_with_help(column, message, fault.help.into()));
            }
        }
        sheet.reads(&[angle.0, pressure.0]);
        let cell = |(row, cells): &(u64, Vec<String>), column: usize| {
            let value = sheet.number(*row, column, &cells[column])?;
            value.ok_or_else(|| sheet.at(*row, column, "found an empty cell, expected a number".into()))
        };
        let rows = sheet.rows();
        let angles: Vec<f64> = rows.iter().map(|r| Ok(cell(r, angle.0)? * angle.1)).collect::<Result<_, InputError>>()?;
        let as_written: Vec<f64> = rows.iter().map(|r| cell(r, pressure.0)).collect::<Result<_, InputError>>()?;
        let pressures = as_written.iter().map(|p| p * pressure.1).collect();
        if let Some(fault) = fault(&angles, &[as_written], CYCLE) {
            let column = if fault.trace.is_some() { pressure.0 } else { angle.0 };
            return Err(match fault.row {
                Some(row) => sheet.at(rows[row].0, column, fault.message),
                None => sheet.whole(fault.message),
            });
        }
        if found.traces.is_empty() {
            found.angles = angles;
        } else if angles != found.angles {
            return Err(sheet.whole("found other angles than in the first trace, expected the same in all".into()));
        }
        if found.traces.iter().any(|t| t.0 == *speed) {
            return Err(sheet.whole(format!("found a second trace at {speed} rpm, expected one a speed")));
        }
        found.traces.push((*speed, pressures));
    }
    Ok(found)
}

/// The column whose head has such words, with the factor of its unit: of several the only one with a unit of the kind.
fn column(sheet: &Sheet, is: fn(&str) -> bool, of: (Units, &str)) -> Result<(usize, f64), InputError> {
    let named: Vec<usize> = (0..sheet.heads().len()).filter(|i| is(&parts(&sheet.heads()[*i]).0)).collect();
    let Some(first) = named.first() else { return Err(sheet.lacks(of.1)) };
    let unit = |i: usize| {
        let head = &sheet.heads()[i];
        // "°KW" and "bar" name nothing but their unit
        parts(head).1.or_else(|| known(of.0, head).map(|_| head.clone()))
    };
    let fitting: Vec<usize> = named.iter().copied().filter(|i| unit(*i).is_some_and(|u| known(of.0, &u).is_some())).collect();
    if let [one, another, ..] = fitting.as_slice() {
        let names = (&sheet.heads()[*one], &sheet.heads()[*another]);
        let message = format!("found `{}` and `{}`, expected one column like `{}`", names.0, names.1, of.1);
        let help = "a table with a column a speed is read by `pressure.measured.file` of an engine file; `--trace` takes one speed a file"
            .to_owned();
        return Err(sheet.at_head_with_help(*another, message, help));
    }
    let own = fitting.first().unwrap_or(first);
    Ok((*own, sheet.factor(*own, of, unit(*own).as_deref())?))
}
