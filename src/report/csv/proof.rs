//! `proof_<design>.csv`: a proof for others to check, a row a box of designs and speed.

use super::table::{Table, number, optional};
use crate::analysis::{OptimumResult, Results};
use crate::files::{Folder, WriteError};
use crate::input::Study;
use crate::input::tables::{COLUMNS, ENDS, EXCLUDED_BY};
use crate::optimise::Exclusions;

/// Writes those of all optima that have one. `lowest_…`, `highest_…`: range of a free parameter; `share`: what objective (in units of `lower_bound`) or limit at this speed counts
/// in the mean over the rows of a box, which of no design in it is below one.
///
/// # Errors
/// [`WriteError`] where one cannot be written.
pub fn proofs(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    results.optima.iter().try_for_each(|o| o.exclusions.as_ref().map_or(Ok(()), |exclusions| proof(study, o, exclusions, folder)))
}

fn proof(study: &Study, o: &OptimumResult, exclusions: &Exclusions, folder: &Folder) -> Result<(), WriteError> {
    let of_absorber = |(absorber, key): &(usize, &str)| if *absorber == 0 { (*key).to_owned() } else { format!("{key}_{}", absorber + 1) };
    let ends = exclusions.free.iter().map(of_absorber).flat_map(|key| ENDS.map(|end| format!("{end}{key}")));
    let header: Vec<String> = COLUMNS.into_iter().map(str::to_owned).chain(ends).collect();
    let mut table = Table::new(&header.iter().map(String::as_str).collect::<Vec<_>>());
    let objective = study.objective_of(o.objective);
    let bound = o.proof.as_ref().and_then(|p| p.lower_bound).map(|b| objective.unit.shown(b));
    for (i, one) in exclusions.boxes.iter().enumerate() {
        for speed in &one.speeds {
            let named = [o.design.name.clone(), objective.key.to_owned(), optional(bound), objective.unit.symbol().to_owned()];
            let cylinder = speed.cylinder.map_or_else(String::new, |c| (c + 1).to_string());
            let by = EXCLUDED_BY[usize::from(speed.by_limit)];
            let at = [(i + 1).to_string(), speed.condition.name().to_owned(), cylinder, number(speed.speed_rpm), by.to_owned()];
            let ranges = one.ranges.iter().flat_map(|r| [number(r.0), number(r.1)]);
            table.row(named.into_iter().chain(at).chain([number(speed.share)]).chain(ranges));
        }
    }
    table.save(folder, &format!("proof_{}.csv", o.design.name))
}
