//! `strain.csv`: absorbers whose rubber softens with its strain, over speed.

use super::table::{Table, number, optional};
use crate::analysis::Results;
use crate::files::{Folder, WriteError};
use crate::units::DEG_PER_RAD;

/// `strain.csv`: a row a design, rule, speed and strain that agrees with itself, the lowest first; the twist belongs to that. None where no material follows its strain.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn strain(results: &Results, folder: &Folder) -> Result<(), WriteError> {
    if results.strain.is_empty() {
        return Ok(());
    }
    let mut table = Table::new(&["design", "absorber", "rule", "speed_rpm", "strain", "twist_deg"]);
    for d in &results.strain {
        for p in &d.points {
            let row = |strain: Option<f64>, twist: Option<f64>| {
                let place = [d.design.clone(), (d.absorber + 1).to_string(), d.rule.name().to_owned(), number(p.speed_rpm)];
                place.into_iter().chain([optional(strain), optional(twist.map(|t| t * DEG_PER_RAD))]).collect::<Vec<_>>()
            };
            for (i, strain) in p.strains.iter().enumerate() {
                table.row(row(Some(*strain), (i == 0).then_some(p.twist)));
            }
            if p.strains.is_empty() {
                table.row(row(None, Some(p.twist)));
            }
        }
    }
    table.save(folder, "strain.csv")
}
