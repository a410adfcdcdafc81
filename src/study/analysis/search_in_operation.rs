//! An optimum of the materials' reference in operation: whether it is as good there, and the search of both where it is not.

use crate::numerics::elementary::Elementary;
use crate::objective::Condition;
use crate::optimise::conflict::{self, Verdict};
use crate::optimise::search::{self, Recorder};
use crate::optimise::starts::NamedPoint;
use crate::optimise::{Optimum, Problem, starts};
use crate::response::{ResponseError, Work};

/// An optimum in operation that is above that of the reference by less than this share is level with it.
const LEVEL: f64 = 1e-9;
/// Starts of a search in operation: other local optima of the reference at most, and random points.
const MOST_OTHERS: usize = 2;
const RANDOM_IN_OPERATION: usize = 2;

/// Whether an optimum of the materials' reference is worse in operation: beyond a limit, or above its value.
pub(super) fn is_worse_in_operation(both: &Problem, optimum: &Optimum) -> Result<bool, ResponseError> {
    if Condition::InOperation.changes_nothing(&optimum.design) {
        return Ok(false);
    }
    let rows = both.rows(&optimum.outcome.point, &mut Work::default())?;
    Ok(!rows.hold() || rows.objective() > optimum.value() * (1.0 + LEVEL))
}

/// The search of a problem that has the absorbers in operation, too: from the optimum of the reference and its other local optima.
pub(super) fn search_in_operation(both: &Problem, reference: &Optimum, seed: u64, step: Recorder) -> Result<Optimum, ResponseError> {
    search::optimise(both, &starts_in_operation(both, reference, seed), search::Finish::Distinct, step)
}

/// The conflict of limits that no design holds at the materials' reference, in operation, too, or a design that holds them all: from the nearest of the reference. `None` where that comes as near in operation.
pub(super) fn conflict_in_operation(both: &Problem, nearest: &Optimum, ratio: f64, seed: u64) -> Result<Option<Verdict>, ResponseError> {
    if Condition::InOperation.changes_nothing(&nearest.design) {
        return Ok(None);
    }
    let as_near = both.rows(&nearest.outcome.point, &mut Work::default())?.excess() <= ratio.logarithm() + LEVEL;
    (!as_near).then(|| conflict::judge_near(both, starts_in_operation(both, nearest, seed))).transpose()
}

/// Starts of a search in operation.
fn starts_in_operation(both: &Problem, reference: &Optimum, seed: u64) -> Vec<NamedPoint> {
    let mut list = vec![("optimum of the reference".to_owned(), reference.outcome.point.clone())];
    let others = reference.others.iter().take(MOST_OTHERS).enumerate();
    list.extend(others.map(|(i, other)| (format!("other optimum {}", i + 1), both.space.point_of(&other.design))));
    let middle = &reference.outcome.point;
    let random = starts::random_points(&both.space, middle, RANDOM_IN_OPERATION, seed);
    list.extend(random.into_iter().map(|point| ("random".to_owned(), point)));
    list
}
