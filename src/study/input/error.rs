//! Mistakes in input files, each with its place, what was found and what was expected.

use super::letters::fault;
use super::overrides::{OPTION, Overrides};
use super::read_toml;
use super::schema::bounds::{Bounds, NOT_NEGATIVE, POSITIVE, Whole};
use super::snippet::{shortened, window};
pub use super::spanned::At;
use super::wording::{BACKSLASH, has_escapes, is_table, of_grammar};
use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A text file being read.
#[derive(Debug, Clone)]
pub struct Source {
    path: PathBuf,
    text: String,
    overrides: Overrides,
}

/// One mistake.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mistake {
    /// What was found and what was expected, in a line.
    pub message: String,
    /// Where.
    pub place: Place,
    /// How to mend it.
    pub help: Option<String>,
}

/// Where a mistake is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// A file as a whole.
    File(PathBuf),
    /// A stretch of a line in a text file.
    Text {
        /// The file.
        path: PathBuf,
        /// From 1.
        line: usize,
        /// From 1, in characters.
        column: usize,
        /// The line itself.
        text: String,
        /// Characters to underline.
        length: usize,
    },
    /// A cell of a table.
    Cell {
        /// The file.
        path: PathBuf,
        /// Line in the file, from 1 (the header is line 1).
        row: u64,
        /// Name of the column.
        column: String,
    },
}

/// One or more mistakes in the input.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct InputError {
    /// At least one.
    pub mistakes: Vec<Mistake>,
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "error: {}", shortened(&self.message))?;
        match &self.place {
            Place::File(path) => writeln!(f, "  --> {}", path.display())?,
            Place::Cell { path, row, column } => writeln!(f, "  --> {}, row {row}, column `{column}`", path.display())?,
            Place::Text { path, line, column, text, length } => {
                let gutter = " ".repeat(line.to_string().len());
                writeln!(f, "{gutter} --> {}:{line}:{column}", path.display())?;
                writeln!(f, "{gutter} |")?;
                let (text, before, length) = window(text, column - 1, *length);
                writeln!(f, "{line} | {text}")?;
                // tabs keep their width, so that the underline sits below the value
                let indent: String = text.chars().take(before).map(|c| if c == '\t' { '\t' } else { ' ' }).collect();
                writeln!(f, "{gutter} | {indent}{}", "^".repeat(length))?;
            }
        }
        if let Some(help) = &self.help {
            writeln!(f, "  = help: {}", shortened(help))?;
        }
        Ok(())
    }
}

impl std::error::Error for InputError {}

impl InputError {
    /// The same mistakes with files of one folder called as in another.
    #[must_use]
    #[doc(hidden)]
    pub fn moved(mut self, from: &Path, to: &Path) -> Self {
        for mistake in &mut self.mistakes {
            let (Place::File(path) | Place::Text { path, .. } | Place::Cell { path, .. }) = &mut mistake.place;
            if let Ok(name) = path.strip_prefix(from) {
                *path = to.join(name);
            }
        }
        self
    }

    /// One mistake of a whole file.
    #[doc(hidden)]
    pub fn of_file(path: &Path, message: impl Into<String>) -> Self {
        Mistake { message: message.into(), place: Place::File(path.to_path_buf()), help: None }.into()
    }

    /// Mistakes in the order of the lines they stand in.
    pub(crate) fn sorted(mut mistakes: Vec<Mistake>) -> Self {
        mistakes.sort_by_key(|m| match &m.place {
            Place::File(_) => (0, 0, 0),
            Place::Text { line, column, .. } => (1, *line, *column),
            Place::Cell { row, .. } => (2, usize::try_from(*row).unwrap_or(usize::MAX), 0),
        });
        Self { mistakes }
    }
}

impl From<Mistake> for InputError {
    fn from(mistake: Mistake) -> Self {
        Self { mistakes: vec![mistake] }
    }
}

/// Where a file was looked for, and why it may not be there.
pub(crate) fn looked_for(path: &Path) -> String {
    let name = path.to_string_lossy();
    if has_escapes(&name) {
        return format!("looked for {}: {BACKSLASH}", name.escape_debug());
    }
    format!("looked for {name}; paths are relative to the file they stand in")
}

/// What a file that is no UTF-8 may be, and how to mend it.
fn encoded(bytes: &[u8]) -> &'static str {
    match bytes {
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => "this is UTF-16: save the file as UTF-8",
        [b'P', b'K', ..] | [0xd0, 0xcf, ..] => "this is a workbook or an archive: studies and engines are texts (TOML), tables are CSV",
        _ => "this may be latin-1 (Windows-1252): save the file as UTF-8",
    }
}

