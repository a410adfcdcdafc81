//! `hartog campaign status`.

use super::told::{MISSING, processor_time, rows};
use crate::cli::exit::{DONE, fail, say, say_raw};
use crate::report::campaign::{Dataset, Manifest, State};
use serde_json::{Map, Value, json};
use std::path::PathBuf;

/// Arguments of `campaign status`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Folder of a planned campaign.
    folder: PathBuf,
    /// Print the numbers of the shards that are missing, a line each, and nothing else.
    #[arg(long, conflicts_with = "json")]
    missing: bool,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// Tells what is done of a campaign.
pub(super) fn status(arguments: &Arguments) -> u8 {
    let manifest = match Manifest::read(&arguments.folder) {
        Ok(manifest) => manifest,
        Err(error) => return fail(&error),
    };
    let dataset = Dataset::read(&arguments.folder, &manifest, false);
    let missing = dataset.missing();
    let torn = dataset.shards.iter().filter(|s| **s == State::Torn).count();
    let done_cases: usize = dataset.done().map(|r| r.cases[1] - r.cases[0]).sum();
    let left = manifest.hours(manifest.cases.saturating_sub(done_cases));
    if arguments.missing {
        say_raw(&missing.iter().map(|i| format!("{i}\n")).collect::<String>());
    } else if arguments.json {
        let statuses: Map<String, Value> = dataset.counts().iter().map(|(s, n)| (s.word().to_owned(), json!(n))).collect();
        let told = json!({
            "campaign": manifest.address,
            "each": manifest.each,
            "shards": manifest.shards,
            "shards_done": manifest.shards - missing.len(),
            "shards_missing": missing,
            "shards_torn": torn,
            "cases": manifest.cases,
            "cases_done": done_cases,
            "rows": dataset.done().map(|r| r.rows).sum::<usize>(),
            "statuses": statuses,
            "processor_hours_left": left,
        });
        say_raw(&format!("{told:#}\n"));
    } else {
        let torn = if torn > 0 { format!(", {torn} of them because their tables are not as they were written") } else { String::new() };
        say(&format!(
            "{} of {} shards are done, {} missing{torn}\n{done_cases} of {} cases, {}\n{}",
            manifest.shards - missing.len(),
            manifest.shards,
            missing.len(),
            manifest.cases,
            rows(&dataset),
            left.map_or_else(String::new, |left| format!("{} left\n", processor_time(left)))
        ));
    }
    if missing.is_empty() { DONE } else { MISSING }
}
