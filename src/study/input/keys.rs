//! Every key of every file: what it is, its unit, its range, its default and an example, from the types that read them.
#![doc = ""]
#![doc = include_str!("keys.md")]

use super::schema::json::FileKind;
use crate::units::of_key;
use serde_json::{Map, Value};

/// Whether a key must stand in its table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Presence {
    /// It must.
    Required,
    /// It may.
    Optional,
    /// It, or another of the same list.
    OneOf,
}

/// A key of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Key {
    /// The file.
    pub file: FileKind,
    /// Its path: names of tables and its own, with points between; `<key>` where any name may stand.
    pub path: String,
    /// What it is, in a sentence.
    pub about: String,
    /// What it takes: numbers, words, tables.
    pub takes: String,
    /// Of numbers.
    pub unit: Option<&'static str>,
    /// Whether it may be left out.
    pub presence: Presence,
    /// What holds where it is left out.
    pub default: Option<Value>,
    /// One that is accepted.
    pub example: Option<Value>,
    /// The schema of its value.
    pub schema: Value,
}

impl Key {
    /// Keys of the table that it takes, or of each of its tables.
    pub fn inner(&self) -> Vec<&str> {
        let inner = self.schema.get("items").unwrap_or(&self.schema);
        let properties = inner.get("properties").and_then(Value::as_object);
        properties.map_or_else(Vec::new, |map| map.keys().map(String::as_str).collect())
    }

    /// Its own name: the last of its path.
    pub fn name(&self) -> &str {
        name_of(&self.path)
    }
}

fn name_of(path: &str) -> &str {
    path.rsplit('.').next().unwrap_or(path)
}

/// All keys of a kind of file, in the order they are declared. Of tables that may stand in several places the keys are listed once.
pub fn keys(file: FileKind) -> Vec<Key> {
    let mut walk = Walk { file, list: Vec::new(), seen: Vec::new() };
    walk.table(&file.json_schema(), "");
    walk.list
}

struct Walk {
    file: FileKind,
    list: Vec<Key>,
    /// Tables whose keys are listed, with their paths.
    seen: Vec<(Value, String)>,
}

/// Tables of fewer keys are listed wherever they stand.
const SMALL: usize = 4;

/// What stands under one key of several, or nothing of a word.
fn alternatives(schema: &Value) -> Vec<(&str, &Value)> {
    let list = schema.get("oneOf").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    let tables = list.iter().filter(|s| s.get("type").is_some()).filter_map(|s| s.get("properties")?.as_object());
    tables.flatten().map(|(key, inner)| (key.as_str(), inner)).collect()
}

/// Words that a value may be.
fn words(schema: &Value) -> Vec<&str> {
    let own = schema.get("enum").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    let each = schema.get("oneOf").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    let constant = each.iter().flat_map(|s| s.get("const").and_then(Value::as_str).into_iter().chain(words(s)));
    own.iter().filter_map(Value::as_str).chain(constant).collect()
}

/// A value, bounds or a list of values.
fn is_range(schema: &Value) -> bool {
    let keys: Vec<&str> = alternatives(schema).iter().map(|a| a.0).collect();
    matches!(keys.as_slice(), ["fixed", "between", "each"] | ["fixed", "between"])
}

fn bounds(schema: &Value) -> String {
    let number = |key: &str| schema.get(key).filter(|v| v.is_number()).map(short);
    let low = number("minimum").map(|x| format!("at least {x}")).or_else(|| number("exclusiveMinimum").map(|x| format!("above {x}")));
    let high = number("maximum").map(|x| format!("at most {x}")).or_else(|| number("exclusiveMaximum").map(|x| format!("below {x}")));
    let numbers = schema.get("enum").and_then(Value::as_array).map(|list| list.iter().map(short).collect::<Vec<_>>().join(" or "));
    let either = schema.get("anyOf").and_then(Value::as_array).and_then(|list| list.iter().map(span).collect::<Option<Vec<_>>>());
    let either = either.map(|spans| spans.join(" or "));
    [low, high, numbers, either].into_iter().flatten().map(|b| format!(", {b}")).collect()
}

/// One of several ranges of a number.
fn span(schema: &Value) -> Option<String> {
    Some(format!("from {} to {}", short(schema.get("minimum")?), short(schema.get("maximum")?)))
}

