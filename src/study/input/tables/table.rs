//! A table in a file, row by row, with the place of each mistake.

use super::encoding::{other_kind, utf8};
use super::form::{Form, Score};
use super::named::{self, Named};
use super::numbers::Convention;
use super::records::{Record, Records};
use super::shown::shown;
use crate::input::error::{InputError, Mistake, Place, read_bytes};
use crate::input::files::remark;
use crate::input::letters::fault;
use std::io::{Cursor, Read};
use std::path::{Path, PathBuf};

/// A mistake of a whole file.
pub fn whole(path: &Path, message: String) -> InputError {
    Mistake { message, place: Place::File(path.to_path_buf()), help: None }.into()
}

/// A mistake of a file that is no text.
///
/// # Errors
/// Always where it begins as one of another kind.
pub(super) fn only_text(path: &Path, start: &[u8]) -> Result<(), InputError> {
    let Some(kind) = other_kind(start) else { return Ok(()) };
    let help = "a spreadsheet saves one of its sheets as `CSV UTF-8`".to_owned();
    let message = format!("found {kind}, expected a table as text");
    Err(Mistake { message, place: Place::File(path.to_path_buf()), help: Some(help) }.into())
}

/// What is to be said of a table in which a line is no UTF-8.
pub(super) fn remark_on_encoding(path: &Path, foreign: Option<&(u64, String)>) {
    if let Some((line, text)) = foreign {
        let words = "the file is no UTF-8, and read as Windows-1252 (latin-1): if this is not what stands there, save it as UTF-8:";
        remark(path, &format!("{words} `{}` in line {line}", shown(text)));
    }
}

pub struct Table {
    path: PathBuf,
    pub header: Vec<String>,
    /// Line in the file and cells, as many as the header has (missing ones at the end are empty).
    pub rows: Vec<(u64, Vec<String>)>,
    /// Line of the header.
    head: u64,
    convention: Convention,
    /// Of the units of columns that are named in other words; empty where none is.
    factors: Vec<f64>,
    /// Heads as they stand in the file; empty where none is named in other words.
    written: Vec<String>,
}

impl Table {
    /// A mistake in a cell.
    pub fn at(&self, row: u64, column: usize, message: String) -> InputError {
        self.at_with_help(row, column, message, None)
    }

    fn at_with_help(&self, row: u64, column: usize, message: String, help: Option<String>) -> InputError {
        let column = self.header.get(column).cloned().unwrap_or_else(|| format!("{}", column + 1));
        Mistake { message, place: Place::Cell { path: self.path.clone(), row, column }, help }.into()
    }

    /// A mistake in the header.
    pub(crate) fn at_head(&self, column: usize, message: String) -> InputError {
        self.at(self.head, column, message)
    }

    /// The same with help.
    pub(crate) fn at_head_with_help(&self, column: usize, message: String, help: String) -> InputError {
        self.at_with_help(self.head, column, message, Some(help))
    }

    /// What is to be said of it.
    pub(crate) fn remark(&self, words: &str) {
        remark(&self.path, words);
    }

    pub fn whole(&self, message: String) -> InputError {
        whole(&self.path, message)
    }

    /// Cells under a header that has some of these columns, each once.
    pub fn read(path: &Path, columns: &[&str]) -> Result<Self, InputError> {
        Self::read_said(path, columns, &|_| None)
    }

    /// The same where heads may say in other words, and with a unit, what the columns are.
    pub(super) fn read_named(path: &Path, columns: &[&str], list: &[Named]) -> Result<Self, InputError> {
        Self::read_said(path, columns, &|head| named::key(list, head).map(|(key, factor)| (key.to_owned(), factor)))
    }

