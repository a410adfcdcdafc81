//! `values.csv`: a row a value of every design.

use super::table::{Table, number, optional};
use crate::analysis::Results;
use crate::files::{Folder, WriteError};
use crate::input::Study;

/// `values.csv`: the values of `designs.csv` and `absorbers.csv` one below the other, each with its condition, unit and place; `order`: the one that adds most.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn values(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let mut table = Table::new(&["design", "condition", "measure", "value", "unit", "where", "order", "speed_rpm"]);
    for d in results.designs.iter().chain(results.optima.iter().map(|o| &o.design)) {
        for v in crate::results_json::values(study, results, d) {
            table.row_of([
                d.name.as_str(),
                v.condition,
                &v.measure,
                &number(v.value),
                v.unit,
                &v.place,
                &optional(v.order),
                &optional(v.speed_rpm),
            ]);
        }
    }
    table.save(folder, "values.csv")
}
