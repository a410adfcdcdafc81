//! Optima under limits, and of several absorbers. What holds limits may fall apart (a stiff lossy part, a soft part, a nearly locked part), and starts that agree may all lie in one of the parts; closed forms of
//! several absorbers share out modes, and an objective other than the response may be least at a corner of the bounds: the whole box is looked over.
//!
//! With one or two coordinates a grid covers the box; with more, its ends, its corners and random points. Designs whose objective is certainly far above that of the optimum are left out by its value at a few
//! speeds; of the others, those that are lowest among their neighbours are followed, by more than one weight of the limits, and by the limits alone; between lines of a grid of two coordinates the limits themselves are looked along, for ripples of the objective. From the optimum without limits the limits are tightened
//! step by step besides.

use super::minimax::{self, Outcome};
use super::search::is_lower;
use super::{Optimum, Problem, Remembers, gradient_free};
use crate::numerics::elementary::Elementary;
use crate::objective::{Condition, HELD, Limit, Over};
use crate::response::Work;
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use rayon::prelude::*;

/// What the whole box says of an optimum.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Serialize)]
pub struct Survey {
    /// Designs of the grid, or ends and corners of the box and random ones.
    pub designs: usize,
    /// Points of the grid along each coordinate; nothing where there was no grid.
    pub per_coordinate: Option<usize>,
    /// Whether there were limits to hold.
    pub under_limits: bool,
    /// Those whose objective is above that of the optimum by a quarter, or that have no finite response: whether they hold the limits is not asked.
    pub above: usize,
    /// Those of the others that hold all limits.
    pub within_limits: usize,
    /// Designs from which the minimax method was run.
    pub followed: usize,
    /// Whether one of them led to a better optimum, which was kept.
    pub better: bool,
}

/// Points of the grid with one coordinate, and along each of two; of what takes long, fewer.
const ALONG_ONE: [usize; 2] = [512, 128];
const ALONG_TWO: [usize; 2] = [32, 20];
/// Random points for each of more coordinates.
const RANDOM: usize = 32;
/// What is above the optimum by this factor leads to nothing better within a step of the grid.
const FAR_ABOVE: f64 = 1.25;
/// What exceeds a limit by more than this (a logarithm) is no neighbour of what holds it.
const FAR_BEYOND: f64 = 0.5;
/// Weights of the worst excess over a limit by which designs are compared with their neighbours.
const WEIGHTS: [f64; 3] = [3.0, 20.0, 1000.0];
/// Most designs that are followed: of a grid, and of ends and random points.
const MOST_FOLLOWED: usize = 24;
const MOST_OF_RANDOM: usize = 6;
/// A design nearer than this to the optimum in every coordinate leads to it.
const BESIDE: f64 = 0.2;
/// Steps in which the limits are tightened from the optimum without them.
const TIGHTENED: usize = 6;

/// Evaluations without derivatives from a design that the minimax method left.
const EVALUATIONS: u64 = 150;

/// A design of the box: objective and worst excess; nothing where it is certainly far above the optimum, or has no finite response.
type Judged = Option<(f64, f64)>;

/// Limits are looked along where the objective is estimated below that of the optimum times this: between two points of a grid there may be ripples,
const NEAR_THE_OPTIMUM: f64 = 1.02;
/// at so many points to a step of the grid;
const BETWEEN_LINES: usize = 8;
/// from a line of the grid to the next they move on by no more steps than this.
const STEEPEST: f64 = 2.0;
/// Weight of the excess over a limit beside it, where the objective hardly changes with what holds the limit.
const WEIGHT_ALONG_LIMITS: f64 = 0.2;
/// Most places that are followed of those.
const MOST_ALONG_LIMITS: usize = 8;

/// Points of the box: a grid whose last coordinate changes fastest, or ends and random points.
pub(super) struct Points {
    pub(super) list: Vec<Vec<f64>>,
    /// Number of coordinates and points along each, of a grid.
    grid: Option<(usize, usize)>,
}

