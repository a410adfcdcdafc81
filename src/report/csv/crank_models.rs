//! `crank_models.csv`: a row a design and model of the crank.

use super::table::{Table, number};
use crate::analysis::Results;
use crate::files::{Folder, WriteError};
use crate::units::DEG_PER_RAD;

/// `crank_models.csv`, or none where the response is that of the chain.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub(crate) fn crank_models(results: &Results, folder: &Folder) -> Result<(), WriteError> {
    if results.crank_models.is_empty() {
        return Ok(());
    }
    let mut table = Table::new(&["design", "model", "twist_deg", "speed_rpm"]);
    for d in &results.crank_models {
        for (model, twist, speed) in &d.twist {
            table.row([d.design.clone(), model.name().to_owned(), number(twist * DEG_PER_RAD), number(*speed)]);
        }
    }
    table.save(folder, "crank_models.csv")
}
