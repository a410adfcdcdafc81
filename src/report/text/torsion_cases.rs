//! Margins at two instants of the cycle by the torsion case of a study.

use super::margin::factor;
use super::table::{dash, table};
use crate::analysis::{CaseAtSpeed, Results};

/// The smallest factors of every design at crankpins and journals with their speeds, beside those over the full cycle; empty without a case.
pub(crate) fn torsion_cases(results: &Results) -> String {
    let Some(case) = results.study.fatigue.as_ref().and_then(|f| f.torsion_case).filter(|_| !results.torsion_cases.is_empty()) else {
        return String::new();
    };
    let rows: Vec<Vec<String>> = results
        .torsion_cases
        .iter()
        .map(|d| {
            let place = |i: usize| {
                let smallest = d.smallest(i).map(|s: &CaseAtSpeed| format!("{} at {}", factor(s.safety_factors[i]), s.speed_rpm));
                let full = d.speeds.iter().filter_map(|s| s.full_cycle[i]).reduce(f64::min);
                [dash(smallest), dash(full.map(factor))]
            };
            std::iter::once(d.design.clone()).chain(place(0)).chain(place(1)).collect()
        })
        .collect();
    let header = ["design", "crankpin, at rpm", "full cycle", "journal, at rpm", "full cycle"];
    format!("Smallest factors by Goodman, torsion case {} at two instants of the cycle:\n{}", case.name(), table(&header, &rows))
}
