//! Where files go when nobody says.

use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

/// A file that many engines have, each in a folder of its own.
const COMMON: &str = "study.toml";

/// Returns the name that a folder has after an input: that of the file without its ending, and of a `study.toml` that of the folder where it is.
///
/// # Errors
/// A sentence, where that is no name for a folder.
pub(super) fn named_after(input: &Path) -> Result<OsString, String> {
    let stem = input.file_stem().unwrap_or_default();
    if stem.as_encoded_bytes().iter().all(|b| *b == b'.') {
        let found = input.display();
        return Err(format!("error: {found} gives no name to a folder of output, expected a file name that does, or --out with a folder"));
    }
    if input.file_name() != Some(OsStr::new(COMMON)) {
        return Ok(stem.to_owned());
    }
    let parent = input.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let own = parent.canonicalize().ok().and_then(|p| p.file_name().map(OsStr::to_owned));
    Ok(own.unwrap_or_else(|| stem.to_owned()))
}

/// Returns the folder that was asked for, or one in `out` after the input, with an ending.
///
/// # Errors
/// As [`named_after`].
pub(super) fn chosen(asked: Option<&PathBuf>, input: &Path, ending: &str) -> Result<PathBuf, String> {
    match asked {
        Some(path) => Ok(path.clone()),
        None => {
            let mut name = named_after(input)?;
            name.push(ending);
            Ok(Path::new("out").join(name))
        }
    }
}
