//! Whole files or none: each is written under a temporary name and renamed. One command at a time writes to a folder, and tells in `summary.json`, its last file, that all are there and of one run.
//!
//! Nothing is replaced or removed but what an earlier command has left there, as it left it: `summary.json` lists that with its checksums, and while a command writes, `journal.log` does, a file being listed there before it gets its
//! name, so that what a killed command has left is known, too.

pub use super::reason::WriteError;

use super::formats::Format;
use super::lines::Lines;
use super::manifest::{Header, JOURNAL, Listed, Manifest, PROGRAM, SUMMARY, TIMES, beginning, bytes};
use super::names::Names;
use super::parquet;
use super::reason::reason;
use super::taken::{FolderError, in_folder, refuse};
use crate::input::InputFile;
use std::collections::HashSet;
use std::fs::{File, TryLockError};
use std::hash::{BuildHasher, RandomState};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use tempfile::NamedTempFile;

/// What a command brings to a folder.
#[derive(Debug, Clone, Copy)]
#[doc(hidden)]
pub struct Job<'a> {
    /// What it may write.
    pub names: &'a Names,
    /// What its files are of, the study (or table) before what that names.
    pub inputs: &'a [InputFile],
    /// Paths of all that it reads.
    pub reads: &'a [PathBuf],
}

/// The output folder.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    /// What names of unfinished files begin with.
    beginning: String,
    /// Whether this command lists what it has written when it has ended.
    lists: bool,
    /// What earlier commands have left.
    manifest: Manifest,
    /// Names here that this command reads.
    read: HashSet<String>,
    state: Mutex<State>,
    /// What the journal held when it was opened.
    left: Vec<u8>,
    /// Held as long as the folder is written to.
    _lock: Option<File>,
}

#[derive(Debug)]
struct State {
    journal: Lines,
    /// Whether the journal lists what the summary listed, which is no more.
    begun: bool,
    /// Files written, in the order of writing.
    written: Vec<(String, Listed)>,
}

impl Folder {
    /// Makes the folder where it is missing, looks whether what is to be written would replace anything but what an earlier command left there, and tries whether it can be written to, so that a long run does not fail at its end.
    ///
    /// # Errors
    /// [`FolderError`] where that is so, or fails.
    #[doc(hidden)]
    pub fn create(path: &Path, job: Job) -> Result<Self, FolderError> {
        let folder = Self::open(path, job)?;
        let header = Header { command: Some(job.names.command.to_owned()), ..Header::new(job.inputs, &folder.beginning) };
        folder.append(header.line())?;
        Ok(folder)
    }

    /// The same, with nothing in the journal yet.
    pub(super) fn open(path: &Path, job: Job) -> Result<Self, FolderError> {
        let failed = |e: std::io::Error| WriteError { path: path.to_path_buf(), reason: reason(&e) };
        if path.is_symlink() && !path.exists() {
            return Err(WriteError { path: path.to_path_buf(), reason: "it is a link to something that is not there".into() }.into());
        }
        std::fs::create_dir_all(path).map_err(failed)?;
        let lock = lock(path)?;
        let own = path.canonicalize().map_err(failed)?;
        let read: HashSet<String> = job.reads.iter().flat_map(|p| in_folder(p, &own)).collect();
        let before = bytes(&path.join(JOURNAL)).map_err(failed)?.unwrap_or_default();
        let manifest = Manifest::read(path, &before).map_err(failed)?;
        refuse(path, job.names, &manifest, &read, job.inputs)?;
        let (journal, left) = Lines::open(path.join(JOURNAL))?;
        let beginning = beginning(RandomState::new().hash_one(path));
        let state = State { journal, begun: false, written: Vec::new() };
        let folder = Self {
            path: path.to_path_buf(),
            beginning,
            lists: job.names.lists,
            manifest,
            read,
            state: Mutex::new(state),
            left,
            _lock: lock,
        };
        if folder._lock.is_some() {
            folder.remove_unfinished().map_err(failed)?;
        }
        Ok(folder)
    }

