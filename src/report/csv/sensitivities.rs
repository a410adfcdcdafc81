//! `sensitivities.csv`: a row a measure and parameter of every optimum.

use super::table::{Table, number, optional};
use crate::analysis::Results;
use crate::files::{Folder, WriteError};

/// `sensitivities.csv`: per cent by which a measure rises for one per cent more or less of a parameter, and per cent of the parameter after which a limit
/// breaks; empty where it holds up to 50.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn sensitivities(results: &Results, folder: &Folder) -> Result<(), WriteError> {
    if results.optima.is_empty() {
        return Ok(());
    }
    let mut table = Table::new(&[
        "design",
        "measure",
        "where",
        "limited",
        "absorber",
        "parameter",
        "percent_for_one_more",
        "percent_for_one_less",
        "drift_more_percent",
        "drift_less_percent",
    ]);
    for o in &results.optima {
        for s in &o.sensitivities {
            let Some(declaration) = o.design.absorbers[s.absorber].absorber.declaration() else { continue };
            table.row([
                o.design.name.clone(),
                s.key.to_owned(),
                s.place.clone(),
                s.limited.to_string(),
                (s.absorber + 1).to_string(),
                declaration.parameters[s.parameter].key.to_owned(),
                number(s.more),
                number(s.less),
                optional(s.drift.0.map(|d| 100.0 * d)),
                optional(s.drift.1.map(|d| 100.0 * d)),
            ]);
        }
    }
    table.save(folder, "sensitivities.csv")
}
