//! `allocation.csv`: the tolerances that designs can bear.

use super::table::{Table, number, optional};
use crate::analysis::Results;
use crate::files::{Folder, WriteError};
use crate::input::{Study, scatter_key};
use crate::optimise::Scatter;
use crate::units::of_key;

/// `allocation.csv`: a row a tolerance of a design: as the study gives it and as the design bears it, in the unit of its key; one without a tolerance where a design bears none. None where the study does not ask for it.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn allocation(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let Some(spec) = study.robust.as_ref().filter(|_| !results.allocation.is_empty()) else { return Ok(()) };
    let (scatter, costs) = (spec.scatter(), spec.allocate.as_ref().and_then(|a| a.costs.as_ref()));
    let columns = ["design", "tolerance", "unit", "given", "allocated", "factor", "at_most", "cost_given", "cost", "others_gain_percent"];
    let columns: Vec<&str> = columns.into_iter().chain(["limit", "limit_used_percent", "settled"]).collect();
    let mut table = Table::new(&columns);
    for d in &results.allocation {
        let limit = study.limits.get(d.limit.0).map_or_else(String::new, |l| l.words.clone());
        let used = optional(Some(100.0 * d.limit.1).filter(|v| v.is_finite()));
        for t in &d.tolerances {
            let s = &scatter[t.of];
            let width = s.width() * if matches!(s, Scatter::Viscosity(_)) { 100.0 } else { 1.0 };
            let gain = t.alone.map(|a| 100.0 * if costs.is_some() { a } else { a - 1.0 });
            table.row([
                d.design.clone(),
                scatter_key(s).to_owned(),
                match s {
                    Scatter::Share(..) => "share",
                    _ => of_key(scatter_key(s)).unwrap_or_default(),
                }
                .to_owned(),
                number(width),
                number(width * t.factor),
                number(t.factor),
                t.at_most.to_string(),
                optional(costs.map(|c| c[t.of])),
                optional(costs.map(|c| c[t.of] / t.factor)),
                optional(gain),
                limit.clone(),
                used.clone(),
                d.settled.to_string(),
            ]);
        }
        if d.tolerances.is_empty() {
            let empty = (1..10).map(|_| String::new());
            table.row([d.design.clone()].into_iter().chain(empty).chain([limit, used, String::new()]));
        }
    }
    table.save(folder, "allocation.csv")
}
