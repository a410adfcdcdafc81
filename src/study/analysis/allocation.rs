//! The tolerances that a design can bear: all of the study in one ratio, or the cheapest, so that all limits hold within them or so many of those that are made hold them.

use super::limits_within::{ratios, worst};
use super::{DesignResult, Progress};
use crate::absorber::{Deviation, Mounted};
use crate::input::{AllocateSpec, Study};
use crate::numerics::elementary::Elementary;
use crate::objective::holds;
use crate::optimise::allocation::{cheapest, widest};
use crate::optimise::checkpoint::remembered;
use crate::optimise::{LoadCase, Scatter, Tolerances};
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use rayon::prelude::*;
use std::convert::Infallible;

/// Most times that a tolerance becomes as wide as it is given, and most of a value that it comes to.
const MOST_TIMES: f64 = 10.0;
const MOST_SHARE: f64 = 0.9;
/// Boxes that are searched, as shares of the one that is asked about.
const PARTS: [f64; 6] = [1.0, 0.8, 0.6, 0.4, 0.2, 0.1];
/// Most times that a deviation inside the box is found to be worse, and the tolerances are sought anew.
const MOST_ROUNDS: usize = 12;
/// Precision of the logarithms of factors: of a worst case, and of a share of random designs, which is coarser by itself.
const EXACT: f64 = 1e-9;
const OF_DRAWS: f64 = 1e-3;
/// What is found inside is worse than the corners by this share.
const WORSE: f64 = 1e-9;

/// One of the tolerances of a study.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Allocated {
    /// Index of it among those that the study gives.
    pub of: usize,
    /// Factor on its width as given.
    pub factor: f64,
    /// Whether it is not looked at any wider.
    pub at_most: bool,
    /// What the others gain where this one is nil: their common factor becomes so many times as large, or their cost falls by this share; `None` where there are no others.
    pub alone: Option<f64>,
}

/// The tolerances of a design.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct AllocationOfDesign {
    /// Its name.
    pub design: String,
    /// Its tolerances; none where it breaks a limit, or is on it, as drawn.
    pub tolerances: Vec<Allocated>,
    /// The limit that is nearest to broken within them, of random designs by the one that the share ends at, or as drawn where there are none (an index), and how much of it is used.
    pub limit: (usize, f64),
    /// Whether the last search of the box found nothing worse, where one was made.
    pub settled: bool,
}

/// A design with what is scattered.
struct Of<'a> {
    study: &'a Study,
    cases: &'a [LoadCase<'a>],
    design: &'a [Mounted],
    scatter: Vec<Scatter>,
    /// Draws, where so many of them are to hold all limits.
    sampled: Option<(usize, Vec<Vec<f64>>)>,
}

