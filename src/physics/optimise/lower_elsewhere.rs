//! Ends of fronts of several absorbers against the whole box: what is lower there is followed, and nothing else.

use super::search::is_lower;
use super::survey::Points;
use super::{Optimum, Problem, minimax};
use crate::objective::HELD;
use crate::response::Work;
use rayon::prelude::*;

/// Most designs that are followed.
const MOST: usize = 6;

/// Looks over the ends and corners of the box and random designs for some that hold all limits and are lower than an optimum, and keeps what the lowest of them lead to.
pub(super) fn lower_elsewhere(problem: &Problem, optimum: &mut Optimum, seed: u64) {
    let (rows, value) = (optimum.outcome.rows.clone(), optimum.value());
    let judge = |w: Vec<f64>| {
        let mut work = Work::default();
        if problem.is_surely_above(&w, (&rows, value), &mut work) {
            work.evaluations += 1;
            return (None, work);
        }
        let judged = problem.value_below(&w, value, &mut work).ok();
        (judged.filter(|(own, excess)| *own < value && *excess <= HELD).map(|(own, _)| (own, w)), work)
    };
    let judged: Vec<_> = Points::over(problem, &optimum.outcome.point, seed).list.into_par_iter().map(judge).collect();
    judged.iter().for_each(|j| optimum.stages.search += j.1);
    let mut lower: Vec<(f64, Vec<f64>)> = judged.into_iter().filter_map(|j| j.0).collect();
    lower.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (_, point) in lower.into_iter().take(MOST) {
        if let Ok(outcome) = minimax::minimise(problem, &point, &mut optimum.stages.minimax)
            && is_lower(&outcome, &optimum.outcome)
        {
            optimum.replace(problem, outcome);
        }
    }
}
