//! Harmonic analysis of a sampled period.

use super::C64;
use crate::numerics::elementary::turn;
use hartog_kernel::kernel;
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
        self.analyse_each(&[samples]).swap_remove(0)
    }

    /// The same of several functions. Samples at psi and -psi are added for the cosines and subtracted for the sines, of which only half a period is needed then.
    pub(crate) fn analyse_each(&self, functions: &[&[f64]]) -> Vec<Vec<C64>> {
        let (n, pairs) = (self.turn.len(), self.turn.len().saturating_sub(1) / 2);
        let folded = |f: &&[f64]| -> [Vec<f64>; 2] {
            let both = || f[1..=pairs].iter().zip(f[n - pairs..].iter().rev());
            [both().map(|(a, b)| a + b).collect(), both().map(|(a, b)| a - b).collect()]
        };
        let folded: Vec<[Vec<f64>; 2]> = functions.iter().map(folded).collect();
        // samples at zero and at half a period have no partner
        let sign = |h: u32| if h.is_multiple_of(2) { 1.0 } else { -1.0 };
        let alone = |f: &[f64], h: u32| f[0] + if n.is_multiple_of(2) { f[n / 2] * sign(h) } else { 0.0 };
        let mut sums: Vec<Vec<C64>> = functions.iter().map(|f| self.harmonics.iter().map(|h| C64::from(alone(f, *h))).collect()).collect();
        for first in (0..pairs).step_by(BLOCK) {
            let count = BLOCK.min(pairs - first);
            for (i, h) in self.harmonics.iter().enumerate() {
                let (step, mut place) = (*h as usize % n, (first + 1) * (*h as usize % n) % n);
                let mut turns = [[0.0; BLOCK]; 2];
                let [cosines, sines] = &mut turns;
                for (cosine, sine) in cosines.iter_mut().zip(sines).take(count) {
                    (*cosine, *sine) = (self.turn[place].re, self.turn[place].im);
                    place += step;
                    place -= if place >= n { n } else { 0 };
                }
                for (sums, folded) in sums.iter_mut().zip(&folded) {
                    let [even, odd] = folded.each_ref().map(|f| &f[first..first + count]);
                    sums[i] += C64::new(dot(even, &turns[0][..count]), dot(odd, &turns[1][..count]));
                }
            }
        }
        for sums in &mut sums {
            sums.iter_mut().zip(self.harmonics).for_each(|(sum, h)| *sum *= if *h == 0 { 1.0 } else { 2.0 } / n as f64);
        }
        sums
    }
}

/// Samples that are summed against the same turns at a time.
const BLOCK: usize = 256;
const LANES: usize = 16;

/// Sum of products.
#[kernel]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<LANES>(), b.as_chunks::<LANES>());
    let mut sums = [0.0; LANES];
    for (a, b) in a.iter().zip(b) {
        sums = std::array::from_fn(|l| sums[l] + a[l] * b[l]);
    }
    a_rest.iter().zip(b_rest).fold(sums.iter().sum(), |sum: f64, (a, b)| sum + a * b)
}

/// `analyse` of one function.
pub fn analyse(samples: &[f64], harmonics: &[u32]) -> Vec<C64> {
    Analyser::new(samples.len(), harmonics).analyse(samples)
}
