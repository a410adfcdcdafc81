//! `limits.csv`: a row a limit of every design.

use super::table::{Table, number, optional};
use crate::analysis::{DesignResult, Results};
use crate::files::{Folder, WriteError};
use crate::input::Study;
use crate::objective::holds;

/// `limits.csv`: value at the worst of the conditions that an optimum is to hold in, empty where the limit of a rule changes with speed and where the design has no such absorber; used: share of the limit at the worst speed; multiplier: per cent
/// of the objective that one per cent more of the limit would bring, of optima.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn limits(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let mut table = Table::new(&["design", "measure", "where", "value", "limit", "unit", "used_percent", "held", "multiplier"]);
    let mut put = |d: &DesignResult, prices: Option<&[f64]>| {
        for (i, (limit, ratio)) in study.limits.iter().zip(&d.limits).enumerate() {
            let unit = limit.of.unit;
            let said = |value: f64| optional(Some(value).filter(|v| v.is_finite() && results.has_value(d, &limit.of.measure)));
            table.row([
                d.name.clone(),
                limit.of.key.to_owned(),
                limit.of.place.clone(),
                if limit.of.measure.within.factors.is_empty() { said(unit.shown(ratio * limit.limit)) } else { String::new() },
                number(unit.shown(limit.limit)),
                unit.symbol().to_owned(),
                said(100.0 * ratio),
                holds(*ratio).to_string(),
                optional(prices.map(|p| p[i])),
            ]);
        }
    };
    results.designs.iter().for_each(|d| put(d, None));
    results.optima.iter().for_each(|o| put(&o.design, Some(&o.prices)));
    table.save(folder, "limits.csv")
}
