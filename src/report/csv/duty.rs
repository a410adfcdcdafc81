//! `duty.csv`: a row a design and point of the duty.

use super::table::{Table, number};
use crate::analysis::Results;
use crate::files::{Folder, WriteError};
use crate::units::DEG_PER_RAD;

/// `duty.csv`, or none where the study has no duty.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn duty(results: &Results, folder: &Folder) -> Result<(), WriteError> {
    if results.duty.is_empty() {
        return Ok(());
    }
    let header = ["design", "speed_rpm", "load_fraction", "share", "twist_deg", "torque_n_m", "dissipated_power_w"];
    let mut table = Table::new(&header);
    for d in &results.duty {
        for p in &d.points {
            let numbers = [p.point.speed_rpm, p.point.load_fraction, p.point.share, p.twist * DEG_PER_RAD, p.torque, p.power].map(number);
            table.row(std::iter::once(d.design.clone()).chain(numbers).collect::<Vec<String>>());
        }
    }
    table.save(folder, "duty.csv")
}