impl Points {
    pub(super) fn over(problem: &Problem, at: &[f64], seed: u64) -> Self {
        let bounds = problem.space.bounds();
        let slow = usize::from(is_slow(problem));
        let (along_one, along_two) = (ALONG_ONE[slow], ALONG_TWO[slow]);
        let along = |i: usize, k: usize, n: usize| {
            let (low, high) = bounds[i];
            if k + 1 == n { high } else { low + (high - low) * k as f64 / (n - 1) as f64 }
        };
        match bounds.len() {
            1 => Self { list: (0..along_one).map(|k| vec![along(0, k, along_one)]).collect(), grid: Some((1, along_one)) },
            2 => {
                let point = |k: usize| vec![along(0, k / along_two, along_two), along(1, k % along_two, along_two)];
                Self { list: (0..along_two * along_two).map(point).collect(), grid: Some((2, along_two)) }
            }
            n => {
                let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
                let middle: Vec<f64> = bounds.iter().map(|(low, high)| 0.5 * (low + high)).collect();
                let mut list = Vec::new();
                // both ends of every bound, from the optimum and from the middle
                for from in [at, &middle] {
                    for (i, (low, high)) in bounds.iter().enumerate() {
                        list.extend([*low, *high].map(|end| {
                            let mut point = from.to_vec();
                            point[i] = end;
                            point
                        }));
                    }
                }
                list.extend(corners(&bounds));
                list.extend(
                    (0..RANDOM * n).map(|_| bounds.iter().map(|(low, high)| random.random_range(*low..=*high)).collect::<Vec<f64>>()),
                );
                Self { list, grid: None }
            }
        }
    }

    /// Indices of the points beside one; none where there is no grid.
    fn beside(&self, i: usize) -> Vec<usize> {
        match self.grid {
            Some((1, n)) => [i.wrapping_sub(1), i + 1].into_iter().filter(|j| *j < n).collect(),
            Some((_, n)) => {
                let (row, column) = (i / n, i % n);
                let near = |k: usize| k.saturating_sub(1)..=(k + 1).min(n - 1);
                near(row).flat_map(|r| near(column).map(move |c| r * n + c)).filter(|j| *j != i).collect()
            }
            None => Vec::new(),
        }
    }
}

/// Corners of a box are looked at where it has no more of them.
const MOST_CORNERS: usize = 64;

/// The corners of a box; none of one that has too many: rings that are nearly locked and rings on soft springs hold what others break.
pub(super) fn corners(bounds: &[(f64, f64)]) -> Vec<Vec<f64>> {
    let count = 1usize.checked_shl(bounds.len() as u32).filter(|count| *count <= MOST_CORNERS).unwrap_or(0);
    let corner = |c: usize| bounds.iter().enumerate().map(|(i, b)| if c >> i & 1 == 0 { b.0 } else { b.1 }).collect();
    (0..count).map(corner).collect()
}

/// Whether a design takes long: its state in operation is found, or its objective asks for that at every speed.
fn is_slow(problem: &Problem) -> bool {
    problem.load_cases.iter().any(|case| case.condition == Condition::InOperation) || costs_more_than_limits(problem)
}

/// Whether limits are asked before the objective.
fn costs_more_than_limits(problem: &Problem) -> bool {
    problem.objectives.iter().any(|o| matches!(o.measure.over, Over::Temperature | Over::Damage))
}

/// Where a design has more load cases than this, as within tolerances, the box is not looked over: it was for the design as drawn.
const MOST_LOAD_CASES: usize = 32;

/// Whether the whole box of a problem is looked over: where its limits or several absorbers leave more than one part of it to end in.
#[doc(hidden)]
pub fn is_wanted(problem: &Problem) -> bool {
    let several = !problem.limits.is_empty() || problem.space.slots.len() > 1;
    !problem.space.variables.is_empty() && several && problem.load_cases.len() <= MOST_LOAD_CASES
}

