//! Several complex numbers at a time: loops over their parts become vector instructions.

// every loop runs over the lanes of several arrays at once
#![allow(clippy::needless_range_loop)]

use crate::numerics::C64;

/// Points solved together.
pub(crate) const LANES: usize = 8;

/// A complex number of each point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Lane {
    pub(crate) re: [f64; LANES],
    pub(crate) im: [f64; LANES],
}

impl Lane {
    /// Zero at every point.
    pub(crate) const ZERO: Self = Self { re: [0.0; LANES], im: [0.0; LANES] };
    /// One at every point.
    pub(crate) const ONE: Self = Self { re: [1.0; LANES], im: [0.0; LANES] };

    /// Of one point.
    pub(crate) fn get(&self, lane: usize) -> C64 {
        C64::new(self.re[lane], self.im[lane])
    }

    /// Sets that of one point.
    pub(crate) fn set(&mut self, lane: usize, value: C64) {
        (self.re[lane], self.im[lane]) = (value.re, value.im);
    }

    /// The sum at each point.
    #[inline(always)]
    pub(crate) fn plus(&self, other: &Self) -> Self {
        let mut sum = *self;
        for l in 0..LANES {
            sum.re[l] += other.re[l];
            sum.im[l] += other.im[l];
        }
        sum
    }

    /// The difference at each point.
    #[inline(always)]
    pub(crate) fn minus(&self, other: &Self) -> Self {
        let mut difference = *self;
        for l in 0..LANES {
            difference.re[l] -= other.re[l];
            difference.im[l] -= other.im[l];
        }
        difference
    }

    /// Real multiples at each point.
    #[inline(always)]
    pub(crate) fn times(&self, factor: f64) -> Self {
        Self { re: self.re.map(|x| factor * x), im: self.im.map(|x| factor * x) }
    }

    /// Real multiples, of each point its own.
    #[inline(always)]
    pub(crate) fn scaled(&self, factor: &[f64; LANES]) -> Self {
        let mut product = *self;
        for l in 0..LANES {
            product.re[l] *= factor[l];
            product.im[l] *= factor[l];
        }
        product
    }

    /// The product at each point.
    #[inline(always)]
    pub(crate) fn by(&self, other: &Self) -> Self {
        let mut product = Self::ZERO;
        for l in 0..LANES {
            product.re[l] = self.re[l] * other.re[l] - self.im[l] * other.im[l];
            product.im[l] = self.re[l] * other.im[l] + self.im[l] * other.re[l];
        }
        product
    }

    /// The quotient at each point.
    #[inline(always)]
    pub(crate) fn over(&self, other: &Self) -> Self {
        let mut quotient = Self::ZERO;
        for l in 0..LANES {
            let scale = 1.0 / (other.re[l] * other.re[l] + other.im[l] * other.im[l]);
            quotient.re[l] = (self.re[l] * other.re[l] + self.im[l] * other.im[l]) * scale;
            quotient.im[l] = (self.im[l] * other.re[l] - self.re[l] * other.im[l]) * scale;
        }
        quotient
    }

    /// Absolute values.
    #[inline(always)]
    pub(crate) fn norm(&self) -> [f64; LANES] {
        let mut norm = [0.0; LANES];
        for l in 0..LANES {
            norm[l] = (self.re[l] * self.re[l] + self.im[l] * self.im[l]).sqrt();
        }
        norm
    }
}
