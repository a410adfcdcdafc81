//! First-order Taylor models of complex functions over a box: y = centre + sum of slope_d x_d + rest, for every x_d from -1 to 1, with the rest in a disc \[Makino & Berz 2003\].
//!
//! Every operation keeps what it encloses: for all x of the box the result of exact arithmetic lies inside. Each adds sixteen units in the last place of its size to the rest for that of its own
//! floating-point numbers.

use super::elementary::{ComplexElementary, Elementary};
use super::{C64, ZERO};

/// Free variables, at most.
pub const MOST: usize = 6;
/// Share of its size that an operation may err by in floating-point numbers: sixteen units in the last place.
pub(crate) const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// A function of some variables, each from -1 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Taylor {
    /// Its value in the middle, but for the rest.
    pub centre: C64,
    /// Change per variable.
    pub slopes: [C64; MOST],
    /// Radius of the disc that holds what is left.
    pub rest: f64,
}

/// A bound of the size of a complex number from above, without a root.
fn size(z: C64) -> f64 {
    z.re.abs() + z.im.abs()
}

impl Taylor {
    /// A number that is known exactly.
    pub const fn constant(centre: C64) -> Self {
        Self { centre, slopes: [ZERO; MOST], rest: 0.0 }
    }

    /// A real variable between two values: that of this index.
    pub fn between(low: f64, high: f64, index: usize) -> Self {
        let (centre, half) = (0.5 * (low + high), 0.5 * (high - low));
        let mut variable = Self::constant(C64::from(centre));
        variable.slopes[index] = C64::from(half);
        variable.rest = ROUNDING * (centre.abs() + half);
        variable
    }

    /// No sum of the slopes is larger than this: of two variables the larger diagonal of their parallelogram.
    fn linear(&self) -> f64 {
        let g = &self.slopes;
        let pair = |a: C64, b: C64| (a + b).norm_sqr().max((a - b).norm_sqr()).sqrt();
        pair(g[0], g[1]) + pair(g[2], g[3]) + pair(g[4], g[5])
    }

    /// Nothing of it is farther from the centre than this.
    pub fn reach(&self) -> f64 {
        self.linear() + self.rest
    }

    /// The same with what its last operation may have lost.
    fn rounded(mut self) -> Self {
        self.rest += ROUNDING * (size(self.centre) + self.slopes.iter().map(|g| size(*g)).sum::<f64>() + self.rest);
        self
    }

    /// The sum.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let mut sum = *self;
        sum.centre += other.centre;
        sum.slopes.iter_mut().zip(&other.slopes).for_each(|(a, b)| *a += b);
        sum.rest += other.rest;
        sum.rounded()
    }

    /// The difference.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        self.plus(&other.times_number(C64::from(-1.0)))
    }

    /// A multiple.
    #[must_use]
    pub(crate) fn times_number(&self, factor: C64) -> Self {
        let slopes = self.slopes.map(|g| g * factor);
        Self { centre: self.centre * factor, slopes, rest: self.rest * factor.norm() }.rounded()
    }

    /// The same and a number.
    #[must_use]
    pub(crate) fn plus_number(&self, number: C64) -> Self {
        self.plus(&Self::constant(number))
    }

    /// The product.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let (a, b, own, its) = (self.linear(), other.linear(), self.centre.norm(), other.centre.norm());
        let mut slopes = self.slopes;
        slopes.iter_mut().zip(&other.slopes).for_each(|(g, h)| *g = *g * other.centre + h * self.centre);
        let rest = a * b + (own + a) * other.rest + (its + b) * self.rest + self.rest * other.rest;
        // slopes may cancel
        let rest = rest + ROUNDING * (own * b + its * a);
        Self { centre: self.centre * other.centre, slopes, rest }.rounded()
    }

    /// A half-plane that holds all of it and not zero: the direction away from zero (of length one) and the distance; `None` where it may be zero.
    fn away_from_zero(&self) -> Option<(C64, f64)> {
        let own = self.centre.norm();
        let mut best = (ZERO, self.rest);
        let mut consider = |direction: C64| {
            let along = |z: C64| direction.re * z.re + direction.im * z.im;
            let centre = along(self.centre);
            let distance = centre.abs() - self.slopes.iter().map(|g| along(*g).abs()).sum::<f64>();
            if distance > best.1 {
                best = (direction * centre.signum(), distance);
            }
        };
        if own > 0.0 {
            consider(self.centre / own);
        }
        // beside a parallelogram the nearest line is often one along a side
        for slope in self.slopes.iter().filter(|g| **g != ZERO) {
            consider(C64::new(-slope.im, slope.re) / slope.norm());
        }
        let lost = ROUNDING * (size(self.centre) + self.slopes.iter().map(|g| size(*g)).sum::<f64>());
        let distance = best.1 - lost - self.rest;
        (best.0 != ZERO && distance > 0.0).then_some((best.0, distance))
    }

    /// Its inverse: by the tangent, or, where that says less, by the disc that the half-plane away from zero maps to; `None` where it may be zero.
    pub fn inverse(&self) -> Option<Self> {
        let (direction, distance) = self.away_from_zero()?;
        let (square, reach) = (self.centre.norm_sqr(), self.reach());
        let tangent = reach * reach / (square * distance) + self.rest / square;
        let half = 0.5 / distance;
        let by_tangent = self.linear() / square + tangent;
        if half < by_tangent || by_tangent.is_nan() {
            return Some(Self { rest: half, ..Self::constant(direction.conj() * half) }.rounded());
        }
        let by = -1.0 / (self.centre * self.centre);
        Some(Self { centre: 1.0 / self.centre, slopes: self.slopes.map(|g| g * by), rest: tangent }.rounded())
    }

    /// e to its power.
    #[must_use]
    pub fn exponential(&self) -> Self {
        let (own, reach) = (self.centre.exponential(), self.reach());
        let rest = own.norm() * (self.rest + 0.5 * reach * reach * reach.exponential());
        Self { centre: own, slopes: self.slopes.map(|g| g * own), rest }.rounded()
    }

    /// Its logarithm on the principal branch, for numbers right of zero; `None` where it may reach the imaginary axis or lies left of it.
    pub fn logarithm(&self) -> Option<Self> {
        let (size, reach) = (self.centre.norm(), self.reach());
        if self.centre.re <= reach {
            return None;
        }
        let share = reach / size;
        let by = 1.0 / self.centre;
        let rest = self.rest / size + 0.5 * share * share / (1.0 - share);
        Some(Self { centre: self.centre.logarithm(), slopes: self.slopes.map(|g| g * by), rest }.rounded())
    }

    /// (i y)^a of itself, y > 0, on the principal branch; `None` where y may be zero.
    pub(crate) fn imaginary_power(&self, exponent: &Self) -> Option<Self> {
        let logarithm = self.logarithm()?.plus_number(C64::new(0.0, std::f64::consts::FRAC_PI_2));
        Some(exponent.times(&logarithm).exponential())
    }

    /// Whether every number of it is one.
    pub fn is_finite(&self) -> bool {
        self.centre.is_finite() && self.slopes.iter().all(|g| g.is_finite()) && self.rest.is_finite()
    }
}
