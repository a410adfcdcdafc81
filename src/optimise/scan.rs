//! An optimum held against designs that no start comes from.

use super::minimax::{self, Outcome};
use super::problem::UNBOUNDED_COST;
use super::search::cost;
use super::{Optimum, Problem};
use crate::response::Work;
use rayon::prelude::*;

/// What designs elsewhere say of an optimum.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Serialize)]
pub struct Scan {
    /// Designs that were looked at.
    pub designs: usize,
    /// Those from which the minimax method was run: the lowest of their neighbours.
    pub followed: usize,
    /// Whether one of them led to a better optimum, which was kept.
    pub better: bool,
}

/// Most designs of a scan that are followed.
const MOST_FOLLOWED: usize = 6;
/// A scan's end is better where it is lower by this share.
const LOWER: f64 = 1e-9;

/// Looks along lines of designs that no start comes from, and follows the lowest: starts that agree may all have missed what lies elsewhere.
pub(crate) fn scan(problem: &Problem, optimum: &mut Optimum, lines: &[Vec<Vec<f64>>]) -> Scan {
    let costs: Vec<Vec<(f64, Work)>> = lines
        .par_iter()
        .map(|line| {
            let at = |w: &Vec<f64>| {
                let mut work = Work::default();
                (problem.cost(w, &mut work), work)
            };
            line.iter().map(at).collect()
        })
        .collect();
    costs.iter().flatten().for_each(|c| optimum.stages.search += c.1);
    let mut lowest: Vec<(f64, &Vec<f64>)> = Vec::new();
    for (line, costs) in lines.iter().zip(&costs) {
        for i in 0..line.len() {
            let beside = |j: usize| costs.get(j).is_none_or(|c| costs[i].0 <= c.0);
            if beside(i.wrapping_sub(1)) && beside(i + 1) && costs[i].0 < UNBOUNDED_COST {
                lowest.push((costs[i].0, &line[i]));
            }
        }
    }
    lowest.sort_by(|a, b| a.0.total_cmp(&b.0));
    lowest.truncate(MOST_FOLLOWED);
    let ends: Vec<(Option<Outcome>, Work)> = lowest
        .par_iter()
        .map(|(_, w)| {
            let mut work = Work::default();
            (minimax::minimise(problem, w, &mut work).ok(), work)
        })
        .collect();
    let mut scan = Scan { designs: lines.iter().map(Vec::len).sum(), followed: ends.len(), better: false };
    for (outcome, work) in ends {
        optimum.stages.minimax += work;
        if let Some(outcome) = outcome.filter(|o| cost(o) < cost(&optimum.outcome) * (1.0 - LOWER)) {
            optimum.design = problem.space.design(&outcome.point);
            optimum.outcome = outcome;
            scan.better = true;
        }
    }
    scan
}
