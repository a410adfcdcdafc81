//! Mistakes in input files, each with its place, what was found and what was expected.

pub use super::at::At;
use super::excerpt::{shortened, window};
use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A text file being read.
#[derive(Debug, Clone)]
pub struct Source {
    path: PathBuf,
    text: String,
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

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, mistake) in self.mistakes.iter().enumerate() {
            write!(f, "{}{mistake}", if i > 0 { "\n" } else { "" })?;
        }
        Ok(())
    }
}

impl std::error::Error for InputError {}

impl InputError {
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
        Self { path: path.to_path_buf(), text: text.to_owned() }
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
        let bytes = read_bytes(path).map_err(|reason| {
            let help = format!("looked for {}; paths are relative to the file they stand in", path.display());
            named_in.mistake(span, reason, Some(help))
        })?;
        Self::decode(path, bytes)
    }

    fn decode(path: &Path, bytes: Vec<u8>) -> Result<Self, InputError> {
        String::from_utf8(bytes).map(|text| Self { path: path.to_path_buf(), text }).map_err(|e| {
            let good = e.utf8_error().valid_up_to();
            let text = String::from_utf8_lossy(e.as_bytes()).into_owned();
            // what is good stands at the same place in the lossy text
            let source = Self { path: path.to_path_buf(), text };
            source.mistake(good..good + 1, "found bytes that are not text, expected UTF-8".into(), None).into()
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

    /// Parses TOML.
    ///
    /// # Errors
    /// The first mistake of grammar, key or type.
    pub fn parse<T: serde::de::DeserializeOwned>(&self) -> Result<T, InputError> {
        toml::from_str(&self.text).map_err(|e| {
            let span = e.span().unwrap_or(0..0);
            let (message, help) = self.decimal_comma(&span).map_or_else(|| reword(e.message()), |found| (found, None));
            self.mistake(span, message, help).into()
        })
    }
}

impl Source {
    /// A comma between digits where one value was expected.
    fn decimal_comma(&self, span: &Range<usize>) -> Option<String> {
        let (before, rest) = self.text.split_at_checked(span.start)?;
        let digits = |c: char| c.is_ascii_digit();
        let whole = &before[before.trim_end_matches(digits).len()..];
        let decimals = rest.strip_prefix(',')?;
        let decimals = &decimals[..decimals.len() - decimals.trim_start_matches(digits).len()];
        let stands_alone = before[..before.len() - whole.len()].trim_end_matches([' ', '-', '+']).ends_with('=');
        (stands_alone && !whole.is_empty() && !decimals.is_empty())
            .then(|| format!("found the decimal comma of `{whole},{decimals}`, expected a point: `{whole}.{decimals}`"))
    }
}

/// Serde's messages in the words of an input file.
fn reword(message: &str) -> (String, Option<String>) {
    let message = message.trim_end();
    if let Some((key, rest)) = message.strip_prefix("unknown field `").and_then(|m| m.split_once('`')) {
        let known: Vec<&str> = rest.split('`').skip(1).step_by(2).collect();
        let help = closest(key, &known).map(|k| {
            let same_quantity = key.rsplit_once('_').is_some_and(|(quantity, _)| k.starts_with(quantity));
            format!("did you mean `{k}`?{}", if same_quantity { " The unit is part of the key" } else { "" })
        });
        let half = key.starts_with("stroke") && known.contains(&"crank_radius_mm");
        let help = if half { Some("`crank_radius_mm` is half the stroke".to_owned()) } else { help };
        return (format!("found unknown key `{key}`, expected {}", list(&known)), help);
    }
    if let Some((variant, rest)) = message.strip_prefix("unknown variant `").and_then(|m| m.split_once('`')) {
        let known: Vec<&str> = rest.split('`').skip(1).step_by(2).collect();
        let help = closest(variant, &known).map(|k| format!("did you mean `{k}`?"));
        return (format!("found `{variant}`, expected {}", list(&known)), help);
    }
    if let Some(key) = message.strip_prefix("missing field `").and_then(|m| m.split('`').next()) {
        return (format!("key `{key}` is missing in this table"), None);
    }
    if let Some((found, expected)) = message.strip_prefix("invalid type: ").and_then(|m| m.split_once(", expected ")) {
        let found = found.replace("map", "a table").replace("sequence", "a list").replace(" as i128", "");
        return (format!("found {found}, expected {}", plain_type(expected)), None);
    }
    if let Some((found, expected)) = message.strip_prefix("invalid value: ").and_then(|m| m.split_once(", expected ")) {
        let most = if found.starts_with("integer ") { format!(" from {} to {}", i64::MIN, i64::MAX) } else { String::new() };
        return (format!("found {found}, expected {}{most}", plain_type(expected)), None);
    }
    if let Some((found, expected)) = message.strip_prefix("invalid length ").and_then(|m| m.split_once(", expected ")) {
        return (format!("found {found} values, expected {}", plain_type(expected)), None);
    }
    if message.starts_with("wanted exactly 1 element") {
        return ("found several or no keys, expected exactly one choice in this table".to_owned(), None);
    }
    if message.starts_with("wanted string or table") {
        return ("found another type, expected one choice: a table with one key".to_owned(), None);
    }
    (message.replace('\n', ", "), None)
}

fn plain_type(expected: &str) -> &str {
    match expected {
        "f64" => "a number",
        "i64" | "u64" | "u32" | "usize" => "a whole number",
        "a string" => "a text in quotes",
        "a sequence" => "a list",
        "an array of length 2" => "two values",
        other if other.starts_with("struct ") => "a table",
        other => other,
    }
}

fn list(known: &[&str]) -> String {
    let quoted: Vec<String> = known.iter().map(|k| format!("`{k}`")).collect();
    match quoted.as_slice() {
        [] => "no key here".to_owned(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} or {last}", first.join(", ")),
    }
}

/// The known word most like `word`: with the longest common start, at least half of it.
pub(crate) fn closest<'k>(word: &str, known: &[&'k str]) -> Option<&'k str> {
    let common = |k: &str| {
        let start = word.chars().zip(k.chars()).take_while(|(a, b)| a == b).count();
        let end = word.chars().rev().zip(k.chars().rev()).take_while(|(a, b)| a == b).count();
        (start + end).min(word.len())
    };
    known.iter().copied().max_by_key(|k| (common(k), usize::MAX - k.len())).filter(|k| 2 * common(k) > word.len())
}

