//! Plots as SVG, with PNG beside it.

mod campbell;
mod canvas;
pub mod chart;
pub mod comparison;
pub(crate) mod curves;
pub(crate) mod drawing;
mod excitation;
pub mod fatigue;
mod front;
mod margin;
pub mod models;
mod pareto;
mod response;

use super::files::{Folder, WriteError};
use crate::analysis::Results;
use crate::input::Study;

/// Draws every plot of a run.
///
/// # Errors
/// [`WriteError`] where a file cannot be written.
pub fn run(study: &Study, results: &Results, folder: &Folder, written: &dyn Fn()) -> Result<(), WriteError> {
    for sweep in &results.sweeps {
        response::draw(study, results, sweep, folder)?;
        written();
    }
    response::overlay(study, results, folder)?;
    written();
    campbell::draw(study, results, folder)?;
    written();
    excitation::draw(study, results, folder)?;
    written();
    if !results.fronts.is_empty() {
        pareto::draw(study, results, folder)?;
        written();
    }
    front::draw(study, results, folder)?;
    results.tradeoffs.iter().for_each(|_| written());
    margin::margins(study, results, folder)?;
    margin::diagram(study, results, folder)?;
    if results.margin.is_some() {
        written();
    }
    Ok(())
}

/// How many files [`run`] draws.
pub fn count(results: &Results) -> usize {
    results.sweeps.len() + results.tradeoffs.len() + 3 + usize::from(!results.fronts.is_empty()) + usize::from(results.margin.is_some())
}
