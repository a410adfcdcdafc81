//! Physics-free mathematics.

pub(crate) mod abs_sums;
pub(crate) mod banded;
pub(crate) mod block_tridiagonal;
pub mod dual;
pub mod eigen;
pub mod elementary;
pub mod ellipsoid;
pub mod enclosing;
pub(crate) mod extremes;
pub(crate) mod gmres;
pub mod harmonics;
pub mod hull;
pub mod interpolation;
pub(crate) mod lazy_extremes;
pub mod least_squares;
pub(crate) mod lowest_modes;
pub(crate) mod lu;
pub mod matrix_exponential;
pub(crate) mod matrix_product;
pub mod maximise;
pub mod normal;
pub(crate) mod periodic_sums;
pub(crate) mod piecewise;
pub mod polyline;
pub(crate) mod projections;
pub mod quadrature;
pub mod rainflow;
pub(crate) mod ranked;
pub(crate) mod rational;
pub(crate) mod roots;
pub mod rounding;
mod samples;
mod sampling;
mod series;
pub mod significant;
pub(crate) mod simd_elementary;
pub(crate) mod sparse;
pub mod synthesis;
pub mod table_lookup;
pub mod taylor;
mod tree;
pub mod tridiagonal;

use elementary::Elementary;

/// A complex number.
pub type C64 = nalgebra::Complex<f64>;
/// The imaginary unit.
pub const I: C64 = C64::new(0.0, 1.0);
/// Complex zero.
pub const ZERO: C64 = C64::new(0.0, 0.0);

/// (i y)^a for y >= 0 on the principal branch, for many y.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ImaginaryPower {
    exponent: f64,
    /// i^a.
    turn: C64,
}

impl ImaginaryPower {
    /// For an exponent a.
    pub fn new(exponent: f64) -> Self {
        let (sin, cos) = (exponent * std::f64::consts::FRAC_PI_2).sine_cosine();
        Self { exponent, turn: C64::new(cos, sin) }
    }

    /// At y.
    pub fn of(self, y: f64) -> C64 {
        if y == 0.0 {
            return C64::from(y.power(self.exponent));
        }
        // a tenth of the time of a power that is exact to half a digit
        self.turn * (self.exponent * y.logarithm()).exponential()
    }

    /// The same without a branch, for y > 0 in loops.
    #[inline(always)]
    pub(crate) fn branchless(self, y: f64) -> C64 {
        let size = simd_elementary::exponential(self.exponent * simd_elementary::logarithm(y));
        C64::new(self.turn.re * size, self.turn.im * size)
    }
}

/// ln(i y) for y > 0, on the principal branch.
pub(crate) fn imaginary_ln(y: f64) -> C64 {
    C64::new(y.logarithm(), std::f64::consts::FRAC_PI_2)
}
