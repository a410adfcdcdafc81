//! Elementary functions without branches and tables, by additions, products, quotients, roots and shifts alone: loops over them become vector instructions, with the same bits on every processor.
//!
//! They agree with those of [`elementary`](super::elementary) to a few units of the last place for arguments of ordinary size, and are not to be asked for any others.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_2_PI, LOG2_E};

/// ln 2 and pi/2, in two parts: products of the first with a small whole number are exact.
const LN_2: [f64; 2] = [f64::from_bits(0x3fe6_2e42_fee0_0000), 1.908_214_929_270_587_7e-10];
const FRAC_PI_2: [f64; 2] = [f64::from_bits(0x3ff9_21fb_5440_0000), 6.077_100_506_506_192e-11];
/// Added to a number it leaves the nearest whole one in the last bits of the sum.
const ROUND: f64 = 6_755_399_441_055_744.0;
/// Beyond these exp leaves the range of normal numbers.
const SMALLEST: f64 = -708.0;
const LARGEST: f64 = 709.0;

/// Sum of c_0 + c_1 x + ... with these coefficients, the highest first: even and odd powers apart, so that neither waits for the other.
#[inline(always)]
fn polynomial<const N: usize>(coefficients: [f64; N], x: f64) -> f64 {
    let (square, mut sums) = (x * x, [0.0; 2]);
    for (i, c) in coefficients.into_iter().enumerate() {
        sums[i % 2] = sums[i % 2] * square + c;
    }
    sums[N % 2] * x + sums[(N + 1) % 2]
}

/// 1/n! for n from `first` down by steps of `step`, with alternating signs where asked for.
const fn inverse_factorials<const N: usize>(first: u32, step: u32, alternating: bool) -> [f64; N] {
    let mut list = [0.0; N];
    let mut i = 0;
    while i < N {
        let (mut factorial, mut n) = (1.0, first - i as u32 * step);
        let negative = alternating && (n / step) % 2 == 1;
        while n > 1 {
            factorial *= n as f64;
            n -= 1;
        }
        list[i] = if negative { -1.0 } else { 1.0 } / factorial;
        i += 1;
    }
    list
}

/// 1/(2 n + 1) for n from `first` down, with alternating signs where asked for.
const fn inverse_odds<const N: usize>(first: u32, alternating: bool) -> [f64; N] {
    let mut list = [0.0; N];
    let mut i = 0;
    while i < N {
        let n = first - i as u32;
        list[i] = if alternating && n % 2 == 1 { -1.0 } else { 1.0 } / (2 * n + 1) as f64;
        i += 1;
    }
    list
}

/// e to the power x, by the exponential of what a multiple of ln 2 leaves, at most 0.35: its series to the 13th power.
#[inline(always)]
pub(crate) fn exponential(x: f64) -> f64 {
    const SERIES: [f64; 14] = inverse_factorials(13, 1, false);
    let x = x.clamp(SMALLEST, LARGEST);
    let shifted = x * LOG2_E + ROUND;
    let whole = shifted - ROUND;
    let rest = (x - whole * LN_2[0]) - whole * LN_2[1];
    polynomial(SERIES, rest) * f64::from_bits((shifted.to_bits() << 52).wrapping_add(1.0f64.to_bits()))
}

/// ln x of normal numbers above zero: with x = 2^n m and m between the roots of 1/2 and 2, ln m = 2 artanh s, s = (m - 1)/(m + 1) at most 0.172, by its series to the 23rd power.
#[inline(always)]
pub(crate) fn logarithm(x: f64) -> f64 {
    const SERIES: [f64; 11] = inverse_odds(11, false);
    let exponent = x.to_bits().wrapping_sub(FRAC_1_SQRT_2.to_bits()) & !0xf_ffff_ffff_ffff;
    let whole = f64::from_bits(ROUND.to_bits().wrapping_add(((exponent as i64) >> 52) as u64)) - ROUND;
    let f = f64::from_bits(x.to_bits().wrapping_sub(exponent)) - 1.0;
    let s = f / (2.0 + f);
    let square = s * s;
    // 2 s = f - s f, so that no digit of f is lost
    whole * LN_2[0] + (f - (s * (f - 2.0 * square * polynomial(SERIES, square)) - whole * LN_2[1]))
}

/// Angle of the point (x, y) with x above zero and y not below, by that of an eighth of it, a tangent of at most 0.2, y/(x + r) being that of half of it: by the series of arctan to the 25th power.
#[inline(always)]
pub(crate) fn angle(x: f64, y: f64) -> f64 {
    const SERIES: [f64; 13] = inverse_odds(12, true);
    let half = y / (x + (x * x + y * y).sqrt());
    let quarter = half / (1.0 + (1.0 + half * half).sqrt());
    let eighth = quarter / (1.0 + (1.0 + quarter * quarter).sqrt());
    8.0 * eighth * polynomial(SERIES, eighth * eighth)
}

/// sin x and cos x, by those of what a multiple of pi/2 leaves, at most 0.79: their series to the 17th and 18th power.
#[inline(always)]
pub(crate) fn sine_cosine(x: f64) -> (f64, f64) {
    const SINE: [f64; 9] = inverse_factorials(17, 2, true);
    const COSINE: [f64; 10] = inverse_factorials(18, 2, true);
    let shifted = x * FRAC_2_PI + ROUND;
    let whole = shifted - ROUND;
    let rest = (x - whole * FRAC_PI_2[0]) - whole * FRAC_PI_2[1];
    let square = rest * rest;
    let (sine, cosine) = (rest * polynomial(SINE, square), polynomial(COSINE, square));
    // quarter turns by the last two bits
    let quarters = shifted.to_bits();
    let sign = |bit: u64| f64::from_bits(((bit & 2) << 62) | 1.0f64.to_bits());
    let (first, second) = if quarters & 1 == 1 { (cosine, sine) } else { (sine, cosine) };
    (sign(quarters) * first, sign(quarters.wrapping_add(1)) * second)
}