fn io_reason(error: &std::io::Error) -> String {
    match error.kind() {
        std::io::ErrorKind::NotFound => "file not found".to_owned(),
        std::io::ErrorKind::PermissionDenied => "no permission to read the file".to_owned(),
        _ => format!("the file could not be read: {error}"),
    }
}

/// Larger files are no studies.
const MOST_BYTES: u64 = 64 << 20;

/// Bytes of a regular file.
///
/// # Errors
/// What keeps it from being read, in words.
pub(crate) fn read_bytes(path: &Path) -> Result<Vec<u8>, String> {
    let metadata = std::fs::metadata(path).map_err(|e| io_reason(&e))?;
    if metadata.is_dir() {
        return Err("found a folder, expected a file".into());
    }
    if !metadata.is_file() {
        return Err("found a device or pipe, expected a file".into());
    }
    if metadata.len() > MOST_BYTES {
        return Err(format!("found a file of {} bytes, expected at most {MOST_BYTES}", metadata.len()));
    }
    let bytes = std::fs::read(path).map_err(|e| io_reason(&e))?;
    super::files::note(path, &bytes);
    Ok(bytes)
}

impl Source {
    /// A text that is there already, under the name it is called in messages.
    pub fn new(path: &Path, text: &str) -> Self {
        Self { path: path.to_path_buf(), text: text.to_owned(), overrides: Overrides::default() }
    }

    /// The same with other values of some keys.
    pub(super) fn with(self, overrides: Overrides) -> Self {
        Self { overrides, ..self }
    }

    /// Reads a file named on the command line.
    ///
    /// # Errors
    /// Where it cannot be read.
    pub fn read(path: &Path) -> Result<Self, InputError> {
        let whole = |message| Mistake { message, place: Place::File(path.to_path_buf()), help: None };
        Self::decode(path, read_bytes(path).map_err(whole)?)
    }

    /// Reads a file named in another one, at `span` there.
    ///
    /// # Errors
    /// Where it cannot be read; the place is where it is named.
    pub(crate) fn read_named(path: &Path, named_in: &Self, span: Range<usize>) -> Result<Self, InputError> {
        let bytes = read_bytes(path).map_err(|reason| named_in.mistake(span, reason, Some(looked_for(path))))?;
        Self::decode(path, bytes)
    }

    fn decode(path: &Path, bytes: Vec<u8>) -> Result<Self, InputError> {
        String::from_utf8(bytes).map(|text| Self::new(path, &text)).map_err(|e| {
            let good = e.utf8_error().valid_up_to();
            let text = String::from_utf8_lossy(e.as_bytes()).into_owned();
            let help =
                if is_table(&text) { "this is a table: `hartog import` takes one of masses and shafts" } else { encoded(e.as_bytes()) };
            // what is good stands at the same place in the lossy text
            let source = Self::new(path, &text);
            source.mistake(good..good + 1, "found bytes that are not text, expected UTF-8".into(), Some(help.into())).into()
        })
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// A mistake at a stretch of bytes.
    pub(crate) fn mistake(&self, span: Range<usize>, message: String, help: Option<String>) -> Mistake {
        if let Some((text, span)) = self.in_override(&span) {
            return Self::new(Path::new(OPTION), text).mistake(span, message, help);
        }
        let start = span.start.min(self.text.len());
        let line_start = self.text[..start].rfind('\n').map_or(0, |i| i + 1);
        let line_end = self.text[start..].find('\n').map_or(self.text.len(), |i| start + i);
        let text = self.text[line_start..line_end].trim_end_matches('\r').to_owned();
        let mut end = span.end.clamp(start, line_end);
        while !self.text.is_char_boundary(end) {
            end += 1;
        }
        Mistake {
            message,
            place: Place::Text {
                path: self.path.clone(),
                line: self.text[..line_start].matches('\n').count() + 1,
                column: self.text[line_start..start].chars().count() + 1,
                length: self.text[start..end].trim_end().chars().count().max(1),
                text,
            },
            help,
        }
    }

    /// The text of the override in which a place is that is not in the file, and the place there.
    fn in_override(&self, span: &Range<usize>) -> Option<(&str, Range<usize>)> {
        let (text, start) = self.overrides.holding(self.text.len(), span.start)?;
        Some((text, span.start - start..span.end.saturating_sub(start)))
    }

    /// Parses TOML.
    ///
    /// # Errors
    /// The first mistake of grammar, key or type.
    pub fn parse<T: serde::de::DeserializeOwned>(&self) -> Result<T, InputError> {
        read_toml::from_str(&self.text, &self.overrides).map_err(|e| {
            if self.text.lines().all(|line| line.trim().is_empty() || line.trim_start().starts_with('#')) {
                let help = "`hartog new` writes files to begin with".to_owned();
                let message = "found an empty file, expected one with keys".to_owned();
                return Mistake { message, place: Place::File(self.path.clone()), help: Some(help) }.into();
            }
            let span = e.span.unwrap_or(0..0);
            let (text, place) = self.in_override(&span).unwrap_or((&self.text, span.clone()));
            let (message, help) = of_grammar(text, &place, &e.message);
            self.mistake(span, message, help).into()
        })
    }
}

/// Collects mistakes while a file is checked, so that all are reported at once.
#[derive(Debug)]
pub struct Check<'a> {
    /// The file.
    pub source: &'a Source,
    /// Found so far.
    pub mistakes: Vec<Mistake>,
    /// Stations of the engine that a rigid mesh makes one body with another, and that.
    pub(crate) meshed: Vec<(String, String)>,
}

