//! `compounds.csv`: compounds, oils and steps of dimensions that a study chooses from.

use super::table::{Table, optional};
use crate::analysis::Results;
use crate::files::{Folder, WriteError};
use crate::input::Study;

/// `compounds.csv`: a row a compound or oil at the steps of dimensions, with the objective at its best; of what was left out, the best that was found without limits. None where the study chooses from nothing.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn compounds(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    if results.compounds.is_empty() {
        return Ok(());
    }
    let unit = study.objective.unit;
    let mut table = Table::new(&["type", "compound", "steps", "objective", "value", "unit", "found", "limits_hold", "chosen"]);
    for r in &results.compounds {
        let steps: Vec<String> = r.steps.iter().map(|(key, value)| format!("{key}={value}")).collect();
        table.row([
            r.kind.to_owned(),
            r.name.clone().unwrap_or_default(),
            steps.join(" "),
            study.objective.key.to_owned(),
            optional(Some(unit.shown(r.value)).filter(|v| v.is_finite())),
            unit.symbol().to_owned(),
            if r.left_out { "without_limits" } else { "optimum" }.to_owned(),
            if r.left_out { String::new() } else { r.holds.to_string() },
            r.chosen.to_string(),
        ]);
    }
    table.save(folder, "compounds.csv")
}