/// Looks over the whole box, follows what may be better than an optimum, and keeps what is.
#[doc(hidden)]
pub fn survey(problem: &Problem, optimum: &mut Optimum, seed: u64) -> Survey {
    let points = Points::over(problem, &optimum.outcome.point, seed);
    let holds = optimum.outcome.rows.hold();
    let most = if holds { optimum.value() * FAR_ABOVE } else { f64::INFINITY };
    let limits_first = costs_more_than_limits(problem);
    let judge = |w: &Vec<f64>| -> (Judged, Work) {
        let mut work = Work::default();
        if holds && problem.is_surely_above(w, (&optimum.outcome.rows, most), &mut work) {
            work.evaluations += 1;
            return (None, work);
        }
        let value = match limits_first {
            true => problem.value_near_limits(w, FAR_BEYOND, &mut work),
            false => problem.value_below(w, most, &mut work),
        };
        (value.ok().filter(|judged| judged.1.is_finite()), work)
    };
    let judged: Vec<(Judged, Work)> = points.list.par_iter().map(judge).collect();
    judged.iter().for_each(|j| optimum.stages.search += j.1);
    let judged: Vec<Judged> = judged.into_iter().map(|j| j.0).collect();
    let within = |j: &&(f64, f64)| j.1 <= HELD;
    let at = &optimum.outcome.point;
    let leads_there =
        |i: &usize| holds && points.list[*i].iter().zip(at).all(|(a, b)| (a - b).abs() < BESIDE) && !is_lower_there(judged[*i], optimum);
    let mut chosen = chosen(&points, &judged);
    chosen.retain(|i| !leads_there(i));
    chosen.truncate(if points.grid.is_some() { MOST_FOLLOWED } else { MOST_OF_RANDOM });
    let known = optimum.outcome.clone();
    let mut starts: Vec<(Vec<f64>, Judged)> = chosen.iter().map(|i| (points.list[*i].clone(), judged[*i])).collect();
    if let Some((2, n)) = points.grid.filter(|_| holds) {
        let step: Vec<f64> = problem.space.bounds().iter().map(|(low, high)| (high - low) / (n - 1) as f64).collect();
        let below = optimum.value() * NEAR_THE_OPTIMUM;
        let mut along = along_limits(&points, &judged, below);
        along.retain(|w| w.iter().zip(at).zip(&step).any(|((a, b), step)| (a - b).abs() >= *step));
        let of_limits: Vec<(Judged, Work)> = along.par_iter().map(judge).collect();
        of_limits.iter().for_each(|j| optimum.stages.search += j.1);
        let of_limits: Vec<Judged> = of_limits.into_iter().map(|j| j.0).collect();
        starts.extend(lowest_along_limits(along, &of_limits, (below, &step)).into_iter().map(|w| (w, None)));
    }
    let mut survey = Survey {
        designs: points.list.len(),
        per_coordinate: points.grid.map(|g| g.1),
        under_limits: !problem.limits.is_empty(),
        above: judged.iter().filter(|j| j.is_none()).count(),
        within_limits: judged.iter().flatten().filter(within).count(),
        followed: starts.len(),
        better: false,
    };
    let follow = |(point, judged): &(Vec<f64>, Judged)| {
        let mut work = Work::default();
        (followed(problem, (point, *judged), &known, &mut work), work)
    };
    let lowest = (0..judged.len()).filter_map(|i| Some((judged[i]?.0, i))).reduce(|a, b| if b.0 < a.0 { b } else { a });
    let from = lowest.map_or_else(|| known.point.clone(), |l| points.list[l.1].clone());
    let mut work = Work::default();
    let (ends, tightened): (Vec<(Vec<Outcome>, Work)>, _) =
        rayon::join(|| starts.par_iter().map(follow).collect(), || tightened(problem, &from, &mut work));
    optimum.stages.minimax += work;
    for (outcomes, work) in ends {
        optimum.stages.minimax += work;
        survey.better |= keep_best(problem, optimum, outcomes);
    }
    survey.better |= keep_best(problem, optimum, tightened.into_iter().collect());
    survey
}

/// Whether a design holds all limits and is lower than an optimum.
fn is_lower_there(judged: Judged, optimum: &Optimum) -> bool {
    judged.is_some_and(|(value, excess)| excess <= HELD && value < optimum.value())
}

/// Puts the best of some outcomes in the place of an optimum where it is better.
fn keep_best(problem: &Problem, optimum: &mut Optimum, outcomes: Vec<Outcome>) -> bool {
    let mut better = false;
    for outcome in outcomes {
        if is_lower(&outcome, &optimum.outcome) {
            optimum.replace(problem, outcome);
            better = true;
        }
    }
    better
}

