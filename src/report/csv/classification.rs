//! Tables of the calculation that a classification society asks for.

use super::table::{Table, number, optional};
use crate::analysis::classification::{Classification, VectorSum};
use crate::files::{Folder, WriteError};
use crate::units::DEG_PER_RAD;

/// `holzer.csv`, `vector_sums.csv`, `criticals.csv` and `shaft_torques.csv`.
///
/// # Errors
/// [`WriteError`] where one cannot be written.
pub(crate) fn classification(c: &Classification, folder: &Folder) -> Result<(), WriteError> {
    super::curves::holzer(&c.holzer, folder)?;
    let first = |s: &VectorSum| {
        let numbers = [s.sum, s.speed_rpm, s.equilibrium * DEG_PER_RAD].map(number);
        [s.mode.to_string(), number(s.frequency_hz), s.order.to_string()].into_iter().chain(numbers)
    };
    let header = ["mode", "frequency_hz", "order", "vector_sum", "critical_rpm", "equilibrium_deg_per_n_m"];
    let mut sums = Table::new(&header);
    c.sums.iter().for_each(|s| sums.row(first(s)));
    sums.save(folder, "vector_sums.csv")?;
    let more = ["torque_of_a_throw_n_m", "equilibrium_deg", "damping_ratio", "resonance_deg"];
    let mut criticals = Table::new(&[&header[..], &more[..]].concat());
    for critical in &c.criticals {
        let own = critical.in_range;
        let rest = [
            own.map(|r| r.torque),
            own.map(|r| r.equilibrium * DEG_PER_RAD),
            own.map(|r| r.damping_ratio),
            own.and_then(|r| r.resonance).map(|r| r * DEG_PER_RAD),
        ];
        criticals.row(first(&critical.of).chain(rest.map(optional)));
    }
    criticals.save(folder, "criticals.csv")?;
    let mut shafts = Table::new(&["design", "condition", "shaft", "torque_n_m", "speed_rpm"]);
    for s in &c.shafts {
        shafts.row([s.design.clone(), s.condition.name().to_owned(), s.shaft.clone(), number(s.torque), number(s.speed_rpm)]);
    }
    shafts.save(folder, "shaft_torques.csv")
}
