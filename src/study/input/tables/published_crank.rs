//! Published tables of a crank in bending, torsion and axial motion.

use super::published::Rows;
use super::shown::shown;
use super::table::Table;
use crate::input::error::InputError;
use crate::input::published::{PublishedMode, PublishedVonMises};
use crate::units::PA_PER_MPA;
use std::path::Path;

/// `mode, frequency_hz`, and optionally `source`, `state` (`attached` or `bare`) and `kind`.
///
/// # Errors
/// [`InputError`] with row and column.
pub fn modes(path: &Path, engine: &str) -> Result<Vec<PublishedMode>, InputError> {
    let table = Table::read(path, &["mode", "frequency_hz"])?;
    let rows = Rows::new(&table, engine)?;
    let (mode, hz) = (table.column("mode")?, table.column("frequency_hz")?);
    rows.only(&["table", "engine", "source", "state", "mode", "kind", "frequency_hz"])?;
    let mut list: Vec<PublishedMode> = Vec::new();
    for (line, cells) in &rows.of_engine {
        let words = |column: &str| table.optional(column).map_or_else(|| Ok(String::new()), |c| table.words(*line, c, &cells[c]));
        let attached = match words("state")?.as_str() {
            "attached" | "" => true,
            "bare" => false,
            other => {
                let column = table.column("state")?;
                return Err(table.at(*line, column, format!("found `{other}`, expected `attached` (with hub and flywheel) or `bare`")));
            }
        };
        let row = PublishedMode {
            table: rows.source(*line, cells)?,
            source: words("source")?,
            attached,
            mode: rows.mode(*line, mode, &cells[mode])?,
            kind: words("kind")?,
            frequency_hz: rows.positive(*line, hz, &cells[hz])?,
        };
        let same = |r: &PublishedMode| (&r.table, &r.source, r.attached, r.mode) == (&row.table, &row.source, row.attached, row.mode);
        if list.iter().any(same) {
            return Err(table.at(*line, mode, format!("found mode {} of this table and source a second time", row.mode)));
        }
        list.push(row);
    }
    Ok(list)
}

/// `design, speed_rpm, von_mises_mpa`, and optionally `bearing_stiffness` and `bearing_damping`, both over those of the engine, `change_percent` from the stress on these, and `place`. `designs`: of the study.
///
/// # Errors
/// [`InputError`] with row and column.
pub fn von_mises(path: &Path, engine: &str, designs: &[String]) -> Result<Vec<PublishedVonMises>, InputError> {
    let table = Table::read(path, &["design", "speed_rpm", "von_mises_mpa"])?;
    let rows = Rows::new(&table, engine)?;
    let (design, speed, stress) = (table.column("design")?, table.column("speed_rpm")?, table.column("von_mises_mpa")?);
    rows.only(&[
        "table",
        "engine",
        "design",
        "speed_rpm",
        "bearing_stiffness",
        "bearing_damping",
        "von_mises_mpa",
        "change_percent",
        "place",
    ])?;
    let mut list: Vec<PublishedVonMises> = Vec::new();
    for (line, cells) in &rows.of_engine {
        let factor =
            |column: &str| table.optional(column).filter(|c| !cells[*c].is_empty()).map_or(Ok(1.0), |c| rows.positive(*line, c, &cells[c]));
        let Some(index) = designs.iter().position(|d| *d == cells[design]) else {
            let found = format!("found design `{}`, expected one of the study: {}", shown(&cells[design]), designs.join(", "));
            return Err(table.at(*line, design, found));
        };
        let row = PublishedVonMises {
            table: rows.source(*line, cells)?,
            design: index,
            speed_rpm: rows.positive(*line, speed, &cells[speed])?,
            bearings: [factor("bearing_stiffness")?, factor("bearing_damping")?],
            stress: rows.positive(*line, stress, &cells[stress])? * PA_PER_MPA,
            change_percent: match table.optional("change_percent").filter(|c| !cells[*c].is_empty()) {
                Some(c) => Some(table.filled(*line, c, &cells[c])?),
                None => None,
            },
            place: table.optional("place").map_or_else(|| Ok(String::new()), |c| table.words(*line, c, &cells[c]))?,
        };
        if list.iter().any(|r| (r.design, r.speed_rpm, r.bearings) == (row.design, row.speed_rpm, row.bearings)) {
            return Err(table.at(*line, speed, "found this design, speed and bearings a second time".into()));
        }
        list.push(row);
    }
    Ok(list)
}
