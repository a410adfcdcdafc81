//! Values of a sum of harmonics at equidistant samples of its period.

use super::C64;
use crate::numerics::elementary::Elementary;
use hartog_kernel::kernel;
use std::f64::consts::TAU;

/// Columns that are summed at a time.
const LANES: usize = 16;

/// Tables for one set of harmonics and one number of samples, the first of them at angle zero.
#[derive(Debug, Clone)]
pub struct PeriodicSums {
    samples: usize,
    /// Whether a quarter of the period is enough: the others mirror it, even and odd harmonics each in their way.
    quarter: bool,
    /// Indices of the harmonics, even ones first, and how many those are.
    sorted: Vec<usize>,
    evens: usize,
    /// Samples in the tables.
    columns: usize,
    /// Cosine and sine at these: block by block of samples, harmonic by harmonic.
    cosine: Vec<f64>,
    sine: Vec<f64>,
}

/// Cosine and sine parts of even and of odd harmonics.
type Parts = [[f64; LANES]; 4];

impl PeriodicSums {
    /// For harmonic numbers and a number of samples.
    pub fn new(harmonics: &[u32], samples: usize) -> Self {
        let (mut sorted, odd): (Vec<usize>, Vec<usize>) = (0..harmonics.len()).partition(|i| harmonics[*i].is_multiple_of(2));
        let evens = sorted.len();
        sorted.extend(odd);
        let quarter = samples.is_multiple_of(4);
        let columns = if quarter { samples / 4 + 1 } else { samples };
        let table = |f: fn(f64) -> f64| {
            let entry = |h: u32, j: usize| f(TAU * ((h as usize * j) % samples.max(1)) as f64 / samples as f64);
            let block = |b: usize| sorted.iter().flat_map(move |&i| (b * LANES..(b + 1) * LANES).map(move |j| entry(harmonics[i], j)));
            (0..columns.div_ceil(LANES)).flat_map(block).collect()
        };
        let (cosine, sine) = (table(f64::cosine), table(f64::sine));
        Self { samples, quarter, sorted, evens, columns, cosine, sine }
    }

    /// `mean` and the sum of Re(Y e^{i h psi}) at every sample.
    pub fn at(&self, phasors: &[C64], mean: f64, out: &mut Vec<f64>) {
        out.clear();
        out.resize(self.samples, mean);
        let sorted: Vec<C64> = self.sorted.iter().map(|i| phasors[*i]).collect();
        let (n, size) = (self.samples, LANES * sorted.len());
        let mut parts: Parts = [[0.0; LANES]; 4];
        for block in 0..self.cosine.len().checked_div(size).unwrap_or(0) {
            let own = block * size..(block + 1) * size;
            sum(&sorted, self.evens, &self.cosine[own.clone()], &self.sine[own], &mut parts);
            let [even_cosine, even_sine, odd_cosine, odd_sine] = &parts;
            for l in 0..LANES.min(self.columns - block * LANES) {
                let j = block * LANES + l;
                let (same, other) = (even_cosine[l] + odd_cosine[l], even_cosine[l] - odd_cosine[l]);
                let (sines, difference) = (even_sine[l] + odd_sine[l], even_sine[l] - odd_sine[l]);
                out[j] = mean + (same - sines);
                if self.quarter {
                    out[n / 2 - j] = mean + (other + difference);
                    out[n / 2 + j] = mean + (other - difference);
                    if j > 0 {
                        out[n - j] = mean + (same + sines);
                    }
                }
            }
        }
    }
}

#[kernel]
fn sum(phasors: &[C64], evens: usize, cosine: &[f64], sine: &[f64], parts: &mut Parts) {
    let (cosine, sine) = (cosine.as_chunks::<LANES>().0, sine.as_chunks::<LANES>().0);
    *parts = [[0.0; LANES]; 4];
    let [even_cosine, even_sine, odd_cosine, odd_sine] = parts;
    for ((y, c), s) in phasors[..evens].iter().zip(cosine).zip(sine) {
        for l in 0..LANES {
            even_cosine[l] += y.re * c[l];
            even_sine[l] += y.im * s[l];
        }
    }
    for ((y, c), s) in phasors[evens..].iter().zip(&cosine[evens..]).zip(&sine[evens..]) {
        for l in 0..LANES {
            odd_cosine[l] += y.re * c[l];
            odd_sine[l] += y.im * s[l];
        }
    }
}
