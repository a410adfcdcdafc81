//! The front of ring inertia against the objective: the optimum followed along the inertia.

use super::minimax::{self, Outcome};
use super::search::{self, Finish, Recorder};
use super::starts::Starts;
use super::{Problem, Proof, Space};
use crate::absorber::Mounted;
use crate::numerics::elementary::Elementary;
use crate::objective::HELD;
use crate::response::{ResponseError, Work};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

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
    /// That no design with its ring inertia is better, where that is asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proof: Option<Proof>,
}

/// A front and the work it took.
#[derive(Debug, Clone, serde::Serialize)]
pub struct Front {
    /// By ascending ring inertia.
    pub points: Vec<FrontPoint>,
    /// Evaluations.
    pub work: Work,
}

/// A known optimum leads to that of an inertia which differs by no more than this share.
const NEXT_TO: f64 = 0.04;
/// From one inertia to the next a coordinate differs by no more than this from where it is expected, unless another branch takes over.
const JUMP: f64 = 0.4;
/// An optimum that is lower than another by more than this share is a better one.
const BETTER: f64 = 1e-9;
/// Points between two heads, about: fixed, so that the result does not depend on threads.
const SEGMENT: usize = 17;

/// An optimum for a ring inertia, as a global search has found it.
#[derive(Debug, Clone)]
#[doc(hidden)]
pub struct KnownOptimum<'a> {
    /// Its family.
    pub space: Space,
    /// The optimum.
    pub outcome: &'a Outcome,
}

/// Points that others are walked to from: those next to known optima, with these, both ends, and some between where these are far apart.
fn heads<'k, 'a>(inertias: &[f64], known: &'k [KnownOptimum<'a>]) -> BTreeMap<usize, Option<&'k KnownOptimum<'a>>> {
    let last = inertias.len() - 1;
    let ring = |optimum: &KnownOptimum| optimum.space.slots[0].values[0];
    let apart = |i: usize, optimum: &KnownOptimum| (inertias[i] / ring(optimum)).logarithm().abs();
    let mut heads: BTreeMap<usize, Option<&KnownOptimum>> = [(0, None), (last, None)].into();
    for optimum in known {
        let nearest = (0..=last).fold(0, |m, i| if apart(i, optimum) < apart(m, optimum) { i } else { m });
        let nearer = heads.get(&nearest).copied().flatten().is_none_or(|k| apart(nearest, optimum) < apart(nearest, k));
        if apart(nearest, optimum) <= NEXT_TO && nearer {
            heads.insert(nearest, Some(optimum));
        }
    }
    let own: Vec<usize> = heads.keys().copied().collect();
    for ends in own.windows(2) {
        let parts = ((ends[1] - ends[0]) as f64 / SEGMENT as f64).round().max(1.0) as usize;
        heads.extend((1..parts).map(|k| (ends[0] + k * (ends[1] - ends[0]) / parts, None)));
    }
    heads
}

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

/// What is followed: a problem over ring inertias, ascending.
struct Follower<'a> {
    problem: &'a Problem<'a>,
    inertias: &'a [f64],
    starts: Starts<'a>,
    recorder: Recorder<'a>,
}

