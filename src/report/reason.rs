//! Why something could not be written, in words.

use std::path::PathBuf;

/// A file or folder could not be written.
#[derive(Debug, thiserror::Error)]
#[error("error: cannot write {}: {reason}", path.display())]
pub struct WriteError {
    /// What was to be written.
    pub path: PathBuf,
    /// Why not.
    pub reason: String,
}

pub(super) fn reason(error: &std::io::Error) -> String {
    match error.kind() {
        std::io::ErrorKind::PermissionDenied => "no permission".to_owned(),
        std::io::ErrorKind::NotADirectory | std::io::ErrorKind::AlreadyExists => "a file is in the way of the folder".to_owned(),
        std::io::ErrorKind::NotFound => "the folder is gone".to_owned(),
        std::io::ErrorKind::StorageFull | std::io::ErrorKind::QuotaExceeded => "no space is left".to_owned(),
        std::io::ErrorKind::FileTooLarge => "no file may be as large here".to_owned(),
        _ => error.to_string(),
    }
}
