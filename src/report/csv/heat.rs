//! `heat.csv`: the temperature of absorbers over speed.

use super::table::{Table, number, optional};
use crate::analysis::Results;
use crate::files::{Folder, WriteError};
use crate::units::DEG_PER_RAD;

/// `heat.csv`: a row a design, speed and temperature in balance, the one reached from cold first; one without a temperature where the absorber overheats. None where no material says what cools it.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn heat(results: &Results, folder: &Folder) -> Result<(), WriteError> {
    if results.heat.is_empty() {
        return Ok(());
    }
    let mut table = Table::new(&["design", "absorber", "speed_rpm", "temperature_c", "stable", "dissipated_power_w", "twist_deg"]);
    for d in &results.heat {
        for p in &d.points {
            let row = |celsius: Option<f64>, stable: &str, power: f64, twist: Option<f64>| {
                let place = [d.design.clone(), (d.absorber + 1).to_string(), number(p.speed_rpm)];
                let rest = [optional(celsius), stable.to_owned(), number(power), optional(twist.map(|t| t * DEG_PER_RAD))];
                place.into_iter().chain(rest).collect::<Vec<_>>()
            };
            if p.balances.is_empty() {
                table.row(row(None, "overheats", p.power_at_limit, Some(p.twist)));
            }
            for (i, b) in p.balances.iter().enumerate() {
                table.row(row(Some(b.celsius), if b.stable { "true" } else { "false" }, b.power, (i == 0).then_some(p.twist)));
            }
        }
    }
    table.save(folder, "heat.csv")
}
