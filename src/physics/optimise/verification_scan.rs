//! An optimum held against designs that no start comes from.

use super::minimax::{self, Outcome};
use super::problem::UNBOUNDED_COST;
use super::search::{LOWER, is_lower};
use super::{Optimum, Problem};
use crate::numerics::elementary::Elementary;
use crate::objective::HELD;
use crate::response::Work;
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
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

/// What random designs near an optimum say of it.
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize)]
pub struct Nearby {
    /// Designs that were looked at.
    pub designs: usize,
    /// Whether one of them led to a better optimum, which was kept.
    pub better: bool,
}

/// Random designs near an optimum, the farthest by this in each coordinate (nearly a factor of e^0.5), the nearest by a ten-thousandth of that.
const NEAR: usize = 40;
const FARTHEST: f64 = 0.5;
const DECADES: f64 = 4.0;

/// Looks at random designs round an optimum, ever nearer, and follows the lowest where it is lower.
#[doc(hidden)]
pub fn nearby(problem: &Problem, optimum: &mut Optimum, seed: u64) -> Nearby {
    let bounds = problem.space.bounds();
    if bounds.is_empty() {
        return Nearby::default();
    }
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let points: Vec<Vec<f64>> = (0..NEAR)
        .map(|i| {
            let size = FARTHEST * 10f64.power(-DECADES * i as f64 / (NEAR - 1) as f64);
            let near = optimum.outcome.point.iter().zip(&bounds);
            near.map(|(w, (low, high))| (w + size * random.random_range(-1.0..1.0)).clamp(*low, *high)).collect()
        })
        .collect();
    let merits: Vec<(f64, Work)> = points
        .par_iter()
        .map(|w| {
            let mut work = Work::default();
            if problem.is_surely_above(w, (&optimum.outcome.rows, optimum.value()), &mut work) {
                work.evaluations += 1;
                return (f64::INFINITY, work);
            }
            let (value, excess) = problem.exactly(w, &mut work).unwrap_or((f64::INFINITY, 0.0));
            (if excess > HELD { f64::INFINITY } else { value }, work)
        })
        .collect();
    merits.iter().for_each(|m| optimum.stages.search += m.1);
    let mut found = Nearby { designs: points.len(), better: false };
    let lowest = (0..points.len()).fold(0, |m, i| if merits[i].0 < merits[m].0 { i } else { m });
    let held = optimum.outcome.rows.hold();
    if held
        && merits[lowest].0 < optimum.value() * (1.0 - LOWER)
        && let Ok(outcome) = minimax::minimise(problem, &points[lowest], &mut optimum.stages.minimax)
        && is_lower(&outcome, &optimum.outcome)
    {
        optimum.replace(problem, outcome);
        found.better = true;
    }
    found
}

/// Most designs of a scan that are followed.
const MOST_FOLLOWED: usize = 6;

/// Looks along lines of designs that no start comes from, and follows the lowest: starts that agree may all have missed what lies elsewhere.
#[doc(hidden)]
pub fn scan(problem: &Problem, optimum: &mut Optimum, lines: &[Vec<Vec<f64>>]) -> Scan {
    let costs: Vec<Vec<(f64, Work)>> = lines
        .par_iter()
        .map(|line| {
            let cost_at = |w: &Vec<f64>| {
                let mut work = Work::default();
                (problem.cost(w, &mut work), work)
            };
            line.iter().map(cost_at).collect()
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
    let known = &optimum.outcome;
    let ends: Vec<(Option<Outcome>, Work)> = lowest
        .par_iter()
        .map(|(_, w)| {
            let mut work = Work::default();
            (minimax::minimise_towards(problem, w, known, &mut work).ok(), work)
        })
        .collect();
    let mut scan = Scan { designs: lines.iter().map(Vec::len).sum(), followed: ends.len(), better: false };
    for (outcome, work) in ends {
        optimum.stages.minimax += work;
        if let Some(outcome) = outcome.filter(|o| is_lower(o, &optimum.outcome)) {
            optimum.replace(problem, outcome);
            scan.better = true;
        }
    }
    scan
}
