//! `large_twist.csv`: steady motions of designs with an absorber whose twist is not small.

use super::table::{Table, number};
use crate::analysis::Results;
use crate::files::{Folder, WriteError};
use crate::units::DEG_PER_RAD;

/// `large_twist.csv`: a row a point, in the order of each curve. None where no design has such an absorber.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn large_twist(results: &Results, folder: &Folder) -> Result<(), WriteError> {
    if results.large_twist.is_empty() {
        return Ok(());
    }
    let mut table =
        Table::new(&["design", "absorber", "curve", "speed_rpm", "stable", "twist_deg", "largest_ring_twist_deg", "dissipated_power_w"]);
    for d in &results.large_twist {
        for (c, curve) in d.curves.iter().enumerate() {
            for p in curve {
                let stable = p.stable.map_or("unknown".to_owned(), |s| s.to_string());
                table.row([
                    d.design.clone(),
                    (d.absorber + 1).to_string(),
                    (c + 1).to_string(),
                    number(p.speed_rpm),
                    stable,
                    number(p.twist * DEG_PER_RAD),
                    number(p.ring_twist * DEG_PER_RAD),
                    number(p.power),
                ]);
            }
        }
    }
    table.save(folder, "large_twist.csv")
}