    /// The same where `said` tells what a head says: a name of ours, and the factor of its unit.
    pub(super) fn read_said(path: &Path, columns: &[&str], said: &dyn Fn(&str) -> Option<(String, f64)>) -> Result<Self, InputError> {
        let says = |cell: &&str| columns.contains(cell) || said(cell).is_some();
        let mut table = Self::of(path, &|cells| cells.iter().filter(|cell| says(cell)).count())?;
        table.tell_convention();
        let written = table.header.clone();
        table.factors = vec![1.0; table.header.len()];
        for (head, factor) in table.header.iter_mut().zip(&mut table.factors).filter(|(head, _)| !columns.contains(&head.as_str())) {
            if let Some(own) = said(head) {
                (*head, *factor) = own;
            }
        }
        // an article number beside a designation: both say what a row is called
        let mut names = (0..table.header.len()).filter(|i| table.header[*i] == "name" && written[*i] != "name");
        let first = names.next();
        for again in names.filter(|i| first.is_some_and(|first| written[first] != written[*i])).collect::<Vec<_>>() {
            table.header[again].clone_from(&written[again]);
        }
        named::tell(path, written.iter().zip(&table.header).map(|(head, key)| (head.as_str(), key.as_str())));
        table.written.clone_from(&written);
        if table.header.is_empty() {
            return Err(table.whole(format!("found an empty table, expected a header with a column `{}`", columns[0])));
        }
        for (i, name) in table.header.iter().enumerate() {
            if let Some(first) = table.header[..i].iter().position(|other| other == name) {
                let found = if written[first] == written[i] {
                    format!("found column `{name}` a second time")
                } else {
                    format!(
                        "found columns `{}` and `{}`, which both are read as `{name}`, expected one of them",
                        shown(&written[first]),
                        shown(&written[i])
                    )
                };
                return Err(table.at_head(i, found));
            }
        }
        Ok(table)
    }

    /// Cells under the header that `score` tells from other rows.
    pub(crate) fn of(path: &Path, score: Score) -> Result<Self, InputError> {
        let mut table = Self {
            path: path.to_path_buf(),
            header: Vec::new(),
            rows: Vec::new(),
            head: 1,
            convention: Convention::default(),
            factors: Vec::new(),
            written: Vec::new(),
        };
        let bytes = read_bytes(path).map_err(|e| table.whole(e))?;
        only_text(path, &bytes)?;
        let mut text = Vec::new();
        let read = utf8(Cursor::new(bytes)).and_then(|mut reader| reader.read_to_end(&mut text));
        read.map_err(|e| table.whole(format!("the table could not be read: {e}")))?;
        let form = Form::of(&text, score).map_err(|fault| table.at(fault.line, 0, fault.message))?;
        (table.header, table.head) = (form.header.clone(), form.line);
        table.convention = form.convention(&text);
        let mut records = Records::new(Cursor::new(text.as_slice()), form.delimiter);
        let (mut record, mut count) = (Record::default(), 0);
        while let Some(row) = records.next(&mut record).map_err(|fault| table.at(fault.line, 0, fault.message))? {
            count += 1;
            if count > form.skip {
                table.push(row, &record, form.is_known)?;
            }
        }
        remark_on_encoding(path, records.foreign.as_ref());
        form.remark().into_iter().for_each(|words| remark(path, &words));
        Ok(table)
    }

    /// Adds a row; it has no more cells than a header that is known.
    fn push(&mut self, row: u64, record: &Record, is_known: bool) -> Result<(), InputError> {
        let columns = self.header.len();
        let last = (columns..record.len()).rev().find(|c| is_known && record.get(*c).is_some_and(|cell| !cell.is_empty()));
        if let Some(cells) = last.map(|last| last + 1) {
            // "0,0,1,25" for 0.0 and 1.25
            let hint = if cells == 2 * columns { ": decimal commas separate columns, expected points" } else { "" };
            return Err(self.at(row, columns, format!("found {cells} cells, expected {columns}{hint}")));
        }
        self.rows.push((row, (0..columns).map(|c| record.get(c).unwrap_or("").to_owned()).collect()));
        Ok(())
    }

    /// Learns from these columns alone what separates decimals: others, which are left out, say nothing of them.
    pub(crate) fn learn_from(&mut self, columns: &[usize]) {
        let mut convention = self.convention.anew();
        for (row, cells) in &self.rows {
            columns.iter().filter_map(|c| cells.get(*c)).for_each(|cell| convention.note(*row, cell));
        }
        self.convention = convention;
    }

