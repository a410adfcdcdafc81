//! Which kind of file a text is.

use super::error::{InputError, Mistake, Place, Source};
use super::wording::is_table;
use std::path::Path;

/// Whether a file has this key at its top.
pub(super) fn has(source: &Source, key: &str) -> bool {
    source.parse::<toml::Table>().is_ok_and(|t| t.contains_key(key))
}

pub(super) fn another_kind(path: &Path, message: &str) -> InputError {
    Mistake { message: message.to_owned(), place: Place::File(path.to_path_buf()), help: None }.into()
}

/// A file in TOML, not a table.
///
/// # Errors
/// [`InputError`] that tells what takes the table.
pub(super) fn no_table(source: &Source, expected: &str, help: &str) -> Result<(), InputError> {
    if !is_table(source.text()) {
        return Ok(());
    }
    let message = format!("found a table, expected {expected}");
    Err(Mistake { message, place: Place::File(source.path().to_path_buf()), help: Some(help.to_owned()) }.into())
}
