//! A global search: closed-form and random starts, each searched without derivatives, then finished by the minimax method.

use super::problem::PENALTY;
use super::{Problem, gradient_free, minimax};
use crate::absorber::Mounted;
use crate::response::{ResponseError, Work};
use minimax::Outcome;
use rayon::prelude::*;

/// Told of progress: once for every start and every front point that is done.
#[doc(hidden)]
pub type Recorder<'a> = &'a (dyn Fn() + Sync);

/// Evaluations without derivatives from each start.
const SEARCH_EVALUATIONS: u64 = 150;
/// Starts that end within this share of the best have found the same optimum.
pub(crate) const SAME: f64 = 1e-6;
/// A design that is better than all starts' ends by more than this share was found from elsewhere.
const ELSEWHERE: f64 = 1e-4;

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
    /// Whether its end holds all limits.
    pub holds: bool,
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

impl Stages {
    pub(super) fn add(&mut self, other: Self) {
        self.seeds += other.seeds;
        self.search += other.search;
        self.minimax += other.minimax;
    }

    /// Of all stages.
    #[doc(hidden)]
    pub fn all(&self) -> Work {
        let mut all = self.seeds;
        all += self.search;
        all += self.minimax;
        all
    }
}

/// Another design that meets the first-order conditions.
#[derive(Debug, Clone, serde::Serialize)]
pub struct LocalOptimum {
    /// The design.
    pub design: Vec<Mounted>,
    /// Value of the objective.
    pub value: f64,
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
    /// Where others ended within all limits and met the first-order conditions: the best first.
    pub others: Vec<LocalOptimum>,
    /// Evaluations.
    pub stages: Stages,
}

impl Optimum {
    /// Value of the objective.
    pub fn value(&self) -> f64 {
        self.outcome.rows.objective()
    }

    /// A better outcome takes its place; it stays as another local optimum.
    pub(super) fn replace(&mut self, problem: &Problem, outcome: Outcome) {
        if self.outcome.meets_first_order() && self.outcome.rows.hold() {
            self.others.insert(0, LocalOptimum { design: self.design.clone(), value: self.value() });
        }
        self.design = problem.space.design(&outcome.point);
        self.outcome = outcome;
    }

    /// Starts whose ends count: those that hold all limits, or all where none does.
    #[doc(hidden)]
    pub fn ended(&self) -> impl Iterator<Item = &Start> {
        let any = self.starts.iter().any(|s| s.holds);
        self.starts.iter().filter(move |s| s.holds || !any)
    }

    /// Starts that ended level with the best of them; all, where none of them led to the best design.
    pub(super) fn level_starts(&self) -> impl Iterator<Item = &str> {
        let least = self.ended().map(|s| s.finished).fold(f64::INFINITY, f64::min);
        let level = if least > self.value() * (1.0 + ELSEWHERE) { f64::INFINITY } else { least * (1.0 + SAME) };
        let any = self.starts.iter().any(|s| s.holds);
        self.starts.iter().filter(move |s| s.finished <= level && (s.holds || !any || level.is_infinite())).map(|s| s.name.as_str())
    }

    /// How many starts ended at the best value.
    pub fn agreeing(&self) -> usize {
        let best = self.ended().map(|s| s.finished).fold(f64::INFINITY, f64::min);
        self.ended().filter(|s| s.finished <= best * (1.0 + SAME)).count()
    }
}

pub(super) fn cost(outcome: &Outcome) -> f64 {
    outcome.rows.objective() * (1.0 + PENALTY * outcome.rows.excess())
}

/// An end is lower than another by more than this share, or it is level with it.
pub(super) const LOWER: f64 = 1e-9;

/// Whether an outcome is lower than another by more than rounding; one that holds all limits is lower than any that does not.
pub(super) fn is_lower(a: &Outcome, b: &Outcome) -> bool {
    match (a.rows.hold(), b.rows.hold()) {
        (true, false) => true,
        (false, true) => false,
        _ => cost(a) < cost(b) * (1.0 - LOWER),
    }
}

