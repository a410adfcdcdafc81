//! The inner loop of sampling a sum of harmonics over its period.

use super::C64;
use multiversion::multiversion;

/// Samples that are summed at a time.
pub(super) const BLOCK: usize = 16;

/// f at equidistant angles of a period. Cosines and sines of even and of odd harmonics (`evens` even ones come first) are summed over its first
/// quarter; the other quarters have the same sums with other signs. Returns the smallest and the largest value.
#[multiversion(targets("x86_64+avx512f", "x86_64+avx2", "x86_64+avx", "aarch64+neon"))]
pub(super) fn sample(phasors: &[C64], evens: usize, cosine: &[f64], sine: &[f64], f: &mut [f64]) -> (f64, f64) {
    let (first, rest) = f.split_at_mut(f.len() / 4);
    let (second, rest) = rest.split_at_mut(first.len());
    let (third, fourth) = rest.split_at_mut(first.len());
    let (cosine, sine) = (cosine.as_chunks::<BLOCK>().0, sine.as_chunks::<BLOCK>().0);
    let forwards = first.as_chunks_mut::<BLOCK>().0.iter_mut().zip(third.as_chunks_mut::<BLOCK>().0);
    let backwards = second.as_chunks_mut::<BLOCK>().0.iter_mut().zip(fourth.as_chunks_mut::<BLOCK>().0).rev();
    let tables = cosine.chunks(phasors.len()).zip(sine.chunks(phasors.len()));
    let (mut low, mut high) = ([f64::INFINITY; BLOCK], [f64::NEG_INFINITY; BLOCK]);
    for (((first, third), (second, fourth)), (cosine, sine)) in forwards.zip(backwards).zip(tables) {
        let (mut even_cos, mut even_sin, mut odd_cos, mut odd_sin) = ([0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK]);
        for ((y, c), s) in phasors[..evens].iter().zip(&cosine[..evens]).zip(&sine[..evens]) {
            for j in 0..BLOCK {
                even_cos[j] += y.re * c[j];
                even_sin[j] += y.im * s[j];
            }
        }
        for ((y, c), s) in phasors[evens..].iter().zip(&cosine[evens..]).zip(&sine[evens..]) {
            for j in 0..BLOCK {
                odd_cos[j] += y.re * c[j];
                odd_sin[j] += y.im * s[j];
            }
        }
        for j in 0..BLOCK {
            let (sum, difference) = (even_cos[j] + odd_cos[j], even_cos[j] - odd_cos[j]);
            let (sines, other) = (even_sin[j] + odd_sin[j], even_sin[j] - odd_sin[j]);
            first[j] = sum - sines;
            third[j] = difference - other;
            second[BLOCK - 1 - j] = difference + other;
            fourth[BLOCK - 1 - j] = sum + sines;
            let (above, below) = (sum + sines.abs(), sum - sines.abs());
            high[j] = if above > high[j] { above } else { high[j] };
            low[j] = if below < low[j] { below } else { low[j] };
            let (above, below) = (difference + other.abs(), difference - other.abs());
            high[j] = if above > high[j] { above } else { high[j] };
            low[j] = if below < low[j] { below } else { low[j] };
        }
    }
    let smaller = |m: f64, v: &f64| if *v < m { *v } else { m };
    let larger = |m: f64, v: &f64| if *v > m { *v } else { m };
    (low.iter().fold(f64::INFINITY, smaller), high.iter().fold(f64::NEG_INFINITY, larger))
}
