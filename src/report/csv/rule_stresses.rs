//! `rule_stresses.csv`: a row a limit by a society's rule of every design, where it is nearest to its limit.

use super::table::{Table, number, optional};
use crate::analysis::Results;
use crate::files::{Folder, WriteError};
use crate::input::Study;

/// `rule_stresses.csv`: over the conditions that the design is judged in; `misfire_cylinder`: from 1; `speed_ratio`: of the speed to the rated one; `limit_mpa`: of the rule at that speed.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn rule_stresses(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let mut table = Table::new(&[
        "design",
        "limit",
        "condition",
        "misfire_cylinder",
        "speed_rpm",
        "speed_ratio",
        "stress_mpa",
        "limit_mpa",
        "used_percent",
    ]);
    for d in results.designs.iter().chain(results.optima.iter().map(|o| &o.design)) {
        for r in &d.rule_stresses {
            let limit = &study.limits[r.limit];
            let there = limit.of.unit.shown(r.of_rated * limit.limit);
            table.row([
                d.name.clone(),
                limit.words.clone(),
                r.condition.name().to_owned(),
                r.cylinder.map_or_else(String::new, |c| (c + 1).to_string()),
                number(r.speed_rpm),
                optional(limit.rule.as_ref().map(|rule| r.speed_rpm / rule.rated_rpm)),
                number(r.ratio * there),
                number(there),
                number(100.0 * r.ratio),
            ]);
        }
    }
    table.save(folder, "rule_stresses.csv")
}
