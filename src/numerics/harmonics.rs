//! Harmonic analysis of a sampled period.

use super::C64;
use std::f64::consts::TAU;

/// Complex amplitudes C_h of the harmonics `harmonics` of a periodic function given at equidistant points of one period,
/// f(psi_j) = mean + sum over h of Re(C_h e^{i h psi_j}), psi_j = 2 pi j / N: the trapezoidal rule, exact for a trigonometric polynomial of
/// degree below N/2.
pub fn analyse(samples: &[f64], harmonics: &[u32]) -> Vec<C64> {
    let n = samples.len();
    // the angle of every sample and harmonic is one of n: none is computed twice
    let turn: Vec<C64> = (0..n).map(|j| C64::cis(-TAU * j as f64 / n as f64)).collect();
    harmonics
        .iter()
        .map(|&h| {
            let sum: C64 = samples.iter().enumerate().map(|(j, &f)| turn[(j * h as usize) % n] * f).sum();
            sum * (if h == 0 { 1.0 } else { 2.0 } / n as f64)
        })
        .collect()
}
