//! The printed chain of an engine.

use super::published::Rows;
use super::table::Table;
use crate::input::error::InputError;
use crate::input::published::PublishedStation;
use std::path::Path;

/// `station` (from 0), `inertia_kg_m2, stiffness_to_next_n_m_per_rad`, and optionally `table` and `name`.
///
/// # Errors
/// [`InputError`] with row and column.
pub fn chain(path: &Path, engine: &str) -> Result<Vec<PublishedStation>, InputError> {
    let table = Table::read(path, &["station", "inertia_kg_m2", "stiffness_to_next_n_m_per_rad"])?;
    let rows = Rows::new(&table, engine)?;
    let (station, inertia) = (table.column("station")?, table.column("inertia_kg_m2")?);
    let stiffness = table.column("stiffness_to_next_n_m_per_rad")?;
    rows.only(&["table", "engine", "station", "name", "inertia_kg_m2", "stiffness_to_next_n_m_per_rad"])?;
    let mut list: Vec<PublishedStation> = Vec::new();
    for (line, cells) in &rows.of_engine {
        let number = table.filled(*line, station, &cells[station])?;
        if number != list.len() as f64 {
            return Err(table.at(*line, station, format!("found station {number}, expected {}: one after the other from 0", list.len())));
        }
        let to_next = Some(stiffness).filter(|c| !cells[*c].is_empty());
        list.push(PublishedStation {
            table: rows.source(*line, cells)?,
            station: list.len(),
            inertia: rows.positive(*line, inertia, &cells[inertia])?,
            stiffness: to_next.map(|c| rows.positive(*line, c, &cells[c])).transpose()?,
        });
    }
    Ok(list)
}
