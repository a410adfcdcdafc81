//! Multiplication of periodic functions, harmonic by harmonic.
//!
//! A function is kept as its mean and the phasors of harmonics 1 to H, x = X0 + sum of Re(X_k e^{i k psi}), in reals: X0, Re X1, Im X1, and so on.

use crate::numerics::{C64, ZERO};
use nalgebra::DMatrix;
use rustfft::{Fft, FftPlanner};
use std::sync::Arc;

/// Samples come in multiples of this: transforms of small factors are quick, and stability is looked at in steps of several.
const BLOCK: usize = 16;

/// Transforms between H harmonics and samples of the cycle.
pub(super) struct Transform {
    pub harmonics: usize,
    samples: usize,
    forward: Arc<dyn Fft<f64>>,
    backward: Arc<dyn Fft<f64>>,
}

impl Transform {
    /// Of functions that are polynomials of this degree: products of harmonics then reach none of those wanted from beyond the samples' own; at least eight samples a harmonic of any others.
    pub fn new(harmonics: usize, degree: Option<usize>) -> Self {
        let most = harmonics.max(1);
        let samples = degree.map_or_else(|| (8 * most).next_power_of_two(), |degree| ((degree + 1) * most + 1).next_multiple_of(BLOCK));
        let mut planner = FftPlanner::new();
        Self { harmonics, samples, forward: planner.plan_fft_forward(samples), backward: planner.plan_fft_inverse(samples) }
    }

    /// Samples of two functions at once, of means and phasors (zero where there are none).
    pub fn sampled(&self, (a0, a): (f64, &[C64]), (b0, b): (f64, &[C64])) -> Vec<C64> {
        let (mut z, i) = (vec![ZERO; self.samples], C64::new(0.0, 1.0));
        z[0] = C64::new(a0, b0);
        for k in 1..=self.harmonics {
            let half = |y: &[C64]| y.get(k - 1).map_or(ZERO, |y| 0.5 * y);
            let (a, b) = (half(a), half(b));
            z[k] = a + i * b;
            z[self.samples - k] = a.conj() + i * b.conj();
        }
        self.backward.process(&mut z);
        z
    }

    /// Two-sided spectra of two functions given by samples of a + i b.
    pub(super) fn spectra(&self, mut z: Vec<C64>) -> [Spectrum; 2] {
        self.forward.process(&mut z);
        let scale = 1.0 / self.samples as f64;
        let (mut a, mut b) = (Vec::with_capacity(2 * self.harmonics + 1), Vec::with_capacity(2 * self.harmonics + 1));
        for k in 0..=2 * self.harmonics {
            let (own, mirrored) = (z[k] * scale, z[(self.samples - k) % self.samples].conj() * scale);
            a.push(0.5 * (own + mirrored));
            b.push(C64::new(0.0, -0.5) * (own - mirrored));
        }
        [Spectrum(a), Spectrum(b)]
    }
}

/// Coefficients of e^{i k psi} for k from 0 to 2 H, or of a constant; those of -k are their conjugates.
#[derive(Debug, Clone)]
pub(super) struct Spectrum(pub Vec<C64>);

impl Spectrum {
    /// Of a function that is the same everywhere.
    pub fn constant(value: f64) -> Self {
        Self(vec![C64::from(value)])
    }

    /// Of any sign.
    fn at(&self, k: isize) -> C64 {
        let found = self.0.get(k.unsigned_abs()).copied().unwrap_or(ZERO);
        if k < 0 { found.conj() } else { found }
    }

    /// Phasor of a harmonic.
    pub fn phasor(&self, k: usize) -> C64 {
        if k == 0 { self.0[0] } else { 2.0 * self.at(k as isize) }
    }
}

/// What a change of phasor k of an unknown does to a sum of products: p X + q conj(X) at each harmonic; `factors` by which the unknown stands in each product's second function.
fn pair(products: &[(&Spectrum, C64)], h: usize, k: usize) -> (C64, C64) {
    let (h, k) = (h as isize, k as isize);
    let (mut p, mut q) = (ZERO, ZERO);
    for (spectrum, factor) in products {
        if spectrum.0.len() == 1 && h != k {
            continue;
        }
        p += spectrum.at(h - k) * factor;
        q += spectrum.at(h + k) * factor.conj();
    }
    (p, q)
}

/// Adds to `matrix`, from its element `at` on, the matrix that takes an unknown's reals to those of `row` times the harmonics of the sum of products: `products(k)` are the functions and what the unknown's
/// phasor k is in each; its mean stands in `mean`. Rows and columns of means are there where asked for.
pub(super) fn add_products<'s>(
    matrix: &mut DMatrix<f64>,
    (top, left): (usize, usize),
    harmonics: usize,
    (mean_row, mean): (bool, Option<&'s Spectrum>),
    row: &dyn Fn(usize) -> C64,
    products: &dyn Fn(usize) -> Vec<(&'s Spectrum, C64)>,
) {
    let (r0, c0) = (usize::from(mean_row), usize::from(mean.is_some()));
    if let Some(mean) = mean {
        for h in 1..=harmonics {
            let y = row(h) * 2.0 * mean.at(h as isize);
            matrix[(top + r0 + 2 * h - 2, left)] += y.re;
            matrix[(top + r0 + 2 * h - 1, left)] += y.im;
        }
        if mean_row {
            matrix[(top, left)] += row(0).re * mean.at(0).re;
        }
    }
    for k in 1..=harmonics {
        let (column, products) = (left + c0 + 2 * k - 2, products(k));
        if mean_row {
            let y: C64 = products.iter().map(|(s, factor)| s.at(-(k as isize)) * factor).sum::<C64>() * row(0).re;
            matrix[(top, column)] += y.re;
            matrix[(top, column + 1)] -= y.im;
        }
        for h in 1..=harmonics {
            let (p, q) = pair(&products, h, k);
            let (p, q, at) = (row(h) * p, row(h) * q, top + r0 + 2 * h - 2);
            matrix[(at, column)] += p.re + q.re;
            matrix[(at, column + 1)] += q.im - p.im;
            matrix[(at + 1, column)] += p.im + q.im;
            matrix[(at + 1, column + 1)] += p.re - q.re;
        }
    }
}
