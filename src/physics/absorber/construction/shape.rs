//! A damper by its dimensions: what its shapes have in common.

use crate::absorber::law::Declaration;
use crate::absorber::parameter::{Parameter, Range, Surroundings, of_material};
use crate::absorber::parts::{MOST, Medium, Number, Parts};
use crate::numerics::dual::Dual;

/// A damper by its dimensions.
#[derive(Debug)]
pub struct Shape {
    /// The type.
    pub declaration: &'static Declaration,
    /// What carries the ring.
    pub medium: Medium,
    /// How many of its parameters are dimensions, the inertia of the ring among them: the first ones.
    pub(super) dimensions: usize,
    /// What the dimensions come to: kg m², then as they are declared.
    pub(super) parts: fn(&[Number; MOST]) -> Parts<Number>,
    /// Dimensions, by their places, at whose least there is the least room; of all others at their most.
    pub(super) tightest_at_least: &'static [usize],
    /// What of it has no room beside a bore that is not above zero.
    pub(super) crowded: fn(&[f64], &Parts<f64>) -> Option<Unfit>,
}

/// Why a drawing cannot be made.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(hidden)]
pub enum Unfit {
    /// The diameter that is free inside, m: not above zero.
    Bore(f64),
    /// All springs together take this much of a circle that is only so long, m.
    Springs {
        /// m.
        taken: f64,
        /// m.
        there: f64,
    },
    /// The path of a pendulum mass has a radius that is not below that of its centre, m.
    Path {
        /// m.
        path: f64,
        /// m.
        centre: f64,
    },
}

impl Shape {
    /// One on rubber or in oil: its outer diameter comes after the inertia of the ring, and all else takes room.
    pub(super) const fn sheared(
        declaration: &'static Declaration,
        medium: Medium,
        dimensions: usize,
        parts: fn(&[Number; MOST]) -> Parts<Number>,
    ) -> Self {
        Self { declaration, medium, dimensions, parts, tightest_at_least: &[1], crowded: |_, _| None }
    }

    /// What the values of its parameters come to.
    pub fn parts_of(&self, values: &[f64]) -> Parts<f64> {
        (self.parts)(&variables(values, self.dimensions)).map(|x| x.value)
    }

    /// Its dimensions: the first of its parameters.
    pub fn drawn(&self) -> &'static [Parameter] {
        &self.declaration.parameters[..self.dimensions]
    }

    /// Whether a parameter is a dimension, by its place.
    #[doc(hidden)]
    pub fn is_dimension(&self, parameter: usize) -> bool {
        parameter < self.dimensions
    }

    /// Places of the parameters that are properties of its compound or oil, which a table may give; none of springs and pendulums.
    #[doc(hidden)]
    pub fn material(&self) -> std::ops::Range<usize> {
        let end = self.declaration.parameters.len();
        if self.medium.is_sheared() { self.dimensions..end } else { end..end }
    }

    /// Why a drawing with these values of its parameters cannot be made; `None` where it can.
    #[doc(hidden)]
    pub fn unfit(&self, values: &[f64]) -> Option<Unfit> {
        let parts = self.parts_of(values);
        if parts.bore <= 0.0 { Some(Unfit::Bore(parts.bore)) } else { (self.crowded)(values, &parts) }
    }

    /// Whether there is the least room where a dimension is least, by its place.
    #[doc(hidden)]
    pub fn tightest_at_least(&self, dimension: usize) -> bool {
        self.tightest_at_least.contains(&dimension)
    }

    /// The same with the derivatives by its dimensions.
    pub(super) fn with_derivatives(&self, values: &[f64]) -> Parts<Number> {
        (self.parts)(&variables(values, self.dimensions))
    }
}

fn variables(values: &[f64], dimensions: usize) -> [Number; MOST] {
    Dual::variables(std::array::from_fn(|i| if i < dimensions { values[i] } else { 0.0 }))
}

pub(super) const M_PER_MM: f64 = 1e-3;

/// Bounds and a typical value.
type Typical = (fn(&Surroundings) -> (f64, f64), fn(&Surroundings) -> f64);

/// A dimension: a study gives it, or its bounds; the typical ones make a damper for a truck's engine.
pub(super) const fn dimension(names: (&'static str, &'static str, &'static str), range: Range, typical: Typical) -> Parameter {
    of_material(names, range, typical.0, typical.1)
}

pub(super) const OUTER_DIAMETER: Parameter =
    dimension(("outer_diameter_mm", "D/mm", "Outer diameter."), Range::Positive, (|_| (225.0, 275.0), |_| 250.0));
pub(super) const RING_WALL: Parameter =
    dimension(("ring_wall_mm", "wall/mm", "Radial height of the ring's section."), Range::Positive, (|_| (18.0, 22.0), |_| 20.0));
pub(super) const RING_DENSITY: Parameter = dimension(
    ("ring_density_kg_m3", "rho/kg/m³", "Density of the ring: 7850 of steel, 7200 of cast iron."),
    Range::Within(500.0, 25_000.0),
    (|_| (7065.0, 8635.0), |_| 7850.0),
);
/// How many springs there are.
pub(super) const SPRINGS: Parameter =
    dimension(("springs", "springs", "How many springs there are."), Range::Within(1.0, 1000.0), (|_| (6.0, 8.0), |_| 8.0));
pub(super) const FACES: Parameter =
    dimension(("faces", "faces", "How many faces of the ring are bonded: 1 or 2."), Range::Within(1.0, 2.0), (|_| (1.0, 2.0), |_| 1.0));
pub(super) const MODULUS: Parameter = of_material(
    ("relaxed_modulus_mpa", "Gr/MPa", "Shear modulus of the compound at low frequency."),
    Range::Positive,
    |_| (0.1, 10.0),
    |_| 1.0,
);

/// Volume of a ring per length, m².
pub(super) fn annulus(inner: Number, outer: Number) -> Number {
    (outer.powi(2) - inner.powi(2)) * std::f64::consts::PI
}

/// Polar second moment of its section, m⁴.
pub(super) fn polar(inner: Number, outer: Number) -> Number {
    (outer.powi(4) - inner.powi(4)) * std::f64::consts::FRAC_PI_2
}

/// B of a sleeve of some length, m³: 4 pi L r1² r2²/(r2² - r1²).
pub(super) fn sleeve_factor(inner: Number, outer: Number, length: Number) -> Number {
    length * inner.powi(2) * outer.powi(2) / (outer.powi(2) - inner.powi(2)) * (4.0 * std::f64::consts::PI)
}
