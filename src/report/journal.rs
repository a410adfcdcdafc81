//! The journal of a run: what its searches have found, in its output folder until the run is complete, so that a run that was killed can go on.
//!
//! A line is a checksum (CRC-32, eight hexadecimal digits), a space, and what it is of. The first line tells of program and inputs; every other one is
//! the key of a search and what was found, in base 64. A line is written at once: only the last one can be torn.

use super::files::{Folder, WriteError, reason};
use crate::input::InputFile;
use crate::numerics::elementary::Elementary;
use crate::objective::holds;
use crate::optimise::{Found, Memory};
use base64::Engine;
use base64::engine::general_purpose::STANDARD_NO_PAD;
use rayon::prelude::*;
use std::collections::{BTreeMap, HashMap};
use std::fs::{File, OpenOptions};
use std::io::{ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Its name.
pub(crate) const JOURNAL: &str = "journal.log";

/// A journal that a run cannot go on from.
#[derive(Debug, thiserror::Error)]
pub(crate) enum JournalError {
    /// It cannot be read or written.
    #[error(transparent)]
    File(#[from] WriteError),
    /// Not what was written.
    #[error("error: cannot resume: {}, line {line} is damaged; run without --resume to start anew", path.display())]
    Damaged {
        /// The journal.
        path: PathBuf,
        /// From 1.
        line: usize,
    },
    /// Of another program or other inputs.
    #[error("error: cannot resume {}: {why}; run without --resume to start anew", folder.display())]
    Another {
        /// The folder.
        folder: PathBuf,
        /// What has changed.
        why: String,
    },
}

/// What a journal is of.
#[derive(Debug, PartialEq, serde::Serialize, serde::Deserialize)]
struct Header {
    program: String,
    /// CRC-32 of the program, where it can be read: a version may be built in many ways.
    build: Option<u32>,
    inputs: Vec<InputFile>,
}

impl Header {
    fn new(inputs: &[InputFile]) -> Self {
        let program = concat!("hartog ", env!("CARGO_PKG_VERSION")).to_owned();
        let build = std::env::current_exe().and_then(|path| checksum(&path)).ok();
        Self { program, build, inputs: inputs.to_vec() }
    }

    /// What differs from that of an earlier run.
    fn changed(&self, before: &Self) -> Option<String> {
        if self.program != before.program {
            return Some(format!("it was begun by {}, this is {}", before.program, self.program));
        }
        if self.build != before.build {
            return Some(format!("it was begun by another build of {}", self.program));
        }
        let name = |f: &InputFile| f.path.file_name().map(|n| n.to_owned());
        for (now, then) in self.inputs.iter().zip(&before.inputs) {
            if name(now) != name(then) {
                return Some(format!("it read `{}`, this run reads `{}`", then.path.display(), now.path.display()));
            }
            if (now.bytes, now.crc32) != (then.bytes, then.crc32) {
                return Some(format!("`{}` has changed since", now.path.display()));
            }
        }
        (self.inputs.len() != before.inputs.len()).then(|| "it read other files".to_owned())
    }
}

/// What one search has come to so far.
#[derive(Debug, Clone, PartialEq)]
struct Best {
    objective: usize,
    value: f64,
    excess: f64,
    design: Vec<(&'static str, &'static str, f64)>,
}

impl Best {
    /// Limits count before the objective.
    fn before(&self, other: &Self) -> bool {
        (self.excess, self.value) < (other.excess, other.value)
    }
}

#[derive(Debug, Default)]
struct State {
    /// Nothing where it could not be written any longer.
    file: Option<File>,
    failure: Option<String>,
    written: usize,
    best: BTreeMap<String, Best>,
}

/// The journal of a run.
#[derive(Debug)]
pub(crate) struct Journal {
    path: PathBuf,
    /// What an earlier run has found.
    known: HashMap<u64, Vec<u8>>,
    state: Mutex<State>,
}

/// Parts of a file that are read side by side, and how much of one at a time.
const PARTS: u64 = 4;
const AT_A_TIME: usize = 1 << 16;

/// CRC-32 of a file.
fn checksum(path: &Path) -> std::io::Result<u32> {
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

/// A line.
fn line(content: &str) -> String {
    format!("{:08x} {content}\n", crc32fast::hash(content.as_bytes()))
}

/// What a line is of, if it is as it was written.
fn content(line: &[u8]) -> Option<&str> {
    let (sum, content) = std::str::from_utf8(line).ok()?.split_once(' ')?;
    (sum == format!("{:08x}", crc32fast::hash(content.as_bytes()))).then_some(content)
}

/// Key and what was found.
fn entry(content: &str) -> Option<(u64, Vec<u8>)> {
    let (key, found) = content.split_once(' ')?;
    Some((u64::from_str_radix(key, 16).ok()?, STANDARD_NO_PAD.decode(found).ok()?))
}

/// What an earlier run has left.
struct Left {
    header: Header,
    known: HashMap<u64, Vec<u8>>,
    /// Bytes of whole lines.
    length: usize,
}

/// The whole lines of a journal; nothing where there are none.
fn read(path: &Path, bytes: &[u8]) -> Result<Option<Left>, JournalError> {
    let length = bytes.iter().rposition(|b| *b == b'\n').map_or(0, |i| i + 1);
    let mut header = None;
    let mut known = HashMap::new();
    for (i, line) in bytes[..length].split_inclusive(|b| *b == b'\n').enumerate() {
        let damaged = || JournalError::Damaged { path: path.to_path_buf(), line: i + 1 };
        let content = content(&line[..line.len() - 1]).ok_or_else(damaged)?;
        if i == 0 {
            header = Some(serde_json::from_str(content).map_err(|_| damaged())?);
        } else {
            let (key, found) = entry(content).ok_or_else(damaged)?;
            known.insert(key, found);
        }
    }
    Ok(header.map(|header| Left { header, known, length }))
}

impl Journal {
    /// Begins one, or goes on with that of an interrupted run where there is one.
    ///
    /// # Errors
    /// [`JournalError`] where it cannot be written, is damaged, or is of another program or other inputs.
    pub(crate) fn open(folder: &Folder, inputs: &[InputFile], resume: bool) -> Result<Self, JournalError> {
        let path = folder.path().join(JOURNAL);
        let failed = |e: std::io::Error| WriteError { path: path.clone(), reason: reason(&e) };
        let own = Header::new(inputs);
        if resume && path.exists() {
            let bytes = std::fs::read(&path).map_err(failed)?;
            if let Some(Left { header, known, length }) = read(&path, &bytes)? {
                if let Some(why) = own.changed(&header) {
                    return Err(JournalError::Another { folder: folder.path().to_path_buf(), why });
                }
                let file = OpenOptions::new().append(true).open(&path).map_err(failed)?;
                file.set_len(length as u64).map_err(failed)?;
                return Ok(Self { path, known, state: Mutex::new(State { file: Some(file), ..State::default() }) });
            }
        }
        let mut file = File::create(&path).map_err(failed)?;
        let header = serde_json::to_string(&own).map_err(|e| failed(e.into()))?;
        file.write_all(line(&header).as_bytes()).map_err(failed)?;
        Ok(Self { path, known: HashMap::new(), state: Mutex::new(State { file: Some(file), ..State::default() }) })
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// How many searches an earlier run has done.
    pub(crate) fn known(&self) -> usize {
        self.known.len()
    }

    /// How many searches are in it.
    pub(crate) fn searches(&self) -> usize {
        self.known.len() + self.state().written
    }

    /// Why it is not complete.
    pub(crate) fn failure(&self) -> Option<String> {
        self.state().failure.clone()
    }

    /// A table of the best designs so far: a row a parameter. `shown`: value and unit of an objective.
    pub(crate) fn best(&self, shown: impl Fn(usize, f64) -> (f64, &'static str)) -> Vec<u8> {
        let mut table = String::from("design,objective,unit,limits_hold,type,parameter,value\n");
        for (search, best) in &self.state().best {
            let (objective, unit) = shown(best.objective, best.value);
            for (kind, parameter, value) in &best.design {
                table += &format!("{search},{objective},{unit},{},{kind},{parameter},{value}\n", holds(best.excess.exponential()));
            }
        }
        table.into_bytes()
    }

    /// Removes it: the run is complete, or cannot go on.
    pub(crate) fn remove(&self) {
        self.state().file = None;
        let _gone = std::fs::remove_file(&self.path);
    }
}

impl Memory for Journal {
    fn recall(&self, key: u64) -> Option<Vec<u8>> {
        self.known.get(&key).cloned()
    }

    fn keep(&self, key: u64, found: &[u8]) {
        let line = line(&format!("{key:016x} {}", STANDARD_NO_PAD.encode(found)));
        let mut state = self.state();
        let Some(file) = state.file.as_mut() else { return };
        match file.write_all(line.as_bytes()) {
            Ok(()) => state.written += 1,
            // what is there stays: a torn line is left out when it is read
            Err(e) => (state.file, state.failure) = (None, Some(reason(&e))),
        }
    }

    fn found(&self, found: &Found) {
        let Found { search, value, excess, design } = found;
        let best = Best { objective: search.objective, value: *value, excess: *excess, design: design.clone() };
        let mut state = self.state();
        if state.best.get(search.design).is_none_or(|b| best.before(b)) {
            state.best.insert(search.design.to_owned(), best);
        }
    }
}
