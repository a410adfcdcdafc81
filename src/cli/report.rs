//! `hartog report`: the calculation that a classification society asks for.

use super::exit::{DONE, FAILED, fail, paths, say};
use super::place::chosen;
use super::progress::Bar;
use super::study_arguments::StudyArguments;
use crate::analysis::classification::classification;
use crate::engine::Source;
use crate::objective::Condition;
use crate::report::{Folder, Job, Names, about_study, text, write_classification};
use std::path::PathBuf;

/// Arguments of `report`.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  hartog report studies/mendes_mwm6.toml\n\n\
Writes classification.html, which prints on A4 pages, and its tables: holzer.csv, vector_sums.csv, criticals.csv, shaft_torques.csv, and what `run`\n\
writes of the designs of the study. With --optima the optima of the study are searched for and reported, too. One cylinder misfiring is\n\
looked at whether the study asks for it or not.\n\n\
Exit code: 0 done, 1 a design breaks a limit of the study, 2 bad input or no finite response.")]
pub struct Arguments {
    /// The study.
    #[command(flatten)]
    pub study: StudyArguments,
    /// Output folder [default: out/STUDY_report; of a file called study.toml, after the folder where it is].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Search for the optima of the study and report them beside its designs; the same as those of `run`.
    #[arg(long)]
    pub optima: bool,
    /// Number of threads [default: all]; results are the same for any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub threads: Option<u16>,
}

/// Evaluates the designs of a study and writes the report.
pub fn report(arguments: &Arguments) -> u8 {
    crate::cli::threads(arguments.threads.map(usize::from));
    let (study, inputs) = arguments.study.read();
    let mut study = match study {
        Ok(study) => study,
        Err(error) => return fail(&error),
    };
    let left_out = study.optimise.is_some() && !arguments.optima;
    study.front = None;
    study.torque_in_conditions = true;
    if !arguments.optima {
        study.leave_searches_out();
    }
    if matches!(study.engine.source, Source::Cylinder { .. }) && !study.conditions.contains(&Condition::Misfire) {
        study.conditions.push(Condition::Misfire);
    }
    let path = match chosen(arguments.out.as_ref(), &arguments.study.path, "_report") {
        Ok(path) => path,
        Err(error) => return fail(&error),
    };
    let job = Job { names: &Names::of_report(&study), inputs: &inputs, reads: &paths(&inputs) };
    let folder = match Folder::create(&path, job) {
        Ok(folder) => folder,
        Err(error) => return fail(&error),
    };
    let bar = Bar::default();
    let results = study.run_with(&bar);
    drop(bar);
    let results = match results {
        Ok(results) => results,
        Err(error) => return fail(&format!("error: {error}")),
    };
    let found = classification(&results.study, &results);
    if let Err(error) =
        write_classification((&results, &inputs), &found, &folder).and_then(|()| folder.complete(&about_study(&results.study, &inputs)))
    {
        return fail(&error);
    }
    say(&text::criticals(&found));
    say(&format!(
        "\n{}\n{} files in {}: open {} there first\n",
        text::designs(&results.study, &results),
        folder.written(),
        path.display(),
        crate::report::CLASSIFICATION
    ));
    if left_out {
        say("The optima of the study are not in it: `--optima` searches for them and reports them, too.\n");
    }
    let reported = results.designs.iter().chain(results.optima.iter().map(|o| &o.design));
    if reported.flat_map(|d| &d.limits).all(|l| crate::objective::holds(*l)) { DONE } else { FAILED }
}
