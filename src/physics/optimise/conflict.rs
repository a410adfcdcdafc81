//! Limits that cannot hold together: which of them, how near to them a design may come, and how far one would have to be loosened.

use super::checkpoint::Remembers;
use super::search::{Stages, Start};
use super::starts::NamedPoint;
use super::{Optimum, Problem, Role, minimax, search, survey};
use crate::objective::{Limit, holds};
use crate::response::{ResponseError, Work};
use rayon::prelude::*;

/// A limit that takes part in a conflict.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Party {
    /// Index of the limit.
    pub limit: usize,
    /// Its share in what keeps the violation from falling: all of them sum to one.
    pub share: f64,
    /// The least factor on this limit alone with which all others were found to hold; nothing where no such design was found.
    pub loosened: Option<f64>,
}

/// Limits that no design of a family was found to hold together.
#[derive(Debug, Clone, serde::Serialize)]
pub struct Conflict {
    /// The least largest ratio of a measure to its limit that was found.
    pub ratio: f64,
    /// Those that keep it from falling, the largest share first.
    pub parties: Vec<Party>,
}

/// Shares below this are rounding.
const LEAST_SHARE: f64 = 1e-4;

/// What an optimum with a broken limit comes to: another optimum from a design that holds all limits, where there is one, or the conflict.
#[doc(hidden)]
pub enum Verdict {
    /// From a point at which all limits hold.
    Found(Box<minimax::Outcome>),
    /// There is none: the design that comes nearest to all limits, and what keeps it from them.
    Conflict(Box<Optimum>, Conflict),
}

/// Looks for a design that holds all limits, from the starts of a search, the corners of the box and from the end of the search.
///
/// # Errors
/// [`ResponseError::Unbounded`] where no start has a finite response.
#[doc(hidden)]
pub fn judge(problem: &Problem, optimum: &Optimum, starts: &[NamedPoint]) -> Result<Verdict, ResponseError> {
    let corners = survey::corners(&problem.space.bounds()).into_iter().map(|point| ("corner".into(), point));
    let mut all: Vec<NamedPoint> = starts.iter().cloned().chain(corners).collect();
    all.push(("optimum".into(), optimum.outcome.point.clone()));
    let nearest = search::optimise(&survey::feasibility(problem), &all, search::Finish::All, &|| {})?;
    verdict(problem, nearest, all)
}

/// The same by the minimax method alone, from starts near what is sought: of problems whose designs take long.
///
/// # Errors
/// As [`judge`].
#[doc(hidden)]
pub fn judge_near(problem: &Problem, starts: Vec<NamedPoint>) -> Result<Verdict, ResponseError> {
    let feasibility = survey::feasibility(problem);
    let run = |(name, point): &NamedPoint| {
        let mut stages = Stages::default();
        let seed = feasibility.cost(point, &mut stages.seeds);
        let outcome = minimax::minimise(&feasibility, point, &mut stages.minimax);
        let finished = outcome.as_ref().map_or(f64::INFINITY, search::cost);
        let holds = outcome.as_ref().is_ok_and(|o| o.rows.hold());
        (Start { name: name.clone(), seed, searched: seed, finished, holds }, outcome, stages)
    };
    let runs: Vec<_> = starts.par_iter().map(run).collect();
    let (mut log, mut ends, mut stages) = (Vec::new(), Vec::new(), Stages::default());
    for (start, outcome, spent) in runs {
        stages.add(spent);
        log.push(start);
        ends.push(outcome);
    }
    let (outcome, others) = search::best_of(&feasibility, ends)?;
    verdict(problem, Optimum { design: problem.space.design(&outcome.point), outcome, starts: log, others, stages }, starts)
}

/// What the design that is nearest to all limits comes to, and from which points limits are loosened.
fn verdict(problem: &Problem, mut nearest: Optimum, mut all: Vec<NamedPoint>) -> Result<Verdict, ResponseError> {
    let ratio = nearest.outcome.rows.objective();
    if holds(ratio) {
        let mut outcome = minimax::minimise(problem, &nearest.outcome.point, &mut Work::default())?;
        if !outcome.rows.hold() {
            // what holds all limits is kept as it is
            outcome = nearest.outcome;
            outcome.rows = problem.rows(&outcome.point, &mut Work::default())?;
            outcome.multipliers = vec![0.0; outcome.rows.rows.len()];
        }
        return Ok(Verdict::Found(Box::new(outcome)));
    }
    let mut shares = vec![0.0; problem.limits.len()];
    for (row, multiplier) in nearest.outcome.rows.rows.iter().zip(&nearest.outcome.multipliers) {
        if let Role::Objective(limit) = row.role {
            shares[limit] += multiplier;
        }
    }
    all.push(("nearest".into(), nearest.outcome.point.clone()));
    let mut parties: Vec<Party> = shares
        .iter()
        .enumerate()
        .filter(|s| *s.1 > LEAST_SHARE)
        .map(|(limit, share)| Ok(Party { limit, share: *share, loosened: loosened(problem, limit, &all) }))
        .collect::<Result<_, ResponseError>>()?;
    parties.sort_by(|a, b| b.share.total_cmp(&a.share));
    // what its rows are in the problem itself
    nearest.outcome.rows = problem.rows(&nearest.outcome.point, &mut Work::default())?;
    nearest.outcome.multipliers = vec![0.0; nearest.outcome.rows.rows.len()];
    Ok(Verdict::Conflict(Box::new(nearest), Conflict { ratio, parties }))
}

/// The least ratio of one limit within all others that is found from some points.
fn loosened(problem: &Problem, limit: usize, points: &[NamedPoint]) -> Option<f64> {
    let others: Vec<Limit> = problem.limits.iter().enumerate().filter(|l| l.0 != limit).map(|l| l.1.clone()).collect();
    let objectives = std::slice::from_ref(&problem.limits[limit]);
    let alone = Problem {
        load_cases: problem.load_cases,
        space: problem.space.clone(),
        objectives,
        weights: &[],
        limits: &others,
        memory: problem.memory.map(Remembers::part),
    };
    let ends = points.par_iter().filter_map(|p| minimax::minimise(&alone, &p.1, &mut Work::default()).ok());
    let held = ends.filter(|o| o.rows.hold()).map(|o| o.rows.objective());
    held.collect::<Vec<_>>().into_iter().reduce(f64::min)
}