/// Whether an outcome holds all limits where another does not, is lower, or level and closer to first-order conditions.
fn is_better(a: &Outcome, b: &Outcome) -> bool {
    if a.rows.hold() != b.rows.hold() {
        return a.rows.hold();
    }
    let (own, other) = (cost(a), cost(b));
    own < other * (1.0 - LEVEL) || (own < other * (1.0 + LEVEL) && a.kkt_residual < b.kkt_residual)
}

/// Which starts are finished by the minimax method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Finish {
    /// Every one: how many agree is a finding.
    All,
    /// Of those that the search without derivatives brought together only the best.
    Distinct,
}

/// Where the search without derivatives has led from a start.
#[derive(Debug, Clone)]
struct Searched {
    point: Vec<f64>,
    /// Cost at the start, and there.
    seed: f64,
    value: f64,
    stages: Stages,
}

/// Costs that differ by less than this share are level.
const LEVEL: f64 = 1e-12;
/// Ends closer than this in every coordinate are one.
const APART: f64 = 1e-3;
/// Points closer than this in every coordinate are of one basin.
const TOGETHER: f64 = 0.1;

/// Starts that [`lowest_nearby`] goes from, and its evaluations from each.
const NEARBY: usize = 2;
const NEARBY_EVALUATIONS: u64 = 60;

/// Runs every start and keeps the best; of level ones the one closest to first-order conditions, in the order of the starts, so that threads change nothing.
///
/// # Errors
/// The error of the first start, where no start has a finite response.
pub fn optimise(problem: &Problem, starts: &[(String, Vec<f64>)], finish: Finish, recorder: Recorder) -> Result<Optimum, ResponseError> {
    let searched = |w: &Vec<f64>| {
        let mut stages = Stages::default();
        let seed = problem.cost(w, &mut stages.seeds);
        let (point, value) = gradient_free::search(problem, w, SEARCH_EVALUATIONS, &mut stages.search);
        if seed < value { Searched { point: w.clone(), seed, value: seed, stages } } else { Searched { point, seed, value, stages } }
    };
    let mut stages = Stages::default();
    let all: Vec<Searched> = starts.par_iter().map(|start| searched(&start.1)).collect();
    let kept: Vec<usize> = match finish {
        Finish::All => (0..all.len()).collect(),
        Finish::Distinct => distinct(&all),
    };
    (0..all.len()).filter(|i| !kept.contains(i)).for_each(|i| stages.add(all[i].stages));
    let finished = |i: &usize, known: Option<&Outcome>| {
        let Searched { point, seed, value: searched, mut stages } = all[*i].clone();
        let outcome = match known {
            Some(known) => minimax::minimise_towards(problem, &point, known, &mut stages.minimax),
            None => minimax::minimise(problem, &point, &mut stages.minimax),
        };
        recorder();
        let finished = outcome.as_ref().map_or(f64::INFINITY, cost);
        let holds = outcome.as_ref().is_ok_and(|o| o.rows.hold());
        (*i, (Start { name: starts[*i].0.clone(), seed, searched, finished, holds }, outcome, stages))
    };
    // the best, and what the search has not brought next to it; the others, which may lead to the same optimum, after that
    let best = kept.iter().copied().reduce(|m, i| if all[i].value < all[m].value { i } else { m });
    let (later, first): (Vec<usize>, Vec<usize>) =
        kept.into_iter().partition(|i| best.is_some_and(|best| best != *i && together(&all[best].point, &all[*i].point)));
    let mut runs: Vec<_> = first.par_iter().map(|i| finished(i, None)).collect();
    let known = runs.iter().find(|r| Some(r.0) == best).and_then(|r| r.1.1.as_ref().ok()).cloned();
    runs.par_extend(later.par_iter().map(|i| finished(i, known.as_ref())));
    runs.sort_by_key(|r| r.0);
    let mut log = Vec::new();
    let mut ends = Vec::new();
    for (_, (start, outcome, spent)) in runs {
        stages.add(spent);
        log.push(start);
        ends.push(outcome);
    }
    let (outcome, others) = best_of(problem, ends)?;
    Ok(Optimum { design: problem.space.design(&outcome.point), outcome, starts: log, others, stages })
}