/// Collects mistakes while a file is checked, so that all are reported at once.
#[derive(Debug)]
pub struct Check<'a> {
    /// The file.
    pub source: &'a Source,
    /// Found so far.
    pub mistakes: Vec<Mistake>,
}

/// Smallest and largest size of a number that is not zero.
const SMALLEST: f64 = 1e-20;
const LARGEST: f64 = 1e20;

impl<'a> Check<'a> {
    /// Nothing found yet.
    pub fn new(source: &'a Source) -> Self {
        Self { source, mistakes: Vec::new() }
    }

    /// Records a mistake.
    pub fn wrong<T>(&mut self, at: &At<T>, message: impl Into<String>) {
        self.mistakes.push(self.source.mistake(at.span(), message.into(), None));
    }

    /// Records a mistake with help.
    pub(crate) fn wrong_with_help<T>(&mut self, at: &At<T>, message: impl Into<String>, help: impl Into<String>) {
        self.mistakes.push(self.source.mistake(at.span(), message.into(), Some(help.into())));
    }

    /// A number within a range, whose words are `expected`; written so that nan is outside every range.
    pub fn within(&mut self, value: &At<f64>, range: impl std::ops::RangeBounds<f64>, expected: &str) -> f64 {
        let x = *value.get_ref();
        if !(x.is_finite() && range.contains(&x)) {
            let plain = x == 0.0 || !x.is_finite() || (1e-6..1e9).contains(&x.abs());
            self.wrong(value, if plain { format!("found {x}, expected {expected}") } else { format!("found {x:e}, expected {expected}") });
        }
        x
    }

    /// A number above zero, of a size that products of a few of them stay finite.
    pub(crate) fn positive(&mut self, value: &At<f64>) -> f64 {
        self.within(value, SMALLEST..=LARGEST, "a number above zero, from 1e-20 to 1e20")
    }

    /// A number of at least zero.
    pub(crate) fn not_negative(&mut self, value: &At<f64>) -> f64 {
        self.within(value, 0.0..=LARGEST, "a number of at least zero, up to 1e20")
    }

    /// A name for tables and plots.
    pub fn name(&mut self, name: &At<String>) {
        if name.get_ref().chars().any(char::is_control) || name.get_ref().chars().count() > 100 {
            self.wrong(name, "found a name with control characters or more than 100 letters, expected one that can be printed");
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