impl<'a> Follower<'a> {
    fn at(&self, i: usize) -> Problem<'a> {
        Problem { space: self.problem.space.with_ring_inertia(self.inertias[i]), ..*self.problem }
    }

    /// The optimum for an inertia by a global search.
    fn searched(&self, i: usize) -> Result<(Outcome, Work), ResponseError> {
        let problem = self.at(i);
        let optimum = search::optimise(&problem, &(self.starts)(&problem.space), Finish::Distinct, &|| {})?;
        (self.recorder)();
        let work = optimum.stages.all();
        Ok((optimum.outcome, work))
    }

    /// The optimum followed from one over some inertias, as long as `go_on` says so.
    fn walk(
        &self,
        (mut space, mut outcome): (Space, Outcome),
        over: impl Iterator<Item = usize>,
        go_on: impl Fn(usize, &Outcome) -> bool,
    ) -> Result<(Vec<(usize, Outcome)>, Work), ResponseError> {
        let mut work = Work::default();
        // by how much the last optimum lay beside where it was expected: the next one does so, too
        let mut beside = vec![0.0; outcome.point.len()];
        let mut outcomes = Vec::new();
        for i in over {
            let problem = self.at(i);
            let guess = problem.space.point(&retuned(&space, &outcome.point, self.inertias[i]));
            let near = guess.iter().zip(&beside).zip(problem.space.bounds());
            let start: Vec<f64> = near.map(|((g, b), (low, high))| (g + b).clamp(low, high)).collect();
            outcome = minimax::minimise_with(&problem, &start, outcome.curvature, &mut work)?;
            beside = outcome.point.iter().zip(&guess).map(|(p, g)| p - g).collect();
            space = problem.space;
            (self.recorder)();
            if !go_on(i, &outcome) {
                break;
            }
            outcomes.push((i, outcome.clone()));
        }
        Ok((outcomes, work))
    }

    /// Optima that others are walked to from.
    fn heads(&self, known: &[KnownOptimum], work: &mut Work) -> Result<BTreeMap<usize, Outcome>, ResponseError> {
        let head_of = |(i, known): (usize, Option<&KnownOptimum>)| {
            let walked = |k: &KnownOptimum| self.walk((k.space.clone(), k.outcome.clone()), std::iter::once(i), |_, _| true);
            match known.map(walked) {
                Some(Ok((mut found, work))) => Ok((i, (found.swap_remove(0).1, work))),
                // a step may lead to a design without a finite response
                Some(Err(_)) | None => Ok((i, self.searched(i)?)),
            }
        };
        let found: Vec<(usize, (Outcome, Work))> =
            heads(self.inertias, known).into_par_iter().map(head_of).collect::<Result<_, ResponseError>>()?;
        found.iter().for_each(|f| *work += f.1.1);
        Ok(found.into_iter().map(|(i, (outcome, _))| (i, outcome)).collect())
    }

    /// Each interval between two heads is walked from its left and from its right one: between heads of one branch another may be better.
    fn between(&self, heads: BTreeMap<usize, Outcome>, work: &mut Work) -> Result<Vec<Outcome>, ResponseError> {
        let knots: Vec<(&usize, &Outcome)> = heads.iter().collect();
        let walks: Vec<(Vec<(usize, Outcome)>, Work)> = (0..2 * (knots.len() - 1))
            .into_par_iter()
            .map(|i| {
                let (left, right) = (*knots[i / 2].0, *knots[i / 2 + 1].0);
                let inner: Vec<usize> = if i % 2 == 0 { (left + 1..right).collect() } else { (left + 1..right).rev().collect() };
                let (head, outcome) = knots[i / 2 + i % 2];
                self.walk((self.at(*head).space, outcome.clone()), inner.into_iter(), |_, _| true)
            })
            .collect::<Result<_, _>>()?;
        let mut best = heads;
        for (outcomes, spent) in walks {
            *work += spent;
            for (i, outcome) in outcomes {
                if best.get(&i).is_none_or(|b| outcome.merit() < b.merit()) {
                    best.insert(i, outcome);
                }
            }
        }
        Ok(best.into_values().collect())
    }

    /// Points under limits that do worse than the one before, the first and the last of each run: a ring may be too heavy for its limits, or the branch that was followed is not the best one.
    fn worse_than_lighter(&self, best: &[Outcome]) -> Vec<usize> {
        let worse = |i: usize| (1..best.len()).contains(&i) && Self::is_better(&best[i - 1], &best[i]);
        let runs = (1..best.len()).filter(|i| worse(*i) && !(worse(i - 1) && worse(i + 1)));
        if self.problem.limits.is_empty() { Vec::new() } else { runs.collect() }
    }

    fn is_better(own: &Outcome, known: &Outcome) -> bool {
        let (own, known) = (own.merit(), known.merit());
        own.0 < known.0 || (own.0 == known.0 && own.1 < known.1 * (1.0 - BETTER))
    }

    /// The best for an inertia of a global search and of steps from the points beside it.
    fn looked_at(&self, i: usize, best: &[Outcome]) -> Result<(Outcome, Work), ResponseError> {
        let (mut outcome, mut work) = self.searched(i)?;
        for beside in [i.checked_sub(1), (i + 1 < best.len()).then_some(i + 1)].into_iter().flatten() {
            // a step may lead to a design without a finite response
            let Ok((found, spent)) = self.walk((self.at(beside).space, best[beside].clone()), std::iter::once(i), |_, _| true) else {
                continue;
            };
            work += spent;
            for (_, own) in found {
                if Self::is_better(&own, &outcome) {
                    outcome = own;
                }
            }
        }
        Ok((outcome, work))
    }

    /// Where the optimum jumps from one inertia to the next, two branches cross, and a third may be better there: both are searched, and what is better is followed to both sides. So are points that do worse than
    /// lighter rings.
    fn look_at_jumps(&self, best: &mut [Outcome], work: &mut Work) -> Result<(), ResponseError> {
        let jumps = |i: &usize| {
            let (own, next) = (self.at(*i).space, self.at(i + 1).space);
            let guess = next.point(&retuned(&own, &best[*i].point, self.inertias[i + 1]));
            guess.iter().zip(&best[i + 1].point).any(|(g, p)| (g - p).abs() > JUMP)
        };
        let beside: BTreeSet<usize> =
            (0..best.len() - 1).filter(jumps).flat_map(|i| [i, i + 1]).chain(self.worse_than_lighter(best)).collect();
        // these are no points of their own
        let silent = Follower { recorder: &|| {}, ..*self };
        let found: Vec<(usize, (Outcome, Work))> =
            beside.into_par_iter().map(|i| Ok((i, silent.looked_at(i, best)?))).collect::<Result<_, ResponseError>>()?;
        for (i, (outcome, spent)) in found {
            *work += spent;
            let better = |i: usize, o: &Outcome, best: &[Outcome]| Self::is_better(o, &best[i]);
            if !better(i, &outcome, best) {
                continue;
            }
            let known: &[Outcome] = best;
            let to = |side: Vec<usize>| silent.walk((self.at(i).space, outcome.clone()), side.into_iter(), |i, o| better(i, o, known));
            let (after, before) = rayon::join(|| to((i + 1..known.len()).collect()), || to((0..i).rev().collect()));
            best[i] = outcome;
            // where a design has no finite response the way ends
            for (outcomes, spent) in [after, before].into_iter().flatten() {
                *work += spent;
                outcomes.into_iter().for_each(|(i, outcome)| best[i] = outcome);
            }
        }
        Ok(())
    }
}

