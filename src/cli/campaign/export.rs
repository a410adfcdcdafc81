//! `hartog campaign export`: the shards for programs that schedule.

use crate::cli::exit::{DONE, fail, say_raw};
use crate::report::campaign::{Manifest, Scheduler, export as files};
use std::path::PathBuf;

/// Arguments of `campaign export`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Folder of a planned campaign.
    folder: PathBuf,
    /// What runs the shards.
    #[arg(long = "for", value_enum, value_name = "WHAT")]
    scheduler: Scheduler,
}

/// Writes what a scheduler needs into the folder of a campaign.
pub(super) fn export(arguments: &Arguments) -> u8 {
    let program = std::env::current_exe().unwrap_or_else(|_| PathBuf::from("hartog"));
    let written = Manifest::read(&arguments.folder).and_then(|manifest| files(&arguments.folder, &manifest, &program, arguments.scheduler));
    match written {
        Ok(words) => {
            // a line for a shell stays one
            say_raw(&words);
            DONE
        }
        Err(error) => fail(&error),
    }
}
