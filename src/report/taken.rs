//! Folders that a command does not write to, because something there would be lost.

use super::manifest::Manifest;
use super::names::Names;
use super::reason::{WriteError, reason};
use crate::input::InputFile;
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// Why a command does not write to a folder.
#[derive(Debug, thiserror::Error)]
#[doc(hidden)]
pub enum FolderError {
    /// It cannot be written to.
    #[error(transparent)]
    File(#[from] WriteError),
    /// It holds an input under a name of an output.
    #[error("error: {} is read by this command, which would write over it; name another folder with --out", path.display())]
    Input {
        /// The input.
        path: PathBuf,
    },
    /// It holds files of somebody else under names of outputs.
    #[error(
        "error: {} holds {what}, not written by `hartog {command}`, or changed since, which would be lost; move {them} away, or name another folder with --out",
        folder.display()
    )]
    Others {
        /// The folder.
        folder: PathBuf,
        /// The command.
        command: &'static str,
        /// Their names.
        what: String,
        /// It or them.
        them: &'static str,
    },
    /// It holds what another command has left.
    #[error("error: {} holds what `hartog {before}` has written; name another folder with --out", folder.display())]
    Command {
        /// The folder.
        folder: PathBuf,
        /// The other command.
        before: String,
    },
    /// It holds what is of another study.
    #[error("error: {} is of another study: what is there read `{before}`, this run reads `{now}`; name another folder with --out", folder.display())]
    Study {
        /// The folder.
        folder: PathBuf,
        /// The other study.
        before: String,
        /// This one.
        now: String,
    },
}

/// Links lead on at most so often.
const MOST_LINKS: usize = 40;

/// Returns the names in a folder (a canonical path) by which a path is read: its own, and those of the links that it leads through.
pub(super) fn in_folder(path: &Path, folder: &Path) -> Vec<String> {
    let mut names = Vec::new();
    let mut at = path.to_path_buf();
    for _ in 0..MOST_LINKS {
        let parent = match at.parent() {
            Some(p) if p.as_os_str().is_empty() => Path::new("."),
            Some(p) => p,
            None => break,
        };
        let (Ok(parent), Some(name)) = (parent.canonicalize(), at.file_name()) else { break };
        if parent == folder {
            names.push(name.to_string_lossy().into_owned());
        }
        let here = parent.join(name);
        match std::fs::read_link(&here) {
            Ok(target) => at = parent.join(target),
            Err(_) => break,
        }
    }
    names
}

/// Names that are told before the others are counted.
const TOLD: usize = 5;

fn list(names: &[String]) -> String {
    let told: Vec<String> = names.iter().take(TOLD).map(|n| format!("`{n}`")).collect();
    let more = names.len().saturating_sub(TOLD);
    if more > 0 { format!("{} and {more} more", told.join(", ")) } else { told.join(", ") }
}

/// Refuses a folder where a command would write over one of its inputs, over what another command or another study has left, or over what nobody of us has written.
///
/// # Errors
/// [`FolderError`], which tells why.
pub(super) fn refuse(
    folder: &Path,
    names: &Names,
    manifest: &Manifest,
    read: &HashSet<String>,
    inputs: &[InputFile],
) -> Result<(), FolderError> {
    if let Some(name) = read.iter().filter(|name| names.hold(name)).min() {
        return Err(FolderError::Input { path: folder.join(name) });
    }
    if let Some(before) = manifest.other_command(names.command).filter(|_| names.lists) {
        return Err(FolderError::Command { folder: folder.to_path_buf(), before: before.to_owned() });
    }
    if let (Some(before), Some(now)) = (manifest.other_study(inputs), inputs.first()) {
        let now = now.path.display().to_string();
        return Err(FolderError::Study { folder: folder.to_path_buf(), before: before.to_owned(), now });
    }
    let failed = |e: std::io::Error| WriteError { path: folder.to_path_buf(), reason: reason(&e) };
    let mut others = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let name = entry.map_err(failed)?.file_name().to_string_lossy().into_owned();
        let write_error = |e: std::io::Error| WriteError { path: folder.join(&name), reason: reason(&e) };
        if names.hold(&name) && !manifest.may_be_replaced(folder, &name).map_err(write_error)? {
            others.push(name);
        }
    }
    others.sort();
    let them = if others.len() == 1 { "it" } else { "them" };
    let refused = || FolderError::Others { folder: folder.to_path_buf(), command: names.command, what: list(&others), them };
    if others.is_empty() { Ok(()) } else { Err(refused()) }
}
