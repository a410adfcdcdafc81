//! Sums of magnitudes, several terms at a time: the same on every processor.

use super::C64;
use hartog_kernel::kernel;

const LANES: usize = 8;

/// Sum of magnitudes.
#[kernel]
pub(crate) fn sum(y: &[C64]) -> f64 {
    let (blocks, rest) = y.as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for y in blocks {
        for l in 0..LANES {
            sums[l] += (y[l].re * y[l].re + y[l].im * y[l].im).sqrt();
        }
    }
    rest.iter().fold(sums.iter().sum(), |sum, y| sum + (y.re * y.re + y.im * y.im).sqrt())
}

/// Sum of weighted magnitudes; as many weights as terms.
#[kernel]
pub(crate) fn weighted(y: &[C64], weights: &[f64]) -> f64 {
    let ((blocks, rest), (weights, others)) = (y.as_chunks::<LANES>(), weights.as_chunks::<LANES>());
    let mut sums = [0.0; LANES];
    for (y, w) in blocks.iter().zip(weights) {
        for l in 0..LANES {
            sums[l] += w[l] * (y[l].re * y[l].re + y[l].im * y[l].im).sqrt();
        }
    }
    rest.iter().zip(others).fold(sums.iter().sum(), |sum, (y, w)| sum + w * (y.re * y.re + y.im * y.im).sqrt())
}

/// Sum of the magnitudes of differences; as many terms in both.
#[kernel]
pub(crate) fn of_difference(a: &[C64], b: &[C64]) -> f64 {
    let ((blocks, rest), (others, other_rest)) = (a.as_chunks::<LANES>(), b.as_chunks::<LANES>());
    let mut sums = [0.0; LANES];
    for (a, b) in blocks.iter().zip(others) {
        for l in 0..LANES {
            let (re, im) = (a[l].re - b[l].re, a[l].im - b[l].im);
            sums[l] += (re * re + im * im).sqrt();
        }
    }
    let norm = |(a, b): (&C64, &C64)| ((a.re - b.re) * (a.re - b.re) + (a.im - b.im) * (a.im - b.im)).sqrt();
    rest.iter().zip(other_rest).map(norm).fold(sums.iter().sum(), |sum, d| sum + d)
}

/// Magnitudes of second derivatives of terms at the middle one of three places, by their slopes to both sides; `distances`: to the place before and to that after. As many terms in all.
#[kernel]
pub(crate) fn second_derivatives(before: &[C64], at: &[C64], after: &[C64], distances: [f64; 2], out: &mut [f64]) {
    let ([low, high], middle) = (distances.map(|d| 1.0 / d), 2.0 / (distances[0] + distances[1]));
    for (((b, y), a), out) in before.iter().zip(at).zip(after).zip(out) {
        let (re, im) = ((a.re - y.re) * high - (y.re - b.re) * low, (a.im - y.im) * high - (y.im - b.im) * low);
        *out = (re * re + im * im).sqrt() * middle;
    }
}
