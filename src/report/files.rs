//! Whole files or none: each is written under a temporary name and renamed. One run at a time writes to a folder, and tells in `summary.json`, its last file, that all are there and of one run.

use super::formats::Format;
use super::parquet;
use rayon::prelude::*;
use std::fs::{File, TryLockError};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use tempfile::NamedTempFile;

/// A file or folder could not be written.
#[derive(Debug, thiserror::Error)]
#[error("error: cannot write {}: {reason}", path.display())]
pub struct WriteError {
    /// What was to be written.
    pub path: PathBuf,
    /// Why not.
    pub reason: String,
}

/// The output folder.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    /// Names of the files written.
    written: Mutex<Vec<String>>,
    /// Held as long as the folder is written to.
    _lock: Option<File>,
}

/// The file that tells of the others.
const SUMMARY: &str = "summary.json";
/// Differs from run to run.
const TIMES: &str = "timing.csv";
/// What temporary names begin with.
const TEMPORARY: &str = ".hartog";

impl Folder {
    /// Makes the folder where it is missing, and tries whether it can be written to, so that a long run does not fail at its end.
    ///
    /// # Errors
    /// [`WriteError`] where that fails.
    pub(crate) fn create(path: &Path) -> Result<Self, WriteError> {
        let failed = |e: std::io::Error| WriteError { path: path.to_path_buf(), reason: reason(&e) };
        if path.is_symlink() && !path.exists() {
            return Err(WriteError { path: path.to_path_buf(), reason: "it is a link to something that is not there".into() });
        }
        std::fs::create_dir_all(path).map_err(failed)?;
        let lock = lock(path)?;
        tempfile::Builder::new().prefix(TEMPORARY).tempfile_in(path).map_err(failed)?;
        let folder = Self { path: path.to_path_buf(), written: Mutex::default(), _lock: lock };
        if folder._lock.is_some() {
            folder.remove_temporary().map_err(failed)?;
        }
        Ok(folder)
    }

    /// Removes what runs that were killed have left: none is at work here.
    fn remove_temporary(&self) -> std::io::Result<()> {
        for entry in std::fs::read_dir(&self.path)? {
            let entry = entry?;
            if entry.file_name().to_string_lossy().starts_with(TEMPORARY) && entry.file_type()?.is_file() {
                std::fs::remove_file(entry.path())?;
            }
        }
        Ok(())
    }

    /// Files of this run begin to take the place of others: as long as both are there nothing says that they belong together.
    fn begin(&self) -> Result<(), WriteError> {
        let path = self.path.join(SUMMARY);
        match std::fs::remove_file(&path) {
            Err(e) if e.kind() != std::io::ErrorKind::NotFound => Err(WriteError { reason: reason(&e), path }),
            _ => Ok(()),
        }
    }

    /// Writes `summary.json` when all else is written, as [`Folder::summarise`].
    ///
    /// # Errors
    /// [`WriteError`] where that fails.
    pub(crate) fn complete(&self) -> Result<(), WriteError> {
        self.summarise(true, &serde_json::Map::new())
    }

