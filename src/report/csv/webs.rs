//! `web_loads.csv`, `web_margins.csv` and `von_mises.csv`: webs of a flexible crank, and margins and stresses by what they carry.

use super::table::{Table, number};
use crate::analysis::Results;
use crate::crankshaft::MarginCriterion;
use crate::files::{Folder, WriteError};
use crate::units::PA_PER_MPA;

/// `web_loads.csv`, or none on a torsional chain.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub(crate) fn web_loads(results: &Results, folder: &Folder) -> Result<(), WriteError> {
    if results.webs.is_empty() {
        return Ok(());
    }
    let heads = ["design", "throw", "web", "moment_n_m", "speed_rpm", "moment_without_vibration_n_m", "additional_stress_mpa"];
    let mut table = Table::new(&heads);
    for d in &results.webs {
        for w in &d.webs {
            table.row([
                d.design.clone(),
                (w.throw + 1).to_string(),
                if w.rear { "rear".into() } else { "front".into() },
                number(w.moment),
                number(w.speed_rpm),
                number(w.still),
                number(w.added / PA_PER_MPA),
            ]);
        }
    }
    table.save(folder, "web_loads.csv")
}

/// `web_margins.csv`, or none on a torsional chain.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub(crate) fn web_margins(results: &Results, folder: &Folder) -> Result<(), WriteError> {
    if results.webs.is_empty() {
        return Ok(());
    }
    let criteria = results.study.fatigue.as_ref().map_or(&[][..], |f| &f.criteria);
    let mut table = Table::new(&["design", "criterion", "margin", "fillet", "speed_rpm", "margin_by_beam"]);
    for d in &results.webs {
        for m in &d.margins {
            table.row([
                d.design.clone(),
                criteria.get(m.criterion).copied().map_or("", MarginCriterion::name).into(),
                number(m.margin),
                m.fillet.clone(),
                number(m.speed_rpm),
                number(m.beam),
            ]);
        }
    }
    table.save(folder, "web_margins.csv")
}

/// `von_mises.csv`, or none where no stress over the cycle was asked for.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub(crate) fn von_mises(results: &Results, folder: &Folder) -> Result<(), WriteError> {
    if results.webs.iter().all(|d| d.von_mises.is_empty()) {
        return Ok(());
    }
    let mut table = Table::new(&["design", "speed_rpm", "von_mises_mpa", "fillet", "crank_deg"]);
    for d in &results.webs {
        for v in &d.von_mises {
            table.row([d.design.clone(), number(v.speed_rpm), number(v.stress / PA_PER_MPA), v.fillet.clone(), number(v.crank_deg)]);
        }
    }
    table.save(folder, "von_mises.csv")
}
