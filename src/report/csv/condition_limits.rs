//! `condition_limits.csv`: a row a limit and condition of every design.

use super::table::{Table, number, optional};
use crate::analysis::{DesignResult, Results};
use crate::files::{Folder, WriteError};
use crate::input::Study;
use crate::objective::{Condition, holds};

/// Whether limits count in a condition.
fn role(study: &Study, condition: Condition) -> &'static str {
    if study.held().contains(&condition) || condition == Condition::InOperation { "judged" } else { "told" }
}

/// `condition_limits.csv`: `role`: `judged` where limits count in that condition, else `told`; the rest as in `limits.csv`. Nothing where no condition changes a design.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn condition_limits(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let mut table = Table::new(&["design", "condition", "measure", "where", "value", "limit", "unit", "used_percent", "held", "role"]);
    let mut put = |d: &DesignResult, condition: Condition, ratios: &[f64]| {
        for (limit, ratio) in study.limits.iter().zip(ratios) {
            let unit = limit.of.unit;
            let said = |value: f64| optional(Some(value).filter(|v| v.is_finite() && results.has_value(d, &limit.of.measure)));
            table.row([
                d.name.clone(),
                condition.name().to_owned(),
                limit.of.key.to_owned(),
                limit.of.place.clone(),
                if limit.of.measure.within.factors.is_empty() { said(unit.shown(ratio * limit.limit)) } else { String::new() },
                number(unit.shown(limit.limit)),
                unit.symbol().to_owned(),
                said(100.0 * ratio),
                holds(*ratio).to_string(),
                role(study, condition).to_owned(),
            ]);
        }
    };
    let all = || results.designs.iter().chain(results.optima.iter().map(|o| &o.design));
    if all().all(|d| d.conditions.is_empty()) {
        return Ok(());
    }
    for d in all() {
        put(d, Condition::Firing, &d.limits_firing);
        d.conditions.iter().for_each(|c| put(d, c.condition, &c.limits));
    }
    table.save(folder, "condition_limits.csv")
}
