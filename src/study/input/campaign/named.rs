//! What axes and samples of a campaign share: files, columns, and keys with values.

use crate::input::error::{At, Check, looked_for};
use crate::input::overrides::Override;
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// A file that is named.
pub(super) fn file(check: &mut Check, folder: &Path, name: &At<String>) -> PathBuf {
    let path = folder.join(name.get_ref());
    if !path.is_file() {
        check.wrong_with_help(name, "file not found", looked_for(&path));
    }
    path
}

/// The column of a key that has no name of its own: the last of its parts that is no number.
pub(super) fn column(key: &str) -> &str {
    key.rsplit('.').find(|part| part.parse::<usize>().is_err()).unwrap_or(key)
}

/// Columns that every table has, by which it is read.
const TAKEN: [&str; 5] = ["case", "status", "reason", "design", "types"];
/// A name is no longer than this: it is part of that of a folder, too.
const LONGEST: usize = 60;

/// Whether a name may be that of a column; names that differ in capitals only are the same to some programs.
pub(super) fn free<T>(check: &mut Check, at: &At<T>, name: &str, names: &mut HashSet<String>) {
    let plain =
        name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    let lower = name.to_ascii_lowercase();
    if !plain || name.len() > LONGEST {
        let expected = format!("expected at most {LONGEST} letters, digits and `_`; `name` gives another one");
        check.wrong(at, format!("found `{name}` as the name of a column, {expected}"));
    } else if TAKEN.contains(&lower.as_str()) {
        check.wrong(at, format!("found `{name}`, which every table has, expected another name; `name` gives one"));
    } else if !names.insert(lower) {
        check.wrong(at, format!("found the column `{name}` a second time, expected different ones; `name` gives another one"));
    }
}

pub(super) fn named<T>(
    check: &mut Check,
    at: &At<T>,
    name: Option<&At<String>>,
    key: Option<&At<String>>,
    names: &mut HashSet<String>,
) -> Option<String> {
    let own = match (name, key) {
        (Some(name), _) => name.get_ref().clone(),
        (None, Some(key)) => column(key.get_ref()).to_owned(),
        (None, None) => {
            check.wrong(at, "key `name` is missing in this table");
            return None;
        }
    };
    match name.or(key) {
        Some(place) => free(check, place, &own, names),
        None => free(check, at, &own, names),
    }
    Some(own)
}

/// An override, as `--set` takes it.
pub(super) fn set(check: &mut Check, at: &At<String>, text: &str) -> Option<Override> {
    Override::parse(text).map_err(|e| check.wrong_with_help(at, e.message, e.help.unwrap_or_else(|| "as --set takes it".into()))).ok()
}
