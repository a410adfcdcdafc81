//! Harmonic analysis of a sampled period.

use super::C64;
use crate::numerics::elementary::turn;
use std::f64::consts::TAU;

/// Analyses functions sampled at the same points; the angles of all samples and harmonics are computed once.
#[derive(Debug, Clone)]
pub(crate) struct Analyser<'a> {
    /// e^{-i psi_j}: every sample and harmonic has one of these angles.
    turn: Vec<C64>,
    harmonics: &'a [u32],
}

impl<'a> Analyser<'a> {
    /// For `samples` equidistant points of a period.
    pub fn new(samples: usize, harmonics: &'a [u32]) -> Self {
        Self { turn: (0..samples).map(|j| turn(-TAU * j as f64 / samples as f64)).collect(), harmonics }
    }

    /// Complex amplitudes C_h of a periodic function given at the points psi_j = 2 pi j / N of one period,
    /// f(psi_j) = mean + sum over h of Re(C_h e^{i h psi_j}): the trapezoidal rule, exact for a trigonometric polynomial of degree below N/2.
    pub fn analyse(&self, samples: &[f64]) -> Vec<C64> {
        let n = self.turn.len();
        self.harmonics
            .iter()
            .map(|&h| {
                let step = h as usize % n;
                let mut place = 0;
                let mut sum = C64::default();
                for &f in samples {
                    sum += self.turn[place] * f;
                    place += step;
                    place -= if place >= n { n } else { 0 };
                }
                sum * (if h == 0 { 1.0 } else { 2.0 } / n as f64)
            })
            .collect()
    }
}

/// `analyse` of one function.
pub fn analyse(samples: &[f64], harmonics: &[u32]) -> Vec<C64> {
    Analyser::new(samples.len(), harmonics).analyse(samples)
}