    /// Writes `summary.json`: the program, whether the run is finished, what else is known of it, and name, size and checksum (CRC-32) of
    /// every file but that of times.
    ///
    /// # Errors
    /// [`WriteError`] where that fails.
    pub(crate) fn summarise(&self, finished: bool, about: &serde_json::Map<String, serde_json::Value>) -> Result<(), WriteError> {
        let mut names = self.names();
        names.sort();
        names.dedup();
        names.retain(|name| name != TIMES);
        let told = |name: String| {
            let path = self.path.join(&name);
            let bytes = std::fs::read(&path).map_err(|e| WriteError { reason: reason(&e), path })?;
            Ok(serde_json::json!({ "name": name, "bytes": bytes.len(), "crc32": format!("{:08x}", crc32fast::hash(&bytes)) }))
        };
        let files: Vec<Result<serde_json::Value, WriteError>> = names.into_par_iter().map(told).collect();
        let files = files.into_iter().collect::<Result<Vec<_>, _>>()?;
        let mut summary = serde_json::Map::new();
        summary.insert("program".into(), concat!("hartog ", env!("CARGO_PKG_VERSION")).into());
        summary.insert("finished".into(), finished.into());
        summary.extend(about.clone());
        summary.insert("files".into(), files.into());
        let text = format!("{:#}\n", serde_json::Value::Object(summary));
        self.write(SUMMARY, text.as_bytes())
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// How many files were written.
    pub fn written(&self) -> usize {
        self.written.lock().unwrap_or_else(PoisonError::into_inner).len()
    }

    /// Whether this run has written a file of that name.
    pub(crate) fn has_written(&self, name: &str) -> bool {
        self.written.lock().unwrap_or_else(PoisonError::into_inner).iter().any(|n| n == name)
    }

    /// Names of what this run has written, in the order of writing.
    pub(crate) fn names(&self) -> Vec<String> {
        self.written.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Removes files of an earlier run that this one does not make, so that they are not taken for its own.
    ///
    /// # Errors
    /// [`WriteError`] where one is there and cannot be removed.
    pub fn remove(&self, names: &[&str]) -> Result<(), WriteError> {
        let beside = names.iter().flat_map(|name| [Format::Pdf, Format::Parquet].into_iter().filter_map(|f| f.beside(name)));
        for name in names.iter().map(|n| (*n).to_owned()).chain(beside) {
            let path = self.path.join(name);
            if path.is_file() {
                self.begin()?;
                std::fs::remove_file(&path).map_err(|e| WriteError { reason: reason(&e), path })?;
            }
        }
        Ok(())
    }

    /// Removes plots named `prefix…` of an earlier run that this one has not written.
    ///
    /// # Errors
    /// [`WriteError`] where one is there and cannot be removed.
    pub(crate) fn remove_other_plots(&self, prefix: &str) -> Result<(), WriteError> {
        let failed = |e: std::io::Error| WriteError { path: self.path.clone(), reason: reason(&e) };
        let mut old = Vec::new();
        for entry in std::fs::read_dir(&self.path).map_err(failed)? {
            let name = entry.map_err(failed)?.file_name().to_string_lossy().into_owned();
            let plot = name.starts_with(prefix) && [".svg", ".png", ".pdf"].iter().any(|end| name.ends_with(end));
            if plot && !self.written.lock().unwrap_or_else(PoisonError::into_inner).contains(&name) {
                old.push(name);
            }
        }
        self.remove(&old.iter().map(String::as_str).collect::<Vec<_>>())
    }

    /// A file that is written as it grows, without a name yet.
    ///
    /// # Errors
    /// [`WriteError`] where that fails.
    pub(crate) fn stream(&self) -> Result<Stream, WriteError> {
        let failed = |e: std::io::Error| WriteError { path: self.path.clone(), reason: reason(&e) };
        let file = tempfile::Builder::new().prefix(TEMPORARY).tempfile_in(&self.path).map_err(failed)?;
        Ok(Stream(BufWriter::new(file)))
    }

    /// Gives a stream its name, in place of an earlier file.
    ///
    /// # Errors
    /// [`WriteError`] where that fails.
    pub fn keep(&self, stream: Stream, name: &str) -> Result<(), WriteError> {
        let target = self.path.join(name);
        let failed = |e: std::io::Error| WriteError { path: target.clone(), reason: reason(&e) };
        let file = stream.0.into_inner().map_err(|e| failed(e.into_error()))?;
        self.named(file, name)
    }

    /// Writes a file.
    ///
    /// # Errors
    /// [`WriteError`] where that fails.
    pub fn write(&self, name: &str, content: &[u8]) -> Result<(), WriteError> {
        let target = self.path.join(name);
        let failed = |e: std::io::Error| WriteError { path: target.clone(), reason: reason(&e) };
        let mut file = tempfile::Builder::new().prefix(TEMPORARY).tempfile_in(&self.path).map_err(failed)?;
        file.write_all(content).map_err(failed)?;
        self.named(file, name)
    }

    fn named(&self, file: NamedTempFile, name: &str) -> Result<(), WriteError> {
        let target = self.path.join(name);
        let failed = |e: std::io::Error| WriteError { path: target.clone(), reason: reason(&e) };
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // temporary files are private; results are as readable as any other file
            file.as_file().set_permissions(std::fs::Permissions::from_mode(0o644)).map_err(failed)?;
        }
        self.begin()?;
        file.persist(&target).map_err(|e| failed(e.error))?;
        self.written.lock().unwrap_or_else(PoisonError::into_inner).push(name.to_owned());
        match Format::Parquet.beside(name).filter(|_| name != TIMES) {
            Some(own) if Format::Parquet.is_wanted() => self.convert(&target, &own),
            Some(own) => self.remove(&[&own]),
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
pub struct Stream(BufWriter<NamedTempFile>);

impl Write for Stream {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.0.flush()
    }
}

pub(super) fn reason(error: &std::io::Error) -> String {
    match error.kind() {
        std::io::ErrorKind::PermissionDenied => "no permission".to_owned(),
        std::io::ErrorKind::NotADirectory | std::io::ErrorKind::AlreadyExists => "a file is in the way of the folder".to_owned(),
        std::io::ErrorKind::StorageFull | std::io::ErrorKind::QuotaExceeded => "no space is left".to_owned(),
        std::io::ErrorKind::FileTooLarge => "no file may be as large here".to_owned(),
        _ => error.to_string(),
    }
}
