//! Rational interpolation of several functions of one variable with poles in common.
//!
//! f(x) = sum w_j f_j/(x - x_j) / sum w_j/(x - x_j): supports x_j are chosen where the error is largest, the weights are those of least error in the linearised sense at the other
//! samples \[Nakatsukasa, Sète & Trefethen 2018\], the same for all functions.

use super::{C64, ZERO};
use nalgebra::DMatrix;
use std::ops::Range;

/// Functions whose errors decide the weights: combinations of all.
const COMBINATIONS: usize = 6;
/// Supports added at a time.
const AT_A_TIME: usize = 4;
/// Most supports, and that over samples.
const MOST: usize = 64;
const MOST_SHARE: f64 = 0.5;

/// A function below this share of the largest of all is what rounding leaves of none (where forces cancel by symmetry, say): its size is that share.
const NOTHING: f64 = 1e-5;

/// Rational functions with common poles.
#[derive(Debug, Clone)]
pub(crate) struct Rational {
    supports: Vec<f64>,
    weights: Vec<C64>,
    /// Function by function, at every support.
    values: Vec<C64>,
}

impl Rational {
    /// What each support counts for at a place: the same for all functions.
    pub(crate) fn shares(&self, x: f64) -> Vec<C64> {
        if let Some(j) = self.supports.iter().position(|s| *s == x) {
            return (0..self.supports.len()).map(|i| C64::from(f64::from(u8::from(i == j)))).collect();
        }
        let mut shares: Vec<C64> = self.supports.iter().zip(&self.weights).map(|(s, weight)| weight / (x - s)).collect();
        let scale = shares.iter().sum::<C64>().inv();
        shares.iter_mut().for_each(|share| *share *= scale);
        shares
    }

    /// Some of the functions at the place of these shares, added to `out` times a factor.
    pub(crate) fn add(&self, shares: &[C64], functions: Range<usize>, factor: C64, out: &mut [C64]) {
        for (sum, function) in out.iter_mut().zip(functions) {
            *sum += factor * self.value(shares, function);
        }
    }

    fn value(&self, shares: &[C64], function: usize) -> C64 {
        let own = &self.values[function * shares.len()..(function + 1) * shares.len()];
        let (mut re, mut im) = (0.0, 0.0);
        for (a, b) in shares.iter().zip(own) {
            re += a.re * b.re - a.im * b.im;
            im += a.re * b.im + a.im * b.re;
        }
        C64::new(re, im)
    }

    /// The same of those that `rows` names among them.
    pub(crate) fn add_rows(&self, shares: &[C64], (first, rows): (usize, &[usize]), factor: C64, out: &mut [C64]) {
        for row in rows {
            out[*row] += factor * self.value(shares, first + row);
        }
    }

    /// All functions at a place.
    fn at(&self, x: f64) -> Vec<C64> {
        let mut out = vec![ZERO; self.values.len() / self.supports.len()];
        self.add(&self.shares(x), 0..out.len(), C64::from(1.0), &mut out);
        out
    }

    /// Through samples (ascending places, a row of functions each), to `tolerance` of the largest value of every function at all of them. `None` where as many supports as are worth it do not reach that.
    pub(crate) fn through(x: &[f64], rows: &[Vec<C64>], tolerance: f64) -> Option<Self> {
        let count = rows.first()?.len();
        let largest = scales(rows);
        let error = |a: &[C64], b: &[C64]| (0..count).map(|c| (a[c] - b[c]).norm() / largest[c]).fold(0.0, f64::max);
        let combined: Vec<[C64; COMBINATIONS]> = rows.iter().map(|row| combinations(row, &largest)).collect();
        let mut chosen: Vec<usize> = vec![0, x.len() / 3, 2 * x.len() / 3, x.len() - 1];
        chosen.dedup();
        while chosen.len() <= MOST && chosen.len() as f64 <= MOST_SHARE * x.len() as f64 {
            chosen.sort_unstable();
            let weights = weights(x, &combined, &chosen)?;
            let values = (0..count).flat_map(|c| chosen.iter().map(move |i| rows[*i][c])).collect();
            let found = Self { supports: chosen.iter().map(|i| x[*i]).collect(), weights, values };
            let errors: Vec<f64> = x
                .iter()
                .zip(rows)
                .map(|(x, row)| {
                    let e = error(&found.at(*x), row);
                    if e.is_finite() { e } else { f64::INFINITY }
                })
                .collect();
            if errors.iter().all(|e| *e <= tolerance) {
                return Some(found);
            }
            let before = chosen.len();
            let peak = |i: &usize| {
                let near = |j: usize| errors.get(j).copied().unwrap_or(0.0);
                !chosen.contains(i) && errors[*i] >= near(i.wrapping_sub(1)) && errors[*i] >= near(i + 1)
            };
            let mut worst: Vec<usize> = (0..x.len()).filter(peak).collect();
            worst.sort_by(|a, b| errors[*b].total_cmp(&errors[*a]));
            chosen.extend(worst.into_iter().take(AT_A_TIME));
            if chosen.len() == before {
                return None;
            }
        }
        None
    }

    /// Largest error at a place over the size of the samples, of each function against `row`.
    pub(crate) fn error(&self, x: f64, row: &[C64]) -> f64 {
        let out = self.at(x);
        let most = |own: &[C64]| own.iter().map(|y| y.norm()).fold(f64::MIN_POSITIVE, f64::max);
        let floor = NOTHING * most(&self.values);
        let largest = |own: &[C64]| most(own).max(floor);
        let of = |(c, own): (usize, &[C64])| (out[c] - row[c]).norm() / largest(own);
        self.values.chunks(self.supports.len()).enumerate().map(of).fold(0.0, f64::max)
    }
}

/// Size of every function: its largest magnitude.
fn scales(rows: &[Vec<C64>]) -> Vec<f64> {
    let of = |c: usize| rows.iter().map(|row| row[c].norm()).fold(0.0, f64::max);
    let all: Vec<f64> = (0..rows[0].len()).map(of).collect();
    let floor = NOTHING * all.iter().copied().fold(0.0, f64::max);
    all.into_iter().map(|largest| if largest > 0.0 { largest.max(floor) } else { 1.0 }).collect()
}

/// Sums of the functions, each over its largest value, with factors on the unit circle that no two share.
fn combinations(row: &[C64], largest: &[f64]) -> [C64; COMBINATIONS] {
    std::array::from_fn(|k| {
        let factor = |c: usize| super::elementary::turn(((c * (2 * k + 1) * 7 + k * k) % 61) as f64);
        row.iter().zip(largest).enumerate().map(|(c, (y, scale))| y / *scale * factor(c)).sum()
    })
}

/// The right singular vector of least singular value of the Loewner matrix.
fn weights(x: &[f64], combined: &[[C64; COMBINATIONS]], chosen: &[usize]) -> Option<Vec<C64>> {
    let others: Vec<usize> = (0..x.len()).filter(|i| !chosen.contains(i)).collect();
    let element = |row: usize, j: usize| {
        let (i, k) = (others[row / COMBINATIONS], row % COMBINATIONS);
        (combined[i][k] - combined[chosen[j]][k]) / (x[i] - x[chosen[j]])
    };
    let loewner = DMatrix::from_fn(others.len() * COMBINATIONS, chosen.len(), element);
    if loewner.nrows() < loewner.ncols() {
        return None;
    }
    let svd = loewner.qr().r().svd(false, true);
    let least = svd.singular_values.imin();
    Some(svd.v_t?.row(least).iter().map(|v| v.conj()).collect())
}
