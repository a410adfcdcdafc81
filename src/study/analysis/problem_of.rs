//! The problem behind an optimum, for those who hold something against it without a search.

use super::evaluation_plan::EvaluationPlan;
use super::run::{grid, modes};
use super::searches::Searches;
use super::systems::{load_cases, systems};
use super::{RunError, Silent, calibrate, compounds, crank_models, margins};
use crate::input::Study;
use crate::objective::PeakFinder;
use crate::optimise::{LoadCase, Problem};
use crate::response::{Direct, Method};

/// What the problem of an optimum is asked for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NoProblem {
    /// The study has no such optimum.
    Unknown,
    /// The study chooses compounds, oils or steps of dimensions: what the optimum is made of follows from its searches.
    Chosen,
}

/// Asks the problem of the optimum of this name, in the conditions that it is held in as drawn; `objective`: the index of what it minimises.
///
/// # Errors
/// [`RunError`] where calibration or the choice of a crank fails.
pub fn with_problem<T>(study: &Study, name: &str, ask: impl FnOnce(&Problem, usize) -> T) -> Result<Result<T, NoProblem>, RunError> {
    let (mut study, _) = calibrate(study, &Silent)?;
    crank_models::choose(&mut study)?;
    let study = &study;
    let Some(spec) = &study.optimise else { return Ok(Err(NoProblem::Unknown)) };
    if compounds::are_named(spec) {
        return Ok(Err(NoProblem::Chosen));
    }
    let systems = systems(study, study.excitation(), &Silent);
    let grid = grid(study, &systems[0]);
    let methods: Vec<Method> = systems.iter().map(|system| Method::Direct(Direct::new(system, &grid))).collect();
    let margin = margins::model(study, &systems[0].excitation.harmonics, &grid);
    let finder = |(system, method)| PeakFinder::new(system, &grid, method, study.refine_peaks).with_margin(margin.as_ref());
    let finders: Vec<PeakFinder> = systems.iter().zip(&methods).map(finder).collect();
    let (modes, measures) = (modes(study, &systems[0]), margins::measures(study));
    let wanted = EvaluationPlan::new(study, &measures);
    let load_cases: Vec<LoadCase> = wanted.held.iter().flat_map(|c| load_cases(*c, &finders)).collect();
    let searches = Searches::new(study, (&finders, &load_cases), &modes, &wanted, &Silent);
    let Some((space, objective)) = searches.named(spec, name) else { return Ok(Err(NoProblem::Unknown)) };
    Ok(Ok(ask(&searches.problem(space, objective), objective)))
}
