//! Designs that a publication recommends.

use super::published::Rows;
use super::shown::shown;
use super::table::Table;
use crate::input::error::InputError;
use crate::input::published::PublishedChoice;
use std::path::Path;

/// `design, words`, and optionally `table`: where it is recommended, and why. `designs`: of the study.
///
/// # Errors
/// [`InputError`] with row and column.
pub fn choices(path: &Path, engine: &str, designs: &[String]) -> Result<Vec<PublishedChoice>, InputError> {
    let table = Table::read(path, &["design", "words"])?;
    let rows = Rows::new(&table, engine)?;
    let (design, words) = (table.column("design")?, table.column("words")?);
    rows.only(&["table", "engine", "design", "words"])?;
    let row = |(line, cells): &&(u64, Vec<String>)| {
        let index = designs.iter().position(|d| *d == cells[design]).ok_or_else(|| {
            let found = format!("found design `{}`, expected one of the study: {}", shown(&cells[design]), designs.join(", "));
            table.at(*line, design, found)
        })?;
        for column in [Some(words), table.optional("table")].into_iter().flatten() {
            if cells[column].trim().is_empty() {
                return Err(table.at(*line, column, "found an empty cell, expected where and why it is recommended".into()));
            }
        }
        Ok(PublishedChoice { table: rows.source(*line, cells)?, design: index, words: table.words(*line, words, &cells[words])? })
    };
    rows.of_engine.iter().map(row).collect()
}
