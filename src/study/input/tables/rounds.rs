//! Printed rounds of sizing, and worked examples.

use super::table::Table;
use crate::input::error::InputError;
use crate::input::published::{PublishedExample, PublishedRounds, ROUND_QUANTITIES};
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

/// `example, role` (`input` or `output`), `quantity, unit, book_or_cad` (of an input a number or a word), and optionally `table` and `program`.
///
/// # Errors
/// [`InputError`] with row and column.
pub(crate) fn published_examples(path: &Path) -> Result<Vec<PublishedExample>, InputError> {
    let table = Table::read(path, &["example", "role", "quantity", "unit", "book_or_cad"])?;
    let (example, role, quantity) = (table.column("example")?, table.column("role")?, table.column("quantity")?);
    let (unit, book) = (table.column("unit")?, table.column("book_or_cad")?);
    let row = |(line, cells): &(u64, Vec<String>)| {
        let words = |column: usize| table.words(*line, column, &cells[column]);
        let is_input = match cells[role].as_str() {
            "input" => true,
            "output" => false,
            other => return Err(table.at(*line, role, format!("found `{other}`, expected `input` or `output`"))),
        };
        let value = match table.number(*line, book, &cells[book]) {
            Ok(Some(x)) => Ok(x),
            Err(_) if is_input => Err(words(book)?),
            Err(error) => return Err(error),
            Ok(None) => return Err(table.at(*line, book, "found an empty cell, expected a number or a word".into())),
        };
        let program = table.optional("program").map_or(Ok(None), |c| table.number(*line, c, &cells[c]))?;
        let source = table.optional("table").map_or_else(|| Ok(String::new()), words)?;
        Ok(PublishedExample {
            table: source,
            example: words(example)?,
            is_input,
            quantity: words(quantity)?,
            unit: words(unit)?,
            value,
            program,
        })
    };
    table.rows.iter().map(row).collect()
}
