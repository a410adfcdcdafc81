//! Keys with other values than a file gives them, as `--set KEY=VALUE` has them: `load_fraction=0.5`, `optimise.absorber.0.types=["rubber"]`.
//!
//! They take their place in the tree of the file before anything is read of it, so that they are checked as if they stood there. Their text stands
//! behind that of the file: a place beyond its end is one of theirs.

use super::wording::of_grammar;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeArray, DeString, DeTable, DeValue};

/// Where mistakes of them are.
pub(super) const OPTION: &str = "--set";
/// Key of a study that names its engine file; before a key of that file.
const ENGINE: &str = "engine";

/// A part of a key, and where it stands in the text.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Part {
    name: String,
    span: Range<usize>,
}

/// A key with its value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Override {
    text: String,
    key: Vec<Part>,
    value: Range<usize>,
}

/// Why a text is no override, or has no place in a file, and which bytes are wrong.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct NoOverride {
    pub message: String,
    pub span: Range<usize>,
    pub help: Option<String>,
}

/// The first sign of equality outside quotes.
fn equals(text: &str) -> Option<usize> {
    let mut quote = None;
    text.char_indices().find_map(|(i, c)| {
        match (c, quote) {
            ('=', None) => return Some(i),
            ('"' | '\'', None) => quote = Some(c),
            (c, Some(q)) if c == q => quote = None,
            _ => {}
        }
        None
    })
}

/// The parts of a key: each is the only one of the table of that before.
fn parts(key: &str) -> Result<Vec<Part>, NoOverride> {
    let document = format!("{key}=0");
    let found = if key.trim().is_empty() { "no key".to_owned() } else { format!("`{key}`") };
    let message = format!("found {found}, expected one with points between its parts, as `hartog keys` lists them");
    let wrong = || NoOverride { message: message.clone(), span: 0..key.len().max(1), help: None };
    let mut here = DeTable::parse(&document).map_err(|_| wrong())?.into_inner();
    let mut list = Vec::new();
    loop {
        let Some((name, value)) = here.into_iter().next() else { return Err(wrong()) };
        list.push(Part { span: name.span(), name: name.into_inner().into_owned() });
        match value.into_inner() {
            DeValue::Table(inner) => here = inner,
            _ => return Ok(list),
        }
    }
}

impl Override {
    /// Reads `KEY=VALUE`.
    ///
    /// # Errors
    /// Where it is none.
    pub(super) fn parse(text: &str) -> Result<Self, NoOverride> {
        let Some(at) = equals(text) else {
            let message = format!("found `{text}`, expected KEY=VALUE");
            return Err(NoOverride { message, span: 0..text.len().max(1), help: None });
        };
        let key = parts(&text[..at])?;
        let (value, own) = (at + 1..text.len(), &text[at + 1..]);
        if own.trim().is_empty() {
            return Err(NoOverride { message: "found no value, expected one behind the `=`".into(), span: at..at + 1, help: None });
        }
        if let Err(e) = DeValue::parse(own) {
            let word = own.trim();
            if word.starts_with(char::is_alphabetic) && word.chars().all(|c| c.is_alphanumeric() || "_-./ ".contains(c)) {
                let message = format!("found {word}, expected a value as it stands in a file");
                let help = Some(format!("a text stands in quotes: --set '{}=\"{word}\"'", &text[..at]));
                return Err(NoOverride { message, span: value, help });
            }
            let place = e.span().unwrap_or(0..own.len());
            let span = value.start + place.start..value.start + place.end;
            let (message, help) = of_grammar(text, &span, e.message());
            return Err(NoOverride { message, span, help });
        }
        Ok(Self { text: text.to_owned(), key, value })
    }

    /// As it was given.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Its key, its parts with points between.
    pub(super) fn path(&self) -> String {
        self.key.iter().map(|p| p.name.as_str()).collect::<Vec<_>>().join(".")
    }

    /// Whether it is of a key of the study (or, as `of_engine`, of its engine file) with this path.
    pub(super) fn is_of(&self, path: &str, of_engine: bool) -> bool {
        let key = if of_engine { self.of_engine().unwrap_or_default() } else { &self.key };
        key.iter().map(|p| p.name.as_str()).eq(path.split('.'))
    }

    /// Its key without the name of the file, where it is one of the engine file: `engine.geometry.bore_mm`.
    fn of_engine(&self) -> Option<&[Part]> {
        self.key.split_first().filter(|(first, rest)| first.name == ENGINE && !rest.is_empty()).map(|(_, rest)| rest)
    }
}

/// Which file keys are of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum OfFile {
    Study,
    Engine,
}

/// Overrides of a file.
#[derive(Debug, Clone, Default)]
pub(super) struct Overrides(Vec<(Override, Vec<Part>)>);

