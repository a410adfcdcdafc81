//! `prices.csv`: what each condition, limit and bound of a study costs.

use super::table::{Table, optional};
use crate::analysis::Results;
use crate::files::{Folder, WriteError};
use crate::input::Study;
use crate::price_words::{change, costs};

/// `prices.csv`: a row a change of what is asked of an optimum: the objective with all that is asked and after the change, and what the change shows to cost, per cent. None where the study does not ask for it.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn prices(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    if results.prices.is_empty() {
        return Ok(());
    }
    let unit = study.objective.unit;
    let columns = [
        "design",
        "change",
        "objective",
        "unit",
        "value",
        "value_after",
        "cost_percent",
        "limits_hold",
        "limits_hold_after",
        "compound_after",
    ];
    let mut table = Table::new(&columns);
    let shown = |value: f64| optional(Some(unit.shown(value)).filter(|v| v.is_finite()));
    for p in &results.prices {
        table.row([
            p.design.clone(),
            change(study, p),
            study.objective.key.to_owned(),
            unit.symbol().to_owned(),
            shown(p.own),
            shown(p.changed),
            optional(costs(study, p)),
            p.own_holds.to_string(),
            p.changed_holds.to_string(),
            p.compound.clone().unwrap_or_default(),
        ]);
    }
    table.save(folder, "prices.csv")
}
