//! What is proved of an optimum, in words.

use super::judged::value_of;
use super::table::significant;
use crate::analysis::OptimumResult;
use crate::input::Study;
use crate::optimise::{Proof, Verdict};

/// What is told of a bound is not above it, whatever the digits that are shown.
const DOWN: f64 = 1.0 - 1e-6;

/// A clause: what no design within the bounds is better than, or why nothing is proved.
pub(super) fn clause(study: &Study, o: &OptimumResult) -> String {
    let Some(proof) = &o.proof else { return "not proved".into() };
    let objective = study.objective_of(o.objective);
    let within = if study.limits.is_empty() { "within the bounds" } else { "within bounds and limits" };
    let side = if objective.unit.is_inverse() { "above" } else { "below" };
    let bound = proof.lower_bound.filter(|b| *b > 0.0);
    let no_design = |bound: f64| format!("no design {within} is {side} {}", value_of(objective, bound * DOWN));
    let gap = bound.and_then(|b| gap(o, b)).map_or_else(String::new, |gap| format!("gap {}, ", significant(gap, 2)));
    let said = match (&proof.verdict, bound) {
        (Verdict::Proved, Some(b)) => format!("proved: {} ({gap}{} boxes)", no_design(b), proof.boxes),
        (Verdict::Impossible, _) => format!("proved: no design within the bounds holds all limits ({} boxes)", proof.boxes),
        (Verdict::Open(_), Some(b)) => format!("proved to a part: {} ({gap}{} boxes)", no_design(b), proof.boxes),
        (Verdict::Open(_), None) | (Verdict::Proved, None) => format!("not proved in {} boxes", proof.boxes),
        (Verdict::None(reason), _) => format!("not proved ({})", reason.words()),
    };
    match proof.better {
        0 => said,
        1 => format!("{said}; a box of the proof led to it"),
        n => format!("{said}; {n} boxes of the proof led to it"),
    }
}

/// Whether it is proved that no design holds all limits.
pub(super) fn is_impossible(o: &OptimumResult) -> bool {
    matches!(o.proof, Some(Proof { verdict: Verdict::Impossible, .. }))
}

/// Share of its value that an optimum is above a bound, at most; `None` where it breaks a limit.
pub(crate) fn gap(o: &OptimumResult, bound: f64) -> Option<f64> {
    o.optimum.outcome.rows.hold().then(|| 1.0 - bound / o.optimum.value())
}
