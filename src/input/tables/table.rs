//! A table in a file, row by row, with the place of each mistake.

use crate::input::error::{InputError, Mistake, Place, read_bytes};
use std::path::{Path, PathBuf};

/// A cell for a message: a quotation mark left open makes one of the rest of the file.
pub(crate) fn shown(cell: &str) -> String {
    const MOST: usize = 40;
    let line = cell.lines().next().unwrap_or("");
    if line.chars().count() > MOST || line.len() < cell.len() { line.chars().take(MOST).chain(['…']).collect() } else { line.to_owned() }
}

/// A mistake of a whole file.
pub fn whole(path: &Path, message: String) -> InputError {
    Mistake { message, place: Place::File(path.to_path_buf()), help: None }.into()
}

pub struct Table {
    path: PathBuf,
    pub header: Vec<String>,
    /// Line in the file and cells, as many as the header has (missing ones at the end are empty).
    pub rows: Vec<(u64, Vec<String>)>,
}

impl Table {
    pub fn at(&self, row: u64, column: usize, message: String) -> InputError {
        let column = self.header.get(column).cloned().unwrap_or_else(|| format!("{}", column + 1));
        Mistake { message, place: Place::Cell { path: self.path.clone(), row, column }, help: None }.into()
    }

    pub fn whole(&self, message: String) -> InputError {
        whole(&self.path, message)
    }

    /// Cells under a header row.
    pub fn read(path: &Path) -> Result<Self, InputError> {
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
        if let [only] = table.header.as_slice()
            && let Some(found) = [(';', "semicolons"), ('\t', "tabs")].iter().find(|(c, _)| only.contains(*c)).map(|f| f.1)
        {
            return Err(table.at(1, 0, format!("found {found} between columns, expected commas between columns and points in numbers")));
        }
        for (i, name) in table.header.iter().enumerate() {
            if table.header[..i].contains(name) {
                return Err(table.at(1, i, format!("found column `{name}` a second time")));
            }
        }
        for record in reader.records() {
            let record = record.map_err(|e| table.whole(format!("the table could not be read: {e}")))?;
            let row = record.position().map_or(0, csv::Position::line);
            if record.len() > table.header.len() {
                // "0,0,1,25" for 0.0 and 1.25
                let hint = if record.len() == 2 * table.header.len() { ": decimal commas separate columns, expected points" } else { "" };
                return Err(table.at(
                    row,
                    table.header.len(),
                    format!("found {} cells, expected {}{hint}", record.len(), table.header.len()),
                ));
            }
            let cells = (0..table.header.len()).map(|c| record.get(c).unwrap_or("").to_owned()).collect();
            table.rows.push((row, cells));
        }
        Ok(table)
    }

    /// A cell as a number; nothing where it is empty.
    pub fn number(&self, row: u64, column: usize, cell: &str) -> Result<Option<f64>, InputError> {
        match cell.parse::<f64>() {
            Ok(x) if x.abs() <= 1e20 => Ok(Some(x)),
            _ if cell.is_empty() => Ok(None),
            _ if cell.matches(',').count() == 1 && cell.replace(',', ".").parse::<f64>().is_ok() => {
                Err(self.at(row, column, format!("found `{}`, expected a number with a decimal point", shown(cell))))
            }
            _ => Err(self.at(row, column, format!("found `{}`, expected a number up to 1e20", shown(cell)))),
        }
    }

    /// A cell that must hold a number.
    pub(crate) fn filled(&self, row: u64, column: usize, cell: &str) -> Result<f64, InputError> {
        self.number(row, column, cell)?.ok_or_else(|| self.at(row, column, "found an empty cell, expected a number".into()))
    }

    /// All cells, each filled with a number.
    pub fn numbers(&self) -> Result<Vec<(u64, Vec<f64>)>, InputError> {
        let row = |(line, cells): &(u64, Vec<String>)| -> Result<(u64, Vec<f64>), InputError> {
            let cells = cells.iter().enumerate().map(|(c, cell)| self.filled(*line, c, cell)).collect::<Result<_, _>>()?;
            Ok((*line, cells))
        };
        self.rows.iter().map(row).collect()
    }

    /// Index of a column that must be there.
    pub fn column(&self, name: &str) -> Result<usize, InputError> {
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
    pub(crate) fn optional(&self, name: &str) -> Option<usize> {
        self.header.iter().position(|h| h == name)
    }
}
