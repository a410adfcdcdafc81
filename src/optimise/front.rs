//! The front of ring inertia against the objective: the optimum followed along the inertia.

use super::minimax::{self, Outcome};
use super::search::{self, Finish, Optimum, Recorder};
use super::{Problem, Space};
use crate::absorber::Mounted;
use crate::response::{ResponseError, Work};
use rayon::prelude::*;

/// One point of a front.
#[derive(Debug, Clone, serde::Serialize)]
pub struct FrontPoint {
    /// The optimum for its ring inertia.
    pub design: Vec<Mounted>,
    /// Objective.
    pub value: f64,
    /// Worst excess over a limit.
    pub excess: f64,
    /// First-order residual.
    pub kkt_residual: f64,
    /// Whether a lighter ring does as well, or a limit fails.
    pub dominated: bool,
}

/// A front and the work it took.
#[derive(Debug, Clone, serde::Serialize)]
pub struct Front {
    /// By ascending ring inertia.
    pub points: Vec<FrontPoint>,
    /// Evaluations.
    pub work: Work,
}

/// Points between two global searches: fixed, so that the result does not depend on threads.
const SEGMENT: usize = 17;

/// Values of a family at a point with another ring: what grows with the ring follows it, so that the tuning is kept.
fn retuned(space: &Space, point: &[f64], ring_inertia: f64) -> Vec<Vec<f64>> {
    let mut values = space.values(point);
    let before = values[0][0];
    for (value, parameter) in values[0].iter_mut().zip(space.slots[0].declaration.parameters).skip(1) {
        if parameter.extensive {
            *value = *value * ring_inertia / before;
        }
    }
    values[0][0] = ring_inertia;
    values
}

/// The optimum followed from a head over some inertias: index, inertia and problem of each.
fn walk<'a>(
    (mut space, mut outcome): (Space, Outcome),
    over: impl Iterator<Item = (usize, f64, Problem<'a>)>,
    recorder: Recorder,
) -> Result<(Vec<(usize, Outcome)>, Work), ResponseError> {
    let mut work = Work::default();
    // by how much the last optimum lay beside where it was expected: the next one does so, too
    let mut beside = vec![0.0; outcome.point.len()];
    let mut outcomes = Vec::new();
    for (i, inertia, problem) in over {
        let guess = problem.space.point(&retuned(&space, &outcome.point, inertia));
        let near = guess.iter().zip(&beside).zip(problem.space.bounds());
        let start: Vec<f64> = near.map(|((g, b), (low, high))| (g + b).clamp(low, high)).collect();
        outcome = minimax::minimise_with(&problem, &start, outcome.curvature, &mut work)?;
        beside = outcome.point.iter().zip(&guess).map(|(p, g)| p - g).collect();
        space = problem.space;
        outcomes.push((i, outcome.clone()));
        recorder();
    }
    Ok((outcomes, work))
}

/// Follows the optimum over `inertias` (ascending). At every seventeenth inertia and the last a global search from `starts` is made; in
/// between the optimum is followed from both sides by the minimax method, and the better one kept.
///
/// # Errors
/// [`ResponseError::Unbounded`] where no start has a finite response.
pub fn follow(
    problem: &Problem,
    inertias: &[f64],
    starts: impl Fn(&Space) -> Vec<(String, Vec<f64>)> + Sync,
    recorder: Recorder,
) -> Result<Front, ResponseError> {
    let last = inertias.len() - 1;
    let at = |i: usize| Problem { space: problem.space.with_ring_inertia(inertias[i]), ..*problem };
    let mut knots: Vec<usize> = (0..last).step_by(SEGMENT).collect();
    knots.push(last);
    let heads: Vec<Optimum> = knots
        .par_iter()
        .map(|&i| {
            let problem = at(i);
            let optimum = search::optimise(&problem, &starts(&problem.space), Finish::Distinct, &|| {});
            recorder();
            optimum
        })
        .collect::<Result<_, _>>()?;
    let mut work = Work::default();
    for head in &heads {
        work += head.stages.seeds;
        work += head.stages.search;
        work += head.stages.minimax;
    }
    // each segment is walked from its left and from its right head: between heads of one branch another may be better
    let walks: Vec<(Vec<(usize, Outcome)>, Work)> = (0..2 * (knots.len() - 1))
        .into_par_iter()
        .map(|i| {
            let (left, right) = (knots[i / 2], knots[i / 2 + 1]);
            let inner: Vec<usize> = if i % 2 == 0 { (left + 1..right).collect() } else { (left + 1..right).rev().collect() };
            let from = (at(knots[i / 2 + i % 2]).space, heads[i / 2 + i % 2].outcome.clone());
            walk(from, inner.into_iter().map(|i| (i, inertias[i], at(i))), recorder)
        })
        .collect::<Result<_, _>>()?;
    let mut best: Vec<Option<Outcome>> = vec![None; inertias.len()];
    for (knot, head) in knots.iter().zip(heads) {
        best[*knot] = Some(head.outcome);
    }
    for (outcomes, spent) in walks {
        work += spent;
        for (i, outcome) in outcomes {
            if best[i].as_ref().is_none_or(|b| outcome.merit() < b.merit()) {
                best[i] = Some(outcome);
            }
        }
    }
    let mut lowest = f64::INFINITY;
    let points = best
        .into_iter()
        .enumerate()
        .filter_map(|(i, outcome)| outcome.map(|o| (i, o)))
        .map(|(i, o)| {
            let value = o.rows.objective();
            let holds = o.rows.hold();
            let dominated = value >= lowest || !holds;
            if holds {
                lowest = lowest.min(value);
            }
            let design = at(i).space.design(&o.point);
            FrontPoint { design, value, excess: o.rows.excess(), kkt_residual: o.kkt_residual, dominated }
        })
        .collect();
    Ok(Front { points, work })
}