impl Of<'_> {
    fn tolerances(&self, factors: &[f64]) -> Tolerances {
        let scatter: Vec<Scatter> = self.scatter.iter().zip(factors).map(|(s, f)| s.times(*f)).collect();
        Tolerances::scattered_of(self.design, &scatter)
    }

    fn ratios(&self, deviation: &Deviation) -> Vec<f64> {
        ratios(self.study, self.cases, self.design, deviation).into_iter().map(|r| r.1).collect()
    }

    /// Rows of an allocation: of every limit at some points of the box, or of the draw that so many are better than.
    fn rows(&self, factors: &[f64], points: &[Vec<f64>]) -> Vec<f64> {
        let tolerances = self.tolerances(factors);
        let Some((rank, draws)) = &self.sampled else {
            let rows: Vec<Vec<f64>> = points.par_iter().map(|p| self.ratios(&tolerances.at(p))).collect();
            return rows.into_iter().flatten().map(Elementary::logarithm).collect();
        };
        vec![self.at_rank(&tolerances, (*rank, draws)).0.logarithm()]
    }

    /// What of its limits the draw of a rank uses, and which limit.
    fn at_rank(&self, tolerances: &Tolerances, (rank, draws): (usize, &[Vec<f64>])) -> (f64, usize) {
        let largest = |p: &Vec<f64>| worst(self.study, self.cases, self.design, &tolerances.at(p));
        let mut all: Vec<(f64, usize)> = draws.par_iter().map(largest).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all[rank]
    }

    /// The worst that searches of a box find, of several boxes on the way to it, too, each of which is a part of it: its point and its value.
    fn worst(&self, factors: &[f64], seed: u64) -> (Vec<f64>, f64) {
        let of_part = |part: f64| {
            let scaled: Vec<f64> = factors.iter().map(|f| f * part).collect();
            let tolerances = self.tolerances(&scaled);
            let (point, value) = tolerances.worst(|p| worst(self.study, self.cases, self.design, &tolerances.at(p)).0, seed);
            (point.iter().map(|x| x * part).collect::<Vec<f64>>(), value)
        };
        let all: Vec<(Vec<f64>, f64)> = PARTS.par_iter().map(|part| of_part(*part)).collect();
        all.into_iter().fold((Vec::new(), 0.0), |m, f| if f.1 > m.1 { f } else { m })
    }

    /// Factors that all limits bear at some points of the box; of those that are zero in `free` no tolerance.
    fn solved(&self, points: &[Vec<f64>], (costs, most): Asked, free: &[bool]) -> Option<Vec<f64>> {
        let own = |list: &[f64]| -> Vec<f64> { list.iter().zip(free).filter(|f| *f.1).map(|f| *f.0).collect() };
        let all = |some: &[f64]| -> Vec<f64> {
            let mut next = some.iter();
            free.iter().map(|f| if *f { next.next().copied().unwrap_or(0.0) } else { 0.0 }).collect()
        };
        let rows = |some: &[f64]| self.rows(&all(some), points);
        let most = own(most);
        let precision = if self.sampled.is_some() { OF_DRAWS } else { EXACT };
        let found = match costs {
            Some(costs) => cheapest(&rows, &own(costs), &most, precision)?,
            None => widest(&rows, &vec![1.0; most.len()], &most, precision)?,
        };
        Some(all(&found))
    }

    /// The same at whatever points are found to be worse, which join them; whether nothing worse was found at last.
    fn settled(&self, asked: Asked, free: &[bool], (points, seed): (&mut Vec<Vec<f64>>, u64)) -> Option<(Vec<f64>, bool)> {
        let mut found = self.solved(points, asked, free)?;
        if self.sampled.is_some() {
            return Some((found, true));
        }
        for _ in 0..MOST_ROUNDS {
            let tolerances = self.tolerances(&found);
            let value = |p: &Vec<f64>| worst(self.study, self.cases, self.design, &tolerances.at(p)).0;
            let known = points.par_iter().map(value).reduce(|| 0.0, f64::max);
            let (point, inside) = self.worst(&found, seed);
            if inside <= known.max(1.0) * (1.0 + WORSE) {
                return Some((found, true));
            }
            points.push(point);
            found = self.solved(points, asked, free)?;
        }
        Some((found, false))
    }
}

/// Costs of tolerances, if the cheapest are sought, and the most that each may be.
type Asked<'a> = (Option<&'a [f64]>, &'a [f64]);

/// Every design with a parameter that has a tolerance; nothing where the study does not ask for it.
pub(super) fn allocations(study: &Study, cases: &[LoadCase], shown: &[&DesignResult], progress: &dyn Progress) -> Vec<AllocationOfDesign> {
    let Some(spec) = study.robust.as_ref().and_then(|r| r.allocate.as_ref()) else { return Vec::new() };
    progress.stage("tolerances that limits bear", shown.len());
    let one = |d: &&DesignResult| {
        let compute = || Ok::<_, Infallible>(of_design(study, (cases, spec), d));
        let Ok(found) = remembered(progress.memory(), &("allocation", &d.name, &d.absorbers), compute);
        progress.step();
        found
    };
    shown.par_iter().filter_map(one).collect()
}

