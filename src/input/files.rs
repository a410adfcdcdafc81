//! Which files an input was read from, and a checksum of each.

use std::cell::RefCell;
use std::path::{Path, PathBuf};

/// A file that was read.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub(crate) struct InputFile {
    /// As it was named.
    pub path: PathBuf,
    /// Its size.
    pub bytes: usize,
    /// CRC-32 of its content.
    pub crc32: u32,
}

thread_local! {
    /// Files read since somebody asked: inputs are read by one thread.
    static READ: RefCell<Option<Vec<InputFile>>> = const { RefCell::new(None) };
}

/// What is read, and from which files, each once.
pub(crate) fn noted<T>(read: impl FnOnce() -> T) -> (T, Vec<InputFile>) {
    READ.set(Some(Vec::new()));
    let result = read();
    (result, READ.take().unwrap_or_default())
}

/// Notes a file that was read.
pub(super) fn note(path: &Path, content: &[u8]) {
    READ.with_borrow_mut(|files| {
        if let Some(files) = files.as_mut().filter(|files| files.iter().all(|f| f.path != path)) {
            files.push(InputFile { path: path.to_path_buf(), bytes: content.len(), crc32: crc32fast::hash(content) });
        }
    });
}
