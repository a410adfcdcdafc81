//! The form of a table: what separates its columns, where its header is, how it writes numbers.

use super::numbers::Convention;
use super::records::{Fault, Record, Records};
use super::shown::shown;
use crate::input::import::unit::{is_unit, parts, plain};
use std::io::Cursor;

/// A header is looked for in so many rows.
const ROWS: usize = 40;
/// What separates columns, the likeliest first where a header can be read with several.
const DELIMITERS: [char; 3] = [';', '\t', ','];

/// The form of a table.
#[derive(Debug)]
pub(crate) struct Form {
    pub delimiter: char,
    pub header: Vec<String>,
    /// Line of the header.
    pub line: u64,
    /// Whether some of its columns are known.
    pub is_known: bool,
    /// Rows to leave out, the header among them.
    pub skip: usize,
    /// Lines of titles above the header: the first and the last, and what stands in the first.
    pub titles: Option<(u64, u64, String)>,
}

/// How well the cells of a row make a header: how many of its columns are known.
pub(crate) type Score<'a> = &'a dyn Fn(&[&str]) -> usize;

/// The sign that a first line `sep=;` tells, as Excel writes it.
fn told(line: &str) -> Option<char> {
    let line = line.trim_start_matches('\u{feff}').trim().trim_matches('"');
    let rest = line.get(..4).filter(|head| head.eq_ignore_ascii_case("sep=")).map(|_| &line[4..])?;
    let mut signs = rest.chars();
    signs.next().filter(|sign| DELIMITERS.contains(sign) || *sign == '|')
}

/// The first rows with a sign between columns, each with its line; as far as they can be read.
fn rows(start: &[u8], delimiter: char) -> Vec<(u64, Record)> {
    let mut records = Records::new(Cursor::new(start), delimiter);
    let mut list = Vec::new();
    let mut record = Record::default();
    while let Ok(Some(line)) = records.next(&mut record) {
        list.push((line, record.clone()));
        if list.len() == ROWS {
            break;
        }
    }
    list
}

impl Form {
    /// That of a table by its first bytes; nothing is known of an empty one.
    ///
    /// # Errors
    /// Where its first row cannot be read.
    pub(crate) fn of(start: &[u8], score: Score) -> Result<Self, Fault> {
        let first_line = start.split(|b| *b == b'\n').next().unwrap_or(&[]);
        let told = told(&String::from_utf8_lossy(first_line));
        let skipped = usize::from(told.is_some());
        let candidates: Vec<char> = told.map_or_else(|| DELIMITERS.to_vec(), |sign| vec![sign]);
        let mut best: Option<(usize, Self)> = None;
        for delimiter in candidates {
            let rows = rows(start, delimiter);
            for (i, (line, record)) in rows.iter().enumerate().skip(skipped) {
                let heads: Vec<String> = record.iter().map(str::to_owned).collect();
                let with_units = rows.get(i + 1).and_then(|(_, below)| with_units(&heads, below));
                // no number is a head
                let known_of = |heads: &[String]| score(&heads.iter().map(|h| if is_digits(h) { "" } else { h }).collect::<Vec<_>>());
                let (mut known, mut own) = (known_of(&heads), (heads, i + 1));
                if let Some(heads) = with_units.filter(|heads| known_of(heads) >= known) {
                    (known, own) = (known_of(&heads), (heads, i + 2));
                }
                if known > best.as_ref().map_or(0, |b| b.0) {
                    let titles = (i > skipped).then(|| (rows[skipped].0, rows[i - 1].0, text(&rows[skipped].1)));
                    best = Some((known, Self::new(delimiter, *line, own, titles)));
                }
            }
        }
        if let Some((_, form)) = best {
            return Ok(Self { is_known: true, ..form });
        }
        // no header that is known: the first row is taken for one, so that it is shown
        let mut delimiter = told.unwrap_or(',');
        let mut records = Records::new(Cursor::new(start), delimiter);
        let mut record = Record::default();
        let mut line = 1;
        for _ in 0..=skipped {
            line = records.next(&mut record)?.unwrap_or(1);
        }
        if told.is_none() {
            let text = text(&record);
            delimiter = [';', '\t'].into_iter().find(|d| text.contains(*d)).unwrap_or(',');
            if let Some((_, own)) = rows(start, delimiter).into_iter().next() {
                record = own;
            }
        }
        Ok(Self::new(delimiter, line, (record.iter().map(str::to_owned).collect(), skipped + 1), None))
    }