/// The lowest value that a short search without derivatives finds from the two lowest of the starts that are apart, or that of a start that is `low_enough`: far fewer evaluations than [`optimise`].
/// Enormous where no start has a finite response.
pub fn lowest_nearby(problem: &Problem, starts: &[(String, Vec<f64>)], low_enough: f64) -> (f64, Work) {
    let mut work = Work::default();
    let mut seed = |start: &(String, Vec<f64>)| {
        let value = problem.cost(&start.1, &mut work);
        Searched { point: start.1.clone(), seed: value, value, stages: Stages::default() }
    };
    let all: Vec<Searched> = starts.iter().map(&mut seed).collect();
    let mut apart = distinct(&all);
    apart.sort_by(|i, j| all[*i].value.total_cmp(&all[*j].value));
    apart.truncate(NEARBY);
    let mut lowest = apart.first().map_or(f64::INFINITY, |i| all[*i].value);
    for i in apart {
        if lowest > low_enough {
            lowest = gradient_free::search(problem, &all[i].point, NEARBY_EVALUATIONS, &mut work).1.min(lowest);
        }
    }
    (lowest, work)
}

/// The best of some ends, and the other local optima among them.
///
/// # Errors
/// The first, where all are.
pub(super) fn best_of(problem: &Problem, ends: Vec<Result<Outcome, ResponseError>>) -> Result<(Outcome, Vec<LocalOptimum>), ResponseError> {
    let mut best: Option<Outcome> = None;
    let mut met: Vec<Outcome> = Vec::new();
    let mut error = None;
    for outcome in ends {
        met.extend(outcome.iter().filter(|o| o.meets_first_order() && o.rows.hold()).cloned());
        match outcome {
            Ok(o) if best.as_ref().is_none_or(|b| is_better(&o, b)) => best = Some(o),
            Ok(_) => {}
            Err(e) => error = error.or(Some(e)),
        }
    }
    match (best, error) {
        (Some(outcome), _) => {
            let others = others(problem, &outcome, met);
            Ok((outcome, others))
        }
        (None, Some(e)) => Err(e),
        (None, None) => unreachable!("a search has at least one start"),
    }
}

/// Ends that differ from each other and from the best, the best of them first.
fn others(problem: &Problem, best: &Outcome, mut ends: Vec<Outcome>) -> Vec<LocalOptimum> {
    ends.sort_by(|a, b| a.rows.objective().total_cmp(&b.rows.objective()));
    let mut distinct: Vec<&Outcome> = vec![best];
    for end in &ends {
        let same = |d: &&Outcome| {
            let near = end.point.iter().zip(&d.point).all(|(a, b)| (a - b).abs() < APART);
            near || (end.rows.objective() / d.rows.objective() - 1.0).abs() < SAME
        };
        if !distinct.iter().any(same) {
            distinct.push(end);
        }
    }
    distinct[1..].iter().map(|o| LocalOptimum { design: problem.space.design(&o.point), value: o.rows.objective() }).collect()
}

/// Whether two points are of one basin.
fn together(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < TOGETHER)
}

/// Indices of the points with no better one near, in their order.
fn distinct(points: &[Searched]) -> Vec<usize> {
    let better = |i: usize, j: usize| points[j].value < points[i].value || (points[j].value == points[i].value && j < i);
    (0..points.len()).filter(|i| !(0..points.len()).any(|j| better(*i, j) && together(&points[*i].point, &points[j].point))).collect()
}
