//! Numbers with their derivatives by a few variables (forward differentiation): exact to rounding, whatever formula they go through.

use super::elementary::Elementary;
use std::ops::{Add, Div, Mul, Sub};

/// A value and its derivatives by N variables.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dual<const N: usize> {
    /// The value.
    pub value: f64,
    /// Its derivatives.
    pub by: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// A constant.
    pub fn constant(value: f64) -> Self {
        Self { value, by: [0.0; N] }
    }

    /// The variables at these values.
    pub fn variables(values: [f64; N]) -> [Self; N] {
        std::array::from_fn(|i| Self { value: values[i], by: std::array::from_fn(|j| f64::from(u8::from(i == j))) })
    }

    /// A function of it by its value and derivative.
    fn through(self, value: f64, slope: f64) -> Self {
        Self { value, by: self.by.map(|d| slope * d) }
    }

    /// The derivatives of another added to its own.
    fn with(self, other: Self) -> Self {
        Self { value: self.value, by: std::array::from_fn(|i| self.by[i] + other.by[i]) }
    }

    /// The same by variables that are these factors times as large.
    #[must_use]
    pub(crate) fn rescaled(self, factor: impl Fn(usize) -> f64) -> Self {
        Self { value: self.value, by: std::array::from_fn(|i| self.by[i] * factor(i)) }
    }

    /// A whole power.
    #[must_use]
    pub fn powi(self, n: i32) -> Self {
        self.through(self.value.powi(n), f64::from(n) * self.value.powi(n - 1))
    }

    /// The sine.
    #[must_use]
    pub(crate) fn sine(self) -> Self {
        let (sine, cosine) = self.value.sine_cosine();
        self.through(sine, cosine)
    }
}

impl<const N: usize> Add for Dual<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, by: std::array::from_fn(|i| self.by[i] + other.by[i]) }
    }
}

impl<const N: usize> Sub for Dual<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, by: std::array::from_fn(|i| self.by[i] - other.by[i]) }
    }
}

impl<const N: usize> Mul for Dual<N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (left, right) = (self.through(self.value * other.value, other.value), other.through(0.0, self.value));
        left.with(right)
    }
}

impl<const N: usize> Div for Dual<N> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        self.through(value, 1.0 / other.value).with(other.through(0.0, -value / other.value))
    }
}

impl<const N: usize> Mul<f64> for Dual<N> {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        self.through(self.value * factor, factor)
    }
}
