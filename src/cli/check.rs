//! `hartog check`: what a study means, without running it, and whether a proof of one of its optima holds.

use super::exit::{DONE, FAILED, fail, say, threads};
use super::study_arguments::StudyArguments;
use crate::analysis::problem_of::{NoProblem, with_problem};
use crate::input::error::{Mistake, Place};
use crate::input::tables::{ProofTable, proof_table};
use crate::input::{InputError, Study};
use crate::report::text::{check, check_in_brief, confirmed};
use crate::validation::proof::{Objection, confirm};
use std::path::{Path, PathBuf};

/// Arguments of `check`.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  hartog check studies/villalva_v10.toml\n  hartog check studies/villalva_i6.toml --proof out/villalva_i6/proof_optimum_tuned.csv\n\n\
A proof is written by `hartog run` where the study has `[optimise] prove = { file = true }`. Its boxes have to cover the bounds of the study, and\n\
no design of them may be better at the speeds of its box than the proof says, by solutions of the whole matrix. A proof that does not hold, or is of\n\
a kind that is not checked, ends with exit code 1."
)]
pub struct Arguments {
    /// The study.
    #[command(flatten)]
    pub study: StudyArguments,
    /// Print the chain station by station, every mode with its critical speeds, the excitation, and what the crank bears.
    #[arg(long, conflicts_with = "proof")]
    pub verbose: bool,
    /// Check a proof that a run of the study has written, instead of printing the model.
    #[arg(long, value_name = "CSV")]
    pub proof: Option<PathBuf>,
    /// Number of threads [default: all]; results are the same for any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub threads: Option<u16>,
}

/// Reads and checks a study, and prints the model it describes, or holds a proof against it.
pub fn check(arguments: &Arguments) -> u8 {
    threads(arguments.threads.map(usize::from));
    let study = match arguments.study.read().0 {
        Ok(study) => study,
        Err(error) => return fail(&error),
    };
    if let Some(path) = &arguments.proof {
        return match proof_table(path) {
            Ok(table) => proof(&study, path, &table),
            Err(error) => fail(&error),
        };
    }
    say(&if arguments.verbose { check::model(&study, true) } else { check_in_brief(&study) });
    DONE
}

fn proof(study: &Study, path: &Path, table: &ProofTable) -> u8 {
    let asked = with_problem(study, &table.design, |problem, objective| {
        let own: Vec<&str> =
            problem.space.variables.iter().map(|v| problem.space.slots[v.absorber].declaration.parameters[v.parameter].key).collect();
        // of several absorbers no proof is checked
        if problem.space.slots.len() == 1 && own != table.free {
            return Err(Objection {
                line: None,
                is_refuted: true,
                words: format!("the boxes are of {}, the free parameters are {}", table.free.join(", "), own.join(", ")),
            });
        }
        let spec = study.objective_of(objective);
        if table.objective != [spec.key, spec.unit.symbol()] {
            let [key, unit] = &table.objective;
            let words = format!("it is of `{key}` in `{unit}`, the optimum is by `{}` in `{}`", spec.key, spec.unit.symbol());
            return Err(Objection { line: None, is_refuted: true, words });
        }
        let claim = table.bound.map(|bound| spec.unit.inside(bound));
        Ok((objective, confirm(problem, claim, &table.boxes)?))
    });
    let mistake = |message: String| InputError::from(Mistake { message, place: Place::File(path.to_path_buf()), help: None });
    match asked {
        Err(error) => fail(&error),
        Ok(Err(NoProblem::Unknown)) => {
            fail(&mistake(format!("found a proof of `{}`, expected one of an optimum of the study", table.design)))
        }
        Ok(Err(NoProblem::Chosen)) => {
            fail(&mistake("the study chooses compounds, oils or steps of dimensions: of such a study no proof is checked".into()))
        }
        Ok(Ok(Ok((objective, parts)))) => {
            say(&confirmed(study, objective, table, parts));
            DONE
        }
        Ok(Ok(Err(Objection { line, is_refuted, words }))) => {
            let place = line.map_or_else(|| path.display().to_string(), |line| format!("{}:{line}", path.display()));
            _ = fail(&format!("{}: {place}: {words}", if is_refuted { "not confirmed" } else { "not checked" }));
            FAILED
        }
    }
}
