//! Which files of a folder are a command's own: those that `summary.json`, or `journal.log` where a command did not end, lists with the size and the checksum that they still have.

use super::lines::contents;
use crate::input::{InputFile, checksum};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io::{ErrorKind, Read, Result};
use std::path::{Component, Path};

/// The program, as files tell of it.
pub(crate) const PROGRAM: &str = concat!("hartog ", env!("CARGO_PKG_VERSION"));

/// The file that lists the others.
pub(super) const SUMMARY: &str = "summary.json";
/// What a command has written so far, and what the searches of a run have found.
pub(crate) const JOURNAL: &str = "journal.log";
/// Differs from run to run, so that no list has its checksum.
pub(super) const TIMES: &str = "timing.csv";

/// What a line of a journal that lists a file begins with.
const OWN: &str = "own ";
/// What a line of a journal that tells how names of unfinished files begin starts with.
const UNFINISHED: &str = "unfinished ";

/// Size and checksum of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Listed {
    pub bytes: u64,
    pub crc32: u32,
}

impl Listed {
    pub fn of(content: &[u8]) -> Self {
        Self { bytes: content.len() as u64, crc32: crc32fast::hash(content) }
    }

    /// As a line of a journal.
    pub fn line(self, name: &str) -> String {
        format!("{OWN}{:08x} {} {name}", self.crc32, self.bytes)
    }
}

/// What names of unfinished files begin with before what is the command's own.
const UNNAMED: &str = ".hartog-";
/// Digits that are the command's own.
const DIGITS: usize = 16;

/// Returns what names of unfinished files of a command begin with.
pub(super) fn beginning(of: u64) -> String {
    format!("{UNNAMED}{of:0DIGITS$x}-")
}

fn is_beginning(text: &str) -> bool {
    let digits = text.strip_prefix(UNNAMED).and_then(|rest| rest.strip_suffix('-'));
    digits.is_some_and(|d| d.len() == DIGITS && d.bytes().all(|b| b.is_ascii_hexdigit()))
}

/// A line of a journal that tells how names of unfinished files begin.
pub(super) fn unfinished_line(beginning: &str) -> String {
    format!("{UNFINISHED}{beginning}")
}

/// What a journal is of.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Header {
    pub program: String,
    /// CRC-32 of the program, where it can be read: a version may be built in many ways.
    pub build: Option<u32>,
    pub inputs: Vec<InputFile>,
    /// Keys that were given other values than the inputs have.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub set: Vec<String>,
    /// Of which command; `run`, where nothing is said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub command: Option<String>,
    /// What names of its unfinished files begin with.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unfinished: Option<String>,
}

impl Header {
    pub fn new(inputs: &[InputFile], unfinished: &str) -> Self {
        let (program, unfinished) = (PROGRAM.to_owned(), Some(unfinished.to_owned()));
        Self { program, build: None, inputs: inputs.to_vec(), set: Vec::new(), command: None, unfinished }
    }

    /// As a line of a journal: words and numbers, in which nothing can fail.
    pub fn line(&self) -> String {
        serde_json::to_string(self).unwrap_or_default()
    }
}

/// Returns whether a line of a journal tells of files.
pub(super) fn is_of_files(content: &str) -> bool {
    content.starts_with(OWN) || content.starts_with(UNFINISHED)
}

/// An input of an earlier command.
#[derive(Debug, Clone, Deserialize)]
struct Recorded {
    path: String,
    bytes: u64,
    crc32: String,
}

/// What is used of `summary.json`.
#[derive(Debug, Deserialize)]
struct Summary {
    program: String,
    #[serde(default)]
    inputs: Vec<Recorded>,
    files: Vec<RecordedFile>,
}

#[derive(Debug, Deserialize)]
struct RecordedFile {
    name: String,
    bytes: u64,
    crc32: String,
}

/// What earlier commands have left in a folder.
#[derive(Debug, Default)]
pub(super) struct Manifest {
    /// Sizes and checksums that a file of a name may have to be theirs.
    own: BTreeMap<String, Vec<Listed>>,
    /// How names of files begin that were not finished.
    pub unfinished: Vec<String>,
    /// Inputs of the earlier command, the study before all else.
    inputs: Vec<Recorded>,
    /// The earlier command, where it is known.
    command: Option<String>,
}

