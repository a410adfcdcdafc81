//! Tables too long to be kept: rows one after the other, for errors with row and column.

use super::table::{shown, whole};
use crate::input::error::{InputError, Mistake, Place};
use crate::units::PA_PER_MPA;
use csv::StringRecord;
use std::fs::File;
use std::path::{Path, PathBuf};

/// Columns of a stress tensor.
pub(crate) const TENSOR: [&str; 6] = ["sxx_mpa", "syy_mpa", "szz_mpa", "sxy_mpa", "syz_mpa", "szx_mpa"];

/// A table with these columns, in this order or another.
pub struct Stream {
    path: PathBuf,
    rows: csv::StringRecordsIntoIter<File>,
    columns: Vec<&'static str>,
    /// Cell of each column.
    places: Vec<usize>,
}

impl Stream {
    /// Opens a table with two columns and those of a tensor.
    pub(crate) fn open(path: &Path, first: [&'static str; 2]) -> Result<Self, InputError> {
        let whole = |message: String| whole(path, message);
        if !path.is_file() {
            return Err(whole(if path.exists() { "found no file there, expected a table".into() } else { "file not found".into() }));
        }
        let file = File::open(path).map_err(|e| whole(format!("cannot be read: {e}")))?;
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).flexible(true).comment(Some(b'#')).from_reader(file);
        let header = reader.headers().map_err(|e| whole(format!("the header could not be read: {e}")))?.clone();
        let columns: Vec<&'static str> = first.into_iter().chain(TENSOR).collect();
        let mut places = Vec::new();
        for name in &columns {
            let found: Vec<usize> = (0..header.len()).filter(|i| header[*i].trim_start_matches('\u{feff}') == *name).collect();
            let wrong = match found.as_slice() {
                [one] => {
                    places.push(*one);
                    continue;
                }
                [] => format!("found no column `{name}`, expected {}", columns.join(", ")),
                _ => format!("found column `{name}` a second time"),
            };
            let place = Place::Cell { path: path.to_path_buf(), row: 1, column: (*name).to_owned() };
            return Err(Mistake { message: wrong, place, help: None }.into());
        }
        Ok(Self { path: path.to_path_buf(), rows: reader.into_records(), columns, places })
    }

    /// A mistake in a cell.
    pub fn at(&self, line: u64, column: usize, message: String) -> InputError {
        let column = self.columns[column].to_owned();
        Mistake { message, place: Place::Cell { path: self.path.clone(), row: line, column }, help: None }.into()
    }

    /// The next row with its line.
    pub fn next(&mut self) -> Result<Option<(u64, StringRecord)>, InputError> {
        let Some(record) = self.rows.next() else { return Ok(None) };
        let record = record.map_err(|e| {
            let line = e.position().map_or(0, csv::Position::line);
            self.at(line, 0, format!("the table could not be read: {e}"))
        })?;
        Ok(Some((record.position().map_or(0, csv::Position::line), record)))
    }

    fn cell<'r>(&self, record: &'r StringRecord, column: usize) -> &'r str {
        record.get(self.places[column]).unwrap_or("")
    }

    /// A cell with a name of something.
    pub fn name(&self, line: u64, record: &StringRecord, column: usize, of: &str) -> Result<String, InputError> {
        match self.cell(record, column) {
            "" => Err(self.at(line, column, format!("found an empty cell, expected the name of a {of}"))),
            name if name.chars().any(char::is_control) => {
                Err(self.at(line, column, format!("found a control character in the name of a {of}, expected none")))
            }
            name => Ok(name.to_owned()),
        }
    }

    /// A cell with a number.
    pub fn number(&self, line: u64, record: &StringRecord, column: usize) -> Result<f64, InputError> {
        let cell = self.cell(record, column);
        match cell.parse::<f64>() {
            Ok(x) if x.abs() <= 1e20 => Ok(x),
            _ => Err(self.at(line, column, format!("found `{}`, expected a number up to 1e20", shown(cell)))),
        }
    }

    /// The tensor of a row, Pa (or Pa per unit load).
    pub fn tensor(&self, line: u64, record: &StringRecord) -> Result<[f64; 6], InputError> {
        let mut tensor = [0.0; 6];
        for (i, t) in tensor.iter_mut().enumerate() {
            *t = self.number(line, record, i + 2)? * PA_PER_MPA;
        }
        Ok(tensor)
    }
}
