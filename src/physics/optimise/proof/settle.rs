//! An optimum and its proof together: what a proof finds that is better takes the place of the optimum.

use super::boxes::prove;
use super::over_speeds::upper_bound;
use super::verdict::{Effort, Found, Proof, Reason};
use crate::optimise::front::mark_dominated;
use crate::optimise::minimax::{self, Outcome};
use crate::optimise::search::is_lower;
use crate::optimise::{Front, FrontPoint, Optimum, Problem, Stages};
use rayon::prelude::*;

/// Better optima that a proof leads to, at most.
const MOST_BETTER: usize = 10;

/// Proves that no design within the bounds is below an optimum by more than the gap; where one is better, the search goes on from there, and the better optimum is proved. Of an optimum that breaks a limit it proves that no
/// design holds all of them, or finds one that does.
#[doc(hidden)]
pub fn settle(problem: &Problem, optimum: &mut Optimum, effort: Effort) -> Proof {
    let (proof, better) = settled(problem, &optimum.outcome, effort, &mut optimum.stages);
    if let Some(outcome) = better {
        optimum.replace(problem, outcome);
    }
    proof
}

/// The same of every point of a front over ring inertia.
#[doc(hidden)]
pub fn settle_front(problem: &Problem, front: &mut Front, effort: Effort) {
    let proved = |point: &mut FrontPoint| {
        let own = Problem { space: problem.space.with_ring_inertia(point.design[0].absorber.ring_inertia()), ..*problem };
        let at = own.space.point_of(&point.design);
        let mut stages = Stages::default();
        let Ok(rows) = own.rows(&at, &mut stages.minimax) else { return stages };
        let (proof, better) = settled(&own, &Outcome::unmoved(&at, rows), effort, &mut stages);
        if let Some(o) = better {
            (point.design, point.value, point.excess, point.kkt_residual) =
                (own.space.design(&o.point), o.rows.objective(), o.rows.excess(), o.kkt_residual);
        }
        point.proof = Some(proof);
        stages
    };
    let stages: Vec<Stages> = front.points.par_iter_mut().map(proved).collect();
    stages.iter().for_each(|s| front.work += s.all());
    mark_dominated(&mut front.points);
}

/// The proof of the best that is known after it, and that where it is another one.
fn settled(problem: &Problem, first: &Outcome, effort: Effort, stages: &mut Stages) -> (Proof, Option<Outcome>) {
    let (mut boxes, mut best) = (0, None::<Outcome>);
    for better in 0..=MOST_BETTER {
        let own = best.as_ref().unwrap_or(first);
        let found = prove(problem, own, effort, &mut boxes, &mut stages.search);
        let point = match found {
            Found::Ended(lower_bound, verdict) => {
                let upper_bound = upper_bound(problem, own, effort, &mut stages.search);
                return (Proof { lower_bound, upper_bound, boxes, better, verdict }, best);
            }
            Found::Better(point) => point,
        };
        match minimax::minimise(problem, &point, &mut stages.minimax) {
            Ok(outcome) if is_lower(&outcome, own) => best = Some(outcome),
            _ => return (Proof { boxes, better, ..Proof::none(Reason::Unfinished) }, best),
        }
    }
    (Proof { boxes, better: MOST_BETTER, ..Proof::none(Reason::Unfinished) }, best)
}