/// Designs to follow: those that are lowest among their neighbours by a weight of the limits, those that hold them before others, and then by how far they exceed them; the lowest first.
fn chosen(points: &Points, judged: &[Judged]) -> Vec<usize> {
    let by_weight = |weight: f64| move |j: (f64, f64)| (0.0, j.0 * (1.0 + weight * j.1.max(0.0)));
    let first_limits = |j: (f64, f64)| if j.1 <= HELD { (0.0, j.0) } else { (j.1, j.0) };
    let mut list: Vec<usize> = Vec::new();
    let mut put = |key: &dyn Fn((f64, f64)) -> (f64, f64)| {
        // an objective that was not asked for is no lowest one
        let key_of = |i: usize| judged[i].map(key).filter(|key| key.0 > 0.0 || key.1.is_finite());
        let lowest =
            |i: &usize| key_of(*i).is_some_and(|mine| points.beside(*i).into_iter().all(|j| key_of(j).is_none_or(|other| mine <= other)));
        let mut found: Vec<usize> = (0..judged.len()).filter(lowest).collect();
        found.sort_by(|a, b| key_of(*a).partial_cmp(&key_of(*b)).unwrap_or(std::cmp::Ordering::Equal).then(a.cmp(b)));
        found.truncate(MOST_FOLLOWED / 3);
        list.extend(found);
    };
    put(&first_limits);
    WEIGHTS.iter().for_each(|weight| put(&by_weight(*weight)));
    let mut seen = std::collections::BTreeSet::new();
    list.retain(|i| seen.insert(*i));
    list
}

/// A place where a line of a grid crosses the limits: which line it is, whether limits are held before it, about where on the line, and the lower objective of the points beside it.
#[derive(Debug, Clone, Copy)]
struct Crossing {
    line: usize,
    held_before: bool,
    at: f64,
    value: f64,
}

/// Points along the limits of two coordinates, between neighbouring lines of the grid that cross them, [`BETWEEN_LINES`] to a step: where the objective is estimated below a value at one of their ends.
fn along_limits(points: &Points, judged: &[Judged], below: f64) -> Vec<Vec<f64>> {
    let Some((2, n)) = points.grid else { return Vec::new() };
    let mut list = Vec::new();
    for axis in 0..2 {
        let index = |line: usize, place: usize| if axis == 0 { place * n + line } else { line * n + place };
        let crossing = |line: usize, place: usize| -> Option<Crossing> {
            let (a, b) = (judged[index(line, place)]?, judged[index(line, place + 1)]?);
            let held_before = a.1 <= HELD;
            if held_before == (b.1 <= HELD) {
                return None;
            }
            // what holds all limits does not say by how much: the two points beyond tell where they are met
            let (beyond, own) = if held_before { (place.checked_add(2), b.1) } else { (place.checked_sub(1), a.1) };
            let farther = beyond.filter(|p| *p < n).and_then(|p| judged[index(line, p)]).map(|j| j.1).filter(|e| e.is_finite() && *e > own);
            let back = farther.map_or(0.5, |e| (own / (e - own)).min(1.0));
            let share = if held_before { 1.0 - back } else { back };
            Some(Crossing { line, held_before, at: place as f64 + share, value: a.0.min(b.0) })
        };
        let of_line = |line: usize| (0..n - 1).filter_map(move |place| crossing(line, place));
        let coordinates = |line: f64, at: f64| -> Vec<f64> {
            let (first, last) = (&points.list[0], &points.list[n * n - 1]);
            let share = if axis == 0 { [at, line] } else { [line, at] }.map(|x| x / (n - 1) as f64);
            (0..2).map(|i| first[i] + (last[i] - first[i]) * share[i]).collect()
        };
        for one in (0..n - 1).flat_map(of_line) {
            let beside = of_line(one.line + 1).filter(|c| c.held_before == one.held_before && (c.at - one.at).abs() <= STEEPEST);
            let Some(next) = beside.min_by(|a, b| (a.at - one.at).abs().total_cmp(&(b.at - one.at).abs())) else { continue };
            if one.value.min(next.value) < below {
                let part = |k: usize| k as f64 / BETWEEN_LINES as f64;
                list.extend((0..=BETWEEN_LINES).map(|k| coordinates(one.line as f64 + part(k), one.at + part(k) * (next.at - one.at))));
            }
        }
    }
    list
}

