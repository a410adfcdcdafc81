//! `hartog check`: what a study means, without running it.

use super::exit::{DONE, fail, say};
use crate::input;
use crate::report::text::check;
use std::path::PathBuf;

/// Arguments of `check`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  hartog check studies/villalva_v10.toml")]
pub struct Arguments {
    /// Study file (TOML).
    pub study: PathBuf,
}

/// Reads and checks a study, and prints the model it describes.
pub fn check(arguments: &Arguments) -> u8 {
    let study = match input::read(&arguments.study) {
        Ok(study) => study,
        Err(error) => return fail(&error),
    };
    say(&check::model(&study));
    DONE
}
