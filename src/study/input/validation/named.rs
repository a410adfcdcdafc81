//! What a file names: tables and stations.

use crate::drivetrain::Chain;
use crate::input::error::{At, Check, InputError, looked_for};
use std::path::{Path, PathBuf};

/// Folder of a file.
pub(super) fn folder_of(path: &Path) -> &Path {
    path.parent().unwrap_or_else(|| Path::new(""))
}

/// Path of a file named in another one; a mistake at its name where it is missing. `what`: what it holds.
pub fn file(check: &mut Check, name: &At<String>, folder: &Path, what: &str) -> Option<PathBuf> {
    let path = folder.join(name.get_ref());
    if path.is_file() {
        return Some(path);
    }
    let help = looked_for(&path);
    check.wrong_with_help(
        name,
        if path.exists() { format!("found no file there, expected {what}") } else { "file not found".into() },
        help,
    );
    None
}

/// A table named in a file: a missing one is a mistake at its name, a mistake in it has its own place.
pub fn table<T>(check: &mut Check, name: &At<String>, folder: &Path, read: impl Fn(&Path) -> Result<T, InputError>) -> Option<T> {
    let path = file(check, name, folder, "a table")?;
    read(&path).map_err(|mut e| check.mistakes.append(&mut e.mistakes)).ok()
}

/// Index of a station named in the study; a mistake where there is none.
pub fn station(check: &mut Check, chain: &Chain, name: &At<String>) -> Option<usize> {
    let found = chain.find(name.get_ref());
    if found.is_none() {
        if let Some((_, into)) = check.meshed.iter().find(|m| m.0 == *name.get_ref()) {
            let message = format!(
                "found station `{}`, expected `{into}`: their mesh is rigid, so that both are one body of that name",
                name.get_ref()
            );
            let help = format!("for a torque of the mesh give `{}` a `stiffness_to_next_n_m_per_rad`, that of the teeth", name.get_ref());
            check.wrong_with_help(name, message, help);
            return None;
        }
        let names: Vec<&str> = chain.stations.iter().take(24).map(|s| s.name.as_str()).collect();
        check.wrong_with_help(
            name,
            format!("found station `{}`, expected one of the engine's stations", name.get_ref()),
            format!("the stations are {}", names.join(", ")),
        );
    }
    found
}
