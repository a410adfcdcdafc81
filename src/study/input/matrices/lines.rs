//! Lines of a file of a matrix, and what they say.

use crate::input::error::{InputError, Source};
use crate::rotor::structure::Unknown;

/// Largest number of unknowns: beyond, modes of dense matrices take minutes.
pub(super) const MOST: usize = 1000;

/// A value with its place: row and column from 0, line of the file from 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Entry {
    pub row: usize,
    pub column: usize,
    pub value: f64,
    pub line: usize,
}

/// What a file says.
#[derive(Debug, Clone, Default)]
pub(super) struct Raw {
    pub entries: Vec<Entry>,
    /// Where the file says it.
    pub size: Option<usize>,
    /// Where the file names them.
    pub unknowns: Option<Vec<Unknown>>,
    /// Whether the file says that both triangles stand in it.
    pub is_full: bool,
}

/// A file with its lines.
pub(super) struct Lines<'a> {
    pub source: &'a Source,
}

impl<'a> Lines<'a> {
    /// The text without a mark of its encoding.
    pub fn text(&self) -> &'a str {
        self.source.text().trim_start_matches('\u{feff}')
    }

    /// Lines with their numbers from 1.
    pub fn all(&self) -> impl Iterator<Item = (usize, &'a str)> + use<'a> {
        self.text().lines().enumerate().map(|(i, line)| (i + 1, line))
    }

    /// A mistake in a line; at some text of it where that stands there.
    pub fn wrong(&self, line: usize, at: &str, message: impl Into<String>) -> InputError {
        let text = self.source.text();
        let start: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
        let own = text[start..].lines().next().unwrap_or("");
        let found = if at.is_empty() { None } else { own.find(at) };
        let span = found.map_or(start..start + own.len().max(1), |i| start + i..start + i + at.len());
        self.source.mistake(span, message.into(), None).into()
    }

    /// A finite number, with D or no letter before an exponent, too.
    pub fn number(&self, line: usize, text: &str) -> Result<f64, InputError> {
        let trimmed = text.trim();
        let mut plain = trimmed.replace(['D', 'd'], "E");
        // 1.5-3 of Nastran is 1.5E-3
        if let Some(i) = plain
            .char_indices()
            .skip(1)
            .find(|(i, c)| ['+', '-'].contains(c) && plain[..*i].ends_with(|c: char| c.is_ascii_digit() || c == '.'))
        {
            plain.insert(i.0, 'E');
        }
        match plain.parse::<f64>() {
            Ok(x) if x.is_finite() => Ok(x),
            _ => Err(self.wrong(line, trimmed, format!("found `{trimmed}`, expected a finite number"))),
        }
    }

    pub fn whole(&self, line: usize, text: &str) -> Result<u64, InputError> {
        let trimmed = text.trim();
        trimmed.parse().map_err(|_| self.wrong(line, trimmed, format!("found `{trimmed}`, expected a whole number")))
    }

    /// A number from 1 as an index.
    pub fn index(&self, line: usize, text: &str) -> Result<usize, InputError> {
        match self.whole(line, text)? {
            n if (1..=MOST as u64).contains(&n) => Ok(n as usize - 1),
            n => Err(self.wrong(
                line,
                text.trim(),
                format!("found index {n}, expected one from 1 to {MOST}: larger matrices are to be reduced"),
            )),
        }
    }

    pub fn component(&self, line: usize, text: &str) -> Result<u8, InputError> {
        match self.whole(line, text)? {
            c @ 0..=6 => Ok(c as u8),
            c => Err(self.wrong(line, text.trim(), format!("found component {c}, expected 1 to 6, or 0 of a mode"))),
        }
    }
}
