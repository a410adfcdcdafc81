//! `limits.csv`: a row a limit of every design; `condition_limits.csv`: in every condition.

use super::table::{Table, number, optional};
use crate::analysis::{DesignResult, Results};
use crate::files::{Folder, WriteError};
use crate::input::{LimitSpec, Study};
use crate::objective::{Condition, Over, holds};

/// What both tables say of a limit.
const OF_LIMIT: [&str; 7] = ["measure", "where", "value", "limit", "unit", "used_percent", "held"];

/// The same of a design whose measure is a share of the limit: the value is empty where the limit of a rule changes with speed, and with the used share where the design has none; used: at the worst speed.
fn of_limit(results: &Results, d: &DesignResult, limit: &LimitSpec, ratio: f64) -> [String; 7] {
    let unit = limit.of.unit;
    let said = |value: f64| optional(Some(value).filter(|v| v.is_finite() && results.has_value(d, &limit.of.measure)));
    [
        limit.of.key.to_owned(),
        limit.of.place.clone(),
        if limit.of.measure.within.factors.is_empty() { said(unit.shown(ratio * limit.limit)) } else { String::new() },
        number(unit.shown(limit.limit)),
        unit.symbol().to_owned(),
        said(100.0 * ratio),
        holds(ratio).to_string(),
    ]
}

/// `limits.csv`: at the worst of the conditions that an optimum is to hold in; multiplier: per cent of the objective that one per cent more of the limit would bring, of optima.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn limits(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let columns: Vec<&str> = ["design"].into_iter().chain(OF_LIMIT).chain(["multiplier"]).collect();
    let mut table = Table::new(&columns);
    let mut put = |d: &DesignResult, prices: Option<&[f64]>| {
        for (i, (limit, ratio)) in study.limits.iter().zip(&d.limits).enumerate() {
            let own = of_limit(results, d, limit, *ratio);
            table.row([d.name.clone()].into_iter().chain(own).chain([optional(prices.map(|p| p[i]))]));
        }
    };
    results.designs.iter().for_each(|d| put(d, None));
    results.optima.iter().for_each(|o| put(&o.design, Some(&o.prices)));
    table.save(folder, "limits.csv")
}

/// Whether limits count in a condition.
fn role(study: &Study, condition: Condition) -> &'static str {
    if study.held().contains(&condition) || condition == Condition::InOperation { "judged" } else { "told" }
}

/// `condition_limits.csv`: `role`: `judged` where limits count in that condition, else `told`. Nothing where no condition changes a design.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn condition_limits(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let columns: Vec<&str> = ["design", "condition"].into_iter().chain(OF_LIMIT).chain(["role"]).collect();
    let mut table = Table::new(&columns);
    let mut put = |d: &DesignResult, condition: Condition, ratios: &[f64]| {
        // a temperature is that in operation: in a state of the material there is none
        let is_known = |(limit, ratio): &(&LimitSpec, &f64)| limit.of.measure.over != Over::Temperature || **ratio != 0.0;
        for (limit, ratio) in study.limits.iter().zip(ratios).filter(is_known) {
            let own = of_limit(results, d, limit, *ratio);
            let named = [d.name.clone(), condition.name().to_owned()];
            table.row(named.into_iter().chain(own).chain([role(study, condition).to_owned()]));
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
