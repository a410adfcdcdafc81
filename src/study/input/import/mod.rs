//! Chains as other programs write them: a mass-elastic table with the units in its header, or an assembly of openTorsion.

mod assembly;
mod found;
mod sheet;
mod table;
mod trace;
pub(crate) mod unit;
pub(crate) mod words;

pub use found::{FoundChain, FoundStation};
pub use trace::{FoundTraces, traces};

use super::error::{InputError, Mistake, Place};
use std::path::Path;

/// Reads a chain: `.json` is an assembly of openTorsion, all else a table.
///
/// # Errors
/// [`InputError`] with the first mistake.
#[doc(hidden)]
pub fn chain(path: &Path) -> Result<FoundChain, InputError> {
    let is_json = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("json"));
    let found = if is_json { assembly::read(path)? } else { table::read(path)? };
    let wrong = |message: String| Err(Mistake { message, place: Place::File(path.to_path_buf()), help: None }.into());
    let Some((last, others)) = found.stations.split_last() else { return wrong("found no station, expected at least two".into()) };
    if let Some(s) = others.iter().find(|s| s.stiffness_to_next <= 0.0) {
        return wrong(format!("found no stiffness from `{}` to the next station, expected one for all but the last", s.name));
    }
    if last.stiffness_to_next > 0.0 {
        return wrong(format!("found a stiffness behind the last station `{}`, expected none", last.name));
    }
    for (i, s) in found.stations.iter().enumerate() {
        if found.stations[..i].iter().any(|other| other.name == s.name) {
            return wrong(format!("found station `{}` a second time, expected different names", s.name));
        }
    }
    Ok(found)
}