/// Files that a command always writes, and no other one whose files do not come before; with that command.
const MARKS: [(&str, &str); 9] = [
    ("results.json", "run"),
    ("classification.html", "report"),
    ("comparison.csv", "compare"),
    ("speed_accuracy.csv", "chart"),
    ("absorber_chart.csv", "curves"),
    ("fatigue.csv", "fatigue"),
    ("fit.csv", "fit"),
    ("sizing.csv", "size"),
    // beside the sizes where they are compared in passing
    ("sizing_comparison.csv", "compare"),
];

impl Manifest {
    /// Reads what `summary.json` of a folder and a journal tell.
    ///
    /// # Errors
    /// What keeps the summary from being read.
    pub fn read(folder: &Path, journal: &[u8]) -> Result<Self> {
        let mut manifest = Self::default();
        if let Some(summary) = summary(&folder.join(SUMMARY))? {
            let has = |name: &str| summary.files.iter().any(|f| f.name == name);
            manifest.command = MARKS.iter().find(|m| has(m.0)).map(|m| m.1.to_owned());
            manifest.inputs = summary.inputs;
            for file in summary.files {
                manifest.put(file.name, file.bytes, &file.crc32);
            }
        }
        for content in contents(journal).filter_map(|line| line.1) {
            if let Some(rest) = content.strip_prefix(OWN) {
                let mut words = rest.splitn(3, ' ');
                if let (Some(crc32), Some(Ok(bytes)), Some(name)) = (words.next(), words.next().map(str::parse), words.next()) {
                    manifest.put(name.to_owned(), bytes, crc32);
                }
            } else if let Some(beginning) = content.strip_prefix(UNFINISHED) {
                manifest.note_unfinished(beginning);
            } else if let Ok(header) = serde_json::from_str::<Header>(content) {
                let recorded = |f: &InputFile| Recorded {
                    path: f.path.display().to_string(),
                    bytes: f.bytes as u64,
                    crc32: format!("{:08x}", f.crc32),
                };
                header.unfinished.iter().for_each(|beginning| manifest.note_unfinished(beginning));
                let command = header.command.unwrap_or_else(|| "run".into());
                // the folder is of no command that lists nothing when it has ended
                if MARKS.iter().any(|m| m.1 == command) {
                    manifest.inputs = header.inputs.iter().map(recorded).collect();
                    manifest.command = Some(command);
                }
            }
        }
        Ok(manifest)
    }

    fn note_unfinished(&mut self, beginning: &str) {
        self.unfinished.extend(is_beginning(beginning).then(|| beginning.to_owned()));
    }

    /// A list names files of its folder only.
    fn put(&mut self, name: String, bytes: u64, crc32: &str) {
        let is_name = matches!(Path::new(&name).components().collect::<Vec<_>>().as_slice(), [Component::Normal(n)] if **n == *name);
        if let (true, Ok(crc32)) = (is_name, u32::from_str_radix(crc32, 16)) {
            self.own.entry(name).or_default().push(Listed { bytes, crc32 });
        }
    }

    /// Names that are listed.
    pub fn names(&self) -> impl Iterator<Item = &String> {
        self.own.keys()
    }

    /// Lines of a journal that list the same.
    pub fn lines(&self) -> Vec<String> {
        self.own.iter().flat_map(|(name, all)| all.iter().map(|l| l.line(name))).collect()
    }

    /// Returns whether nothing is lost where a file is replaced: it is listed and as it was written, is known by its beginning, is empty, or there is none.
    ///
    /// # Errors
    /// What keeps it from being read.
    pub(super) fn may_be_replaced(&self, folder: &Path, name: &str) -> Result<bool> {
        let path = folder.join(name);
        let there = match std::fs::symlink_metadata(&path) {
            Err(e) if e.kind() == ErrorKind::NotFound => return Ok(true),
            there => there?,
        };
        if !there.is_file() {
            return Ok(false);
        }
        Ok(there.len() == 0 || self.is_listed(&path, name, there.len())? || is_known(&path, name)?)
    }

