//! `hartog size`: piston pin, connecting rod and crank from operating data, and a study of the chain that follows.

use super::exit::{DONE, FAILED, fail, files, say};
use super::progress::Bar;
use crate::analysis::sizing::run;
use crate::input::read_sizing;
use crate::report::{Folder, text, write_folder, write_sizing};
use crate::validation::rounds::rounds;
use std::path::{Path, PathBuf};

/// Arguments of `size`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  hartog size studies/fialho_four.toml --out sized\n  hartog run sized/study.toml\n\n\
Sizes every section for static strength and for infinite life until dimensions, masses and forces agree. Writes sizing.csv, forces and moments over the cycle,\n\
a drawing, and engine.toml and study.toml for `hartog run`.\n\nExit code: 0 done, 1 a dimension that was given falls short of the design factor, 2 bad input or no dimensions that hold.")]
pub struct Arguments {
    /// Sizing file (TOML).
    pub sizing: PathBuf,
    /// Output folder [default: out/SIZING].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Number of threads [default: all]; results are the same for any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub threads: Option<u16>,
}

/// Sizes and writes.
pub fn size(arguments: &Arguments) -> u8 {
    crate::cli::threads(arguments.threads.map(usize::from));
    let study = match read_sizing(&arguments.sizing) {
        Ok(study) => study,
        Err(error) => return fail(&error),
    };
    let path = arguments.out.clone().unwrap_or_else(|| Path::new("out").join(&study.name));
    let folder = match Folder::create(&path) {
        Ok(folder) => folder,
        Err(error) => return fail(&error),
    };
    let bar = Bar::default();
    let found = run(&study, &bar);
    drop(bar);
    let results = match found {
        Ok(results) => results,
        Err(error) => return fail(&format!("error: {}: {error}", arguments.sizing.display())),
    };
    let published = study.published.as_ref().map_or_else(Vec::new, |p| rounds(&study.specification, &results.sized.rounds, p));
    let printed = || text::sizing(&study, &results, &published);
    let written = write_sizing(&study, &results, &published, &folder)
        .and_then(|()| write_folder(&format!("{}: sections sized", study.title), printed, &folder));
    if let Err(error) = written.and_then(|()| folder.complete()) {
        return fail(&error);
    }
    say(&printed());
    say(&files(&folder));
    if results.sized.last().short_of(&study.specification).is_empty() { DONE } else { FAILED }
}
