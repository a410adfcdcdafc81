//! Tables as spreadsheets save them: commas, semicolons or tabs between columns, decimal commas where these do not separate.

use crate::input::error::{InputError, Mistake, Place, read_bytes};
use std::path::{Path, PathBuf};

/// Heads and cells.
pub(super) struct Sheet {
    path: PathBuf,
    delimiter: u8,
    pub heads: Vec<String>,
    /// Line in the file and cells, as many as heads.
    pub rows: Vec<(u64, Vec<String>)>,
}

impl Sheet {
    /// Reads one.
    ///
    /// # Errors
    /// [`InputError`] where it is no table.
    pub fn read(path: &Path) -> Result<Self, InputError> {
        let mut sheet = Self { path: path.to_path_buf(), delimiter: b',', heads: Vec::new(), rows: Vec::new() };
        let bytes = read_bytes(path).map_err(|e| sheet.whole(e))?;
        let text = String::from_utf8(bytes).map_err(|_| sheet.whole("found bytes that are not text, expected UTF-8".into()))?;
        let text = text.trim_start_matches('\u{feff}');
        let first = text.lines().find(|l| !l.starts_with('#')).unwrap_or("");
        sheet.delimiter = [b';', b'\t'].into_iter().find(|d| first.contains(char::from(*d))).unwrap_or(b',');
        let mut reader = csv::ReaderBuilder::new()
            .delimiter(sheet.delimiter)
            .trim(csv::Trim::All)
            .flexible(true)
            .comment(Some(b'#'))
            .from_reader(text.as_bytes());
        let heads = reader.headers().map_err(|e| sheet.whole(format!("the header could not be read: {e}")))?;
        sheet.heads = heads.iter().map(str::to_owned).collect();
        for record in reader.records() {
            let record = record.map_err(|e| sheet.whole(format!("the table could not be read: {e}")))?;
            let row = record.position().map_or(0, csv::Position::line);
            if record.iter().skip(sheet.heads.len()).any(|cell| !cell.is_empty()) {
                return Err(sheet.at(row, 0, format!("found {} cells, expected {}", record.len(), sheet.heads.len())));
            }
            let cells = (0..sheet.heads.len()).map(|c| record.get(c).unwrap_or("").to_owned()).collect();
            sheet.rows.push((row, cells));
        }
        Ok(sheet)
    }

    /// A mistake in a cell.
    pub fn at(&self, row: u64, column: usize, message: String) -> InputError {
        let column = self.heads.get(column).cloned().unwrap_or_default();
        Mistake { message, place: Place::Cell { path: self.path.clone(), row, column }, help: None }.into()
    }

    /// A mistake of the file.
    pub fn whole(&self, message: String) -> InputError {
        Mistake { message, place: Place::File(self.path.clone()), help: None }.into()
    }

    /// Heads for a message.
    pub(super) fn all_heads(&self) -> String {
        self.heads.iter().map(|h| format!("`{h}`")).collect::<Vec<_>>().join(", ")
    }

    /// A number with either decimal sign; nothing where the cell is empty or a dash.
    ///
    /// # Errors
    /// [`InputError`] at the cell.
    pub fn number(&self, row: u64, column: usize, cell: &str) -> Result<Option<f64>, InputError> {
        if ["", "-", "–"].contains(&cell) {
            return Ok(None);
        }
        if cell.contains(',') && (self.delimiter == b',' || cell.contains('.')) {
            let expected = "expected a number with one decimal point and nothing between thousands";
            return Err(self.at(row, column, format!("found `{cell}`, {expected}")));
        }
        match cell.replace(',', ".").parse::<f64>() {
            Ok(x) if x.abs() <= 1e20 => Ok(Some(x)),
            _ => Err(self.at(row, column, format!("found `{cell}`, expected a number up to 1e20"))),
        }
    }
}
