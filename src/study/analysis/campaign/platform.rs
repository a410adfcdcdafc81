//! Rows of a platform: a row for each number of dampers and each of its studies.

use super::cases::Case;
use super::columns::{Cell, DAMPERS, WORST_RATIO, target_of};
use super::dampers::{Damper, Dampers, Studies};
use super::rows::{By, Row, Status, as_asked, values};
use super::setup::with_searches;
use crate::analysis::RunError;
use crate::analysis::searches::Searches;
use crate::input::Study;
use crate::input::campaign::{Each, Platform};
use crate::objective::holds;
use crate::optimise::Stop;
use crate::optimise::assignment::Assignment;

/// The searches of several studies, one inside the other.
fn with_all<T>(studies: &[Study], found: &[&Searches], ask: &mut dyn FnMut(&[&Searches]) -> Result<T, RunError>) -> Result<T, RunError> {
    let Some((first, rest)) = studies.split_first() else { return ask(found) };
    with_searches(first, None, |searches| {
        let more: Vec<&Searches> = found.iter().copied().chain([searches]).collect();
        with_all(rest, &more, ask)
    })
}

/// The rows of a platform: of its studies, which are those of each engine after the other, with the indices of their values of what it covers.
///
/// # Errors
/// [`RunError`] where the damper of a single study has no finite response.
pub(super) fn rows(platform: &Platform, (members, studies): (&[Case], &[Study])) -> Result<Vec<Row>, RunError> {
    let studies: Vec<Study> = studies.iter().map(|s| as_asked(s, Each::Platform)).collect();
    with_all(&studies, &[], &mut |searches| {
        let loads = searches.len() / platform.engines.variants.len();
        let all = match Studies::new(searches, loads) {
            Ok(all) => all,
            Err(reason) => return Ok(vec![Row::without(Status::Refused, reason)]),
        };
        let target = |of: &[f64], i: usize| searches[i].study.objective.unit.inside(of[i / loads]);
        let targets = platform.targets.as_ref().map(|of| (0..searches.len()).map(|i| target(of, i)).collect::<Vec<f64>>());
        let families = all.dampers(targets.as_deref(), platform.sets)?;
        let covered = |row: (usize, Row)| Row { covered: members[row.0 % members.len()].covered.clone(), ..row.1 };
        Ok(families.iter().flat_map(|family| of_family(searches, &all, family)).enumerate().map(covered).collect())
    })
}

/// For each number of dampers a row for each study.
fn of_family(searches: &[&Searches], all: &Studies, family: &Dampers) -> Vec<Row> {
    let of_count = |(count, own): (usize, &Assignment)| -> Vec<Row> {
        let bound = family.lower_bound(own);
        let row = |i: usize| {
            let number = own.sets.iter().position(|set| all.of(*set).any(|s| s == i)).unwrap_or_default();
            let mut row = match &family.of_sets[&own.sets[number]] {
                Ok(damper) => of_study(searches[i], (all, i), family, damper),
                Err(error) => Row::without(Status::Unbounded, error.to_string()),
            };
            row.put(DAMPERS, Cell::Count(count as i64 + 1));
            row.put("damper", Cell::Count(number as i64 + 1));
            row.put(WORST_RATIO, Cell::of(Some(own.cost)));
            row.put("lower_bound_of_worst_ratio", Cell::of(bound));
            row
        };
        (0..searches.len()).map(row).collect()
    };
    family.assignments.iter().enumerate().flat_map(of_count).collect()
}

/// A study with a damper.
fn of_study(searches: &Searches, (all, i): (&Studies, usize), family: &Dampers, damper: &Damper) -> Row {
    let (study, design) = (searches.study, all.mounted(i, &damper.optimum.design));
    let (mut row, objective, target) = (Row::of(&family.name, &design), &study.objective, family.targets[i]);
    let ratio = all.ratio(family, i, damper);
    row.put("ratio", Cell::of(ratio));
    row.put(target_of(objective), Cell::of(Some(objective.unit.shown(target))));
    row.put(objective.column.clone(), Cell::of(ratio.map(|r| objective.unit.shown(r * target))));
    match values(searches, &design, By::Exact) {
        Ok(found) => row.limits(study, &found.limits, found.limits.iter().all(|l| holds(*l))),
        Err(error) => row.status(Status::Unbounded, error.to_string()),
    }
    let outcome = &damper.optimum.outcome;
    let is_finished = outcome.stop == Stop::NothingFree || outcome.meets_first_order();
    if !is_finished {
        row.status(Status::NotConverged, format!("first-order residual {:.0e}", outcome.kkt_residual));
    }
    row.put("converged", Cell::Truth(is_finished && outcome.stop == Stop::Converged));
    row.put("kkt_residual", Cell::of(Some(outcome.kkt_residual)));
    row.put("starts_agreeing", Cell::Count(damper.optimum.agreeing() as i64));
    if let Some(proof) = &damper.proof {
        row.put("proof", Cell::Text(proof.verdict.word().to_owned()));
    }
    row
}
