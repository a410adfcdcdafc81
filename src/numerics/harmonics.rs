//! Harmonic analysis of a sampled period.

use super::C64;
use std::f64::consts::TAU;

/// Complex amplitudes C_h of the harmonics `harmonics` of a periodic function given at equidistant points of one period,
/// f(psi_j) = mean + sum over h of Re(C_h e^{i h psi_j}), psi_j = 2 pi j / N: the trapezoidal rule, exact for a trigonometric polynomial of
/// degree below N/2.
pub fn analyse(samples: &[f64], harmonics: &[u32]) -> Vec<C64> {
    let n = samples.len();
    harmonics
        .iter()
        .map(|&h| {
            let sum: C64 = samples
                .iter()
                .enumerate()
                // the product is reduced first: sine and cosine of small arguments keep all their digits
                .map(|(j, &f)| C64::from_polar(f, -TAU * ((j * h as usize) % n) as f64 / n as f64))
                .sum();
            sum * (if h == 0 { 1.0 } else { 2.0 } / n as f64)
        })
        .collect()
}
