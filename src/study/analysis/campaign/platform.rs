//! Rows of a platform: a row for each number of dampers and each of its studies.

use super::cases::Case;
use super::columns::{Cell, target_of};
use super::dampers::{Count, Damper, Dampers, NoDampers, Share, Studies, disagreement};
use super::rows::{By, Row, Status, as_asked, values};
use super::setup::with_searches;
use crate::analysis::RunError;
use crate::analysis::searches::Searches;
use crate::input::Study;
use crate::input::campaign::{BOUND_OF_RATIO, Campaign, DAMPER, DAMPERS, Each, Platform, RATIO, WORST_RATIO};
use crate::objective::holds;
use crate::optimise::{Stop, Verdict};

impl Campaign {
    /// What the studies of a platform are called: the engine, with its loads.
    pub(super) fn study_name(&self, member: &Case) -> String {
        self.labels(member)[self.axes.len()..].join(" ")
    }

    /// Why the studies of a case, all of which are read, ask for no common damper; `None` where they do, and of what is no platform.
    #[doc(hidden)]
    pub fn disagreement(&self, case: &Case, studies: &[Study]) -> Option<String> {
        let names: Vec<String> = self.members(case).iter().map(|m| self.study_name(m)).collect();
        self.platform.as_ref().and_then(|_| disagreement(studies, &names))
    }
}

/// The searches of several studies, one inside the other.
fn with_all<T>(studies: &[Study], found: &[&Searches], ask: &mut dyn FnMut(&[&Searches]) -> Result<T, RunError>) -> Result<T, RunError> {
    let Some((first, rest)) = studies.split_first() else { return ask(found) };
    with_searches(first, None, |searches| {
        let more: Vec<&Searches> = found.iter().copied().chain([searches]).collect();
        with_all(rest, &more, ask)
    })
}

/// The studies of a platform that are read, with their names.
pub(super) struct Named<'s> {
    pub members: &'s [Case],
    pub names: Vec<String>,
    pub studies: &'s [Study],
}

/// The rows of a platform, whose studies are those of each engine after the other.
///
/// # Errors
/// [`RunError`] where the damper of a single study has no finite response.
pub(super) fn rows(platform: &Platform, of: &Named) -> Result<Vec<Row>, RunError> {
    if let Some(reason) = disagreement(of.studies, &of.names) {
        return Ok(vec![Row::without(Status::Refused, reason)]);
    }
    let studies: Vec<Study> = of.studies.iter().map(|s| as_asked(s, Each::Platform)).collect();
    with_all(&studies, &[], &mut |searches| {
        let loads = searches.len() / platform.engines.variants.len();
        let all = Studies::new(searches, loads);
        let target = |targets: &[f64], i: usize| searches[i].study.objective.unit.inside(targets[i / loads]);
        let targets = platform.targets.as_ref().map(|own| (0..searches.len()).map(|i| target(own, i)).collect::<Vec<f64>>());
        match all.dampers(targets.as_deref(), platform.sets) {
            Ok(families) => Ok(families.iter().flat_map(|family| of_family(searches, (&all, of), family)).collect()),
            Err(NoDampers::Unbounded(error)) => Err(error),
            Err(NoDampers::Nothing(i)) => {
                let reason = format!(
                    "{}: the best damper leaves nothing of the objective, so that there is no ratio to it; `targets` give one",
                    of.names[i]
                );
                Ok(vec![Row { covered: of.members[i].covered.clone(), ..Row::without(Status::Refused, reason) }])
            }
        }
    })
}

/// For each number of dampers a row for each study.
fn of_family(searches: &[&Searches], (all, of): (&Studies, &Named), family: &Dampers) -> Vec<Row> {
    let none = [Count { dampers: Vec::new(), worst: f64::INFINITY, at_least: 0.0 }];
    let counts = if family.counts.is_empty() { &none[..] } else { &family.counts };
    let of_count = |(i, own): (usize, &Count)| -> Vec<Row> {
        let row = |study: usize| {
            let shares = own.dampers.iter().map(|d| &**d).chain(&family.left_out);
            let (number, share) = shares.enumerate().find(|(_, share)| share.studies.contains(&study))?;
            let mut row = match &share.damper {
                Ok(damper) => of_study(searches[study], (all, of, study), family, (share, damper)),
                Err(error) => Row::without(Status::Unbounded, error.to_string()),
            };
            row.covered.clone_from(&of.members[study].covered);
            row.put(DAMPERS, Cell::Count(i as i64 + 1));
            if number < own.dampers.len() {
                row.put(DAMPER, Cell::Count(number as i64 + 1));
            }
            row.put(WORST_RATIO, Cell::of(Some(own.worst)));
            row.put(BOUND_OF_RATIO, Cell::of(Some(own.at_least).filter(|b| *b > 0.0)));
            Some(row)
        };
        (0..searches.len()).filter_map(row).collect()
    };
    counts.iter().enumerate().flat_map(of_count).collect()
}

/// A study with a damper.
fn of_study(searches: &Searches, (all, of, i): (&Studies, &Named, usize), family: &Dampers, (share, damper): (&Share, &Damper)) -> Row {
    let (study, design) = (searches.study, all.mounted(family, i, &damper.optimum.design));
    let (mut row, objective, target) = (Row::of(&family.name, &design), &study.objective, family.targets[i]);
    let outcome = &damper.optimum.outcome;
    let is_left_out = family.left_out.iter().any(|d| d.studies.contains(&i));
    let ratio = all.ratio(family, i, damper).filter(|_| !is_left_out);
    row.put(RATIO, Cell::of(ratio));
    row.put(target_of(objective), Cell::of(Some(objective.unit.shown(target)).filter(|_| !is_left_out)));
    if !outcome.rows.hold() {
        let names: Vec<&str> = share.studies.iter().map(|s| of.names[*s].as_str()).collect();
        let is_proved = damper.proof.as_ref().is_some_and(|p| p.verdict == Verdict::Impossible);
        let word = if is_proved { "no damper holds all limits of" } else { "no damper was found that holds all limits of" };
        row.status(Status::LimitsBroken, format!("{word} {}", names.join(", ")));
    }
    match values(searches, &design, By::Exact) {
        Ok(found) => {
            let value = ratio.map_or(found.objectives[0], |r| r * target);
            row.put(objective.column.clone(), Cell::of(Some(objective.unit.shown(value))));
            row.limits(study, &found.limits, found.limits.iter().all(|l| holds(*l)));
        }
        Err(error) => row.status(Status::Unbounded, error.to_string()),
    }
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
