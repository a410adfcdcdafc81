//! What searches evaluate designs by: exactly, or by tables as fine as they have to be.

use super::Progress;
use super::method_selection::{self, Choice, Strategy};
use super::timing::Clock;
use crate::absorber::closed_forms::EngineMode;
use crate::input::{MeasureSpec, ResponseMethod, Study};
use crate::objective::PeakFinder;
use crate::objective::surrogate::Surrogate;
use crate::response::{Method, Work};
use rayon::prelude::*;

/// What searches evaluate designs by, and the finders with its tables.
pub(super) fn with_tables<'a>(
    study: &Study,
    modes: &[Vec<EngineMode>],
    finders: Vec<PeakFinder<'a>>,
    progress: &dyn Progress,
    clock: &mut Clock,
) -> (Vec<Choice>, Vec<PeakFinder<'a>>) {
    let choices = choices(study, modes, &finders[0], progress);
    let finders = finders.into_iter().map(|finder| surrogates(study, &choices, finder)).collect();
    if !choices.is_empty() {
        clock.lap("choice", Work::default());
    }
    (choices, finders)
}

/// What searches by each objective of the study are to evaluate designs by; nothing where that is not `auto`, or where there is nothing to search or to choose.
fn choices(study: &Study, modes: &[Vec<EngineMode>], finder: &PeakFinder, progress: &dyn Progress) -> Vec<Choice> {
    match finder.method {
        Method::Receptance(r) if study.method == ResponseMethod::Auto && study.refine_peaks && study.optimise.is_some() => {
            let objectives: Vec<_> = study.objectives().collect();
            progress.stage("choice of the method", objectives.len());
            let choose = |o: &&MeasureSpec| method_selection::choose(study, &o.measure, modes, finder, r);
            objectives.par_iter().map(choose).inspect(|_| progress.step()).collect()
        }
        _ => Vec::new(),
    }
}

/// A finder that searches may ask for surrogate peaks, as chosen.
fn surrogates<'a>(study: &Study, choices: &[Choice], finder: PeakFinder<'a>) -> PeakFinder<'a> {
    let Method::Receptance(r) = finder.method else { return finder };
    choices.iter().zip(study.objectives()).fold(finder, |finder, (choice, objective)| match choice.chosen.strategy {
        Strategy::Tables(stride) => {
            let surrogate = Surrogate::of(r, &objective.measure, finder.margin, stride);
            finder.with_surrogate(surrogate, study.tolerance)
        }
        Strategy::Exact => finder,
    })
}
