//! How many of the dampers that are made hold all limits of the study.
//!
//! Limits on sizes and masses are those of the drawing, and not among them. Random dampers, distributed as the study says. Where next to none of a normal distribution fails, as many are drawn evenly over the whole box beside them, each counted by the density of the normal one: what fails
//! lies near its corners, which the normal distribution rarely reaches (importance sampling).

use crate::absorber::Mounted;
use crate::analysis::limits_within::broken;
use crate::input::{Sampling, Study};
use crate::numerics::elementary::Elementary;
use crate::optimise::{LoadCase, Tolerances};
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use rayon::prelude::*;

/// Share of the dampers that hold all limits.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Holding {
    /// The share.
    pub share: f64,
    /// Bounds of its 95 % confidence interval.
    pub between: (f64, f64),
    /// How many were drawn.
    pub samples: usize,
    /// Whether those near the corners were drawn more often, and counted less.
    pub by_importance: bool,
    /// The limit that most of those that fail break (an index); nothing where none fails.
    pub broken: Option<usize>,
}

/// Normal deviate of a 95 % interval.
const TWO_SIDED_95: f64 = 1.959_964;
/// A smaller share of failures than this is drawn by importance.
const FEW: f64 = 0.02;
/// Of fewer failures than these an estimate by importance has no variance to speak of.
const LEAST: usize = 20;
/// Standard deviations of a normal distribution to each side within a tolerance.
const WITHIN: f64 = 3.0;

/// Of a design, with tolerances and draws of the study.
pub(super) fn holding(
    study: &Study,
    cases: &[LoadCase],
    design: &[Mounted],
    (tolerances, sampling, seed): (&Tolerances, Sampling, u64),
) -> Holding {
    let failing = |normal: bool, seed: u64| -> Vec<(Vec<f64>, Option<usize>)> {
        let mut generator = Xoshiro256PlusPlus::seed_from_u64(seed);
        let points: Vec<Vec<f64>> = (0..sampling.samples).map(|_| tolerances.sample(normal, &mut generator)).collect();
        let judged = |p: Vec<f64>| {
            let failed = broken(study, cases, design, &tolerances.at(&p));
            (p, failed)
        };
        points.into_par_iter().map(judged).collect()
    };
    let drawn = failing(sampling.normal, seed);
    let n = sampling.samples as f64;
    let fails = drawn.iter().filter(|d| d.1.is_some()).count() as f64;
    let most = |drawn: &[(Vec<f64>, Option<usize>)]| {
        let count = |limit: usize| drawn.iter().filter(|d| d.1 == Some(limit)).count();
        (0..study.limits.len()).filter(|l| count(*l) > 0).max_by_key(|l| count(*l))
    };
    let plain = || {
        let (share, between) = (1.0 - fails / n, wilson(n - fails, n));
        Holding { share, between, samples: sampling.samples, by_importance: false, broken: most(&drawn) }
    };
    if !sampling.normal || fails >= FEW * n {
        return plain();
    }
    let even = failing(false, seed.wrapping_add(1));
    if even.iter().filter(|e| e.1.is_some()).count() < LEAST {
        return plain();
    }
    let weights: Vec<f64> = even.iter().map(|(p, failed)| if failed.is_some() { density(p) } else { 0.0 }).collect();
    let mean = weights.iter().sum::<f64>() / n;
    let variance = weights.iter().map(|w| (w - mean) * (w - mean)).sum::<f64>() / (n * (n - 1.0));
    let half = TWO_SIDED_95 * variance.sqrt();
    Holding {
        share: 1.0 - mean,
        between: ((1.0 - mean - half).max(0.0), (1.0 - mean + half).min(1.0)),
        samples: 2 * sampling.samples,
        by_importance: true,
        broken: most(&even),
    }
}

/// Density of the normal distribution whose tolerance is three standard deviations, cut off there, over that of the even one.
fn density(point: &[f64]) -> f64 {
    // share of a normal distribution within three standard deviations, and 2 · 3/√(2π)
    const SHARE: f64 = 0.997_300_203_936_74;
    const PEAK: f64 = 2.393_653_682_408_6;
    point.iter().map(|x| PEAK / SHARE * (-0.5 * (WITHIN * x) * (WITHIN * x)).exponential()).product()
}

/// Wilson's interval of a share.
fn wilson(successes: f64, n: f64) -> (f64, f64) {
    let (p, z2) = (successes / n, TWO_SIDED_95 * TWO_SIDED_95);
    let (centre, half) = (p + z2 / (2.0 * n), TWO_SIDED_95 * (p * (1.0 - p) / n + z2 / (4.0 * n * n)).sqrt());
    let below = 1.0 + z2 / n;
    // at an end rounding is no share
    let low = if successes == 0.0 { 0.0 } else { (centre - half) / below };
    let high = if successes == n { 1.0 } else { (centre + half) / below };
    (low, high)
}