    /// Removes what commands that were killed have not finished: none is at work here.
    fn remove_unfinished(&self) -> std::io::Result<()> {
        if self.manifest.unfinished.is_empty() {
            return Ok(());
        }
        for entry in std::fs::read_dir(&self.path)? {
            let entry = entry?;
            let name = entry.file_name().to_string_lossy().into_owned();
            if self.manifest.unfinished.iter().any(|p| name.starts_with(p)) && entry.file_type()?.is_file() {
                std::fs::remove_file(entry.path())?;
            }
        }
        Ok(())
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What names of unfinished files begin with.
    pub(super) fn beginning(&self) -> &str {
        &self.beginning
    }

    /// What an earlier command has left of its journal.
    pub(super) fn left(&self) -> &[u8] {
        &self.left
    }

    /// Writes a line at the end of the journal.
    ///
    /// # Errors
    /// [`WriteError`] where that fails.
    pub(super) fn append(&self, line: String) -> Result<(), WriteError> {
        self.state().journal.append(&[line]).map_err(|e| WriteError { path: self.path.join(JOURNAL), reason: reason(&e) })
    }

    /// Returns the journal, if it is still where it was opened.
    pub(crate) fn journal(&self) -> Option<PathBuf> {
        let state = self.state();
        state.journal.is_there().then(|| state.journal.path().to_path_buf())
    }

    /// Takes back what this command has put into the journal, where it has written no file.
    #[doc(hidden)]
    pub fn abandon(&self) {
        let mut state = self.state();
        if state.written.is_empty() && !state.begun {
            state.journal.take_back();
        }
    }

    /// Lists a file in the journal before it gets its name. What the summary has listed is listed there, too, before the summary goes: as long as old and new files are there nothing says that they belong together.
    fn list(&self, name: &str, listed: Listed) -> Result<(), WriteError> {
        let failed = |name: &str, e: std::io::Error| WriteError { path: self.path.join(name), reason: reason(&e) };
        let mut state = self.state();
        if self.lists && !state.begun {
            state.journal.append(&self.manifest.lines()).map_err(|e| failed(JOURNAL, e))?;
            match std::fs::remove_file(self.path.join(SUMMARY)) {
                Err(e) if e.kind() != std::io::ErrorKind::NotFound => return Err(failed(SUMMARY, e)),
                _ => state.begun = true,
            }
        }
        state.journal.append(&[listed.line(name)]).map_err(|e| failed(name, e))
    }

    /// Ends the work in the folder: removes what an earlier command has left that this one has not made, writes `summary.json` as [`Folder::summarise`], and removes the journal.
    ///
    /// # Errors
    /// [`WriteError`] where that fails.
    #[doc(hidden)]
    pub fn complete(&self, about: &serde_json::Map<String, serde_json::Value>) -> Result<(), WriteError> {
        for name in self.manifest.names().filter(|name| !self.has_written(name) && !self.read.contains(*name)) {
            let failed = |e: std::io::Error| WriteError { path: self.path.join(name), reason: reason(&e) };
            if self.manifest.is_as_listed(&self.path, name).map_err(failed)? {
                std::fs::remove_file(self.path.join(name)).map_err(failed)?;
            }
        }
        self.summarise(true, about)?;
        self.state().journal.remove();
        Ok(())
    }

    /// Ends the work of a command that lists nothing when it has ended: what others have left in the journal stays.
    #[doc(hidden)]
    pub fn close(&self) {
        self.state().journal.take_back();
    }

    /// Writes `summary.json`: the program, whether the run is finished, what else is known of it, and name, size and checksum (CRC-32) of
    /// every file but that of times.
    ///
    /// # Errors
    /// [`WriteError`] where that fails.
    #[doc(hidden)]
    pub fn summarise(&self, finished: bool, about: &serde_json::Map<String, serde_json::Value>) -> Result<(), WriteError> {
        let mut files = self.state().written.clone();
        files.reverse();
        // of a file that was written twice the last counts
        files.sort_by(|a, b| a.0.cmp(&b.0));
        files.dedup_by(|a, b| a.0 == b.0);
        files.retain(|f| f.0 != TIMES);
        let told = |(name, l): (String, Listed)| serde_json::json!({ "name": name, "bytes": l.bytes, "crc32": format!("{:08x}", l.crc32) });
        let mut summary = serde_json::Map::new();
        summary.insert("program".into(), PROGRAM.into());
        summary.insert("finished".into(), finished.into());
        summary.extend(about.clone());
        summary.insert("files".into(), files.into_iter().map(told).collect());
        let text = format!("{:#}\n", serde_json::Value::Object(summary));
        self.write(SUMMARY, text.as_bytes())
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// How many files were written.
    pub fn written(&self) -> usize {
        self.state().written.len()
    }

    /// Whether this run has written a file of that name.
    pub(crate) fn has_written(&self, name: &str) -> bool {
        self.state().written.iter().any(|w| w.0 == name)
    }

    /// Names of what this run has written, in the order of writing.
    pub(crate) fn names(&self) -> Vec<String> {
        self.state().written.iter().map(|w| w.0.clone()).collect()
    }

    /// A file without its name yet, with the permissions that the user gives new files.
    fn unfinished(&self) -> std::io::Result<NamedTempFile> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(&self.beginning);
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // less what the mask of the process takes away
            builder.permissions(std::fs::Permissions::from_mode(0o666)).tempfile_in(&self.path)
        }
        #[cfg(not(unix))]
        builder.tempfile_in(&self.path)
    }

