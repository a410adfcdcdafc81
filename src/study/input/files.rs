//! Which files an input was read from, a checksum of each, and what is to be said of how they were read.

use rayon::prelude::*;
use std::cell::RefCell;
use std::fs::File;
use std::io::{ErrorKind, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

/// A file that was read.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[doc(hidden)]
pub struct InputFile {
    /// As it was named.
    #[serde(serialize_with = "as_text")]
    pub path: PathBuf,
    /// Its size.
    pub bytes: usize,
    /// CRC-32 of its content.
    pub crc32: u32,
}

/// A path as it is shown: JSON holds text only, and not every path is that.
fn as_text<S: serde::Serializer>(path: &Path, to: S) -> Result<S::Ok, S::Error> {
    to.collect_str(&path.display())
}

thread_local! {
    /// Files read since somebody asked: inputs are read by one thread.
    static READ: RefCell<Option<Vec<InputFile>>> = const { RefCell::new(None) };
    /// Remarks made since somebody asked.
    static REMARKS: RefCell<Option<Vec<String>>> = const { RefCell::new(None) };
}

/// What is read, and from which files, each once.
#[doc(hidden)]
pub fn noted<T>(read: impl FnOnce() -> T) -> (T, Vec<InputFile>) {
    READ.set(Some(Vec::new()));
    let result = read();
    (result, READ.take().unwrap_or_default())
}

/// Notes a file that was read.
pub(super) fn note(path: &Path, content: &[u8]) {
    put(path, || Ok((content.len(), crc32fast::hash(content))));
}

/// Notes a file that is read row by row.
pub(super) fn note_stream(path: &Path) {
    put(path, || Ok((usize::try_from(std::fs::metadata(path)?.len()).unwrap_or(usize::MAX), checksum(path)?)));
}

/// What cannot be read is told of where it is read.
fn put(path: &Path, found: impl FnOnce() -> std::io::Result<(usize, u32)>) {
    READ.with_borrow_mut(|files| {
        if let Some(files) = files.as_mut().filter(|files| files.iter().all(|f| f.path != path))
            && let Ok((bytes, crc32)) = found()
        {
            files.push(InputFile { path: path.to_path_buf(), bytes, crc32 });
        }
    });
}

/// What is read, and what is to be said of how its files were read, each sentence once.
#[doc(hidden)]
pub fn remarked<T>(read: impl FnOnce() -> T) -> (T, Vec<String>) {
    REMARKS.set(Some(Vec::new()));
    let result = read();
    (result, REMARKS.take().unwrap_or_default())
}

/// Notes what the user is to know of how a file was read.
pub(super) fn remark(path: &Path, words: &str) {
    let sentence = format!("{}: {words}", path.display());
    REMARKS.with_borrow_mut(|list| {
        if let Some(list) = list.as_mut().filter(|list| !list.contains(&sentence)) {
            list.push(sentence);
        }
    });
}

/// Parts of a file that are read side by side, and how much of one at a time.
const PARTS: u64 = 4;
const AT_A_TIME: usize = 1 << 16;

/// Returns the CRC-32 of a file.
#[doc(hidden)]
pub fn checksum(path: &Path) -> std::io::Result<u32> {
    let length = std::fs::metadata(path)?.len();
    let part = |i: u64| -> std::io::Result<crc32fast::Hasher> {
        let (first, last) = (length * i / PARTS, length * (i + 1) / PARTS);
        let mut file = File::open(path)?;
        file.seek(SeekFrom::Start(first))?;
        let mut left = file.take(last - first);
        let (mut hasher, mut bytes) = (crc32fast::Hasher::new(), vec![0; AT_A_TIME]);
        loop {
            match left.read(&mut bytes) {
                Ok(0) => return Ok(hasher),
                Ok(n) => hasher.update(&bytes[..n]),
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
    };
    let parts = (0..PARTS).into_par_iter().map(part).collect::<std::io::Result<Vec<_>>>()?;
    let mut whole = crc32fast::Hasher::new();
    parts.iter().for_each(|part| whole.combine(part));
    Ok(whole.finalize())
}