    /// Returns whether a file is listed, and is as it was written.
    ///
    /// # Errors
    /// What keeps it from being read.
    pub(super) fn is_as_listed(&self, folder: &Path, name: &str) -> Result<bool> {
        let path = folder.join(name);
        match std::fs::symlink_metadata(&path) {
            Err(e) if e.kind() == ErrorKind::NotFound => Ok(false),
            there => there.map(|t| t.is_file().then_some(t.len()))?.map_or(Ok(false), |bytes| self.is_listed(&path, name, bytes)),
        }
    }

    fn is_listed(&self, path: &Path, name: &str, bytes: u64) -> Result<bool> {
        let Some(all) = self.own.get(name).filter(|all| all.iter().any(|l| l.bytes == bytes)) else { return Ok(false) };
        let own = Listed { bytes, crc32: checksum(path)? };
        Ok(all.contains(&own))
    }

    /// Returns the command that has left the folder, where it is another one.
    pub(crate) fn other_command(&self, command: &str) -> Option<&str> {
        self.command.as_deref().filter(|c| *c != command)
    }

    /// Returns the study (or table) that the folder is of, as it was named, where it is another one: another path that leads to another file, which is still there, with other content.
    pub(crate) fn other_study(&self, inputs: &[InputFile]) -> Option<&str> {
        let (before, now) = (self.inputs.first()?, inputs.first()?);
        let path = Path::new(&before.path);
        let is_same_file = || matches!((path.canonicalize(), now.path.canonicalize()), (Ok(a), Ok(b)) if a == b);
        let alike = |(b, n): (&Recorded, &InputFile)| b.bytes == n.bytes as u64 && b.crc32 == format!("{:08x}", n.crc32);
        let is_copy = || self.inputs.len() == inputs.len() && self.inputs.iter().zip(inputs).all(alike);
        let same = before.path == now.path.display().to_string() || !path.exists() || is_same_file() || is_copy();
        (!same).then_some(&before.path)
    }
}

/// `summary.json`, where it is one of ours.
fn summary(path: &Path) -> Result<Option<Summary>> {
    let parsed = |text: Vec<u8>| serde_json::from_slice::<Summary>(&text).ok().filter(|s| s.program.starts_with("hartog "));
    Ok(bytes(path)?.and_then(parsed))
}

/// Returns what a file holds, None where there is none: links, folders and devices are none of ours.
///
/// # Errors
/// What keeps it from being read.
pub(super) fn bytes(path: &Path) -> Result<Option<Vec<u8>>> {
    match std::fs::symlink_metadata(path) {
        Err(e) if e.kind() == ErrorKind::NotFound => Ok(None),
        Err(e) => Err(e),
        Ok(there) if there.is_file() => std::fs::read(path).map(Some),
        Ok(_) => Ok(None),
    }
}

/// Whether a file that no list can hold is one of ours, by what it begins with.
fn is_known(path: &Path, name: &str) -> Result<bool> {
    const MOST: u64 = 4096;
    let beginning = || -> Result<Vec<u8>> {
        let mut bytes = Vec::new();
        std::fs::File::open(path)?.take(MOST).read_to_end(&mut bytes)?;
        Ok(bytes)
    };
    Ok(match name {
        SUMMARY => summary(path)?.is_some(),
        TIMES => beginning()?.starts_with(b"stage,seconds,evaluations,"),
        JOURNAL => is_journal(&std::fs::read(path)?),
        _ if name.ends_with(".1") => String::from_utf8_lossy(&beginning()?).contains("\n.TH hartog"),
        _ => false,
    })
}

/// A journal has a line with its checksum, or the beginning of its first one.
fn is_journal(bytes: &[u8]) -> bool {
    const SUM: usize = 8;
    let first = b" {\"program\":\"hartog ";
    let begins = || {
        let (sum, rest) = bytes.split_at(SUM.min(bytes.len()));
        let rest = &rest[..first.len().min(rest.len())];
        sum.iter().all(u8::is_ascii_hexdigit) && first.starts_with(rest)
    };
    contents(bytes).any(|line| line.1.is_some()) || begins()
}
