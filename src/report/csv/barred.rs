//! `barred.csv`: a row a range of speed that a society's rule bars.

use super::table::{Table, number, optional};
use crate::analysis::Results;
use crate::files::{Folder, WriteError};
use crate::input::Study;

/// `barred.csv`: of given designs and optima; `ratio`: stress at the critical speed over the limit; `transient_ratio`: the largest that the rule allows there; empty by rules for cranks, of which that is not judged.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn barred(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let mut table = Table::new(&[
        "design",
        "limit",
        "condition",
        "critical_rpm",
        "ratio",
        "from_rpm",
        "to_rpm",
        "speed_ratio",
        "allowed",
        "transient_ratio",
        "excepted",
    ]);
    for d in results.designs.iter().chain(results.optima.iter().map(|o| &o.design)) {
        for b in &d.barred {
            let limit = &study.limits[b.limit];
            table.row([
                d.name.clone(),
                limit.words.clone(),
                b.condition.name().to_owned(),
                number(b.critical_rpm),
                number(b.ratio),
                number(b.from_rpm),
                number(b.to_rpm),
                number(b.critical_rpm / limit.rule.as_ref().map_or(f64::NAN, |rule| rule.rated_rpm)),
                b.objection.is_none().to_string(),
                optional(limit.rule.as_ref().and_then(|rule| rule.transient)),
                b.excepted.to_string(),
            ]);
        }
    }
    table.save(folder, "barred.csv")
}
