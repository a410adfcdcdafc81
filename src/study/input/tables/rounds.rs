//! Printed rounds of sizing.

use super::table::Table;
use crate::input::error::InputError;
use crate::input::published::{PublishedRounds, ROUND_QUANTITIES};
use std::path::Path;

/// `symbol, iteration_1, iteration_2, ...`: a row a quantity.
///
/// # Errors
/// [`InputError`] with row and column.
pub(crate) fn published_rounds(path: &Path) -> Result<Vec<PublishedRounds>, InputError> {
    let table = Table::read(path, &["symbol"])?;
    let symbol = table.column("symbol")?;
    let rounds: Vec<usize> = (0..table.header.len()).filter(|c| *c != symbol).collect();
    for (i, column) in rounds.iter().enumerate() {
        let (found, expected) = (&table.header[*column], format!("iteration_{}", i + 1));
        if *found != expected {
            return Err(table.at_head(*column, format!("found column `{found}`, expected `{expected}`")));
        }
    }
    let mut list = Vec::new();
    for (row, cells) in &table.rows {
        let Some(quantity) = ROUND_QUANTITIES.iter().find(|q| q.symbol == cells[symbol]) else {
            let known: Vec<&str> = ROUND_QUANTITIES.iter().map(|q| q.symbol).collect();
            return Err(table.at(*row, symbol, format!("found `{}`, expected one of {}", cells[symbol], known.join(", "))));
        };
        let values = rounds.iter().map(|c| table.filled(*row, *c, &cells[*c])).collect::<Result<_, _>>()?;
        list.push(PublishedRounds { quantity: *quantity, values });
    }
    Ok(list)
}