    /// With a header and the rows to leave out.
    fn new(delimiter: char, line: u64, (mut header, skip): (Vec<String>, usize), titles: Option<(u64, u64, String)>) -> Self {
        // what a spreadsheet leaves behind the last column
        while header.last().is_some_and(String::is_empty) {
            header.pop();
        }
        Self { delimiter, header, line, is_known: false, skip, titles }
    }

    /// What is to be said of lines that are left out.
    pub(crate) fn remark(&self) -> Option<String> {
        let (first, last, text) = self.titles.as_ref()?;
        let lines = if first == last {
            format!("line {first} above the header is")
        } else {
            format!("lines {first} to {last} above the header are")
        };
        Some(format!("{lines} left out: `{}`", shown(text)))
    }

    /// How the rows that begin a table write numbers.
    pub(crate) fn convention(&self, start: &[u8]) -> Convention {
        let mut convention = Convention::new(self.delimiter);
        let mut records = Records::new(Cursor::new(start), self.delimiter);
        let (mut record, mut rows) = (Record::default(), 0);
        while let Ok(Some(line)) = records.next(&mut record) {
            rows += 1;
            if rows > self.skip {
                record.iter().for_each(|cell| convention.note(line, cell));
            }
        }
        convention
    }
}

/// Heads with the units of a row of their own below them, in brackets; `None` where that row is none, or contradicts a head.
fn with_units(heads: &[String], below: &Record) -> Option<Vec<String>> {
    let units: Vec<&str> = below.iter().collect();
    let mut said = units.iter().filter(|cell| !cell.is_empty()).peekable();
    if units.iter().any(|cell| is_digits(cell)) {
        return None;
    }
    if said.peek().is_none() || units.len() > heads.len() || !units.iter().any(|cell| is_unit(cell) || is_other_unit(cell)) {
        return None;
    }
    if !said.all(|cell| is_unit(cell) || is_other_unit(cell) || ["-", "–", "%", "ψ"].contains(&bare(cell))) {
        return None;
    }
    let joined = |(head, unit): (&String, &&str)| match parts(head).1 {
        _ if unit.is_empty() => Some(head.clone()),
        None => Some(format!("{head} [{}]", bare(unit))),
        Some(own) => (plain(&own) == plain(bare(unit))).then(|| head.clone()),
    };
    let rest = &heads[units.len().min(heads.len())..];
    heads.iter().zip(&units).map(joined).chain(rest.iter().cloned().map(Some)).collect()
}

/// Whether a cell is of digits and the signs in numbers.
fn is_digits(cell: &str) -> bool {
    let cell = cell.trim();
    cell.bytes().any(|b| b.is_ascii_digit()) && cell.bytes().all(|b| b.is_ascii_digit() || b".,+-".contains(&b))
}

/// A unit without the brackets round it.
fn bare(unit: &str) -> &str {
    unit.trim().trim_matches(['[', ']', '(', ')'])
}

/// Units of columns that no chain and no pressure has.
fn is_other_unit(cell: &str) -> bool {
    ["Hz", "kHz", "°C", "deg C", "MPa", "N/mm²", "N/mm2"].contains(&bare(cell))
}

/// The filled cells of a row.
fn text(record: &Record) -> String {
    record.iter().filter(|cell| !cell.is_empty()).collect::<Vec<_>>().join(" ")
}
