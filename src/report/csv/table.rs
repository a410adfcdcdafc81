//! A table on its way to a file, and how numbers are written.

use crate::files::{Folder, Stream, WriteError};
use crate::input::{MeasureSpec, Study};
use crate::numerics::rounding::seven_digits;
use std::io::Write;

/// A table in memory.
pub struct Table {
    writer: csv::Writer<Vec<u8>>,
}

impl Table {
    pub fn new(header: &[&str]) -> Self {
        let mut table = Self { writer: csv::Writer::from_writer(Vec::new()) };
        table.row(header.iter().map(|h| (*h).to_owned()));
        table
    }

    pub fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        self.row_of(cells);
    }

    pub(crate) fn row_of(&mut self, cells: impl IntoIterator<Item = impl AsRef<[u8]>>) {
        // memory does not fail to be written to, and every row has the length of the header
        let written = self.writer.write_record(cells);
        debug_assert!(written.is_ok(), "{written:?}");
    }

    /// Moves the rows so far to a file that grows: a table may be longer than memory.
    pub(crate) fn move_to(&mut self, stream: &mut Stream) -> std::io::Result<()> {
        let rows = std::mem::replace(&mut self.writer, csv::Writer::from_writer(Vec::new()));
        stream.write_all(&rows.into_inner().unwrap_or_default())
    }

    pub(crate) fn save(self, folder: &Folder, name: &str) -> Result<(), WriteError> {
        folder.write(name, &self.writer.into_inner().unwrap_or_default())
    }
}

/// The shortest decimal that reads back exactly, below 1e-5 and from 1e16 on with an exponent.
pub fn number(x: f64) -> String {
    let mut buffer = ryu::Buffer::new();
    let text = buffer.format(x);
    text.strip_suffix(".0").unwrap_or(text).to_owned()
}

/// The shortest decimal that reads back to seven significant digits: for curves, of which there are many numbers.
pub(crate) fn rounded(x: f64) -> String {
    number(seven_digits(x))
}

pub(crate) fn optional(x: Option<f64>) -> String {
    x.map_or_else(String::new, number)
}

/// A value of the study's (first) objective in the unit of its column.
pub(crate) fn in_unit(study: &Study, value: f64) -> f64 {
    in_unit_of(&study.objective, value)
}

/// A value of an objective in the unit of its column; a margin is the inverse of what is minimised.
pub(crate) fn in_unit_of(objective: &MeasureSpec, value: f64) -> f64 {
    objective.unit.shown(value)
}
