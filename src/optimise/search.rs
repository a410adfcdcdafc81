//! A global search: closed-form and random starts, each searched without derivatives, then finished by the minimax method.

use super::problem::{PENALTY, UNBOUNDED_COST};
use super::{Problem, gradient_free, minimax};
use crate::absorber::Mounted;
use crate::response::{ResponseError, Work};
use minimax::Outcome;
use rayon::prelude::*;

/// Told of progress: once for every start and every front point that is done.
pub(crate) type Recorder<'a> = &'a (dyn Fn() + Sync);

/// Evaluations without derivatives from each start.
const SEARCH_EVALUATIONS: u64 = 150;
/// Starts that end within this share of the best have found the same optimum.
pub(crate) const SAME: f64 = 1e-6;

/// One start and where it led.
#[derive(Debug, Clone, serde::Serialize)]
pub struct Start {
    /// Where it came from.
    pub name: String,
    /// Cost there.
    pub seed: f64,
    /// Cost after the search without derivatives.
    pub searched: f64,
    /// Cost after the minimax method.
    pub finished: f64,
}

/// Work by stage.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Serialize)]
pub struct Stages {
    /// Evaluations of the starts.
    pub seeds: Work,
    /// Search without derivatives.
    pub search: Work,
    /// Minimax.
    pub minimax: Work,
}

/// The best design found, and how.
#[derive(Debug, Clone, serde::Serialize)]
pub struct Optimum {
    /// The design.
    pub design: Vec<Mounted>,
    /// The end of the best start.
    pub outcome: Outcome,
    /// Every start.
    pub starts: Vec<Start>,
    /// Evaluations.
    pub stages: Stages,
}

impl Optimum {
    /// Value of the objective.
    pub fn value(&self) -> f64 {
        self.outcome.rows.objective()
    }

    /// How many starts ended at the best value.
    pub fn agreeing(&self) -> usize {
        let best = self.starts.iter().map(|s| s.finished).fold(f64::INFINITY, f64::min);
        self.starts.iter().filter(|s| s.finished <= best * (1.0 + SAME)).count()
    }
}

fn cost(outcome: &Outcome) -> f64 {
    outcome.rows.objective() * (1.0 + PENALTY * outcome.rows.excess())
}

/// Runs every start and keeps the best; the first of equals, so that threads change nothing.
///
/// # Errors
/// The error of the first start, where no start has a finite response.
pub fn optimise(problem: &Problem, starts: &[(String, Vec<f64>)], recorder: Recorder) -> Result<Optimum, ResponseError> {
    let runs: Vec<_> = starts
        .par_iter()
        .map(|(name, w)| {
            let mut stages = Stages::default();
            let seed = problem.cost(w, &mut stages.seeds);
            let (mut searched, mut value) = gradient_free::search(problem, w, SEARCH_EVALUATIONS, &mut stages.search);
            if seed < value {
                (searched, value) = (w.clone(), seed);
            }
            let outcome = minimax::minimise(problem, &searched, &mut stages.minimax);
            recorder();
            (Start { name: name.clone(), seed, searched: value, finished: outcome.as_ref().map_or(f64::INFINITY, cost) }, outcome, stages)
        })
        .collect();
    let mut stages = Stages::default();
    let mut log = Vec::new();
    let mut best: Option<Outcome> = None;
    let mut error = None;
    for (start, outcome, work) in runs {
        stages.seeds += work.seeds;
        stages.search += work.search;
        stages.minimax += work.minimax;
        log.push(start);
        match outcome {
            Ok(o) if best.as_ref().is_none_or(|b| cost(&o) < cost(b) * (1.0 - 1e-12)) => best = Some(o),
            Ok(_) => {}
            Err(e) => error = error.or(Some(e)),
        }
    }
    match (best, error) {
        (Some(outcome), _) => Ok(Optimum { design: problem.space.design(&outcome.point), outcome, starts: log, stages }),
        (None, Some(e)) => Err(e),
        (None, None) => unreachable!("a search has at least one start"),
    }
}

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
