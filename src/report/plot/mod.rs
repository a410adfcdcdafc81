//! Plots as SVG, with PNG beside it.

pub(crate) mod campbell;
pub(crate) mod canvas;
pub mod chart;
pub mod comparison;
pub(crate) mod curves;
pub(crate) mod drawing;
mod excitation;
pub mod fatigue;
mod front;
mod heat;
mod labels;
pub mod ladder;
mod large_twist;
mod legend;
mod margin;
pub mod models;
mod pareto;
mod pdf;
pub mod proofs;
mod response;
mod robust;

use super::files::{Folder, WriteError};
use crate::analysis::Results;
use crate::input::Study;
use rayon::prelude::*;

/// Draws what a classification society asks for: critical speeds, orders of the torque, responses.
///
/// # Errors
/// [`WriteError`] where a file cannot be written.
pub(crate) fn classification(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    campbell::draw(study, results, folder)?;
    excitation::draw(study, results, folder)?;
    results.sweeps.par_iter().try_for_each(|sweep| response::draw(study, results, sweep, folder))
}

/// Draws every plot of a run.
///
/// # Errors
/// [`WriteError`] where a file cannot be written.
pub fn run(study: &Study, results: &Results, folder: &Folder, written: &(dyn Fn() + Sync)) -> Result<(), WriteError> {
    type Plot<'a> = Box<dyn Fn() -> Result<(), WriteError> + Sync + Send + 'a>;
    // what takes longest first, so that the last ones end together
    let mut plots: Vec<Plot> = vec![
        Box::new(|| margin::margins(study, results, folder)),
        Box::new(|| margin::diagram(study, results, folder)),
        Box::new(|| excitation::draw(study, results, folder)),
        Box::new(|| heat::draw(study, results, folder)),
        Box::new(|| large_twist::draw(study, results, folder)),
        Box::new(|| robust::draw(study, results, folder)),
        Box::new(|| front::draw(study, results, folder)),
        Box::new(|| response::overlay(study, results, folder)),
        Box::new(|| campbell::draw(study, results, folder)),
    ];
    if !results.fronts.is_empty() {
        plots.push(Box::new(|| pareto::draw(study, results, folder)));
    }
    for sweep in &results.sweeps {
        plots.push(Box::new(|| response::draw(study, results, sweep, folder)));
    }
    let drawn: Vec<Result<(), WriteError>> = plots
        .par_iter()
        .with_max_len(1)
        .map(|plot| {
            let drawn = plot();
            written();
            drawn
        })
        .collect();
    drawn.into_iter().collect()
}

/// Plots that every run has, or looks whether it has them.
const ALWAYS: usize = 9;

/// How many plots [`run`] draws.
pub fn count(results: &Results) -> usize {
    ALWAYS + usize::from(!results.fronts.is_empty()) + results.sweeps.len()
}
