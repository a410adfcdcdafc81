//! What designs that no start comes from say of an optimum: elsewhere, over the whole box, near it, and in operation; and the conflict of limits that none holds.

use super::search_in_operation::{conflict_in_operation, is_worse_in_operation, search_in_operation};
use crate::numerics::elementary::Elementary;
use crate::optimise::conflict::{self, Conflict, Verdict};
use crate::optimise::search::Recorder;
use crate::optimise::starts::NamedPoint;
use crate::optimise::{Nearby, Optimum, Problem, Scan, Survey, starts, survey, verification_scan};
use crate::response::ResponseError;

/// What designs that no start comes from say of an optimum.
pub(super) struct LookedOver {
    pub scan: Scan,
    pub survey: Option<Survey>,
    pub nearby: Nearby,
    pub conflict: Option<Conflict>,
}

impl LookedOver {
    /// Whether one of these designs has led to a better optimum.
    pub(super) fn led_elsewhere(&self) -> bool {
        self.scan.better || self.nearby.better || self.survey.is_some_and(|s| s.better)
    }
}

/// Frequencies to which designs elsewhere are tuned.
const SCANNED: usize = 24;

/// Holds an optimum against designs that no start comes from, and keeps what is better, with designs tuned to frequencies in equal ratios between those that the torque excites (rad/s); where it breaks a limit, looks for what does not.
pub(super) fn looked_over(
    problem: &Problem,
    optimum: &mut Optimum,
    (starts, excited): (&[NamedPoint], Option<(f64, f64)>),
    seed: u64,
) -> Result<LookedOver, ResponseError> {
    let between = |(low, high): (f64, f64)| (0..SCANNED).map(|i| low * (high / low).power(i as f64 / (SCANNED - 1) as f64)).collect();
    let frequencies: Vec<f64> = excited.map_or_else(Vec::new, between);
    let lines = starts::elsewhere(&problem.space, &optimum.outcome.point, &frequencies);
    let scan = verification_scan::scan(problem, optimum, &lines);
    let survey = surveyed(problem, optimum, seed);
    let nearby = verification_scan::nearby(problem, optimum, seed);
    Ok(LookedOver { scan, survey, nearby, conflict: conflict_of(problem, optimum, starts)? })
}

/// The whole box of an optimum under limits, or of several absorbers.
fn surveyed(problem: &Problem, optimum: &mut Optimum, seed: u64) -> Option<Survey> {
    survey::is_wanted(problem).then(|| survey::survey(problem, optimum, seed))
}

/// The same in operation, for a problem that has the absorbers there, too, of an optimum of the materials' reference; whether anything differs there.
pub(super) fn in_operation(
    both: &Problem,
    (optimum, looked): (&mut Optimum, &mut LookedOver),
    starts: &[NamedPoint],
    seed: u64,
    step: Recorder,
) -> Result<bool, ResponseError> {
    if let Some(known) = &looked.conflict {
        let Some(verdict) = conflict_in_operation(both, optimum, known.ratio, seed)? else { return Ok(false) };
        looked.conflict = settled(both, optimum, verdict);
        return Ok(true);
    }
    if !is_worse_in_operation(both, optimum)? {
        return Ok(false);
    }
    *optimum = search_in_operation(both, optimum, seed, step)?;
    // what was looked at for the reference says nothing of this one
    let survey = surveyed(both, optimum, seed);
    let nearby = verification_scan::nearby(both, optimum, seed);
    *looked = LookedOver { scan: Scan::default(), survey, nearby, conflict: conflict_of(both, optimum, starts)? };
    Ok(true)
}

/// Where limits are broken: an optimum from a design that holds them, or the conflict.
fn conflict_of(problem: &Problem, optimum: &mut Optimum, starts: &[NamedPoint]) -> Result<Option<Conflict>, ResponseError> {
    if optimum.outcome.rows.hold() {
        return Ok(None);
    }
    Ok(settled(problem, optimum, conflict::judge(problem, optimum, starts)?))
}

/// An optimum by a verdict on its limits.
fn settled(problem: &Problem, optimum: &mut Optimum, verdict: Verdict) -> Option<Conflict> {
    match verdict {
        Verdict::Conflict(nearest, conflict) => {
            *optimum = *nearest;
            optimum.others.clear();
            Some(conflict)
        }
        Verdict::Found(outcome) => {
            if outcome.rows.hold() {
                optimum.design = problem.space.design(&outcome.point);
                optimum.outcome = *outcome;
            }
            None
        }
    }
}