    /// A file that is written as it grows, without a name yet.
    ///
    /// # Errors
    /// [`WriteError`] where that fails.
    pub(crate) fn stream(&self) -> Result<Stream, WriteError> {
        let file = self.unfinished().map_err(|e| WriteError { path: self.path.clone(), reason: reason(&e) })?;
        Ok(Stream { file: BufWriter::new(file), bytes: 0, hasher: crc32fast::Hasher::new() })
    }

    /// Gives a stream its name, in place of an earlier file.
    ///
    /// # Errors
    /// [`WriteError`] where that fails.
    pub fn keep(&self, stream: Stream, name: &str) -> Result<(), WriteError> {
        let failed = |e: std::io::Error| WriteError { path: self.path.join(name), reason: reason(&e) };
        let listed = Listed { bytes: stream.bytes, crc32: stream.hasher.finalize() };
        let file = stream.file.into_inner().map_err(|e| failed(e.into_error()))?;
        self.named(file, name, listed)
    }

    /// Writes a file.
    ///
    /// # Errors
    /// [`WriteError`] where that fails.
    pub fn write(&self, name: &str, content: &[u8]) -> Result<(), WriteError> {
        let failed = |e: std::io::Error| WriteError { path: self.path.join(name), reason: reason(&e) };
        let mut file = self.unfinished().map_err(failed)?;
        file.write_all(content).map_err(failed)?;
        self.named(file, name, Listed::of(content))
    }

    fn named(&self, file: NamedTempFile, name: &str, listed: Listed) -> Result<(), WriteError> {
        let target = self.path.join(name);
        let failed = |e: std::io::Error| WriteError { path: target.clone(), reason: reason(&e) };
        let may =
            !self.read.contains(name) && (self.has_written(name) || self.manifest.may_be_replaced(&self.path, name).map_err(failed)?);
        if !may {
            let reason =
                "a file of this name is there that this command has not written, or that was changed since: move it away".to_owned();
            return Err(WriteError { path: target, reason });
        }
        self.list(name, listed)?;
        file.persist(&target).map_err(|e| failed(e.error))?;
        self.state().written.push((name.to_owned(), listed));
        match Format::Parquet.beside(name).filter(|_| name != TIMES && Format::Parquet.is_wanted()) {
            Some(own) => self.convert(&target, &own),
            None => Ok(()),
        }
    }

    /// Writes a table as Parquet, from its `.csv`.
    fn convert(&self, csv: &Path, name: &str) -> Result<(), WriteError> {
        let mut stream = self.stream()?;
        parquet::convert(csv, &mut stream).map_err(|e| WriteError { path: self.path.join(name), reason: e.to_string() })?;
        self.keep(stream, name)
    }
}

impl Drop for Folder {
    /// What has written nothing leaves nothing.
    fn drop(&mut self) {
        self.abandon();
    }
}

/// The folder, locked against other runs; nothing where that is not possible.
fn lock(path: &Path) -> Result<Option<File>, WriteError> {
    // a folder can be opened as a file on Unix only
    let Ok(folder) = File::open(path) else { return Ok(None) };
    match folder.try_lock() {
        Ok(()) => Ok(Some(folder)),
        Err(TryLockError::WouldBlock) => Err(WriteError { path: path.to_path_buf(), reason: "another run is writing to it".into() }),
        Err(TryLockError::Error(_)) => Ok(None),
    }
}

/// A file being written.
#[derive(Debug)]
pub struct Stream {
    file: BufWriter<NamedTempFile>,
    bytes: u64,
    hasher: crc32fast::Hasher,
}

impl Write for Stream {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let count = self.file.write(bytes)?;
        self.hasher.update(&bytes[..count]);
        self.bytes += count as u64;
        Ok(count)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.file.flush()
    }
}