/// Follows the optimum over `inertias` (ascending). It begins next to `known` optima; where there are none, at both ends and about every seventeenth inertia with a global search from `starts`. In
/// between the optimum is followed from both sides by the minimax method, and the better one kept; where it jumps, both points are searched again.
///
/// # Errors
/// [`ResponseError::Unbounded`] where no start has a finite response.
#[doc(hidden)]
pub fn follow(
    problem: &Problem,
    (inertias, known): (&[f64], &[KnownOptimum]),
    starts: Starts,
    recorder: Recorder,
) -> Result<Front, ResponseError> {
    let follower = Follower { problem, inertias, starts, recorder };
    let mut work = Work::default();
    let heads = follower.heads(known, &mut work)?;
    let mut best = follower.between(heads, &mut work)?;
    follower.look_at_jumps(&mut best, &mut work)?;
    let points = best.into_iter().enumerate().map(|(i, o)| {
        let design = follower.at(i).space.design(&o.point);
        let (value, excess) = (o.rows.objective(), o.rows.excess());
        FrontPoint { design, value, excess, kkt_residual: o.kkt_residual, dominated: false, proof: None }
    });
    let mut points: Vec<FrontPoint> = points.collect();
    mark_dominated(&mut points);
    Ok(Front { points, work })
}

/// Tells of each point, by ascending inertia, whether a lighter ring does as well or a limit fails.
pub(super) fn mark_dominated(points: &mut [FrontPoint]) {
    let mut lowest = f64::INFINITY;
    for p in points {
        let holds = p.excess <= HELD;
        p.dominated = p.value >= lowest || !holds;
        if holds {
            lowest = lowest.min(p.value);
        }
    }
}
