//! Gauss's distribution.

use super::elementary::Elementary;
use std::f64::consts::{SQRT_2, TAU};

/// Steps of Newton's method: each doubles the digits, of which three are there.
const STEPS: usize = 4;

/// The value below which a share of a normal distribution with mean 0 and deviation 1 lies: the inverse of Φ. `p` between 0 and 1; infinite at these.
///
/// The rational approximation 26.2.23 of \[Abramowitz & Stegun 1964\] (its error is below 4.5e-4), then Newton's method on erfc, which keeps its digits in the tail.
#[doc(hidden)]
pub fn normal_quantile(p: f64) -> f64 {
    if p > 0.5 {
        return -normal_quantile(1.0 - p);
    }
    if p <= 0.0 {
        return f64::NEG_INFINITY;
    }
    let t = (-2.0 * p.logarithm()).sqrt();
    let above = 2.515_517 + t * (0.802_853 + t * 0.010_328);
    let below = 1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308));
    let step = |x: f64| {
        let share = 0.5 * libm::erfc(-x / SQRT_2);
        let density = (-0.5 * x * x).exponential() / TAU.sqrt();
        x - (share - p) / density
    };
    (0..STEPS).fold(above / below - t, |x, _| step(x))
}
