//! `torsion_cases.csv`: a row a design and speed by the torsion case of a study.

use super::table::{Table, number, optional};
use crate::analysis::Results;
use crate::files::{Folder, WriteError};
use crate::units::PA_PER_MPA;

/// `torsion_cases.csv`, or none where the study asks for no case.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub(crate) fn torsion_cases(results: &Results, folder: &Folder) -> Result<(), WriteError> {
    let Some(case) = results.study.fatigue.as_ref().and_then(|f| f.torsion_case).filter(|_| !results.torsion_cases.is_empty()) else {
        return Ok(());
    };
    let header = [
        "design",
        "torsion_case",
        "speed_rpm",
        "throw",
        "crankpin_amplitude_mpa",
        "crankpin_mean_mpa",
        "crankpin_safety_factor",
        "crankpin_full_cycle_safety_factor",
        "journal_amplitude_mpa",
        "journal_mean_mpa",
        "journal_safety_factor",
        "journal_full_cycle_safety_factor",
    ];
    let mut table = Table::new(&header);
    for d in &results.torsion_cases {
        for s in &d.speeds {
            let place = |i: usize| {
                let cycle = s.at.cycles[i];
                let stresses = [cycle.amplitude, cycle.mean].map(|p| number(p / PA_PER_MPA));
                stresses.into_iter().chain([number(s.safety_factors[i]), optional(s.full_cycle[i])])
            };
            let about = [d.design.clone(), case.name().to_owned(), number(s.speed_rpm), (s.at.throw + 1).to_string()];
            table.row(about.into_iter().chain(place(0)).chain(place(1)));
        }
    }
    table.save(folder, "torsion_cases.csv")
}