impl Overrides {
    /// Those that are of a file.
    pub fn of(file: OfFile, all: &[Override]) -> Self {
        let own = |o: &Override| match (file, o.of_engine()) {
            (OfFile::Engine, Some(key)) => Some((o.clone(), key.to_vec())),
            (OfFile::Study, None) => Some((o.clone(), o.key.clone())),
            _ => None,
        };
        Self(all.iter().filter_map(own).collect())
    }

    /// The one that holds a byte behind a text of this length: its own text, and where that begins.
    pub fn holding(&self, length: usize, byte: usize) -> Option<(&str, usize)> {
        let texts = self.0.iter().map(|o| o.0.text());
        texts.zip(self.starts(length)).find(|(text, start)| (*start..=start + text.len()).contains(&byte))
    }

    /// Where the text of each begins, behind a text of this length.
    fn starts(&self, length: usize) -> impl Iterator<Item = usize> {
        self.0.iter().scan(length + 1, |next, o| {
            let start = *next;
            *next += o.0.text.len() + 1;
            Some(start)
        })
    }

    /// Puts them into the tree of a text of this length.
    ///
    /// # Errors
    /// Where a part of a key leads nowhere.
    pub(super) fn apply<'o>(&'o self, tree: &mut DeTable<'o>, length: usize) -> Result<(), NoOverride> {
        for ((own, key), start) in self.0.iter().zip(self.starts(length)) {
            let value = DeValue::parse(&own.text[own.value.clone()]).map_err(|e| {
                let span = start + own.value.start..start + own.value.end;
                NoOverride { message: e.message().to_owned(), span, help: None }
            })?;
            let parts: Vec<(&str, Range<usize>)> =
                key.iter().map(|p| (p.name.as_str(), start + p.span.start..start + p.span.end)).collect();
            put(tree, &parts, moved(value, start + own.value.start))?;
        }
        Ok(())
    }
}

/// A value whose text begins at another byte.
fn moved(value: Spanned<DeValue>, by: usize) -> Spanned<DeValue> {
    let at = |span: Range<usize>| span.start + by..span.end + by;
    let span = at(value.span());
    let value = match value.into_inner() {
        DeValue::Array(list) => DeValue::Array(list.into_iter().map(|v| moved(v, by)).collect::<DeArray>()),
        DeValue::Table(table) => {
            let mut own = DeTable::new();
            for (key, value) in table {
                let span = at(key.span());
                own.insert(Spanned::new(span, key.into_inner()), moved(value, by));
            }
            DeValue::Table(own)
        }
        other => other,
    };
    Spanned::new(span, value)
}

/// Puts a value under a key; tables on the way that are not there are made.
fn put<'o>(tree: &mut DeTable<'o>, key: &[(&'o str, Range<usize>)], value: Spanned<DeValue<'o>>) -> Result<(), NoOverride> {
    let Some(((name, span), rest)) = key.split_first() else { return Ok(()) };
    let entry = Spanned::new(span.clone(), DeString::Borrowed(*name));
    if rest.is_empty() {
        tree.insert(entry, value);
        return Ok(());
    }
    if !tree.contains_key(*name) {
        tree.insert(entry, Spanned::new(span.clone(), DeValue::Table(DeTable::new())));
    }
    tree.get_mut(*name).map_or(Ok(()), |own| below(own.get_mut(), name, rest, value))
}

/// The same below a value: a table, or an element of a list by its number or its `name`.
fn below<'o>(here: &mut DeValue<'o>, name: &str, key: &[(&'o str, Range<usize>)], value: Spanned<DeValue<'o>>) -> Result<(), NoOverride> {
    let list = match here {
        DeValue::Table(table) => return put(table, key, value),
        DeValue::Array(list) => list,
        other => {
            let (message, span) = (format!("found a key below `{name}`, which is {} and has none", word(other)), key[0].1.clone());
            return Err(NoOverride { message, span, help: None });
        }
    };
    let ((own, span), rest) = (&key[0], &key[1..]);
    let called = |v: &Spanned<DeValue>| v.get_ref().get("name").and_then(|n| n.get_ref().as_str()) == Some(own);
    let index = own.parse().ok().filter(|i| *i < list.len()).or_else(|| list.iter().position(called));
    let Some(element) = index.and_then(|i| list.get_mut(i)) else {
        let numbers = match list.len() {
            0 => "which is empty".to_owned(),
            1 => "which has one: 0".to_owned(),
            n => format!("which has {n}: 0 to {}", n - 1),
        };
        let message = format!("found `{own}`, expected the number or the name of an element of `{name}`, {numbers}");
        return Err(NoOverride { message, span: span.clone(), help: None });
    };
    if rest.is_empty() {
        *element = value;
        return Ok(());
    }
    below(element.get_mut(), own, rest, value)
}

fn word(value: &DeValue) -> &'static str {
    match value {
        DeValue::String(_) => "a text",
        DeValue::Integer(_) | DeValue::Float(_) => "a number",
        DeValue::Boolean(_) => "true or false",
        DeValue::Datetime(_) => "a date",
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    }
}
