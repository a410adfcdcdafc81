//! The study that a command is of, and keys that it gives other values than the files have.

use crate::input::{self, InputError, InputFile, Study};
use std::path::PathBuf;

/// A study file and what of it is to be otherwise.
#[derive(Debug, clap::Args)]
pub struct StudyArguments {
    /// Study file (TOML).
    #[arg(value_name = "STUDY")]
    pub path: PathBuf,
    /// Give a key another value than the study has, checked as in its file; a key of the engine file stands behind `engine.`, an element of a list is told by its number, from 0, or its name; may be given several times.
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}

impl StudyArguments {
    /// Reads and checks the study, and tells which files that took.
    pub(super) fn read(&self) -> (Result<Study, InputError>, Vec<InputFile>) {
        input::noted(|| input::read_with(&self.path, &input::overrides(&self.set)?))
    }
}
