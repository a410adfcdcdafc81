//! Pressure over the angle of the crank, a file a speed: a column of angles and one of pressures, with units in the header.

use super::sheet::Sheet;
use super::unit::{Units, factor, parts};
use crate::input::error::InputError;
use crate::input::tables::hole;
use std::path::PathBuf;

const ANGLE: (Units, &str) =
    (&[("deg", 1.0), ("degca", 1.0), ("°", 1.0), ("°ca", 1.0), ("rad", 180.0 / std::f64::consts::PI)], "Angle [deg]");
const PRESSURE: (Units, &str) = (&[("bar", 1.0), ("mpa", 10.0), ("kpa", 0.01), ("pa", 1e-5)], "Pressure [bar]");

/// Traces over the same angles.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct FoundTraces {
    /// Degrees.
    pub angles: Vec<f64>,
    /// Speed, rpm, and pressure at each angle, bar.
    pub traces: Vec<(f64, Vec<f64>)>,
}

/// Reads a file a speed.
///
/// # Errors
/// [`InputError`] at the cell that is not understood, or where angles differ from those of the first file.
pub(crate) fn traces(files: &[(f64, PathBuf)]) -> Result<FoundTraces, InputError> {
    let mut found = FoundTraces::default();
    for (speed, path) in files {
        let sheet = Sheet::read(path)?;
        let (angle, pressure) =
            (column(&sheet, &["angle", "crank", "ca", "deg", "theta"], ANGLE)?, column(&sheet, &["press", "p", "bar"], PRESSURE)?);
        let cell = |(row, cells): &(u64, Vec<String>), (column, factor): (usize, f64)| {
            let value = sheet.number(*row, column, &cells[column])?;
            value.map(|x| x * factor).ok_or_else(|| sheet.at(*row, column, "found an empty cell, expected a number".into()))
        };
        let angles: Vec<f64> = sheet.rows.iter().map(|r| cell(r, angle)).collect::<Result<_, _>>()?;
        if let Some((i, message)) = hole(&angles) {
            return Err(sheet.at(sheet.rows[i].0, angle.0, message));
        }
        let pressures = sheet.rows.iter().map(|r| cell(r, pressure)).collect::<Result<_, _>>()?;
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

/// The column whose head begins with one of these words, with the factor of its unit.
fn column(sheet: &Sheet, words: &[&str], of: (Units, &str)) -> Result<(usize, f64), InputError> {
    let begins =
        |head: &String| parts(head).0.split([' ', '_']).any(|part| words.iter().any(|w| part == *w || w.len() > 2 && part.starts_with(w)));
    let Some(i) = sheet.heads.iter().position(begins) else {
        return Err(sheet.at(1, 0, format!("found columns {}, expected one like `{}` among them", sheet.all_heads(), of.1)));
    };
    Ok((i, factor(sheet, i, of, parts(&sheet.heads[i]).1)?))
}
