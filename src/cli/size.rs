//! `hartog size`: piston pin, connecting rod and crank from operating data, and a study of the chain that follows.

use super::exit::{DONE, FAILED, fail, files, paths, say};
use super::place::chosen;
use super::progress::Bar;
use crate::analysis::sizing::run;
use crate::input::{noted, read_sizing};
use crate::report::{Folder, Job, Names, about_inputs, text, write_folder, write_sizing};
use crate::validation::rounds::rounds;
use std::path::PathBuf;

/// Arguments of `size`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  hartog size studies/fialho_four.toml --out sized\n  hartog run sized/study.toml\n\n\
Sizes every section for static strength and for infinite life until dimensions, masses and forces agree. Writes sizing.csv, forces and moments over the cycle,\n\
a drawing, and engine.toml and study.toml for `hartog run`; where these are there and were changed since, it refuses to replace them.\n\nExit code: 0 done, 1 a dimension that was given falls short of the design factor, 2 bad input or no dimensions that hold.")]
pub struct Arguments {
    /// Sizing file (TOML).
    pub sizing: PathBuf,
    /// Output folder [default: out/SIZING].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Number of threads [default: all]; results are the same for any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub threads: Option<u16>,
    /// Print the tables of dimensions, margins and masses; the page has them in any case.
    #[arg(long)]
    pub verbose: bool,
}

/// Sizes and writes.
pub fn size(arguments: &Arguments) -> u8 {
    crate::cli::threads(arguments.threads.map(usize::from));
    let (study, inputs) = noted(|| read_sizing(&arguments.sizing));
    let study = match study {
        Ok(study) => study,
        Err(error) => return fail(&error),
    };
    let path = match chosen(arguments.out.as_ref(), &arguments.sizing, "") {
        Ok(path) => path,
        Err(error) => return fail(&error),
    };
    let folder = match Folder::create(&path, Job { names: &Names::of_size(), inputs: &inputs, reads: &paths(&inputs) }) {
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
    if let Err(error) = written.and_then(|()| folder.complete(&about_inputs(&inputs))) {
        return fail(&error);
    }
    say(&if arguments.verbose { printed() } else { text::sizing_in_brief(&study, &results) });
    say(&files(&folder));
    if results.sized.last().short_of(&study.specification).is_empty() { DONE } else { FAILED }
}
