//! A chain as engineers exchange it: a row a station.

use super::table::Table;
use crate::input::error::{At, InputError};
use crate::input::schema::engine::RawStation;
use std::ops::Range;
use std::path::Path;

/// Columns that must be there, then those that may.
const COLUMNS: [&str; 10] = [
    "station",
    "inertia_kg_m2",
    "stiffness_to_next_n_m_per_rad",
    "throws",
    "damping_to_next_n_m_s_per_rad",
    "loss_factor_to_next",
    "stiffness_to_ground_n_m_per_rad",
    "damping_to_ground_n_m_s_per_rad",
    "next",
    "gear_ratio_to_next",
];

/// `station, inertia_kg_m2, stiffness_to_next_n_m_per_rad` (empty for the last) and the other keys of a station; several throws are separated by spaces.
/// What is wrong with the chain as a whole is reported at `named`, the place of the file's name.
///
/// # Errors
/// [`InputError`] with row and column.
pub(crate) fn mass_elastic(path: &Path, named: Range<usize>) -> Result<Vec<RawStation>, InputError> {
    let table = Table::read(path, &COLUMNS)?;
    if let Some(i) = table.header.iter().position(|h| !COLUMNS.contains(&h.as_str())) {
        let expected = format!("{}, and of others only {}", COLUMNS[..3].join(", "), COLUMNS[3..].join(", "));
        return Err(table.at_head(i, format!("found column `{}`, expected {expected}", table.header[i])));
    }
    let (station, inertia) = (table.column(COLUMNS[0])?, table.column(COLUMNS[1])?);
    table.column(COLUMNS[2])?;
    if table.rows.is_empty() {
        return Err(table.whole("found no row, expected at least one station".into()));
    }
    let mut stations = Vec::new();
    for (row, cells) in &table.rows {
        let located = |value: f64| At::new(named.clone(), value);
        let optional = |name: &str| -> Result<Option<At<f64>>, InputError> {
            let Some(column) = table.optional(name) else { return Ok(None) };
            let value = table.number(*row, column, &cells[column])?;
            match value {
                // a ratio may be negative
                Some(x) if x < 0.0 && name != "gear_ratio_to_next" => {
                    Err(table.at(*row, column, format!("found {x}, expected at least zero")))
                }
                found => Ok(found.map(located)),
            }
        };
        let mut throws = Vec::new();
        if let Some(column) = table.optional("throws") {
            for word in cells[column].split_whitespace() {
                let throw = word.parse::<i64>();
                let throw =
                    throw.map_err(|_| table.at(*row, column, format!("found `{word}`, expected numbers of throws with spaces between")))?;
                throws.push(At::new(named.clone(), throw));
            }
        }
        let mass = table.filled(*row, inertia, &cells[inertia])?;
        if mass <= 0.0 {
            return Err(table.at(*row, inertia, format!("found {mass}, expected an inertia above zero")));
        }
        let next = table.optional("next").map(|c| cells[c].clone()).filter(|n| !n.is_empty());
        stations.push(RawStation {
            name: At::new(named.clone(), table.words(*row, station, &cells[station])?),
            throws,
            inertia_kg_m2: Some(located(mass)),
            stiffness_to_next_n_m_per_rad: optional(COLUMNS[2])?,
            damping_to_next_n_m_s_per_rad: optional("damping_to_next_n_m_s_per_rad")?,
            loss_factor_to_next: optional("loss_factor_to_next")?,
            stiffness_to_ground_n_m_per_rad: optional("stiffness_to_ground_n_m_per_rad")?,
            damping_to_ground_n_m_s_per_rad: optional("damping_to_ground_n_m_s_per_rad")?,
            next: next.map(|n| At::new(named.clone(), n)),
            gear_ratio_to_next: optional("gear_ratio_to_next")?,
            shaft_to_next: None,
        });
    }
    Ok(stations)
}