/// A number as short as it can be said.
fn short(value: &Value) -> String {
    match value.as_f64() {
        Some(x) if x != 0.0 && !(1e-4..1e7).contains(&x.abs()) => format!("{x:e}"),
        Some(x) => format!("{x}"),
        None => value.to_string(),
    }
}

fn takes(schema: &Value) -> String {
    let quoted = |list: Vec<&str>| list.iter().map(|w| format!("`{w}`")).collect::<Vec<_>>().join(", ");
    if is_range(schema) {
        return format!("a table with one of {}", quoted(alternatives(schema).iter().map(|a| a.0).collect()));
    }
    let (choice, word) = (alternatives(schema), words(schema));
    if !choice.is_empty() {
        let words = if word.is_empty() { String::new() } else { format!(", or a word: {}", quoted(word)) };
        return format!("a table with one of {}{words}", quoted(choice.iter().map(|c| c.0).collect()));
    }
    if !word.is_empty() {
        return format!("a word: {}", quoted(word));
    }
    match schema.get("type").and_then(Value::as_str) {
        Some("number") => format!("a number{}", bounds(schema)),
        Some("integer") => format!("a whole number{}", bounds(schema)),
        Some("boolean") => "true or false".into(),
        Some("string") => "text".into(),
        Some("array") => {
            let item = schema.get("items").map_or_else(String::new, takes);
            match item.split_once(' ') {
                Some(("a", "table")) => "tables".into(),
                _ => format!("a list, each {item}"),
            }
        }
        _ => "a table".into(),
    }
}

/// Whether numbers are part of what a value takes.
fn is_numeric(schema: &Value) -> bool {
    match schema.get("type").and_then(Value::as_str) {
        Some("number" | "integer") => true,
        Some("array") => schema.get("items").is_some_and(is_numeric),
        _ => is_range(schema),
    }
}

impl Walk {
    fn table(&mut self, schema: &Value, path: &str) {
        let none = Map::new();
        let properties = schema.get("properties").and_then(Value::as_object).unwrap_or(&none);
        let required: Vec<&str> =
            schema.get("required").and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_str).collect();
        for (key, own) in properties {
            let presence = if required.contains(&key.as_str()) { Presence::Required } else { Presence::Optional };
            self.key(key, own, presence, path);
        }
        if let Some(any) = schema.get("additionalProperties").filter(|a| a.is_object()) {
            self.key("<key>", any, Presence::Optional, path);
        }
    }

    /// A key whose value has this schema.
    fn key(&mut self, key: &str, schema: &Value, presence: Presence, path: &str) {
        let table = path;
        let path = if table.is_empty() { key.to_owned() } else { format!("{table}.{key}") };
        let about = schema.get("description").and_then(Value::as_str).unwrap_or_default();
        let own = Key {
            file: self.file,
            about: about.to_owned(),
            takes: takes(schema),
            // of `speed_rpm.from` the unit stands in the name of its table
            unit: if is_numeric(schema) { of_key(key).or_else(|| of_key(name_of(table))) } else { None },
            presence,
            default: schema.get("default").cloned(),
            example: schema.get("examples").and_then(|e| e.get(0)).cloned(),
            schema: schema.clone(),
            path: path.clone(),
        };
        self.list.push(own);
        let inner = if schema.get("type").is_some_and(|t| t == "array") { schema.get("items").unwrap_or(schema) } else { schema };
        let choice = alternatives(inner);
        let count = inner.get("properties").and_then(Value::as_object).map_or(choice.len(), Map::len);
        if is_range(inner) || count == 0 && inner.get("additionalProperties").is_none() {
            return;
        }
        let mut bare = inner.clone();
        for said in ["description", "examples", "default"] {
            bare.as_object_mut().map(|map| map.remove(said));
        }
        if let Some((_, first)) = self.seen.iter().find(|s| s.0 == bare) {
            if let Some(last) = self.list.last_mut() {
                last.takes += &format!("; keys as of `{first}`");
            }
            return;
        }
        if count >= SMALL {
            self.seen.push((bare, path.clone()));
        }
        for (key, schema) in choice {
            self.key(key, schema, Presence::OneOf, &path);
        }
        self.table(inner, &path);
    }
}
