//! `timing.csv`.

use super::table::{Table, number};
use crate::analysis::Timing;
use crate::files::{Folder, WriteError};

/// `timing.csv`: the only table that differs from run to run.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn timing(timing: &[Timing], folder: &Folder) -> Result<(), WriteError> {
    let header = ["stage", "seconds", "evaluations", "direct_solves", "receptance_points", "singular_points", "syntheses"];
    let mut table = Table::new(&header);
    for t in timing {
        let w = &t.work;
        let counts = [w.evaluations, w.direct_solves, w.receptance_points, w.singular_points, w.syntheses];
        table.row([t.stage.clone(), number(t.seconds)].into_iter().chain(counts.map(|c| c.to_string())));
    }
    table.save(folder, "timing.csv")
}
