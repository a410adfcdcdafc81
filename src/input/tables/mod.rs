//! Tables with a header row: cells with their places, for errors with row and column.

mod cycle;
mod history;
mod multiaxial;
mod published;
mod stream;
mod superposed;
mod torque;
mod unit_loads;

pub use history::{HistoryReader, PointHistory};
pub use multiaxial::{histories, multiaxial};
pub use published::{Reach, absorbers, amplitudes, engines, factors, fatigue, frequencies, stresses};
pub use superposed::Superposed;
pub use torque::{pressure_traces, torque_harmonics};
pub use unit_loads::{UnitLoadReader, UnitPoint};

use super::error::{InputError, Mistake, Place, read_bytes};
use std::path::{Path, PathBuf};

/// A cell for a message: a quotation mark left open makes one of the rest of the file.
fn shown(cell: &str) -> String {
    const MOST: usize = 40;
    let line = cell.lines().next().unwrap_or("");
    if line.chars().count() > MOST || line.len() < cell.len() { line.chars().take(MOST).chain(['…']).collect() } else { line.to_owned() }
}

/// A mistake of a whole file.
fn whole(path: &Path, message: String) -> InputError {
    Mistake { message, place: Place::File(path.to_path_buf()), help: None }.into()
}

struct Table {
    path: PathBuf,
    header: Vec<String>,
    /// Line in the file and cells, as many as the header has (missing ones at the end are empty).
    rows: Vec<(u64, Vec<String>)>,
}

impl Table {
    fn at(&self, row: u64, column: usize, message: String) -> InputError {
        let column = self.header.get(column).cloned().unwrap_or_else(|| format!("{}", column + 1));
        Mistake { message, place: Place::Cell { path: self.path.clone(), row, column }, help: None }.into()
    }

    fn whole(&self, message: String) -> InputError {
        whole(&self.path, message)
    }

    /// Cells under a header row.
    fn read(path: &Path) -> Result<Self, InputError> {
        let mut table = Self { path: path.to_path_buf(), header: Vec::new(), rows: Vec::new() };
        let text = String::from_utf8(read_bytes(path).map_err(|e| table.whole(e))?).map_err(|e| {
            let row = 1 + e.as_bytes()[..e.utf8_error().valid_up_to()].iter().filter(|b| **b == b'\n').count() as u64;
            table.at(row, 0, "found bytes that are not text, expected UTF-8".into())
        })?;
        let mut reader = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .flexible(true)
            .comment(Some(b'#'))
            .from_reader(text.trim_start_matches('\u{feff}').as_bytes());
        table.header =
            reader.headers().map_err(|e| table.whole(format!("the header could not be read: {e}")))?.iter().map(str::to_owned).collect();
        for (i, name) in table.header.iter().enumerate() {
            if table.header[..i].contains(name) {
                return Err(table.at(1, i, format!("found column `{name}` a second time")));
            }
        }
        for record in reader.records() {
            let record = record.map_err(|e| table.whole(format!("the table could not be read: {e}")))?;
            let row = record.position().map_or(0, csv::Position::line);
            if record.len() > table.header.len() {
                return Err(table.at(row, table.header.len(), format!("found {} cells, expected {}", record.len(), table.header.len())));
            }
            let cells = (0..table.header.len()).map(|c| record.get(c).unwrap_or("").to_owned()).collect();
            table.rows.push((row, cells));
        }
        Ok(table)
    }

    /// A cell as a number; nothing where it is empty.
    fn number(&self, row: u64, column: usize, cell: &str) -> Result<Option<f64>, InputError> {
        match cell.parse::<f64>() {
            Ok(x) if x.abs() <= 1e20 => Ok(Some(x)),
            _ if cell.is_empty() => Ok(None),
            _ => Err(self.at(row, column, format!("found `{}`, expected a number up to 1e20", shown(cell)))),
        }
    }

    /// A cell that must hold a number.
    fn filled(&self, row: u64, column: usize, cell: &str) -> Result<f64, InputError> {
        self.number(row, column, cell)?.ok_or_else(|| self.at(row, column, "found an empty cell, expected a number".into()))
    }

    /// All cells, each filled with a number.
    fn numbers(&self) -> Result<Vec<(u64, Vec<f64>)>, InputError> {
        let row = |(line, cells): &(u64, Vec<String>)| -> Result<(u64, Vec<f64>), InputError> {
            let cells = cells.iter().enumerate().map(|(c, cell)| self.filled(*line, c, cell)).collect::<Result<_, _>>()?;
            Ok((*line, cells))
        };
        self.rows.iter().map(row).collect()
    }

    /// Index of a column that must be there.
    fn column(&self, name: &str) -> Result<usize, InputError> {
        self.header.iter().position(|h| h == name).ok_or_else(|| {
            let found: Vec<String> = self.header.iter().map(|h| format!("`{h}`")).collect();
            let message = if self.header.is_empty() {
                format!("found an empty table, expected a header with a column `{name}`")
            } else {
                format!("found columns {}, expected `{name}` among them", found.join(", "))
            };
            Mistake { message, place: Place::Cell { path: self.path.clone(), row: 1, column: name.to_owned() }, help: None }.into()
        })
    }

    /// Index of a column that may be there.
    fn optional(&self, name: &str) -> Option<usize> {
        self.header.iter().position(|h| h == name)
    }
}
