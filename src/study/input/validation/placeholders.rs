//! Values of an example that nobody has replaced or confirmed yet.

use crate::input::error::{At, Check};
use crate::input::wording::closest;
use std::path::PathBuf;

/// A value of an example.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Placeholder {
    /// The file in which it stands.
    pub file: PathBuf,
    /// Path of its key there.
    pub key: String,
    /// What stands there, as far as it is short.
    pub value: String,
}

/// Longest value that is shown whole, in letters.
const LONGEST: usize = 60;

/// What stands at a path of keys with points between; in lists of tables the first that has it.
fn at<'v>(value: &'v toml::Value, path: &str) -> Option<&'v toml::Value> {
    if let toml::Value::Array(list) = value {
        return list.iter().find_map(|one| at(one, path));
    }
    match path.split_once('.') {
        Some((key, rest)) => at(value.get(key)?, rest),
        None => value.get(path),
    }
}

/// All paths of a value, those of lists of tables once.
fn paths(value: &toml::Value, before: &str, list: &mut Vec<String>) {
    match value {
        toml::Value::Table(table) => {
            for (key, inner) in table {
                let path = if before.is_empty() { key.clone() } else { format!("{before}.{key}") };
                paths(inner, &path, list);
                list.push(path);
            }
        }
        toml::Value::Array(values) => values.iter().filter(|v| v.is_table()).for_each(|v| paths(v, before, list)),
        _ => {}
    }
}

fn shown(value: &toml::Value) -> String {
    match value {
        toml::Value::Array(list) if list.first().is_some_and(toml::Value::is_table) => {
            format!("{} table{}", list.len(), if list.len() == 1 { "" } else { "s" })
        }
        value => {
            let text = value.to_string();
            if text.chars().count() > LONGEST { text.chars().take(LONGEST).chain(['…']).collect() } else { text }
        }
    }
}

/// The values that a file calls those of an example; a path of no key of it is a mistake.
pub(super) fn resolve(check: &mut Check, list: &[At<String>]) -> Vec<Placeholder> {
    if list.is_empty() {
        return Vec::new();
    }
    let source = check.source;
    let Ok(file) = source.parse::<toml::Table>().map(toml::Value::Table) else { return Vec::new() };
    let mut found: Vec<Placeholder> = Vec::new();
    for name in list {
        let key = name.get_ref();
        if found.iter().any(|p| p.key == *key) {
            check.wrong(name, format!("found `{key}` a second time, expected each key once"));
        } else if let Some(value) = at(&file, key).filter(|_| key != "placeholder") {
            found.push(Placeholder { file: source.path().to_path_buf(), key: key.clone(), value: shown(value) });
        } else {
            let mut all = Vec::new();
            paths(&file, "", &mut all);
            let known: Vec<&str> = all.iter().map(String::as_str).filter(|path| *path != "placeholder").collect();
            let ends: Option<&str> = known.iter().copied().find(|path| path.rsplit('.').next() == Some(key.as_str()));
            let help = ends.or_else(|| closest(key, &known)).map_or_else(String::new, |path| format!("did you mean `{path}`? "));
            let words = format!("found `{key}`, expected the path of a key of this file");
            check.wrong_with_help(name, words, format!("{help}A name that is deleted from this list is a value that you have confirmed"));
        }
    }
    found
}