    /// How a number was read that could be read in two ways, told to the user.
    pub(crate) fn tell_convention(&self) {
        self.convention.remark().into_iter().for_each(|words| remark(&self.path, &words));
    }

    /// A cell as a number; nothing where it is empty.
    pub fn number(&self, row: u64, column: usize, cell: &str) -> Result<Option<f64>, InputError> {
        if cell.is_empty() {
            return Ok(None);
        }
        let factor = self.factors.get(column).copied().unwrap_or(1.0);
        let read = self.convention.read(cell);
        read.map(|value| Some(value * factor))
            .map_err(|e| self.at_with_help(row, column, format!("found `{}`, {}", shown(cell), e.expected), e.help))
    }

    /// A cell with words that are written to other tables.
    pub(crate) fn words(&self, row: u64, column: usize, cell: &str) -> Result<String, InputError> {
        fault(cell).map_or_else(|| Ok(cell.to_owned()), |fault| Err(self.at(row, column, format!("found {fault}"))))
    }

    /// A cell that must hold a number.
    pub(crate) fn filled(&self, row: u64, column: usize, cell: &str) -> Result<f64, InputError> {
        self.number(row, column, cell)?.ok_or_else(|| self.at(row, column, "found an empty cell, expected a number".into()))
    }

    /// Without columns that no row fills, as those for remarks, but for those of some names.
    pub(super) fn without_empty_columns(mut self, named: &[&str]) -> Self {
        let is_kept = |c: usize| named.contains(&self.header[c].as_str()) || self.rows.iter().any(|(_, cells)| !cells[c].is_empty());
        let kept: Vec<usize> = (0..self.header.len()).filter(|c| is_kept(*c)).collect();
        self.rows.iter_mut().for_each(|(_, cells)| *cells = kept.iter().map(|c| cells[*c].clone()).collect());
        if !self.factors.is_empty() {
            self.factors = kept.iter().map(|c| self.factors[*c]).collect();
        }
        if !self.written.is_empty() {
            self.written = kept.iter().map(|c| self.written[*c].clone()).collect();
        }
        self.header = kept.into_iter().map(|c| self.header[c].clone()).collect();
        self
    }

    /// All cells, each filled with a number.
    pub fn numbers(&self) -> Result<Vec<(u64, Vec<f64>)>, InputError> {
        let row = |(line, cells): &(u64, Vec<String>)| -> Result<(u64, Vec<f64>), InputError> {
            let cells = cells.iter().enumerate().map(|(c, cell)| self.filled(*line, c, cell)).collect::<Result<_, _>>()?;
            Ok((*line, cells))
        };
        self.rows.iter().map(row).collect()
    }

    /// The names of its columns, for a message.
    pub(crate) fn all_columns(&self) -> String {
        self.header.iter().map(|h| format!("`{}`", shown(h))).collect::<Vec<_>>().join(", ")
    }

    /// Index of a column that must be there.
    pub fn column(&self, name: &str) -> Result<usize, InputError> {
        self.header.iter().position(|h| h == name).ok_or_else(|| self.without(name, &format!("`{name}`"), None))
    }

    /// The mistake that a column is missing: what was expected among its columns, with help.
    pub(super) fn without(&self, name: &str, expected: &str, help: Option<String>) -> InputError {
        let message = format!("found columns {}, expected {expected} among them", self.all_columns());
        Mistake { message, place: Place::Cell { path: self.path.clone(), row: self.head, column: name.to_owned() }, help }.into()
    }

    /// Whether a column is named in other words than its key.
    pub(super) fn is_in_other_words(&self, column: usize) -> bool {
        self.written.get(column).is_some_and(|head| *head != self.header[column])
    }

    /// Index of a column that may be there.
    pub(crate) fn optional(&self, name: &str) -> Option<usize> {
        self.header.iter().position(|h| h == name)
    }
}