/// Where limits are crossed at the lowest objective, the lowest first, none within half a step of the grid of another.
fn lowest_along_limits(list: Vec<Vec<f64>>, judged: &[Judged], (below, step): (f64, &[f64])) -> Vec<Vec<f64>> {
    let near = |j: &Judged| j.filter(|(value, excess)| *value < below && *excess < FAR_BEYOND);
    let weighted = |j: &Judged| near(j).map(|(value, excess)| value * (1.0 + WEIGHT_ALONG_LIMITS * excess));
    let mut all: Vec<(f64, Vec<f64>)> = judged.iter().zip(list).filter_map(|(j, w)| Some((weighted(j)?, w))).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut kept: Vec<Vec<f64>> = Vec::new();
    for (_, w) in all {
        let near = |other: &Vec<f64>| w.iter().zip(other).zip(step).all(|((a, b), step)| (a - b).abs() < 0.5 * step);
        if kept.len() < MOST_ALONG_LIMITS && !kept.iter().any(near) {
            kept.push(w);
        }
    }
    kept
}

/// Where a design leads: the minimax method's end, from where the limits hold if it does not hold them; and the design itself, if it is better than the known optimum and that end is not.
fn followed(problem: &Problem, (point, judged): (&[f64], Judged), known: &Outcome, work: &mut Work) -> Vec<Outcome> {
    let mut ends: Vec<Outcome> = minimax::minimise_towards(problem, point, known, work).ok().into_iter().collect();
    if ends.iter().all(|end| !end.rows.hold()) {
        let restored = minimax::minimise(&feasibility(problem), point, work).ok();
        ends.extend(restored.and_then(|near| minimax::minimise(problem, &near.point, work).ok()));
    }
    let itself = judged.filter(|(value, excess)| *excess <= HELD && (!known.rows.hold() || *value < known.rows.objective()));
    if let Some((value, _)) = itself
        && ends.iter().all(|end| !end.rows.hold() || end.rows.objective() > value)
    {
        // the method left a design that was better: without derivatives it may get on from there
        let (near, _) = gradient_free::search(problem, point, EVALUATIONS, work);
        ends.extend(minimax::minimise(problem, &near, work).ok());
        ends.extend([near.as_slice(), point].into_iter().filter_map(|w| unmoved(problem, w, work)));
    }
    ends
}

/// A design as an outcome of its own, with nothing said of its first-order conditions.
fn unmoved(problem: &Problem, point: &[f64], work: &mut Work) -> Option<Outcome> {
    let rows = problem.rows(point, work).ok()?;
    Some(Outcome::unmoved(point, rows))
}

/// The problem of coming nearest to all limits.
pub(super) fn feasibility<'a>(problem: &Problem<'a>) -> Problem<'a> {
    Problem {
        load_cases: problem.load_cases,
        space: problem.space.clone(),
        objectives: problem.limits,
        weights: &[],
        limits: &[],
        memory: problem.memory.map(Remembers::part),
    }
}

/// The end of a path from the optimum without limits, which is sought from a point, along limits that are tightened in equal ratios until they are those of the problem.
fn tightened(problem: &Problem, from: &[f64], work: &mut Work) -> Option<Outcome> {
    let free = Problem { limits: &[], memory: problem.memory.map(Remembers::part), space: problem.space.clone(), ..*problem };
    let mut outcome = minimax::minimise(&free, from, work).ok()?;
    let excess = problem.value(&outcome.point, work).ok()?.1;
    if excess <= HELD {
        return minimax::minimise(problem, &outcome.point, work).ok();
    }
    for step in (0..TIGHTENED).rev() {
        let factor = (excess * step as f64 / TIGHTENED as f64).exponential();
        let limits: Vec<Limit> = problem.limits.iter().map(|l| l.scaled(factor)).collect();
        let eased = Problem { limits: &limits, space: problem.space.clone(), ..free };
        outcome = minimax::minimise_with(&eased, &outcome.point, outcome.curvature, work).ok()?;
    }
    Some(outcome)
}
