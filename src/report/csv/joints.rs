//! `joints.csv`: a row a design and speed on bearings that are not linear.

use super::table::{Table, number};
use crate::analysis::Results;
use crate::files::{Folder, WriteError};
use crate::units::DEG_PER_RAD;

/// `joints.csv`, or none where the bearings are linear.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub(crate) fn joints(results: &Results, folder: &Folder) -> Result<(), WriteError> {
    if results.joints.is_empty() {
        return Ok(());
    }
    let heads =
        ["design", "speed_rpm", "twist_linear_deg", "twist_joints_deg", "displacement_ratio", "last_ratio", "steps", "stages", "status"];
    let mut table = Table::new(&heads);
    for d in &results.joints {
        for s in &d.speeds {
            let found = s.joints.as_ref().ok();
            let cell = |value: &dyn Fn(&crate::analysis::FoundOnJoints) -> f64| found.map_or_else(String::new, |f| number(value(f)));
            table.row([
                d.design.clone(),
                number(s.speed_rpm),
                if s.linear.is_finite() { number(s.linear * DEG_PER_RAD) } else { String::new() },
                cell(&|f| f.twist * DEG_PER_RAD),
                cell(&|f| f.displacement),
                cell(&|f| f.last),
                cell(&|f| f.steps as f64),
                cell(&|f| f.stages as f64),
                s.joints.as_ref().err().map_or_else(|| "found".into(), Clone::clone),
            ]);
        }
    }
    table.save(folder, "joints.csv")
}
