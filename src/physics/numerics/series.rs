//! Sums of consecutive harmonics and their derivatives, several harmonics at a time: the same on every processor.

use super::C64;
use hartog_kernel::kernel;

const LANES: usize = 8;

/// f = sum of Re(`y[n]` e^{i (n + 1) psi}) and its first three derivatives at psi, by e^{i psi}.
#[kernel]
pub(super) fn derivatives(y: &[C64], turn: C64) -> (f64, f64, f64, f64) {
    let product = |a: (f64, f64), b: (f64, f64)| (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0);
    // powers of the turn by products
    let one = (turn.re, turn.im);
    let two = product(one, one);
    let four = product(two, two);
    let (mut turns, mut h) = ([one, two, product(one, two), four, four, four, four, four], [0.0; LANES]);
    for j in 0..LANES / 2 {
        turns[4 + j] = product(four, turns[j]);
    }
    let step = turns[LANES - 1];
    let (mut re, mut im) = (turns.map(|t| t.0), turns.map(|t| t.1));
    for (j, h) in h.iter_mut().enumerate() {
        *h = (j + 1) as f64;
    }
    let mut sums = [[0.0; LANES]; 4];
    let (blocks, rest) = y.as_chunks::<LANES>();
    let mut add = |j: usize, y: &C64| {
        let f = y.re * re[j] - y.im * im[j];
        let g = y.re * im[j] + y.im * re[j];
        sums[0][j] += f;
        let (f, g) = (h[j] * f, h[j] * g);
        sums[1][j] += g;
        let (f, g) = (h[j] * f, h[j] * g);
        sums[2][j] += f;
        sums[3][j] += h[j] * g;
        (re[j], im[j]) = (re[j] * step.0 - im[j] * step.1, re[j] * step.1 + im[j] * step.0);
        h[j] += LANES as f64;
    };
    for y in blocks {
        for (j, y) in y.iter().enumerate() {
            add(j, y);
        }
    }
    for (j, y) in rest.iter().enumerate() {
        add(j, y);
    }
    let sum = |s: &[f64; LANES]| ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
    (sum(&sums[0]), -sum(&sums[1]), -sum(&sums[2]), sum(&sums[3]))
}
