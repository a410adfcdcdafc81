//! Samples of a sum of harmonics over its period: the same on every processor.

use super::C64;
use super::projections::largest;
use crate::numerics::elementary::Elementary;
use hartog_kernel::kernel;
use std::f64::consts::TAU;

/// Samples that are summed at a time.
pub(super) const BLOCK: usize = 8;
/// A value for each place in a block.
type Lanes = [f64; BLOCK];
/// Harmonics that are summed together, one of each of two kinds: of even ones those with and without the factor four, of odd ones those that are one and those that are three above a multiple of four.
const PAIR: usize = 2;

/// Smallest and largest samples.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Sampled {
    /// By places in the blocks of the first eighth, with the samples that mirror them.
    pub lows: Lanes,
    pub highs: Lanes,
    /// Of all.
    pub low: f64,
    pub high: f64,
}

/// Cosines and sines of some harmonics over an eighth of the period; the other samples have the same sums with other signs.
#[derive(Debug, Clone)]
pub(super) struct Tables {
    /// Indices of the harmonics, pair by pair, where there is one: even ones first,
    columns: Vec<Option<usize>>,
    /// and how many columns those have.
    evens: usize,
    /// Samples in a quarter of a period, the first half a step from angle zero: a whole number of pairs of blocks.
    quarter: usize,
    /// cos(h psi) and sin(h psi) at every sample of the first eighth: block by block of samples, column by column.
    cosine: Vec<Lanes>,
    sine: Vec<Lanes>,
}

impl Tables {
    /// For some harmonics: at least eight samples in the shortest wave.
    pub fn new(harmonics: &[u32]) -> Self {
        let of_kind = |kind: u32| (0..harmonics.len()).filter(move |i| harmonics[*i] % 4 == kind);
        let pairs = |kinds: [u32; PAIR]| {
            let kinds = kinds.map(|kind| of_kind(kind).collect::<Vec<usize>>());
            let rows = 0..kinds[0].len().max(kinds[1].len());
            rows.flat_map(|row| [kinds[0].get(row).copied(), kinds[1].get(row).copied()]).collect::<Vec<Option<usize>>>()
        };
        let (mut columns, odd) = (pairs([0, 2]), pairs([1, 3]));
        let evens = columns.len();
        columns.extend(odd);
        let quarter = (2 * harmonics.iter().max().map_or(1, |&h| h as usize)).next_multiple_of(2 * BLOCK);
        let table = |f: fn(f64) -> f64| {
            // angles by whole numbers of half steps
            let entry = |h: u32, j: usize| f(TAU * (((2 * j + 1) * h as usize) % (8 * quarter)) as f64 / (8 * quarter) as f64);
            let column =
                |b: usize, i: Option<usize>| i.map_or([0.0; BLOCK], |i| std::array::from_fn(|j| entry(harmonics[i], b * BLOCK + j)));
            (0..quarter / BLOCK / 2).flat_map(|b| columns.iter().map(move |i| column(b, *i))).collect()
        };
        let (cosine, sine) = (table(f64::cosine), table(f64::sine));
        Self { columns, evens, quarter, cosine, sine }
    }

    /// Samples in a period.
    pub fn samples(&self) -> usize {
        4 * self.quarter
    }

    /// Samples the sum of these harmonics; `ordered` is a buffer.
    pub fn sample(&self, phasors: &[C64], ordered: &mut Vec<C64>, f: &mut Vec<f64>) -> Sampled {
        ordered.clear();
        ordered.extend(self.columns.iter().map(|i| i.map_or(C64::ZERO, |i| phasors[i])));
        f.resize(self.samples(), 0.0);
        sample(ordered, self.evens, (&self.cosine, &self.sine), f)
    }
}

/// Indices of a sample of the first eighth of a period and of those that mirror it, of `n` in a period.
pub(super) fn mirrored(j: usize, n: usize) -> [usize; 8] {
    let q = n / 4;
    [j, q - 1 - j, q + j, 2 * q - 1 - j, 2 * q + j, 3 * q - 1 - j, 3 * q + j, n - 1 - j]
}

/// Place by place.
#[inline(always)]
fn each(a: &Lanes, b: &Lanes, of: impl Fn(f64, f64) -> f64) -> Lanes {
    std::array::from_fn(|j| of(a[j], b[j]))
}

/// f at psi, pi - psi, pi + psi and 2 pi - psi by sums at psi over cosines and sines of even and of odd harmonics.
#[inline(always)]
fn quarters(even_cos: &Lanes, even_sin: &Lanes, odd_cos: &Lanes, odd_sin: &Lanes, ends: &mut (Lanes, Lanes)) -> [Lanes; 4] {
    let (sum, difference) = (each(even_cos, odd_cos, |a, b| a + b), each(even_cos, odd_cos, |a, b| a - b));
    let (sines, other) = (each(even_sin, odd_sin, |a, b| a + b), each(even_sin, odd_sin, |a, b| a - b));
    for (cosines, sines) in [(&sum, &sines), (&difference, &other)] {
        let (above, below) = (each(cosines, sines, |c, s| c + s.abs()), each(cosines, sines, |c, s| c - s.abs()));
        ends.0 = each(&ends.0, &below, |a, b| if b < a { b } else { a });
        ends.1 = each(&ends.1, &above, |a, b| if b > a { b } else { a });
    }
    let (add, subtract) = (|a: f64, b: f64| a + b, |a: f64, b: f64| a - b);
    [each(&sum, &sines, subtract), each(&difference, &other, add), each(&difference, &other, subtract), each(&sum, &sines, add)]
}

