//! Results as text, tables and plots: the only place that writes files.

pub mod csv;
pub mod files;
pub mod plot;
pub mod text;

pub use files::{Folder, WriteError};

use crate::assess::Results;
use crate::study::Study;

/// Writes everything a run gives.
///
/// # Errors
/// [`WriteError`] where a file cannot be written.
pub fn write_run(study: &Study, results: &Results, folder: &Folder, written: &dyn Fn()) -> Result<(), WriteError> {
    csv::designs(study, results, folder)?;
    csv::response(study, results, folder)?;
    if results.fronts.is_empty() {
        folder.remove(&["pareto.csv", "pareto.svg", "pareto.png"])?;
    } else {
        csv::pareto(study, results, folder)?;
    }
    written();
    plot::run(study, results, folder, written)
}
