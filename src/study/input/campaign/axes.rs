//! What varies.

use super::named::{column, file, named, set};
use super::spec::{Axis, Variant};
use crate::input::error::{At, Check, looked_for};
use crate::input::schema::campaign::{RawVariant, RawVary};
use std::collections::HashSet;
use std::path::{Path, PathBuf};

pub(super) fn axis(check: &mut Check, folder: &Path, raw: &At<RawVary>, names: &mut HashSet<String>) -> Option<Axis> {
    let own = raw.get_ref();
    let name = named(check, raw, own.name.as_ref(), own.key.as_ref(), names)?;
    let mut numeric = false;
    let variants: Vec<Variant> = match (&own.key, &own.values, &own.files) {
        (Some(key), Some(values), None) if own.variant.is_empty() => {
            numeric = values.get_ref().iter().all(|v| v.get_ref().is_float() || v.get_ref().is_integer());
            values.get_ref().iter().enumerate().filter_map(|(i, v)| value(check, key, v.get_ref(), i + 1)).collect()
        }
        (Some(key), None, Some(pattern)) if own.variant.is_empty() => files(check, folder, key, pattern),
        (None, None, None) if !own.variant.is_empty() => own.variant.iter().map(|v| variant(check, folder, v)).collect(),
        _ => {
            check.wrong(raw, "found another choice, expected `key` with `values` or `files`, or [[vary.variant]]");
            return None;
        }
    };
    let mut seen = HashSet::new();
    if let Some(twice) = variants.iter().find(|v| !seen.insert(&v.label)) {
        check.wrong(raw, format!("found `{}` twice among the values of `{name}`, expected each once", twice.label));
    }
    if variants.is_empty() {
        check.wrong(raw, format!("found no value of `{name}`, expected at least one"));
    }
    Some(Axis { name, numeric, variants })
}

/// A label is no longer than this: it is the name of a folder, too.
const LONGEST: usize = 60;

/// A value as it is told of: a list by its elements, a table by its name; `None` of what has none.
fn label(value: &toml::Value) -> Option<String> {
    match value {
        toml::Value::String(text) => Some(text.clone()),
        toml::Value::Array(list) => Some(list.iter().map(label).collect::<Option<Vec<_>>>()?.join("+")),
        toml::Value::Table(table) => table.get("name")?.as_str().map(str::to_owned),
        other => Some(other.to_string()),
    }
}

fn value(check: &mut Check, key: &At<String>, value: &toml::Value, number: usize) -> Option<Variant> {
    let set = set(check, key, &format!("{}={value}", key.get_ref()))?;
    let own = label(value).filter(|text| !text.is_empty() && text.len() <= LONGEST);
    Some(Variant { label: own.unwrap_or_else(|| format!("{}_{number}", column(key.get_ref()))), study: None, set: vec![set] })
}

/// Files that a pattern finds, in the order of their names.
fn files(check: &mut Check, folder: &Path, key: &At<String>, pattern: &At<String>) -> Vec<Variant> {
    let whole = folder.join(pattern.get_ref());
    let found: Vec<PathBuf> = match glob::glob(&whole.to_string_lossy()) {
        Ok(paths) => paths.filter_map(Result::ok).filter(|p| p.is_file()).collect(),
        Err(e) => {
            check.wrong(pattern, format!("found `{}`, expected a pattern of file names: {}", pattern.get_ref(), e.msg));
            return Vec::new();
        }
    };
    if found.is_empty() {
        check.wrong_with_help(pattern, "found no file of this pattern, expected at least one", looked_for(&whole));
    }
    let one = |path: PathBuf| {
        let label = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        if key.get_ref() == "study" {
            return Some(Variant { label, study: Some(path), set: Vec::new() });
        }
        let path = path.canonicalize().unwrap_or(path);
        let set = set(check, key, &format!("{}={}", key.get_ref(), toml::Value::from(path.to_string_lossy().into_owned())))?;
        Some(Variant { label, study: None, set: vec![set] })
    };
    found.into_iter().filter_map(one).collect()
}

fn variant(check: &mut Check, folder: &Path, raw: &RawVariant) -> Variant {
    check.name(&raw.name);
    if raw.name.get_ref().len() > LONGEST {
        check.wrong(&raw.name, format!("found a name of more than {LONGEST} letters, expected a shorter one: it is that of a folder, too"));
    }
    let study = raw.study.as_ref().map(|s| file(check, folder, s));
    let set = raw.set.iter().filter_map(|text| set(check, text, text.get_ref())).collect();
    Variant { label: raw.name.get_ref().clone(), study, set }
}
