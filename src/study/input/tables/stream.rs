//! Tables too long to be kept: rows one after the other, for errors with row and column.

use super::encoding::utf8;
use super::form::Form;
use super::named::{self, Named};
use super::numbers::Convention;
use super::records::{Fault, Record, Records};
use super::shown::shown;
use super::table::{only_text, remark_on_encoding, whole};
use crate::input::error::{InputError, Mistake, Place};
use crate::input::files::{note_stream, remark};
use crate::input::letters::fault;
use crate::units::PA_PER_MPA;
use std::fs::File;
use std::io::{BufRead, Chain, Cursor, Read};
use std::path::{Path, PathBuf};

/// Columns of a stress tensor.
pub(crate) const TENSOR: [&str; 6] = ["sxx_mpa", "syy_mpa", "szz_mpa", "sxy_mpa", "syz_mpa", "szx_mpa"];

/// The form of a table is that of so many bytes at its beginning.
const START: usize = 1 << 18;

/// Bytes of a table: its beginning, then the rest.
type Bytes = Chain<Cursor<Vec<u8>>, Box<dyn BufRead + Send>>;

/// A table with these columns, in this order or another.
pub struct Stream {
    path: PathBuf,
    rows: Records<Bytes>,
    columns: Vec<&'static str>,
    /// Cell of each column, and the factor of its unit.
    places: Vec<(usize, f64)>,
    /// Cells of the header.
    width: usize,
    /// Line of the header.
    head: u64,
    convention: Convention,
    /// Whether the user knows that lines are no UTF-8.
    is_told: bool,
}

/// The rows that a table begins with, whole, and all of it.
fn beginning(path: &Path) -> Result<(Vec<u8>, Bytes), InputError> {
    let failed = |e: std::io::Error| whole(path, format!("cannot be read: {e}"));
    let mut file = File::open(path).map_err(failed)?;
    let mut first = Vec::new();
    file.by_ref().take(8).read_to_end(&mut first).map_err(failed)?;
    only_text(path, &first)?;
    let mut text = utf8(Cursor::new(first).chain(file)).map_err(failed)?;
    let mut bytes = Vec::new();
    text.by_ref().take(START as u64).read_to_end(&mut bytes).map_err(failed)?;
    let rows = if bytes.len() < START { bytes.len() } else { bytes.iter().rposition(|b| *b == b'\n').map_or(0, |last| last + 1) };
    Ok((bytes[..rows].to_vec(), Cursor::new(bytes).chain(text)))
}

