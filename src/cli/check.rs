//! `hartog check`: what a study means, without running it.

use super::exit::{DONE, fail, say};
use crate::input;
use crate::report::text::{check, check_in_brief};
use std::path::PathBuf;

/// Arguments of `check`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  hartog check studies/villalva_v10.toml")]
pub struct Arguments {
    /// Study file (TOML).
    pub study: PathBuf,
    /// Print the chain station by station, every mode with its critical speeds, the excitation, and what the crank bears.
    #[arg(long)]
    pub verbose: bool,
}

/// Reads and checks a study, and prints the model it describes.
pub fn check(arguments: &Arguments) -> u8 {
    let study = match input::read(&arguments.study) {
        Ok(study) => study,
        Err(error) => return fail(&error),
    };
    say(&if arguments.verbose { check::model(&study, true) } else { check_in_brief(&study) });
    DONE
}
