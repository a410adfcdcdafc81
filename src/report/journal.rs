//! The journal of a run: what its searches have found, in its output folder until the run is complete, so that a run that was killed can go on.
//!
//! Its first line tells of program and inputs; the others are the key of a search and what was found, in base 64, or tell of files. A run that does not go on from an earlier one begins with a first line of its own behind that one's lines.

use super::files::{Folder, Job, WriteError};
use super::lines::contents;
use super::manifest::{Header, JOURNAL, is_of_files, unfinished_line};
use super::taken::FolderError;
use crate::input::{InputFile, checksum};
use crate::numerics::elementary::Elementary;
use crate::objective::holds;
use crate::optimise::{BestSoFar, Memory};
use base64::Engine;
use base64::engine::general_purpose::STANDARD_NO_PAD;
use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A journal that a run cannot go on from.
#[derive(Debug, thiserror::Error)]
#[doc(hidden)]
pub enum JournalError {
    /// It cannot be read or written.
    #[error(transparent)]
    File(#[from] WriteError),
    /// The folder is not one to write to.
    #[error(transparent)]
    Folder(#[from] FolderError),
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

/// What differs from that of an earlier run.
fn changed(own: &Header, before: &Header) -> Option<String> {
    if own.program != before.program {
        return Some(format!("it was begun by {}, this is {}", before.program, own.program));
    }
    if own.build != before.build {
        return Some(format!("it was begun by another build of {}", own.program));
    }
    if own.set != before.set {
        let shown = |set: &[String]| if set.is_empty() { "none".to_owned() } else { set.join(" ") };
        return Some(format!("its --set was {}, that of this run is {}", shown(&before.set), shown(&own.set)));
    }
    let name = |f: &InputFile| f.path.file_name().map(|n| n.to_string_lossy().into_owned());
    for (now, then) in own.inputs.iter().zip(&before.inputs) {
        if name(now) != name(then) {
            return Some(format!("it read `{}`, this run reads `{}`", then.path.display(), now.path.display()));
        }
        if (now.bytes, now.crc32) != (then.bytes, then.crc32) {
            return Some(format!("`{}` has changed since", now.path.display()));
        }
    }
    (own.inputs.len() != before.inputs.len()).then(|| "it read other files".to_owned())
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
    /// Why a search could not be kept.
    failure: Option<String>,
    written: usize,
    best: BTreeMap<String, Best>,
}

/// The journal of a run.
#[derive(Debug)]
#[doc(hidden)]
pub struct Journal {
    folder: Arc<Folder>,
    /// What an earlier run has found.
    known: HashMap<u64, Vec<u8>>,
    state: Mutex<State>,
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
}

/// What the last run in a journal has left; nothing where there is none. Lines that begin a run anew have nothing to do with those before them, damaged or not.
fn read(path: &Path, bytes: &[u8]) -> Result<Option<Left>, JournalError> {
    let mut left = None;
    let mut wrong = None;
    for (line, content) in contents(bytes) {
        let content = content.unwrap_or("");
        if let Ok(header) = serde_json::from_str::<Header>(content) {
            left = header.command.is_none().then(|| Left { header, known: HashMap::new() });
            wrong = None;
        } else if let (Some((key, found)), Some(left)) = (entry(content), left.as_mut()) {
            left.known.insert(key, found);
        } else if !is_of_files(content) {
            wrong = wrong.or(Some(line));
        }
    }
    match wrong {
        Some(line) => Err(JournalError::Damaged { path: path.to_path_buf(), line }),
        None => Ok(left),
    }
}

impl Journal {
    /// Makes the folder of a run, some keys of whose inputs are `set`, as [`Folder::create`] does, and begins its journal, or goes on with that of an interrupted run where there is one.
    ///
    /// # Errors
    /// [`JournalError`] where that cannot be, or the journal is damaged, or of another program or other inputs.
    #[doc(hidden)]
    pub fn open(path: &Path, job: Job, set: &[String], resume: bool) -> Result<Self, JournalError> {
        let folder = Arc::new(Folder::open(path, job)?);
        let build = std::env::current_exe().and_then(|path| checksum(&path)).ok();
        let own = Header { build, set: set.to_vec(), ..Header::new(job.inputs, folder.beginning()) };
        let left = if resume { read(&path.join(JOURNAL), folder.left())? } else { None };
        let (line, known) = match left {
            Some(left) => match changed(&own, &left.header) {
                Some(why) => return Err(JournalError::Another { folder: path.to_path_buf(), why }),
                None => (unfinished_line(folder.beginning()), left.known),
            },
            None => (own.line(), HashMap::new()),
        };
        folder.append(line)?;
        Ok(Self { folder, known, state: Mutex::default() })
    }

    /// The folder.
    #[doc(hidden)]
    pub fn folder(&self) -> &Arc<Folder> {
        &self.folder
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// How many searches an earlier run has done.
    #[doc(hidden)]
    pub fn known(&self) -> usize {
        self.known.len()
    }

    /// How many searches are in it.
    pub(crate) fn searches(&self) -> usize {
        self.known.len() + self.state().written
    }

    /// Why it is not complete.
    #[doc(hidden)]
    pub fn failure(&self) -> Option<String> {
        self.state().failure.clone()
    }

    /// What is kept of a run that ends before it is complete, in words, and whether a run can go on from there.
    #[doc(hidden)]
    pub fn kept(&self) -> (String, bool) {
        let Some(journal) = self.folder.journal() else {
            return ("its journal is gone, and with it what its searches have found".into(), false);
        };
        match (self.searches(), self.failure()) {
            (0, Some(why)) => (format!("nothing of what its searches have found could be kept ({why})"), false),
            (n, Some(why)) => (format!("{n} searches are kept in {}, the others are not ({why})", journal.display()), true),
            (n, None) => (format!("{n} searches are kept in {}", journal.display()), true),
        }
    }

    /// A table of the best designs so far: a row a parameter. `shown`: value and unit of an objective.
    #[doc(hidden)]
    pub fn best(&self, shown: impl Fn(usize, f64) -> (f64, &'static str)) -> Vec<u8> {
        let mut table = String::from("design,objective,unit,limits_hold,type,parameter,value\n");
        for (search, best) in &self.state().best {
            let (objective, unit) = shown(best.objective, best.value);
            for (kind, parameter, value) in &best.design {
                table += &format!("{search},{objective},{unit},{},{kind},{parameter},{value}\n", holds(best.excess.exponential()));
            }
        }
        table.into_bytes()
    }
}

impl Memory for Journal {
    fn recall(&self, key: u64) -> Option<Vec<u8>> {
        self.known.get(&key).cloned()
    }

    fn keep(&self, key: u64, found: &[u8]) {
        let kept = self.folder.append(format!("{key:016x} {}", STANDARD_NO_PAD.encode(found)));
        let mut state = self.state();
        match kept {
            Ok(()) => state.written += 1,
            // what is there stays
            Err(e) => state.failure = Some(e.reason),
        }
    }

    fn found(&self, found: &BestSoFar) {
        let BestSoFar { search, value, excess, design } = found;
        let best = Best { objective: search.objective, value: *value, excess: *excess, design: design.clone() };
        let mut state = self.state();
        if state.best.get(search.design).is_none_or(|b| best.before(b)) {
            state.best.insert(search.design.to_owned(), best);
        }
    }
}