impl Stream {
    /// Opens a table with two columns and those of a tensor, whose heads may say in other words, and with a unit, what they are.
    pub(super) fn open(path: &Path, first: [&'static str; 2], list: &[Named]) -> Result<Self, InputError> {
        if !path.is_file() {
            return Err(whole(path, if path.exists() { "found no file there, expected a table".into() } else { "file not found".into() }));
        }
        note_stream(path);
        let columns: Vec<&'static str> = first.into_iter().chain(TENSOR).collect();
        let mistake_at = |line: u64, column: &str, message: String| -> InputError {
            Mistake { message, place: Place::Cell { path: path.to_path_buf(), row: line, column: column.to_owned() }, help: None }.into()
        };
        let failed = |fault: Fault| mistake_at(fault.line, columns[0], fault.message);
        let (start, bytes) = beginning(path)?;
        let key = |head: &str| columns.iter().find(|c| **c == head).map(|c| (*c, 1.0)).or_else(|| named::key(list, head));
        let form = Form::of(&start, &|cells| cells.iter().filter(|cell| key(cell).is_some()).count()).map_err(failed)?;
        let heads: Vec<Option<(&str, f64)>> = form.header.iter().map(|head| key(head)).collect();
        let mut places = Vec::new();
        for name in &columns {
            let all = heads.iter().enumerate().filter_map(|(i, h)| h.filter(|h| h.0 == *name).map(|h| (i, h.1)));
            // where a column has our own name, others are none of ours
            let is_own = form.header.iter().any(|head| head == name);
            let found: Vec<(usize, f64)> = all.filter(|(i, _)| !is_own || form.header[*i] == *name).collect();
            let wrong = match found.as_slice() {
                [one] => {
                    places.push(*one);
                    continue;
                }
                [] => format!("found no column `{name}`, expected {}", columns.join(", ")),
                [(one, _), (other, _), ..] if form.header[*one] != form.header[*other] => format!(
                    "found columns `{}` and `{}`, which both are read as `{name}`, expected one of them",
                    shown(&form.header[*one]),
                    shown(&form.header[*other])
                ),
                _ => format!("found column `{name}` a second time"),
            };
            return Err(mistake_at(form.line, name, wrong));
        }
        named::tell(path, columns.iter().zip(&places).map(|(name, (i, _))| (form.header[*i].as_str(), *name)));
        let mut rows = Records::new(bytes, form.delimiter);
        for _ in 0..form.skip {
            rows.next(&mut Record::default()).map_err(failed)?;
        }
        let convention = form.convention(&start);
        form.remark().into_iter().chain(convention.remark()).for_each(|words| remark(path, &words));
        let (width, head) = (form.header.len(), form.line);
        Ok(Self { path: path.to_path_buf(), rows, columns, places, width, head, convention, is_told: false })
    }

    /// A mistake in a cell.
    pub fn at(&self, line: u64, column: usize, message: String) -> InputError {
        self.at_with_help(line, column, message, None)
    }

    fn at_with_help(&self, row: u64, column: usize, message: String, help: Option<String>) -> InputError {
        let column = self.columns[column].to_owned();
        Mistake { message, place: Place::Cell { path: self.path.clone(), row, column }, help }.into()
    }

    /// A mistake in the header.
    pub(crate) fn at_head(&self, column: usize, message: String) -> InputError {
        self.at(self.head, column, message)
    }

    /// The next row with its line.
    pub fn next(&mut self) -> Result<Option<(u64, Record)>, InputError> {
        let mut record = Record::default();
        let Some(line) = self.rows.next(&mut record).map_err(|fault| self.at(fault.line, 0, fault.message))? else { return Ok(None) };
        if !self.is_told && self.rows.foreign.is_some() {
            remark_on_encoding(&self.path, self.rows.foreign.as_ref());
            self.is_told = true;
        }
        if (self.width..record.len()).any(|c| record.get(c).is_some_and(|cell| !cell.is_empty())) {
            return Err(self.at(line, 0, format!("found {} cells, expected {}", record.len(), self.width)));
        }
        Ok(Some((line, record)))
    }

    fn cell<'r>(&self, record: &'r Record, column: usize) -> &'r str {
        record.get(self.places[column].0).unwrap_or("")
    }

    /// A cell with a name of something.
    pub fn name(&self, line: u64, record: &Record, column: usize, of: &str) -> Result<String, InputError> {
        match self.cell(record, column) {
            "" => Err(self.at(line, column, format!("found an empty cell, expected the name of a {of}"))),
            name => match fault(name) {
                Some(fault) => Err(self.at(line, column, format!("found {fault}"))),
                None => Ok(name.to_owned()),
            },
        }
    }

    /// A cell with a number.
    pub fn number(&self, line: u64, record: &Record, column: usize) -> Result<f64, InputError> {
        let cell = self.cell(record, column);
        let read = self.convention.read(cell).map(|x| x * self.places[column].1);
        read.map_err(|e| self.at_with_help(line, column, format!("found `{}`, {}", shown(cell), e.expected), e.help))
    }

    /// The tensor of a row, Pa (or Pa per unit load).
    pub fn tensor(&self, line: u64, record: &Record) -> Result<[f64; 6], InputError> {
        let mut tensor = [0.0; 6];
        for (i, t) in tensor.iter_mut().enumerate() {
            *t = self.number(line, record, i + 2)? * PA_PER_MPA;
        }
        Ok(tensor)
    }
}
