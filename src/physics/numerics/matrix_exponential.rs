//! The exponential of a matrix, by the same bits on every processor.

use super::elementary::Elementary;
use super::lu::Lu;
use super::matrix_product::{ROWS, product};
use nalgebra::DMatrix;
use nalgebra::linalg::balancing::{balance_parlett_reinsch, unbalance};

/// Largest norm at which Padé's approximant of degree 13 is exact to rounding \[Higham 2005\] table 2.3.
const THETA: f64 = 5.371_920_351_148_152;
/// Its coefficients.
const PADE: [f64; 14] = [
    64_764_752_532_480_000.0,
    32_382_376_266_240_000.0,
    7_771_770_303_897_600.0,
    1_187_353_796_428_800.0,
    129_060_195_264_000.0,
    10_559_470_521_600.0,
    670_442_572_800.0,
    33_522_128_640.0,
    1_323_241_920.0,
    40_840_800.0,
    960_960.0,
    16_380.0,
    182.0,
    1.0,
];

/// exp A of a square matrix by scaling, Padé's approximant of degree 13 and squaring \[Higham 2005\] algorithm 2.3; not finite where A is not. It is scaled by roots of the norms of its powers, which are far below
/// its norm where units differ, so that fewer squarings spoil digits \[Al-Mohy & Higham 2009\], and balanced before.
pub fn matrix_exponential(a: &DMatrix<f64>) -> DMatrix<f64> {
    let size = a.nrows();
    let norm = |m: &DMatrix<f64>| m.column_iter().map(|c| c.iter().map(|x| x.abs()).sum::<f64>()).fold(0.0, f64::max);
    let undefined = || DMatrix::from_element(size, size, f64::NAN);
    if a.iter().any(|x| !x.is_finite()) {
        return undefined();
    }
    // by powers of two: no digit is lost
    let mut a = a.clone();
    let scales = balance_parlett_reinsch(&mut a);
    // filled up with zeros to whole groups of rows, whose exponential is one on the diagonal there
    let height = size.next_multiple_of(ROWS);
    let a = a.resize(height, height, 0.0);
    let a2 = product(&a, &a);
    let a4 = product(&a2, &a2);
    let a6 = product(&a4, &a2);
    let root = |m: &DMatrix<f64>, power: f64| norm(m).power(1.0 / power);
    let largest = norm(&a).min(root(&a4, 4.0).max(root(&a6, 6.0)));
    let halvings = if largest > THETA { ((largest / THETA).logarithm() / std::f64::consts::LN_2).ceil().min(500.0) as i32 } else { 0 };
    let scale = 0.5f64.powi(halvings);
    let (a, a2, a4, a6) = (a * scale, a2 * scale.powi(2), a4 * scale.powi(4), a6 * scale.powi(6));
    // c6 A^6 + c4 A^4 + c2 A^2 + c0
    let sum = |c: [f64; 3], c0: f64| {
        let mut sum = a6.zip_zip_map(&a4, &a2, |a6, a4, a2| c[0] * a6 + c[1] * a4 + c[2] * a2);
        (0..height).for_each(|i| sum[(i, i)] += c0);
        sum
    };
    let part = |from: usize| {
        let high = sum([PADE[from + 12], PADE[from + 10], PADE[from + 8]], 0.0);
        product(&a6, &high) + sum([PADE[from + 6], PADE[from + 4], PADE[from + 2]], PADE[from])
    };
    let (even, odd) = (part(0), product(&a, &part(1)));
    let Some(mut exponential) = Lu::new(&(&even - &odd)).solve_all(&(even + odd)) else { return undefined() };
    (0..halvings).for_each(|_| exponential = product(&exponential, &exponential));
    let mut exponential = exponential.resize(size, size, 0.0);
    unbalance(&mut exponential, &scales);
    exponential
}