/// Sums over cosines and sines of even harmonics at psi, those of one kind and then those of the other.
#[inline(always)]
fn even_sums(phasors: &[[C64; PAIR]], cosine: &[[Lanes; PAIR]], sine: &[[Lanes; PAIR]]) -> [Lanes; 4] {
    let (mut cos0, mut sin0, mut cos2, mut sin2) = ([0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK]);
    for (y, (c, s)) in phasors.iter().zip(cosine.iter().zip(sine)) {
        for j in 0..BLOCK {
            cos0[j] += y[0].re * c[0][j];
            sin0[j] += y[0].im * s[0][j];
            cos2[j] += y[1].re * c[1][j];
            sin2[j] += y[1].im * s[1][j];
        }
    }
    [cos0, sin0, cos2, sin2]
}

/// The same of odd harmonics, and at pi/2 - psi, where cosines are sines and sines cosines but for signs.
#[inline(always)]
fn odd_sums(phasors: &[[C64; PAIR]], cosine: &[[Lanes; PAIR]], sine: &[[Lanes; PAIR]]) -> ([Lanes; 4], [Lanes; 4]) {
    let (mut cos1, mut sin1, mut cos3, mut sin3) = ([0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK]);
    let (mut next_cos1, mut next_sin1, mut next_cos3, mut next_sin3) = ([0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK]);
    for (y, (c, s)) in phasors.iter().zip(cosine.iter().zip(sine)) {
        for j in 0..BLOCK {
            cos1[j] += y[0].re * c[0][j];
            sin1[j] += y[0].im * s[0][j];
            cos3[j] += y[1].re * c[1][j];
            sin3[j] += y[1].im * s[1][j];
            next_cos1[j] += y[0].re * s[0][j];
            next_sin1[j] += y[0].im * c[0][j];
            next_cos3[j] += y[1].re * s[1][j];
            next_sin3[j] += y[1].im * c[1][j];
        }
    }
    ([cos1, sin1, cos3, sin3], [next_cos1, next_sin1, next_cos3, next_sin3])
}

/// f at equidistant angles of a period, by phasors, cosines and sines, `evens` of them of even harmonics.
#[kernel]
fn sample(phasors: &[C64], evens: usize, (cosine, sine): (&[Lanes], &[Lanes]), f: &mut [f64]) -> Sampled {
    let (first, rest) = f.split_at_mut(f.len() / 4);
    let (second, rest) = rest.split_at_mut(first.len());
    let (third, fourth) = rest.split_at_mut(first.len());
    let [first, second, third, fourth] = [first, second, third, fourth].map(|quarter| quarter.as_chunks_mut::<BLOCK>().0);
    let mut ends = ([f64::INFINITY; BLOCK], [f64::NEG_INFINITY; BLOCK]);
    let last = first.len() - 1;
    let (even, odd) = phasors.split_at(evens);
    let (even, odd) = (even.as_chunks::<PAIR>().0, odd.as_chunks::<PAIR>().0);
    for (b, (cosine, sine)) in cosine.chunks(phasors.len()).zip(sine.chunks(phasors.len())).enumerate() {
        let ((even_cosine, odd_cosine), (even_sine, odd_sine)) = (cosine.split_at(evens), sine.split_at(evens));
        let [cos0, sin0, cos2, sin2] = &even_sums(even, even_cosine.as_chunks().0, even_sine.as_chunks().0);
        let ([cos1, sin1, cos3, sin3], [next_cos1, next_sin1, next_cos3, next_sin3]) =
            &odd_sums(odd, odd_cosine.as_chunks().0, odd_sine.as_chunks().0);
        let (add, subtract) = (|a: f64, b: f64| a + b, |a: f64, b: f64| a - b);
        let r = last - b;
        let backwards = |f: Lanes| -> Lanes { std::array::from_fn(|j| f[BLOCK - 1 - j]) };
        let f = quarters(&each(cos0, cos2, add), &each(sin0, sin2, add), &each(cos1, cos3, add), &each(sin1, sin3, add), &mut ends);
        (first[b], second[r], third[b], fourth[r]) = (f[0], backwards(f[1]), f[2], backwards(f[3]));
        let f = quarters(
            &each(cos0, cos2, subtract),
            &each(sin2, sin0, subtract),
            &each(next_cos1, next_cos3, subtract),
            &each(next_sin1, next_sin3, subtract),
            &mut ends,
        );
        (first[r], second[b], third[r], fourth[b]) = (backwards(f[0]), f[1], backwards(f[2]), f[3]);
    }
    let (lows, highs) = ends;
    Sampled { lows, highs, low: -largest(lows.map(|v| -v)), high: largest(highs) }
}
