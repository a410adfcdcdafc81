//! Designs that hold within tolerances: the largest objective over a box of deviations is minimised.
//!
//! The worst of a box is a minimax problem of its own. Its corners are scenarios from the start; at the optimum of those the box is searched for a worse deviation inside, which joins them until none is found or after a number of rounds.

use super::minimax::Outcome;

use super::scatter::{HARDNESS, Scatter, modulus_of_hardness};
use super::search::{self, Finish, Optimum, Recorder};
use super::{LoadCase, Problem, minimax};
use crate::absorber::construction::shape;
use crate::absorber::parameter::Follows;
use crate::absorber::{Declaration, Deviation, Medium, Mounted, Parameter, Substance};
use crate::numerics::elementary::Elementary;
use crate::numerics::maximise::maximise;
use crate::objective::{Limit, Measure};
use crate::response::{ResponseError, Work};
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use rayon::prelude::*;
use std::convert::Infallible;
use std::f64::consts::TAU;

/// Key of the relaxation time of an oil.
const RELAXATION_TIME: &str = "relaxation_time_s";
/// A deviation is worse where it is by this share.
const WORSE: f64 = 1e-9;
/// Most searches of the inside of the box, after each of which an optimum is sought anew.
const MOST_INSIDE: usize = 24;
/// Random deviations of a search of the box, per edge; the best so many are searched from; rounds of one edge after the other.
const RANDOM: usize = 16;
const SEARCHED: usize = 3;
const ROUNDS: usize = 6;
/// A box is wide where a parameter may fall below this share of what is drawn: narrow ridges have room in it. Random deviations per edge of those, many on edges of the box and the others by equal ratios; the best so many are
/// searched from.
const WIDE: f64 = 0.5;
const RANDOM_WIDE: usize = 96;
const SEARCHED_WIDE: usize = 12;
/// Share of the reach at which it is looked whether the value falls from an end.
const INWARD: f64 = 0.05;

/// How a point of an edge, from -1 to 1, changes a parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
enum By {
    /// 1 + share x.
    Share(f64),
    /// Amount x is added.
    Amount(f64),
    /// The first factor at x = 1, the second at x = -1, by powers between.
    Factors(f64, f64),
}

impl By {
    /// The smallest factor on a parameter, where that is known.
    fn least(self) -> f64 {
        match self {
            Self::Share(share) => 1.0 - share,
            Self::Amount(_) => 1.0,
            Self::Factors(up, down) => up.min(down),
        }
    }

    /// A random point of the edge: an end of it in a third of all, else by equal ratios of the factor below what is drawn and evenly above.
    fn by_ratio(self, generator: &mut impl Rng) -> f64 {
        let (which, x): (f64, f64) = (generator.random(), generator.random());
        match self {
            _ if which < 0.25 => -1.0,
            _ if which < 0.33 => 1.0,
            Self::Share(share) if share > 0.0 && which < 0.8 => (((1.0 - share).logarithm() * x).exponential() - 1.0) / share,
            _ if which < 0.8 => -x,
            _ => x,
        }
    }
}

/// Shares and amounts by which parameters of the absorbers of a design may deviate.
#[derive(Debug, Clone, PartialEq)]
pub struct Tolerances {
    /// Parameters of each absorber.
    counts: Vec<usize>,
    /// Absorber, parameters that change together, and how.
    edges: Vec<(usize, Vec<usize>, By)>,
}

