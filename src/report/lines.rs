//! A file of lines that grows by whole lines. A line is a checksum (CRC-32, eight hexadecimal digits), a space, and what it is of; it is written at once, so that a program that is killed leaves a torn line at the end at worst.

use super::reason::{WriteError, reason};
use std::fs::{File, OpenOptions};
use std::io::{Error, ErrorKind, Read, Result, Write};
use std::path::{Path, PathBuf};

/// Such a file, open at its end.
#[derive(Debug)]
pub(super) struct Lines {
    path: PathBuf,
    file: File,
    /// Whether there was none.
    made: bool,
    /// Bytes of whole lines when it was opened.
    begun: u64,
    /// Bytes of whole lines.
    length: u64,
    /// Whether a part of a line follows them.
    torn: bool,
}

/// Returns the whole lines among some bytes in their order, each with its number from 1 and what it is of: None where the checksum does not agree.
pub(super) fn contents(bytes: &[u8]) -> impl Iterator<Item = (usize, Option<&str>)> {
    let whole = bytes.split_inclusive(|b| *b == b'\n').filter_map(|line| line.strip_suffix(b"\n"));
    whole.enumerate().map(|(i, line)| (i + 1, content(line)))
}

fn content(line: &[u8]) -> Option<&str> {
    let (sum, content) = std::str::from_utf8(line).ok()?.split_once(' ')?;
    (sum == format!("{:08x}", crc32fast::hash(content.as_bytes()))).then_some(content)
}

/// Opens what stands at a path itself: a link is not followed.
fn itself(path: &Path) -> Result<File> {
    let there = std::fs::symlink_metadata(path)?;
    let linked = || Error::other("it is no file of its own, but a link or something else: what it leads to is not to be written to");
    if !there.is_file() {
        return Err(linked());
    }
    let file = OpenOptions::new().read(true).append(true).open(path)?;
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        // it may have become a link in between
        let opened = file.metadata()?;
        if (opened.dev(), opened.ino()) != (there.dev(), there.ino()) {
            return Err(linked());
        }
    }
    Ok(file)
}

impl Lines {
    /// Opens a file at its end, made where there is none, and returns it with the bytes that it holds.
    ///
    /// # Errors
    /// [`WriteError`] where it cannot be opened, or is a link.
    pub(super) fn open(path: PathBuf) -> std::result::Result<(Self, Vec<u8>), WriteError> {
        let open = || -> Result<(File, Vec<u8>, bool)> {
            match OpenOptions::new().create_new(true).append(true).open(&path) {
                Err(e) if e.kind() == ErrorKind::AlreadyExists => {
                    let (mut file, mut bytes) = (itself(&path)?, Vec::new());
                    file.read_to_end(&mut bytes)?;
                    Ok((file, bytes, false))
                }
                new => Ok((new?, Vec::new(), true)),
            }
        };
        let (file, bytes, made) = open().map_err(|e| WriteError { reason: reason(&e), path: path.clone() })?;
        let whole = bytes.iter().rposition(|b| *b == b'\n').map_or(0, |i| i + 1);
        let (length, torn) = (whole as u64, whole < bytes.len());
        Ok((Self { path, file, made, begun: length, length, torn }, bytes))
    }

    /// Where it is.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Writes lines at the end, all or none.
    ///
    /// # Errors
    /// What keeps them from being written; what was there before stays as it was.
    pub(super) fn append(&mut self, contents: &[String]) -> Result<()> {
        if self.torn {
            self.file.set_len(self.length)?;
        }
        let lines: String = contents.iter().map(|c| format!("{:08x} {c}\n", crc32fast::hash(c.as_bytes()))).collect();
        self.torn = true;
        self.file.write_all(lines.as_bytes())?;
        (self.torn, self.length) = (false, self.length + lines.len() as u64);
        Ok(())
    }

    /// Whether it still stands where it was opened, and does not stand there for another one.
    pub(super) fn is_there(&self) -> bool {
        #[cfg(unix)]
        {
            use std::os::unix::fs::MetadataExt;
            let identity = |m: std::fs::Metadata| (m.dev(), m.ino());
            let there = std::fs::symlink_metadata(&self.path).map(identity);
            matches!((there, self.file.metadata().map(identity)), (Ok(a), Ok(b)) if a == b)
        }
        #[cfg(not(unix))]
        self.path.is_file()
    }

    /// Takes back what was written since it was opened; a file that was not there is removed.
    pub(super) fn take_back(&mut self) {
        if self.made {
            self.remove();
        } else if self.length > self.begun && self.file.set_len(self.begun).is_ok() {
            (self.length, self.torn) = (self.begun, false);
        }
    }

    /// Removes it; what has taken its place stays.
    pub(super) fn remove(&mut self) {
        if self.is_there() {
            let _gone = std::fs::remove_file(&self.path);
        }
    }
}