/// Mistakes of a file that have a place: more than are ever told.
const MOST_PLACED: usize = 1000;

impl<'a> Check<'a> {
    /// Nothing found yet.
    pub fn new(source: &'a Source) -> Self {
        Self { source, mistakes: Vec::new(), meshed: Vec::new() }
    }

    /// Records a mistake.
    pub fn wrong<T>(&mut self, at: &At<T>, message: impl Into<String>) {
        self.put(at.span(), message.into(), None);
    }

    /// Records a mistake with help.
    pub(crate) fn wrong_with_help<T>(&mut self, at: &At<T>, message: impl Into<String>, help: impl Into<String>) {
        self.put(at.span(), message.into(), Some(help.into()));
    }

    fn put(&mut self, span: Range<usize>, message: String, help: Option<String>) {
        // finding a line takes a walk through the file: those after very many are counted only
        let counted = || Mistake {
            message: String::new(),
            place: Place::Cell { path: PathBuf::new(), row: u64::MAX, column: String::new() },
            help: None,
        };
        let placed = self.mistakes.len() < MOST_PLACED;
        self.mistakes.push(if placed { self.source.mistake(span, message, help) } else { counted() });
    }

    /// A number of a kind.
    pub(crate) fn within(&mut self, value: &At<f64>, bounds: &Bounds) -> f64 {
        self.within_as(value, bounds, bounds.what)
    }

    /// The same, where a message calls it otherwise.
    pub(crate) fn within_as(&mut self, value: &At<f64>, bounds: &Bounds, what: &str) -> f64 {
        let x = *value.get_ref();
        if !bounds.contains(x) {
            let expected = bounds.expected_of(what);
            let plain = x == 0.0 || !x.is_finite() || (1e-6..1e9).contains(&x.abs());
            self.wrong(value, if plain { format!("found {x}, expected {expected}") } else { format!("found {x:e}, expected {expected}") });
        }
        x
    }

    /// A whole number of a kind; of one out of its range, which is a mistake, the nearest within it.
    pub(crate) fn whole(&mut self, value: &At<i64>, range: &Whole) -> u64 {
        let x = *value.get_ref();
        if !(range.low..=range.high).contains(&x) {
            self.wrong(value, format!("found {x}, expected {}", range.expected()));
        }
        x.clamp(range.low, range.high).unsigned_abs()
    }

    /// A number above zero, of a size that products of a few of them stay finite.
    pub(crate) fn positive(&mut self, value: &At<f64>) -> f64 {
        self.within(value, &POSITIVE)
    }

    /// A number of at least zero.
    pub(crate) fn not_negative(&mut self, value: &At<f64>) -> f64 {
        self.within(value, &NOT_NEGATIVE)
    }

    /// A name for tables and plots.
    pub fn name(&mut self, name: &At<String>) {
        if let Some(fault) = fault(name.get_ref()) {
            self.wrong(name, format!("found {fault}"));
        } else if name.get_ref().chars().count() > 100 {
            self.wrong(name, "found a name of more than 100 letters, expected one that can be printed");
        }
    }

    /// Ascending positive numbers, at least one.
    pub(crate) fn ascending(&mut self, values: &At<Vec<At<f64>>>) -> Vec<f64> {
        if values.get_ref().is_empty() {
            self.wrong(values, "found an empty list, expected at least one value");
        }
        let list: Vec<f64> = values.get_ref().iter().map(|v| self.positive(v)).collect();
        for (i, pair) in list.windows(2).enumerate() {
            if pair[1] <= pair[0] {
                self.wrong(&values.get_ref()[i + 1], format!("found {} after {}, expected ascending values", pair[1], pair[0]));
            }
        }
        list
    }
}
