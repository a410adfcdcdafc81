//! Points of a sample, and Sobol's indices of what comes of them.

use crate::input::campaign::{Distribution, Drawing, Sample, Sampled};
use crate::numerics::normal::normal_quantile;
use rand::seq::SliceRandom;
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use sobol::Sobol;
use sobol::params::JoeKuoD6;
use std::ops::Range;

/// The value below which a share of a distribution lies.
fn quantile(of: &Sampled, share: f64) -> f64 {
    match &of.distribution {
        Some(Distribution::Uniform(low, high)) => low + (high - low) * share,
        Some(Distribution::Normal(mean, deviation)) => mean + deviation * normal_quantile(share),
        Some(Distribution::Table(values)) => {
            let mut below = 0.0;
            let found = values.iter().find(|(_, own)| {
                below += own;
                share < below
            });
            found.or(values.last()).map_or(f64::NAN, |v| v.0)
        }
        None => share,
    }
}

/// Points of a range of a sample, a value a key.
pub(super) fn points(sample: &Sample, range: Range<usize>) -> Vec<Vec<f64>> {
    let keys = sample.keys.len();
    let shares: Vec<Vec<f64>> = match &sample.drawing {
        Drawing::Rows(rows) => return rows[range].to_vec(),
        Drawing::Full => range.map(|i| level(sample.points, keys, i)).collect(),
        Drawing::LatinHypercube => latin_hypercube(sample)[range].to_vec(),
        Drawing::Sobol if sample.indices => saltelli(sample, range),
        Drawing::Sobol => shifted(sample, keys, range),
    };
    shares.iter().map(|point| sample.keys.iter().zip(point).map(|(key, share)| quantile(key, *share)).collect()).collect()
}

/// Middles of equal shares, the last key changing fastest.
fn level(levels: usize, keys: usize, mut index: usize) -> Vec<f64> {
    let mut point = vec![0.0; keys];
    for share in point.iter_mut().rev() {
        *share = ((index % levels) as f64 + 0.5) / levels as f64;
        index /= levels;
    }
    point
}

/// A point in each of as many equal shares of every key.
fn latin_hypercube(sample: &Sample) -> Vec<Vec<f64>> {
    let mut generator = Xoshiro256PlusPlus::seed_from_u64(sample.seed);
    let mut points = vec![Vec::with_capacity(sample.keys.len()); sample.points];
    for _ in &sample.keys {
        let mut shares: Vec<usize> = (0..sample.points).collect();
        shares.shuffle(&mut generator);
        for (point, share) in points.iter_mut().zip(shares) {
            point.push((share as f64 + generator.random::<f64>()) / sample.points as f64);
        }
    }
    points
}

/// Points of Sobol's sequence with the direction numbers of \[Joe & Kuo 2008\], shifted at random round the unit cube \[Cranley & Patterson 1976\]: no share is then zero.
fn shifted(sample: &Sample, keys: usize, range: Range<usize>) -> Vec<Vec<f64>> {
    let mut generator = Xoshiro256PlusPlus::seed_from_u64(sample.seed);
    let shift: Vec<f64> = (0..keys).map(|_| generator.random::<f64>()).collect();
    let all = Sobol::<f64>::new(keys, &JoeKuoD6::minimal());
    let moved = |point: Vec<f64>| point.iter().zip(&shift).map(|(x, s)| (x + s).fract()).collect();
    all.skip(range.start).take(range.len()).map(moved).collect()
}

/// Saltelli's scheme: after each pair of points A and B those that have one key of B and the others of A \[Saltelli et al. 2010\].
fn saltelli(sample: &Sample, range: Range<usize>) -> Vec<Vec<f64>> {
    let keys = sample.keys.len();
    let block = keys + 2;
    let pairs = shifted(sample, 2 * keys, range.start / block..range.end.div_ceil(block));
    let one = |i: usize| {
        let pair = &pairs[i / block - range.start / block];
        let (a, b) = pair.split_at(keys);
        match i % block {
            0 => a.to_vec(),
            1 => b.to_vec(),
            k => a.iter().zip(b).enumerate().map(|(j, (a, b))| if j == k - 2 { *b } else { *a }).collect(),
        }
    };
    range.clone().map(one).collect()
}

/// How much of the variance of a result a key makes, with half the width of a 95 % confidence interval.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[doc(hidden)]
pub struct Index {
    /// By itself.
    pub first: f64,
    /// Half of the interval.
    pub first_within: f64,
    /// With all that it does together with others.
    pub total: f64,
    /// Half of the interval.
    pub total_within: f64,
}

/// Normal deviate of a 95 % interval.
const TWO_SIDED_95: f64 = 1.959_964;

/// Sobol's indices of each key from the values at the points of Saltelli's scheme, in their order: first order by \[Saltelli et al. 2010\], total by \[Jansen 1999\]. Both are means over the pairs of points; their confidence intervals are by the
/// standard deviations of these, as if the points were random, over the variance of all. `None` where a value is missing, or all are the same.
#[doc(hidden)]
pub fn indices(values: &[Option<f64>], keys: usize) -> Option<Vec<Index>> {
    let blocks: Vec<Vec<f64>> = values.chunks_exact(keys + 2).map(|b| b.iter().copied().collect::<Option<_>>()).collect::<Option<_>>()?;
    let n = blocks.len() as f64;
    let both = || blocks.iter().flat_map(|b| &b[..2]);
    let mean = both().sum::<f64>() / (2.0 * n);
    let variance = both().map(|x| (x - mean).powi(2)).sum::<f64>() / (2.0 * n);
    if n < 2.0 || variance <= 0.0 || variance.is_nan() {
        return None;
    }
    let of = |terms: Vec<f64>| {
        let middle = terms.iter().sum::<f64>() / n;
        let spread = terms.iter().map(|t| (t - middle).powi(2)).sum::<f64>() / (n - 1.0);
        (middle / variance, TWO_SIDED_95 * (spread / n).sqrt() / variance)
    };
    let one = |k: usize| {
        let (first, first_within) = of(blocks.iter().map(|b| (b[1] - mean) * (b[2 + k] - b[0])).collect());
        let (total, total_within) = of(blocks.iter().map(|b| 0.5 * (b[0] - b[2 + k]).powi(2)).collect());
        Index { first, first_within, total, total_within }
    };
    Some((0..keys).map(one).collect())
}