/// `None` where it has none of what is scattered.
fn of_design(study: &Study, (cases, spec): (&[LoadCase], &AllocateSpec), d: &DesignResult) -> Option<AllocationOfDesign> {
    let all = study.robust.as_ref()?.scatter();
    let has = |s: &Scatter| Tolerances::scattered_of(&d.absorbers, &[*s]).edges() > 0;
    let indices: Vec<usize> = (0..all.len()).filter(|i| has(&all[*i])).collect();
    if indices.is_empty() {
        return None;
    }
    let seed = study.optimise.as_ref().map_or(1, |o| o.seed);
    let scatter: Vec<Scatter> = indices.iter().map(|i| all[*i]).collect();
    let of = Of { study, cases, design: &d.absorbers, sampled: None, scatter };
    let given = of.tolerances(&vec![1.0; indices.len()]);
    // as it is judged: in operation, too
    let judged = study.limits.iter().zip(&d.limits).enumerate().filter(|l| !l.1.0.of.measure.is_inertia());
    let (limit, ratio) = judged.map(|(i, l)| (i, *l.1)).fold((0, 0.0), |m, l| if l.1 > m.1 { l } else { m });
    let none = AllocationOfDesign { design: d.name.clone(), tolerances: Vec::new(), limit: (limit, ratio), settled: true };
    if !holds(ratio) {
        return Some(none);
    }
    let sampled = spec.holding.map(|(share, sampling)| {
        let mut generator = Xoshiro256PlusPlus::seed_from_u64(seed);
        let draws: Vec<Vec<f64>> = (0..sampling.samples).map(|_| given.sample(sampling.normal, &mut generator)).collect();
        let rank = ((share * draws.len() as f64).ceil() as usize).clamp(1, draws.len()) - 1;
        (rank, draws)
    });
    let of = Of { sampled, ..of };
    let most: Vec<f64> = of.scatter.iter().map(|s| most_times(*s, &d.absorbers)).collect();
    let costs: Option<Vec<f64>> = spec.costs.as_ref().map(|c| indices.iter().map(|i| c[*i]).collect());
    let asked = (costs.as_deref(), most.as_slice());
    let mut points = given.corners();
    points.push(vec![0.0; given.edges()]);
    let every = vec![true; indices.len()];
    let Some((factors, settled)) = of.settled(asked, &every, (&mut points, seed)) else { return Some(none) };
    let alone = |i: usize| {
        let others: Vec<bool> = (0..indices.len()).map(|j| j != i).collect();
        let rest = |f: &[f64]| -> f64 {
            let sum = (0..f.len()).filter(|j| *j != i).map(|j| costs.as_ref().map_or(f[j], |c| c[j] / f[j]));
            sum.fold(0.0, |a, b| if costs.is_some() { a + b } else { f64::max(a, b) })
        };
        let (found, _) = of.settled(asked, &others, (&mut points.clone(), seed))?;
        Some(if costs.is_some() { 1.0 - rest(&found) / rest(&factors) } else { rest(&found) / rest(&factors) })
    };
    let tolerance = |(i, f): (usize, &f64)| Allocated {
        of: indices[i],
        factor: *f,
        at_most: *f >= most[i],
        alone: if indices.len() > 1 { alone(i) } else { None },
    };
    let tolerances: Vec<Allocated> = factors.iter().enumerate().map(tolerance).collect();
    let made = of.tolerances(&factors);
    let at = |p: &Vec<f64>| worst(study, cases, &d.absorbers, &made.at(p));
    let (used, limit) = match &of.sampled {
        Some((rank, draws)) => of.at_rank(&made, (*rank, draws)),
        None => points.iter().map(at).fold((0.0, limit), |m, r| if r.0 > m.0 { r } else { m }),
    };
    Some(AllocationOfDesign { tolerances, limit: (limit, used), settled, ..none })
}

/// How many times as wide as given a tolerance is looked at.
fn most_times(scatter: Scatter, design: &[Mounted]) -> f64 {
    let of_share = MOST_SHARE / scatter.width();
    let most = match scatter {
        Scatter::Share(..) | Scatter::Viscosity(_) => of_share,
        Scatter::Amount(key, amount) => {
            let values = design.iter().filter_map(|m| m.absorber.value(key));
            values.map(|x| MOST_SHARE * x / amount).fold(f64::INFINITY, f64::min)
        }
        Scatter::Hardness(_) | Scatter::Temperature(_) => f64::INFINITY,
    };
    most.min(MOST_TIMES)
}
