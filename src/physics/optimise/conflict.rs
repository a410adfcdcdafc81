//! Limits that cannot hold together: which of them, how near to them a design may come, and how far one would have to be loosened.

use super::checkpoint::Remembers;
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

/// Looks for a design that holds all limits, from the starts of a search and from its end.
///
/// # Errors
/// [`ResponseError::Unbounded`] where no start has a finite response.
#[doc(hidden)]
pub fn judge(problem: &Problem, optimum: &Optimum, starts: &[(String, Vec<f64>)]) -> Result<Verdict, ResponseError> {
    let feasibility = survey::feasibility(problem);
    let mut all = starts.to_vec();
    all.extend(corners(&problem.space.bounds()).into_iter().map(|point| ("corner".into(), point)));
    all.push(("optimum".into(), optimum.outcome.point.clone()));
    let mut nearest = search::optimise(&feasibility, &all, search::Finish::All, &|| {})?;
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

/// Corners of a box are starts where it has no more of them.
const MOST_CORNERS: usize = 64;

/// The corners of a box; none of one that has too many: rings that are nearly locked and rings on soft springs hold what others break.
fn corners(bounds: &[(f64, f64)]) -> Vec<Vec<f64>> {
    let count = 1usize.checked_shl(bounds.len() as u32).filter(|count| *count <= MOST_CORNERS).unwrap_or(0);
    let corner = |c: usize| bounds.iter().enumerate().map(|(i, b)| if c >> i & 1 == 0 { b.0 } else { b.1 }).collect();
    (0..count).map(corner).collect()
}

/// The least ratio of one limit within all others that is found from some points.
fn loosened(problem: &Problem, limit: usize, points: &[(String, Vec<f64>)]) -> Option<f64> {
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
