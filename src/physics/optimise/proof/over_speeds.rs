//! That an optimum has no more than its value, and holds its limits, at every speed, not only where peaks were looked for.

use super::verdict::Effort;
use crate::objective::{Condition, Over};
use crate::optimise::problem::Role;
use crate::optimise::{Outcome, Problem};
use crate::response::Work;

/// By which what is told may exceed what was asked for.
const ROUNDED: f64 = 1e-8;

/// What the objective of an optimum is nowhere above, over all speeds and conditions, as close to its value as the gap where as many speeds as boxes suffice; `None` where it is not proved, or a limit is not to hold to the gap.
#[doc(hidden)]
pub fn upper_bound(problem: &Problem, optimum: &Outcome, effort: Effort, work: &mut Work) -> Option<f64> {
    if !optimum.rows.hold() || !problem.weights.is_empty() {
        return None;
    }
    let (design, value, within) = (problem.space.design(&optimum.point), optimum.rows.objective(), 1.0 + effort.gap);
    let objectives = problem.objectives.iter().enumerate().map(|(i, l)| (Role::Objective(i), l));
    let asked: Vec<_> = objectives.chain(problem.limits.iter().enumerate().map(|(i, l)| (Role::Limit(i), l))).collect();
    let mut upper = 0.0;
    for case in problem.load_cases {
        if case.condition == Condition::InOperation || case.deviation.is_some() {
            return None;
        }
        let absorbers = case.absorbers(&design).ok()?;
        for (role, limit) in &asked {
            let most = if role.is_limit() { within } else { value * within };
            for (measure, unit) in case.parts_of(limit) {
                if let Over::Property(_) = measure.over {
                    // it has no speeds
                    if role.is_limit() {
                        continue;
                    }
                    return None;
                }
                let found = case.finder.ceiling(&absorbers, measure, (most * unit, effort.boxes), work)?.value / unit;
                if role.is_limit() && found > most * (1.0 + ROUNDED) {
                    return None;
                }
                upper = if role.is_limit() { upper } else { f64::max(upper, found) };
            }
        }
    }
    Some(upper)
}
