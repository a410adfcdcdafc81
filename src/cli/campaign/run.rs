//! `hartog campaign run`: a shard in this program, or several by workers, each a program of its own.

use super::isolate::{crashing, worker};
use super::told::{MISSING, rows};
use crate::analysis::Progress;
use crate::analysis::campaign::{Status, run_cases};
use crate::cli::exit::{BAD_INPUT, DONE, FAILED, fail, say, say_to_error};
use crate::cli::progress::Bar;
use crate::report::campaign::{Dataset, Manifest, write_shard};
use std::collections::VecDeque;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Arguments of `campaign run`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Folder of a planned campaign.
    folder: PathBuf,
    /// Run this shard, whether or not it is done, in this program on one thread.
    #[arg(long, value_name = "N", conflicts_with_all = ["shards", "workers"])]
    shard: Option<usize>,
    /// Run those of these shards that are missing: `0..99`.
    #[arg(long, value_name = "A..B", value_parser = range)]
    shards: Option<Range<usize>>,
    /// How many programs work at a time, a thread each [default: as many as there are processors].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    workers: Option<u16>,
    /// Find the cases of a shard that has ended its program three times, and leave them out as `crashed`.
    #[arg(long)]
    isolate: bool,
    /// Run the missing shards from the last to the first.
    #[arg(long, hide = true)]
    reversed: bool,
    /// Compute these cases and keep nothing.
    #[arg(long, hide = true, value_name = "A..B", value_parser = range)]
    probe: Option<Range<usize>>,
    /// Cases that are known to end the program.
    #[arg(long, hide = true, value_delimiter = ',')]
    crashed: Vec<usize>,
}

/// A range with both of its ends.
fn range(text: &str) -> Result<Range<usize>, String> {
    let ends = text.split_once("..").and_then(|(a, b)| Some((a.parse().ok()?, b.parse::<usize>().ok()?)));
    match ends {
        Some((first, last)) if first <= last => Ok(first..last + 1),
        _ => Err("expected two numbers with points between them, the lower one first: 0..99".into()),
    }
}

/// So often a shard is tried.
const TRIES: usize = 3;

/// Runs what is missing of a campaign.
pub(super) fn run(arguments: &Arguments) -> u8 {
    crate::cli::threads(Some(1));
    let folder = arguments.folder.as_path();
    let manifest = match Manifest::read(folder) {
        Ok(manifest) => manifest,
        Err(error) => return fail(&error),
    };
    if arguments.shard.is_none() && arguments.probe.is_none() {
        return all(arguments, folder, &manifest);
    }
    let campaign = match manifest.campaign() {
        Ok(campaign) => campaign,
        Err(error) => return fail(&error),
    };
    if let Some(cases) = &arguments.probe {
        rayon::scope(|_| run_cases(&campaign, &manifest.columns, cases.clone(), &[], &mut |_, _| {}));
        return DONE;
    }
    // within the pool, which has one thread: what is parallel inside then does not wait for another one
    match rayon::scope(|_| write_shard(folder, &manifest, &campaign, arguments.shard.unwrap_or_default(), &arguments.crashed)) {
        Ok(receipt) if receipt.count(Status::Ok) == receipt.rows => DONE,
        Ok(_) => FAILED,
        Err(error) => fail(&error),
    }
}

/// What became of the shards that were run.
#[derive(Debug, Default)]
struct Outcome {
    /// Shards that ended their program, and how.
    died: Vec<(usize, String)>,
    /// What a worker said that could not work.
    refused: Option<String>,
}

fn all(arguments: &Arguments, folder: &Path, manifest: &Manifest) -> u8 {
    // what has changed is told once, not by every worker
    if let Err(error) = manifest.campaign() {
        return fail(&error);
    }
    let before = Dataset::read(folder, manifest, true);
    let wanted = arguments.shards.clone().unwrap_or(0..manifest.shards);
    if wanted.end > manifest.shards {
        return fail(&format!("error: found shard {}, expected one from 0 to {}", wanted.end - 1, manifest.shards - 1));
    }
    let mut missing: VecDeque<usize> = before.missing().into_iter().filter(|i| wanted.contains(i)).collect();
    if arguments.reversed {
        missing.make_contiguous().reverse();
    }
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    let workers = arguments.workers.map_or(processors, usize::from).min(missing.len().max(1));
    let bar = Bar::default();
    bar.stage("shards", missing.len());
    let (queue, outcome) = (Mutex::new(missing), Mutex::new(Outcome::default()));
    let work = || {
        loop {
            let Some(shard) = queue.lock().unwrap_or_else(PoisonError::into_inner).pop_front() else { return };
            if let Err(end) = tried(arguments, folder, manifest, shard) {
                let mut outcome = outcome.lock().unwrap_or_else(PoisonError::into_inner);
                match end {
                    End::Died(how) => outcome.died.push((shard, how)),
                    End::Refused(words) => {
                        outcome.refused = Some(words);
                        queue.lock().unwrap_or_else(PoisonError::into_inner).clear();
                    }
                }
            }
            bar.step();
        }
    };
    std::thread::scope(|scope| (0..workers).for_each(|_| _ = scope.spawn(work)));
    drop(bar);
    let outcome = outcome.into_inner().unwrap_or_else(PoisonError::into_inner);
    if let Some(words) = outcome.refused {
        say_to_error(&words);
        return BAD_INPUT;
    }
    for (shard, how) in &outcome.died {
        say_to_error(&format!("shard {shard} ended its program {TRIES} times ({how}); --isolate finds the case that does it"));
    }
    told(folder, manifest)
}

/// Why a shard is not done.
enum End {
    Died(String),
    Refused(String),
}

/// Runs a shard by a worker, again where that dies.
fn tried(arguments: &Arguments, folder: &Path, manifest: &Manifest, shard: usize) -> Result<(), End> {
    let own = ["--shard".to_owned(), shard.to_string()];
    let mut how = String::new();
    for _ in 0..TRIES {
        let end = worker(folder, &own).map_err(|e| End::Refused(format!("error: no worker can be started: {e}")))?;
        match end.code {
            Some(code) if code == i32::from(DONE) || code == i32::from(FAILED) => return Ok(()),
            Some(code) if code == i32::from(BAD_INPUT) => return Err(End::Refused(end.said)),
            _ => how = end.how(),
        }
    }
    if !arguments.isolate {
        return Err(End::Died(how));
    }
    let Some(cases) = manifest.campaign().ok().and_then(|c| manifest.shard(&c, shard)).map(|s| s.cases) else { return Err(End::Died(how)) };
    let crashed: Vec<String> = crashing(folder, cases).iter().map(ToString::to_string).collect();
    let again = [own.as_slice(), &["--crashed".to_owned(), crashed.join(",")]].concat();
    match worker(folder, &again) {
        Ok(end) if matches!(end.code, Some(0 | 1)) => Ok(()),
        _ => Err(End::Died(how)),
    }
}

/// What is done by now, in words and as an exit code.
fn told(folder: &Path, manifest: &Manifest) -> u8 {
    let now = Dataset::read(folder, manifest, false);
    let missing = now.missing().len();
    let path = folder.display();
    let next = if missing > 0 { format!("{missing} are missing") } else { format!("`hartog campaign collect {path}` makes its page") };
    say(&format!("{} of {} shards are done, {}; {next}\n", manifest.shards - missing, manifest.shards, rows(&now)));
    match (missing, now.is_as_asked()) {
        (0, true) => DONE,
        (0, false) => FAILED,
        _ => MISSING,
    }
}