impl Tolerances {
    /// Those of some types (nothing for an absorber without one) by the keys of their parameters.
    pub fn new(types: &[Option<&'static Declaration>], shares: &[(&'static str, f64)]) -> Self {
        let types: Vec<_> = types.iter().map(|t| t.map(|t| (t, None))).collect();
        let scatter: Vec<Scatter> = shares.iter().map(|(key, share)| Scatter::Share(key, *share)).collect();
        Self::scattered(&types, &scatter)
    }

    /// The same of what their making scatters, with the compound or oil of each.
    pub fn scattered(types: &[Option<(&'static Declaration, Option<&Substance>)>], scatter: &[Scatter]) -> Self {
        let counts = types.iter().map(|t| t.map_or(0, |t| t.0.parameters.len())).collect();
        let edges_of = |(i, t): (usize, &Option<(&'static Declaration, Option<&Substance>)>)| -> Vec<(usize, Vec<usize>, By)> {
            let place = |scatter: &Scatter| -> Option<(usize, Vec<usize>, By)> {
                let (kind, substance) = t.as_ref()?;
                let medium = shape(kind).map(|s| s.medium);
                match *scatter {
                    Scatter::Share(key, share) => Some((i, vec![kind.index(key)?], By::Share(share))),
                    Scatter::Amount(key, amount) => Some((i, vec![kind.index(key)?], By::Amount(amount))),
                    Scatter::Hardness(amount) => {
                        let own = substance.filter(|_| medium == Some(Medium::Rubber))?.grade;
                        let to = |hardness: f64| modulus_of_hardness(hardness.clamp(HARDNESS.0, HARDNESS.1)) / modulus_of_hardness(own);
                        Some((i, vec![shape(kind)?.material().start], By::Factors(to(own + amount), to(own - amount))))
                    }
                    Scatter::Viscosity(share) => {
                        let first = shape(kind).filter(|_| medium == Some(Medium::Oil))?.material().start;
                        Some((i, vec![first, kind.index(RELAXATION_TIME)?], By::Share(share)))
                    }
                    Scatter::Temperature(kelvin) => {
                        let law = (*substance)?.temperature;
                        let (low, high) = law.range();
                        let at = |kelvin: f64| law.factor((law.reference() + kelvin).clamp(low, high));
                        let follows = |p: &(usize, &Parameter)| p.1.follows == Follows::Factor;
                        let parameters: Vec<usize> = kind.parameters.iter().enumerate().filter(follows).map(|p| p.0).collect();
                        (!parameters.is_empty()).then(|| (i, parameters, By::Factors(at(kelvin), at(-kelvin))))
                    }
                }
            };
            scatter.iter().filter_map(place).collect()
        };
        Self { counts, edges: types.iter().enumerate().flat_map(edges_of).collect() }
    }

    /// Of a design.
    #[doc(hidden)]
    pub fn of(design: &[Mounted], shares: &[(&'static str, f64)]) -> Self {
        Self::new(&design.iter().map(|m| m.absorber.declaration()).collect::<Vec<_>>(), shares)
    }

    /// Of a design, of what its making scatters.
    #[doc(hidden)]
    pub fn scattered_of(design: &[Mounted], scatter: &[Scatter]) -> Self {
        let one = |m: &Mounted| {
            let law = m.absorber.law()?;
            Some((law.declaration(), law.material().and_then(|m| m.substance.clone())))
        };
        let owned: Vec<_> = design.iter().map(one).collect();
        let types: Vec<_> = owned.iter().map(|o| o.as_ref().map(|(t, s)| (*t, s.as_deref()))).collect();
        Self::scattered(&types, scatter)
    }

    /// Number of edges of the box.
    pub fn edges(&self) -> usize {
        self.edges.len()
    }

    /// Each edge: absorber, parameters that change together, whether by an amount (or by a factor), and its least and largest.
    pub(super) fn ranges(&self) -> impl Iterator<Item = (usize, &[usize], bool, (f64, f64))> {
        self.edges.iter().map(|(absorber, parameters, by)| {
            let (is_amount, range) = match *by {
                By::Share(share) => (false, (1.0 - share, 1.0 + share)),
                By::Amount(amount) => (true, (-amount, amount)),
                By::Factors(up, down) => (false, (up.min(down), up.max(down))),
            };
            (*absorber, parameters.as_slice(), is_amount, range)
        })
    }

    /// The deviation with these factors or amounts, one an edge.
    pub(super) fn built(&self, values: &[f64]) -> Deviation {
        let mut all = self.at(&vec![0.0; self.edges()]);
        for ((absorber, parameters, is_amount, _), value) in self.ranges().zip(values) {
            for p in parameters {
                if is_amount {
                    all.amounts[absorber][*p] += value;
                } else {
                    all.factors[absorber][*p] *= value;
                }
            }
        }
        all
    }

    /// The deviation at a point of the box: each edge from -1 to 1.
    pub fn at(&self, point: &[f64]) -> Deviation {
        let mut factors: Vec<Vec<f64>> = self.counts.iter().map(|n| vec![1.0; *n]).collect();
        let adds = self.edges.iter().any(|e| matches!(e.2, By::Amount(_)));
        let mut amounts: Vec<Vec<f64>> = if adds { self.counts.iter().map(|n| vec![0.0; *n]).collect() } else { Vec::new() };
        for ((absorber, parameters, by), x) in self.edges.iter().zip(point) {
            for parameter in parameters {
                match *by {
                    By::Share(share) => factors[*absorber][*parameter] *= 1.0 + share * x,
                    By::Amount(amount) => amounts[*absorber][*parameter] += amount * x,
                    By::Factors(up, down) => factors[*absorber][*parameter] *= if *x >= 0.0 { up.power(*x) } else { down.power(-*x) },
                }
            }
        }
        Deviation { factors, amounts }
    }

    /// All corners.
    pub fn corners(&self) -> Vec<Vec<f64>> {
        let corner = |bits: usize| (0..self.edges()).map(|i| if bits >> i & 1 == 1 { 1.0 } else { -1.0 }).collect();
        (0..1usize << self.edges()).map(corner).collect()
    }

    /// The largest value over the box that a search of it finds, and where.
    pub fn worst(&self, value: impl Fn(&[f64]) -> f64 + Sync, seed: u64) -> (Vec<f64>, f64) {
        self.highest(value, seed).into_iter().reduce(|m, p| if p.1 > m.1 { p } else { m }).expect("a box has corners")
    }

    /// The highest values over the box that a search of it finds, and where: corners, the middle of every edge's range, and random points, the best followed along one edge after the other.
    fn highest(&self, value: impl Fn(&[f64]) -> f64 + Sync, seed: u64) -> Vec<(Vec<f64>, f64)> {
        let d = self.edges();
        let is_wide = self.edges.iter().any(|e| e.2.least() < WIDE);
        let mut generator = Xoshiro256PlusPlus::seed_from_u64(seed);
        let mut points = self.corners();
        points.push(vec![0.0; d]);
        points.extend((0..RANDOM * d).map(|_| (0..d).map(|_| generator.random_range(-1.0..=1.0)).collect::<Vec<f64>>()));
        if is_wide {
            points.extend((0..RANDOM_WIDE * d).map(|_| self.edges.iter().map(|e| e.2.by_ratio(&mut generator)).collect::<Vec<f64>>()));
        }
        let mut valued: Vec<(Vec<f64>, f64)> = points.into_par_iter().map(|p| (value(&p), p)).map(|(v, p)| (p, v)).collect();
        valued.sort_by(|a, b| b.1.total_cmp(&a.1));
        valued.truncate(if is_wide { SEARCHED_WIDE } else { SEARCHED });
        valued.par_iter_mut().for_each(|(point, own)| {
            let mut reach = 1.0;
            for _ in 0..ROUNDS {
                let before = *own;
                for i in 0..d {
                    let (low, high) = (f64::max(point[i] - reach, -1.0), f64::min(point[i] + reach, 1.0));
                    let mut moved = point.clone();
                    if point[i].abs() == 1.0 {
                        // at an end from which the value falls
                        moved[i] *= 1.0 - INWARD * reach;
                        if value(&moved) < *own {
                            continue;
                        }
                    }
                    let along = |x: f64| {
                        moved[i] = x;
                        Ok::<f64, Infallible>(value(&moved))
                    };
                    let Ok((x, found)) = maximise(low, high, along);
                    if found > *own {
                        (point[i], *own) = (x, found);
                    }
                }
                // beside a narrow ridge only a short reach finds more
                if !is_wide && *own <= before * (1.0 + WORSE) {
                    break;
                }
                reach *= 0.5;
            }
        });
        valued
    }

    /// A random point of the box; normal: the share is three standard deviations, and what is farther is not delivered.
    pub fn sample(&self, normal: bool, generator: &mut impl Rng) -> Vec<f64> {
        let mut next = || generator.random::<f64>();
        let mut one = || loop {
            // Box and Muller
            let x = if normal { (-2.0 * (1.0 - next()).logarithm()).sqrt() * (TAU * next()).cosine() / 3.0 } else { 2.0 * next() - 1.0 };
            if x.abs() <= 1.0 {
                return x;
            }
        };
        (0..self.edges()).map(|_| one()).collect()
    }
}

/// Load cases as they are, and each with every deviation.
#[doc(hidden)]
pub fn scenarios<'a>(cases: &[LoadCase<'a>], deviations: &'a [Deviation]) -> Vec<LoadCase<'a>> {
    let with = |deviation: &'a Deviation| cases.iter().map(move |case| LoadCase { deviation: Some(deviation), ..*case });
    cases.iter().copied().chain(deviations.iter().flat_map(with)).collect()
}

/// The largest value of a measure of a design over load cases with a deviation; infinite where nothing damps a resonance.
#[doc(hidden)]
pub fn deviated(cases: &[LoadCase], design: &[Mounted], deviation: &Deviation, measure: &Measure) -> f64 {
    let mut cases = cases.iter().map(|case| LoadCase { deviation: Some(deviation), ..*case });
    let larger = |m: f64, case: LoadCase| case.peak_above(design, measure, m, &mut Work::default()).map(|p| f64::max(m, p));
    cases.try_fold(0.0, larger).unwrap_or(f64::INFINITY)
}

/// The optimum of a problem that has more scenarios than the one it is from: from there, and from those of its other local optima whose value, which more scenarios only raise, is below.
fn again(problem: &Problem, mut before: Optimum) -> Result<Optimum, ResponseError> {
    let others = std::mem::take(&mut before.others);
    let own = minimax::minimise(problem, &before.outcome.point, &mut before.stages.minimax)?;
    let (below, above): (Vec<_>, Vec<_>) = others.into_iter().partition(|o| !own.rows.hold() || o.value < own.rows.objective());
    let points: Vec<Vec<f64>> = below.iter().map(|o| problem.space.point_of(&o.design)).collect();
    let ends = from_each(problem, &points, &mut before.stages.minimax);
    let (outcome, mut others) = search::best_of(problem, std::iter::once(Ok(own)).chain(ends).collect())?;
    others.extend(above);
    Ok(Optimum { design: problem.space.design(&outcome.point), outcome, others, ..before })
}

/// Ends of the minimax method from some points.
fn from_each(problem: &Problem, points: &[Vec<f64>], work: &mut Work) -> Vec<Result<Outcome, ResponseError>> {
    let from = |point: &Vec<f64>| {
        let mut work = Work::default();
        (minimax::minimise(problem, point, &mut work), work)
    };
    let ends: Vec<_> = points.par_iter().map(from).collect();
    ends.iter().for_each(|end| *work += end.1);
    ends.into_iter().map(|end| end.0).collect()
}

/// The design whose worst objective over the box is least, and the deviations that it is held against.
///
/// # Errors
/// The error of the first start, where no start has a finite response.
#[doc(hidden)]
pub fn optimise(
    problem: &Problem,
    tolerances: &Tolerances,
    starts: &[(String, Vec<f64>)],
    seed: u64,
    recorder: Recorder,
) -> Result<(Vec<Deviation>, Optimum), ResponseError> {
    let deviations: Vec<Deviation> = tolerances.corners().iter().map(|c| tolerances.at(c)).collect();
    let cases = scenarios(problem.load_cases, &deviations);
    let of_corners = Problem { load_cases: &cases, space: problem.space.clone(), ..*problem };
    let optimum = search::optimise(&of_corners, starts, Finish::Distinct, recorder)?;
    settled((problem, &[]), tolerances, (deviations, optimum), seed)
}

/// An optimum for some deviations, held against the whole box: what is worse inside joins the deviations, and the optimum is sought anew, until none is found or after a number of rounds. `as_drawn`: load cases that count
/// without deviations.
///
/// # Errors
/// As [`optimise`].
#[doc(hidden)]
pub fn settled<'a>(
    (problem, as_drawn): (&Problem<'a>, &[LoadCase<'a>]),
    tolerances: &Tolerances,
    (mut deviations, mut optimum): (Vec<Deviation>, Optimum),
    seed: u64,
) -> Result<(Vec<Deviation>, Optimum), ResponseError> {
    let mut others_known = true;
    for _ in 0..MOST_INSIDE {
        let new = worse_inside(problem, tolerances, &optimum, seed);
        let known = deviations.len();
        for deviation in new {
            if !deviations.contains(&deviation) {
                deviations.push(deviation);
            }
        }
        let mut cases = scenarios(problem.load_cases, &deviations);
        cases.extend(as_drawn);
        let problem = Problem { load_cases: &cases, space: problem.space.clone(), ..*problem };
        if deviations.len() > known {
            optimum = again(&problem, optimum)?;
            others_known = false;
        } else if others_known || !with_others_anew(&problem, &mut optimum)? {
            break;
        } else {
            others_known = true;
        }
    }
    Ok((deviations, optimum))
}

/// Deviations that make an objective, or a limited measure beyond its limit, worse than in all scenarios of an optimum. Each limit is searched for itself: what is within its limit in all points that were drawn may exceed it between them.
fn worse_inside(problem: &Problem, tolerances: &Tolerances, optimum: &Optimum, seed: u64) -> Vec<Deviation> {
    let value_at = |point: &[f64], (objectives, weights): (&[Limit], &[f64])| {
        let deviation = tolerances.at(point);
        let cases: Vec<LoadCase> = problem.load_cases.iter().map(|case| LoadCase { deviation: Some(&deviation), ..*case }).collect();
        let built = Problem { load_cases: &cases, space: problem.space.clone(), objectives, weights, limits: &[], ..*problem };
        built.exactly(&optimum.outcome.point, &mut Work::default()).map_or(f64::INFINITY, |found| found.0)
    };
    let own = (problem.objectives, problem.weights);
    let value = optimum.value() * (1.0 + WORSE);
    let mut worse: Vec<(Vec<f64>, f64)> = tolerances.highest(|point| value_at(point, own), seed);
    worse.retain(|w| w.1 > value);
    let excess = optimum.outcome.rows.excess().exponential() * (1.0 + WORSE);
    // sizes grow or fall with every dimension: they are worst in a corner
    for limit in problem.limits.iter().filter(|l| !l.measure.is_inertia()) {
        let beyond = tolerances.highest(|point| value_at(point, (std::slice::from_ref(limit), &[])), seed);
        worse.extend(beyond.into_iter().filter(|w| w.1 > excess));
    }
    worse.iter().map(|w| tolerances.at(&w.0)).collect()
}

/// Seeks the other local optima anew, whose values are those of fewer scenarios; whether one of them has led to a lower optimum, which then takes its place.
fn with_others_anew(problem: &Problem, optimum: &mut Optimum) -> Result<bool, ResponseError> {
    let points: Vec<Vec<f64>> = optimum.others.iter().map(|o| problem.space.point_of(&o.design)).collect();
    let ends = from_each(problem, &points, &mut optimum.stages.minimax);
    let own = std::iter::once(Ok(optimum.outcome.clone()));
    let (outcome, others) = search::best_of(problem, own.chain(ends).collect())?;
    let lower = search::is_lower(&outcome, &optimum.outcome);
    *optimum = Optimum { design: problem.space.design(&outcome.point), outcome, others, ..optimum.clone() };
    Ok(lower)
}
