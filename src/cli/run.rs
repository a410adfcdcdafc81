//! `hartog run`: the main job.

use super::exit::{DONE, FAILED, fail, paths, say, say_raw, say_to_error};
use super::place::chosen;
use super::study_arguments::StudyArguments;
use super::supervised_run::{Watched, end_at_interrupt};
use crate::analysis::{Progress, Results, Timing};
use crate::report::{Job, Journal, Names, about, csv, results_json, text};
use crate::response::Work;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

/// Arguments of `run`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  hartog run studies/villalva_i6.toml --out out/six\n\n\
The objective of a study is, by default, half the peak-to-peak twist of all orders together (over = \"synthesis\"), from the\n\
absorber's hub to the last station, at its worst speed. Neither the hub's amplitude nor a single order will do: at low speed the hub\n\
rolls with the whole engine, which no absorber changes; and the largest single order saturates on forced twist, so that a ring that\n\
wins by order can lose by the sum. Both can be chosen: hub_amplitude, and over = \"orders\".\n\n\
Example of other values: hartog run studies/villalva_i6.toml --set load_fraction=0.5 --set 'optimise.absorber.0.types=[\"tuned\"]'\n\n\
Exit code: 0 done, 1 a limit of the study fails for an optimum, its absorber overheats or has no steady motion, 2 bad input or no finite response.")]
pub struct Arguments {
    /// The study.
    #[command(flatten)]
    pub study: StudyArguments,
    /// Output folder [default: out/STUDY; of a file called study.toml, out/ and the name of the folder where it is].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Number of threads [default: all]; results are the same for any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub threads: Option<u16>,
    /// Print `results.json` instead of the answer.
    #[arg(long, conflicts_with_all = ["verbose", "quiet"])]
    pub json: bool,
    /// Print nothing but errors.
    #[arg(long, short, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Print all tables and certificates, how searches evaluated designs, what one design costs, and the time of each stage.
    #[arg(long)]
    pub verbose: bool,
    /// Go on where a run into the same folder was interrupted; files are those of a run that was not.
    #[arg(long)]
    pub resume: bool,
}

impl Arguments {
    /// Whether tables are printed.
    fn tells(&self) -> bool {
        !self.json && !self.quiet
    }
}

/// Runs a study, prints its answer and writes its files.
pub fn run(arguments: &Arguments) -> u8 {
    crate::cli::threads(arguments.threads.map(usize::from));
    let start = Instant::now();
    let (study, inputs) = arguments.study.read();
    let study = match study {
        Ok(study) => study,
        Err(error) => return fail(&error),
    };
    let path = match chosen(arguments.out.as_ref(), &arguments.study.path, "") {
        Ok(path) => path,
        Err(error) => return fail(&error),
    };
    let job = Job { names: &Names::of_run(&study), inputs: &inputs, reads: &paths(&inputs) };
    let journal = match Journal::open(&path, job, &study.set, arguments.resume) {
        Ok(journal) => Arc::new(journal),
        Err(error) => return fail(&error),
    };
    let folder = journal.folder().clone();
    if arguments.resume && arguments.tells() {
        say(&match journal.known() {
            0 => format!("no interrupted run in {}: from the beginning\n", folder.path().display()),
            n => format!("{n} searches of the interrupted run are known\n"),
        });
    }
    end_at_interrupt(&study, &folder, &journal);
    let watched = Watched::new(&study, journal.clone(), arguments.quiet);
    let results = match study.run_with(&watched) {
        Ok(results) => results,
        Err(error) => {
            drop(watched);
            folder.abandon();
            return fail(&format!("error: {error}"));
        }
    };
    let (study, calibration) = (&results.study, results.calibration.as_ref());
    let before_files = start.elapsed().as_secs_f64();
    watched.stage("tables and plots", crate::report::steps(&results));
    let written = crate::report::write_run(study, calibration, (&results, &inputs), &folder, &|| watched.step());
    drop(watched);
    if let Err(error) = written {
        let (kept, goes_on) = journal.kept();
        return fail(&format!("{error}; {kept}{}", if goes_on { ": once it can be written, add --resume" } else { "" }));
    }
    let total = start.elapsed().as_secs_f64();
    let mut timing = results.timing.clone();
    timing.push(Timing { stage: "files".into(), seconds: total - before_files, work: Work::default() });
    timing.push(Timing { stage: "all".into(), seconds: total, work: Work::default() });
    if let Err(error) = csv::timing(&timing, &folder).and_then(|()| folder.complete(&about(study, &inputs, &results))) {
        return fail(&error);
    }
    if !arguments.quiet {
        text::notes(study, &results).iter().for_each(|line| say_to_error(line));
    }
    if let Some(reason) = journal.failure() {
        say_to_error(&format!(
            "warning: not all that searches found could be kept ({reason}): after a kill they would have been made again"
        ));
    }
    if arguments.json {
        say_raw(&results_json::text(study, &inputs, &results));
    }
    if arguments.verbose {
        say(&text::whole(study, calibration, &results));
        say(&costs(&results, &timing));
    } else if arguments.tells() {
        say(&text::answer(study, calibration, &results));
    }
    if arguments.tells() {
        let all = if arguments.verbose { "" } else { "; --verbose prints all tables" };
        let (files, path) = (folder.written(), folder.path().display());
        say(&format!("\n{files} files in {path} after {total:.1} s: open {} there first{all}\n", crate::report::PAGE));
    }
    if results.limits_hold() { DONE } else { FAILED }
}

/// What the run took.
fn costs(results: &Results, timing: &[Timing]) -> String {
    let choices = text::choices(results);
    let mut out = if choices.is_empty() { choices } else { format!("\n{choices}") };
    let cost: Vec<String> = timing
        .iter()
        .filter_map(|t| t.stage.strip_prefix("one_design_").map(|what| format!("{} {}", what.replace('_', " "), duration(t.seconds))))
        .collect();
    if !cost.is_empty() {
        out += &format!("\nOne design on one thread: {}\n", cost.join(", "));
    }
    let stages: Vec<String> = timing.iter().filter(|t| t.seconds >= 0.05).map(|t| format!("{} {:.1} s", t.stage, t.seconds)).collect();
    out + &format!("Stages: {}\n", stages.join(", "))
}

fn duration(seconds: f64) -> String {
    if seconds < 1e-3 { format!("{:.1} µs", 1e6 * seconds) } else { format!("{:.2} ms", 1e3 * seconds) }
}
