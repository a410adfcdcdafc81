//! `catalogue.csv`: absorbers of catalogues, the best first.

use super::table::{Table, number, optional};
use crate::analysis::Results;
use crate::files::{Folder, WriteError};
use crate::input::Study;
use crate::objective::holds;

/// `catalogue.csv`: a row an absorber, with the limit that it uses most and how much of it; without a value where nothing damps a resonance, without a verdict where the study has no limits. None where the study has no catalogue.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn catalogue(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    if results.catalogue.is_empty() {
        return Ok(());
    }
    let unit = study.objective.unit;
    let mut table =
        Table::new(&["catalogue", "design", "place", "objective", "value", "unit", "limits_hold", "nearest_limit", "used_percent"]);
    for r in &results.catalogue {
        table.row([
            r.file.clone(),
            r.design.clone(),
            number(r.place as f64),
            study.objective.key.to_owned(),
            optional(r.objective.map(|v| unit.shown(v))),
            unit.symbol().to_owned(),
            if study.limits.is_empty() { String::new() } else { (r.objective.is_some() && holds(r.over_limit)).to_string() },
            r.nearest_limit.map_or_else(String::new, |i| study.limits[i].words.clone()),
            optional(r.nearest_limit.map(|_| 100.0 * r.over_limit).filter(|v| v.is_finite())),
        ]);
    }
    table.save(folder, "catalogue.csv")
}
