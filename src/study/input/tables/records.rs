//! Rows of cells, each with the line in which it begins: quoted cells may hold delimiters and line ends; blank lines, rows of empty cells and lines that begin with `#` are left out.

use super::encoding::windows_1252;
use std::io::BufRead;
use std::ops::Range;

/// A quoted cell of more lines is one whose quotation mark was left open.
const MOST_LINES: u64 = 100;
/// A longer line is no row of a table.
const LONGEST: usize = 1 << 24;

/// Cells of a row.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Record {
    text: String,
    cells: Vec<Range<usize>>,
}

impl Record {
    /// A cell, without blanks round it; None behind the last.
    pub(crate) fn get(&self, cell: usize) -> Option<&str> {
        self.cells.get(cell).map(|range| &self.text[range.clone()])
    }

    pub(crate) fn len(&self) -> usize {
        self.cells.len()
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &str> {
        self.cells.iter().map(|range| &self.text[range.clone()])
    }

    fn push(&mut self, cell: &str) {
        let start = self.text.len();
        self.text.push_str(cell.trim());
        self.cells.push(start..self.text.len());
    }

    /// Splits a line; false where a quotation mark is left open.
    fn split(&mut self, line: &str, delimiter: char) -> bool {
        self.text.clear();
        self.cells.clear();
        let mut rest = line;
        loop {
            let quoted = rest.trim_start_matches(' ').strip_prefix('"');
            let (cell, behind) = match quoted {
                None => (None, rest),
                Some(mut inner) => {
                    let mut cell = String::new();
                    loop {
                        let Some((before, after)) = inner.split_once('"') else { return false };
                        cell.push_str(before);
                        inner = after;
                        let Some(more) = after.strip_prefix('"') else { break };
                        // two quotation marks are one in the cell
                        cell.push('"');
                        inner = more;
                    }
                    (Some(cell), inner)
                }
            };
            let end = behind.find(delimiter);
            let own = &behind[..end.unwrap_or(behind.len())];
            match cell {
                Some(cell) => self.push(&(cell + own)),
                None => self.push(own),
            }
            let Some(end) = end else { return true };
            rest = &behind[end + delimiter.len_utf8()..];
        }
    }
}

/// What keeps a row from being read.
#[derive(Debug)]
pub(crate) struct Fault {
    pub line: u64,
    pub message: String,
}

/// Reads rows.
pub(crate) struct Records<R> {
    input: R,
    delimiter: char,
    /// Lines read so far.
    line: u64,
    bytes: Vec<u8>,
    /// The first line that is no UTF-8, with its text in Windows-1252.
    pub(super) foreign: Option<(u64, String)>,
}

impl<R: BufRead> Records<R> {
    pub(crate) fn new(input: R, delimiter: char) -> Self {
        Self { input, delimiter, line: 0, bytes: Vec::new(), foreign: None }
    }

    /// The next line without its end, appended to `text`; false at the end of the file.
    fn append_line(&mut self, text: &mut String) -> Result<bool, Fault> {
        let fault = |line: u64, message: String| Fault { line, message };
        self.bytes.clear();
        let read = std::io::Read::take(&mut self.input, LONGEST as u64).read_until(b'\n', &mut self.bytes);
        if read.map_err(|e| fault(self.line + 1, format!("the table could not be read: {e}")))? == 0 {
            return Ok(false);
        }
        self.line += 1;
        if self.bytes.len() == LONGEST {
            return Err(fault(self.line, format!("found a line of more than {LONGEST} bytes, expected rows of a table")));
        }
        while self.bytes.last().is_some_and(|b| [b'\n', b'\r'].contains(b)) {
            self.bytes.pop();
        }
        if self.bytes.contains(&0) {
            return Err(fault(
                self.line,
                "found a zero byte, as UTF-16 without its mark has, expected UTF-8: save the table as UTF-8".into(),
            ));
        }
        if let Ok(line) = std::str::from_utf8(&self.bytes) {
            text.push_str(line);
        } else if let Some(line) = windows_1252(&self.bytes) {
            text.push_str(&line);
            self.foreign.get_or_insert((self.line, line));
        } else {
            return Err(fault(self.line, "found bytes that are not text, expected UTF-8".into()));
        }
        Ok(true)
    }

    /// Reads the next row into `record`, and tells the line in which it begins; None at the end.
    pub(crate) fn next(&mut self, record: &mut Record) -> Result<Option<u64>, Fault> {
        let mut text = String::new();
        loop {
            text.clear();
            if !self.append_line(&mut text)? {
                return Ok(None);
            }
            if text.starts_with('#') || text.trim().is_empty() {
                continue;
            }
            let first = self.line;
            while !record.split(&text, self.delimiter) {
                text.push('\n');
                if self.line - first >= MOST_LINES || !self.append_line(&mut text)? {
                    return Err(Fault {
                        line: first,
                        message: "found a quotation mark that is not closed, expected another behind it".into(),
                    });
                }
            }
            if record.iter().any(|cell| !cell.is_empty()) {
                return Ok(Some(first));
            }
        }
    }
}
