//! Multiplication of periodic functions, harmonic by harmonic.
//!
//! A function is kept as its mean and the phasors of harmonics 1 to H, x = X0 + sum of Re(X_k e^{i k psi}), in reals: X0, Re X1, Im X1, and so on.

use crate::numerics::{C64, ZERO};
use hartog_kernel::kernel;
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
        let (scale, most) = (0.5 / self.samples as f64, 2 * self.harmonics);
        let mut spectra = [Spectrum::zeros(most), Spectrum::zeros(most)];
        for k in 0..=most {
            let (own, mirrored) = (z[k] * scale, z[(self.samples - k) % self.samples].conj() * scale);
            let difference = own - mirrored;
            spectra[0].set(k, own + mirrored);
            spectra[1].set(k, C64::new(difference.im, -difference.re));
        }
        spectra
    }
}

/// Coefficients of e^{i k psi} for k from -2 H to 2 H, or of a constant, by parts.
#[derive(Debug, Clone)]
pub(super) struct Spectrum {
    /// 2 H.
    most: usize,
    re: Vec<f64>,
    im: Vec<f64>,
}

impl Spectrum {
    fn zeros(most: usize) -> Self {
        Self { most, re: vec![0.0; 2 * most + 1], im: vec![0.0; 2 * most + 1] }
    }

    /// Of a function that is the same everywhere.
    pub fn constant(value: f64) -> Self {
        Self { most: 0, re: vec![value], im: vec![0.0] }
    }

    /// That of k, and of -k its conjugate.
    fn set(&mut self, k: usize, value: C64) {
        (self.re[self.most + k], self.im[self.most + k]) = (value.re, value.im);
        (self.re[self.most - k], self.im[self.most - k]) = (value.re, -value.im);
    }

    /// Of k from nothing up.
    fn at(&self, k: usize) -> C64 {
        if k > self.most { ZERO } else { C64::new(self.re[self.most + k], self.im[self.most + k]) }
    }

    /// Phasor of a harmonic.
    pub fn phasor(&self, k: usize) -> C64 {
        if k == 0 { self.at(0) } else { 2.0 * self.at(k) }
    }

    /// Coefficients from k on, by parts.
    fn from(&self, k: isize) -> [&[f64]; 2] {
        let first = self.most.saturating_add_signed(k);
        [&self.re[first..], &self.im[first..]]
    }
}

/// What a change of the phasor of an unknown does to a sum of products at each harmonic from the first on: p X + q conj(X).
struct Pairs {
    p: [Vec<f64>; 2],
    q: [Vec<f64>; 2],
}

impl Pairs {
    fn new(harmonics: usize) -> Self {
        let none = || [vec![0.0; harmonics], vec![0.0; harmonics]];
        Self { p: none(), q: none() }
    }

    /// Of phasor k, by a factor in each product's second function.
    fn set(&mut self, k: usize, products: &[(&Spectrum, C64)]) {
        self.p.iter_mut().chain(&mut self.q).for_each(|part| part.fill(0.0));
        for (spectrum, factor) in products {
            if spectrum.most == 0 {
                self.p[0][k - 1] += spectrum.re[0] * factor.re;
                self.p[1][k - 1] += spectrum.re[0] * factor.im;
            } else {
                add_times(&mut self.p, spectrum.from(1 - k as isize), *factor);
                add_times(&mut self.q, spectrum.from(1 + k as isize), factor.conj());
            }
        }
    }
}

#[kernel]
fn add_times(sum: &mut [Vec<f64>; 2], values: [&[f64]; 2], factor: C64) {
    let [re, im] = sum;
    let n = re.len();
    let ([a, b], re, im) = (values.map(|part| &part[..n]), &mut re[..n], &mut im[..n]);
    for i in 0..n {
        re[i] += a[i] * factor.re - b[i] * factor.im;
        im[i] += a[i] * factor.im + b[i] * factor.re;
    }
}

/// Adds to `matrix`, from its element `at` on, the matrix that takes an unknown's reals to those of `row` times the harmonics of the sum of products: `products(k)` are the functions and what the unknown's
/// phasor k is in each; its mean stands in `mean`. Rows and columns of means are there where asked for.
pub(super) fn add_products<'s, const N: usize>(
    matrix: &mut DMatrix<f64>,
    (top, left): (usize, usize),
    (mean_row, mean): (bool, Option<&'s Spectrum>),
    row: &[C64],
    products: impl Fn(usize) -> [(&'s Spectrum, C64); N],
) {
    // row of the mean, then of each harmonic
    let harmonics = row.len() - 1;
    let (r0, c0) = (usize::from(mean_row), usize::from(mean.is_some()));
    if let Some(mean) = mean {
        for (h, row) in row.iter().enumerate().skip(1) {
            let y = row * 2.0 * mean.at(h);
            matrix[(top + r0 + 2 * h - 2, left)] += y.re;
            matrix[(top + r0 + 2 * h - 1, left)] += y.im;
        }
        if mean_row {
            matrix[(top, left)] += row[0].re * mean.at(0).re;
        }
    }
    let mut pairs = Pairs::new(harmonics);
    for k in 1..=harmonics {
        let (column, products) = (left + c0 + 2 * k - 2, products(k));
        if mean_row {
            let y: C64 = products.iter().map(|(s, factor)| s.at(k).conj() * factor).sum::<C64>() * row[0].re;
            matrix[(top, column)] += y.re;
            matrix[(top, column + 1)] -= y.im;
        }
        pairs.set(k, &products);
        let rows = matrix.nrows();
        let (own, next) = matrix.as_mut_slice()[column * rows..(column + 2) * rows].split_at_mut(rows);
        let (own, next) = (&mut own[top + r0..], &mut next[top + r0..]);
        let columns = own.as_chunks_mut::<2>().0.iter_mut().zip(next.as_chunks_mut::<2>().0);
        for (i, (own, next)) in columns.take(harmonics).enumerate() {
            let row = row[i + 1];
            let (p, q) = (row * C64::new(pairs.p[0][i], pairs.p[1][i]), row * C64::new(pairs.q[0][i], pairs.q[1][i]));
            own[0] += p.re + q.re;
            own[1] += p.im + q.im;
            next[0] += q.im - p.im;
            next[1] += p.re - q.re;
        }
    }
}
