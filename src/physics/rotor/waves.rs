//! Sums of harmonics at samples of a cycle, and back.

use crate::numerics::elementary::Elementary;
use nalgebra::DMatrix;
use std::f64::consts::TAU;

/// Samples to a period of the highest harmonic.
const SAMPLES: usize = 8;

/// Rows of coefficients (the mean, then cosine parts of all harmonics, then their sine parts), a column each unknown.
pub(super) type Rows = DMatrix<f64>;

/// Samples of a cycle from coefficients, and back: of angles to half a turn, whose mirror has the sines with the other sign.
pub(super) struct Waves {
    cosines: DMatrix<f64>,
    sines: DMatrix<f64>,
    samples: usize,
}

impl Waves {
    pub(super) fn new(harmonics: usize) -> Self {
        let samples = SAMPLES * (harmonics + 1).max(2);
        let angle = |j: usize, m: usize| TAU * ((j * m) % samples) as f64 / samples as f64;
        let half = samples / 2 + 1;
        Self {
            cosines: DMatrix::from_fn(half, harmonics + 1, |j, m| angle(j, m).cosine()),
            sines: DMatrix::from_fn(half, harmonics, |j, m| angle(j, m + 1).sine()),
            samples,
        }
    }

    pub(super) fn to_samples(&self, rows: &Rows) -> DMatrix<f64> {
        let even = self.cosines.ncols();
        let (even, odd) = (&self.cosines * rows.rows(0, even), &self.sines * rows.rows(even, rows.nrows() - even));
        let half = self.samples / 2;
        DMatrix::from_fn(self.samples, rows.ncols(), |j, c| match j <= half {
            true => even[(j, c)] - odd[(j, c)],
            false => even[(self.samples - j, c)] + odd[(self.samples - j, c)],
        })
    }

    pub(super) fn to_rows(&self, samples: &DMatrix<f64>) -> Rows {
        let (n, half) = (self.samples, self.samples / 2);
        let mirror = |j: usize| (j != 0 && j != half).then(|| n - j);
        let folded = |sign: f64| {
            DMatrix::from_fn(half + 1, samples.ncols(), |j, c| samples[(j, c)] + mirror(j).map_or(0.0, |k| sign * samples[(k, c)]))
        };
        let (even, odd) = (self.cosines.tr_mul(&folded(1.0)), self.sines.tr_mul(&folded(-1.0)));
        let weight = 2.0 / n as f64;
        DMatrix::from_fn(even.nrows() + odd.nrows(), samples.ncols(), |i, c| match i {
            0 => 0.5 * weight * even[(0, c)],
            i if i < even.nrows() => weight * even[(i, c)],
            i => -weight * odd[(i - even.nrows(), c)],
        })
    }
}
