//! Absorbers that can be bought.

use super::table::{Table, shown};
use crate::absorber::{Declaration, Range, TYPES, types};
use crate::input::error::InputError;
use std::path::Path;

/// An absorber of a catalogue.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CatalogueRow {
    /// Its name: letters, digits, `_`, `-` and `.`.
    pub name: String,
    /// Its type.
    pub declaration: &'static Declaration,
    /// A value for each of its parameters.
    pub values: Vec<f64>,
}

/// `name, type` and a column for every parameter that a type in it has, empty where a row's type has none.
///
/// # Errors
/// [`InputError`] with file, row and column.
pub(crate) fn catalogue(path: &Path) -> Result<Vec<CatalogueRow>, InputError> {
    let table = Table::read(path)?;
    let (name, kind) = (table.column("name")?, table.column("type")?);
    let known = |key: &String| ["name", "type"].contains(&key.as_str()) || TYPES.iter().any(|t| t.index(key).is_some());
    if let Some(column) = table.header.iter().position(|key| !known(key)) {
        let found = format!("found column `{}`, expected `name`, `type` and parameters of types", shown(&table.header[column]));
        return Err(table.at(1, column, found));
    }
    let mut rows: Vec<CatalogueRow> = Vec::new();
    for (line, cells) in &table.rows {
        let (own, word) = (&cells[name], &cells[kind]);
        let plain = !own.is_empty() && own.len() <= 100 && own.chars().all(|c| c.is_ascii_alphanumeric() || "_-.".contains(c));
        if !plain || own.starts_with('.') || own.starts_with("optimum_") {
            let found =
                format!("found the name `{}`, expected letters, digits, `_`, `-` and `.`, not starting with `optimum_`", shown(own));
            return Err(table.at(*line, name, found));
        }
        if rows.iter().any(|r| r.name == *own) {
            return Err(table.at(*line, name, format!("found `{own}` a second time, expected different names")));
        }
        let Some(declaration) = types::find(word) else {
            let known: Vec<&str> = TYPES.iter().map(|t| t.name).collect();
            return Err(table.at(*line, kind, format!("found type `{}`, expected one of {}", shown(word), known.join(", "))));
        };
        let mut values = Vec::new();
        for p in declaration.parameters {
            let column = table.column(p.key)?;
            let value = table.filled(*line, column, &cells[column])?;
            let expected = match p.range {
                Range::Positive => (value <= 0.0).then(|| "a number above zero".to_owned()),
                Range::NotNegative => (value < 0.0).then(|| "zero or more".to_owned()),
                Range::Above(least) => (value <= least).then(|| format!("more than {least}")),
                Range::Within(low, high) => (!(low..=high).contains(&value)).then(|| format!("a value from {low} to {high}")),
            };
            if let Some(expected) = expected {
                return Err(table.at(*line, column, format!("found {value}, expected {expected}")));
            }
            values.push(value);
        }
        for (column, cell) in cells.iter().enumerate().filter(|(c, cell)| ![name, kind].contains(c) && !cell.is_empty()) {
            if declaration.index(&table.header[column]).is_none() {
                let found = format!(
                    "found `{}`, expected an empty cell: `{}` has no `{}`",
                    shown(cell),
                    declaration.name,
                    shown(&table.header[column])
                );
                return Err(table.at(*line, column, found));
            }
        }
        rows.push(CatalogueRow { name: own.clone(), declaration, values });
    }
    if rows.is_empty() {
        return Err(table.whole("found no absorber, expected at least one row".into()));
    }
    Ok(rows)
}
