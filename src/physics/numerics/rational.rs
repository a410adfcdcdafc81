//! Rational interpolation of several functions of one variable with poles in common.
//!
//! f(x) = sum w_j f_j/(x - x_j) / sum w_j/(x - x_j): supports x_j are chosen where the error is largest, the weights are those of least error in the linearised sense at the other
//! samples \[Nakatsukasa, Sète & Trefethen 2018\], the same for all functions.

use super::{C64, ZERO};
use hartog_kernel::kernel;
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

/// Supports that are summed side by side.
const LANES: usize = 8;

/// Rational functions with common poles. Supports come in blocks of so many lanes; those that fill the last one weigh nothing.
#[derive(Debug, Clone)]
pub(crate) struct Rational {
    supports: Vec<f64>,
    weights: Vec<Block>,
    /// Function by function, at every support.
    values: Vec<Block>,
}

/// Complex numbers side by side.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Block {
    re: [f64; LANES],
    im: [f64; LANES],
}

impl Block {
    const ZERO: Self = Self { re: [0.0; LANES], im: [0.0; LANES] };

    /// Numbers in blocks, zeros behind the last.
    fn all(numbers: &[C64]) -> Vec<Self> {
        let block_of = |own: &[C64]| {
            let number_at = |k: usize| own.get(k).copied().unwrap_or(ZERO);
            Self { re: std::array::from_fn(|k| number_at(k).re), im: std::array::from_fn(|k| number_at(k).im) }
        };
        numbers.chunks(LANES).map(block_of).collect()
    }

    fn at(&self, k: usize) -> C64 {
        C64::new(self.re[k], self.im[k])
    }
}

/// What each support counts for at a place that is none of them: its weight over the distance, over the sum of all.
#[kernel]
fn shares(x: f64, supports: &[f64], weights: &[Block]) -> Vec<Block> {
    let mut all = weights.to_vec();
    let mut sum = Block::ZERO;
    for (own, supports) in all.iter_mut().zip(supports.as_chunks::<LANES>().0) {
        for (k, support) in supports.iter().enumerate() {
            let distance = x - support;
            (own.re[k], own.im[k]) = (own.re[k] / distance, own.im[k] / distance);
            sum.re[k] += own.re[k];
            sum.im[k] += own.im[k];
        }
    }
    let (re, im) = (sum.re.iter().sum::<f64>(), sum.im.iter().sum::<f64>());
    let square = re * re + im * im;
    let (re, im) = (re / square, -im / square);
    for own in &mut all {
        for k in 0..LANES {
            (own.re[k], own.im[k]) = (own.re[k] * re - own.im[k] * im, own.re[k] * im + own.im[k] * re);
        }
    }
    all
}

/// Products of shares with some functions (their blocks one after another; by their indices), times a factor, added to what stands at those indices less `first` in `out`.
#[kernel]
fn add_products(
    shares: &[Block],
    values: &[Block],
    functions: impl Iterator<Item = usize>,
    (first, factor): (usize, C64),
    out: &mut [C64],
) {
    for function in functions {
        let mut sum = Block::ZERO;
        for (a, b) in shares.iter().zip(&values[function * shares.len()..]) {
            for k in 0..LANES {
                sum.re[k] += a.re[k] * b.re[k] - a.im[k] * b.im[k];
                sum.im[k] += a.re[k] * b.im[k] + a.im[k] * b.re[k];
            }
        }
        out[function - first] += factor * C64::new(sum.re.iter().sum(), sum.im.iter().sum());
    }
}

impl Rational {
    fn new(supports: &[f64], weights: &[C64], functions: impl Iterator<Item = Vec<C64>>) -> Self {
        let blocks = supports.len().div_ceil(LANES);
        // no place is at infinity
        let supports = supports.iter().copied().chain(std::iter::repeat(f64::INFINITY)).take(blocks * LANES).collect();
        Self { supports, weights: Block::all(weights), values: functions.flat_map(|own| Block::all(&own)).collect() }
    }

    /// What each support counts for at a place: the same for all functions.
    pub(crate) fn shares(&self, x: f64) -> Vec<Block> {
        match self.supports.iter().position(|s| *s == x) {
            Some(j) => Block::all(&(0..self.supports.len()).map(|i| C64::from(f64::from(u8::from(i == j)))).collect::<Vec<_>>()),
            None => shares(x, &self.supports, &self.weights),
        }
    }

    /// How many functions there are.
    fn functions(&self) -> usize {
        self.values.len() / self.weights.len()
    }

    /// Some of the functions at the place of these shares, added to `out` times a factor.
    pub(crate) fn add(&self, shares: &[Block], functions: Range<usize>, factor: C64, out: &mut [C64]) {
        let first = functions.start;
        add_products(shares, &self.values, functions, (first, factor), out);
    }

    /// The same of those that `rows` names among them.
    pub(crate) fn add_rows(&self, shares: &[Block], (first, rows): (usize, &[usize]), factor: C64, out: &mut [C64]) {
        add_products(shares, &self.values, rows.iter().map(|row| first + row), (first, factor), out);
    }

    /// All functions at a place.
    fn at(&self, x: f64) -> Vec<C64> {
        let mut out = vec![ZERO; self.functions()];
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
            let supports: Vec<f64> = chosen.iter().map(|i| x[*i]).collect();
            let found = Self::new(&supports, &weights, (0..count).map(|c| chosen.iter().map(|i| rows[*i][c]).collect()));
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
        let norms = |own: &Block| (0..LANES).map(|k| own.at(k).norm()).fold(f64::MIN_POSITIVE, f64::max);
        let most = |own: &[Block]| own.iter().map(norms).fold(f64::MIN_POSITIVE, f64::max);
        let floor = NOTHING * most(&self.values);
        let largest = |own: &[Block]| most(own).max(floor);
        let relative_error = |(c, own): (usize, &[Block])| (out[c] - row[c]).norm() / largest(own);
        self.values.chunks(self.weights.len()).enumerate().map(relative_error).fold(0.0, f64::max)
    }
}

/// Size of every function: its largest magnitude.
fn scales(rows: &[Vec<C64>]) -> Vec<f64> {
    let scale_of = |c: usize| rows.iter().map(|row| row[c].norm()).fold(0.0, f64::max);
    let all: Vec<f64> = (0..rows[0].len()).map(scale_of).collect();
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
