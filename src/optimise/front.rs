//! The front of ring inertia against the objective: the optimum followed along the inertia.

use super::minimax::{self, Outcome};
use super::search::{self, Optimum, Recorder};
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
const SEGMENT: usize = 11;

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

/// Follows the optimum over `inertias` (ascending). At every eleventh inertia and the last a global search from `starts` is made; in
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
            let optimum = search::optimise(&problem, &starts(&problem.space), &|| {});
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
    // each segment is walked from its left and from its right head
    let walks: Vec<(Vec<(usize, Outcome)>, Work)> = (0..2 * (knots.len() - 1))
        .into_par_iter()
        .map(|walk| {
            let (left, right) = (knots[walk / 2], knots[walk / 2 + 1]);
            let inner: Vec<usize> = if walk % 2 == 0 { (left + 1..right).collect() } else { (left + 1..right).rev().collect() };
            let head = &heads[walk / 2 + walk % 2];
            let mut work = Work::default();
            let (mut point, mut space) = (head.outcome.point.clone(), at(knots[walk / 2 + walk % 2]).space);
            let mut outcomes = Vec::new();
            for i in inner {
                let problem = at(i);
                let guess = retuned(&space, &point, inertias[i]);
                let outcome = minimax::minimise(&problem, &problem.space.point(&guess), &mut work)?;
                (point, space) = (outcome.point.clone(), problem.space);
                outcomes.push((i, outcome));
                recorder();
            }
            Ok((outcomes, work))
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
