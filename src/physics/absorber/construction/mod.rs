//! Dampers by their dimensions: a ring on rubber or in oil whose stiffness, damping, strain, mass and width all follow from one drawing. One file a shape.
//!
//! The inertia of the ring and its section (outer diameter, radial wall) are given; the width follows: w = 2 J/(pi rho (ro⁴ - ri⁴)). What is sheared has S = B G* or B i omega eta*
//! ([`super::geometry`]) with the compound or the oil as its law. The inertia of rubber and oil is left out.

mod disc;
mod housing;
mod law;
mod sleeve;
mod wedge;

pub use disc::DISC;
pub use housing::HOUSING;
pub use sleeve::SLEEVE;
pub use wedge::WEDGE;

use super::law::{Declaration, Law};
use super::parameter::{Parameter, Range, of_material};
use crate::numerics::dual::Dual;

/// Most dimensions of a shape, the inertia of the ring among them.
const MOST: usize = 8;
/// A length, area or inertia with its derivatives by the dimensions.
pub type Number = Dual<MOST>;

/// What a drawing comes to, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parts<T> {
    /// B of what is sheared, m³.
    pub factor: T,
    /// Largest shear strain per twist, 1/rad.
    pub strain_per_twist: T,
    /// Of a housing, kg m²; zero where the hub is another part.
    pub hub_inertia: T,
    /// kg.
    pub ring_mass: T,
    /// Of a housing, kg.
    pub hub_mass: T,
    /// Of what is sheared, m³.
    pub sheared_volume: T,
    /// Outer diameter of all of it, m.
    pub outer_diameter: T,
    /// Width of all of it, m.
    pub width: T,
    /// Diameter that is free inside: of what is sheared, or of the housing, m.
    pub bore: T,
    /// Inner and outer radius of the ring, m.
    pub ring: [T; 2],
    /// Width of the ring, m.
    pub ring_width: T,
    /// Length of a sleeve or a wedge at its outer edge, thickness of a disc, radial gap of a housing, m.
    pub sheared_length: T,
}

impl<T: Copy> Parts<T> {
    pub(super) fn map<U>(&self, f: impl Fn(T) -> U) -> Parts<U> {
        Parts {
            factor: f(self.factor),
            strain_per_twist: f(self.strain_per_twist),
            hub_inertia: f(self.hub_inertia),
            ring_mass: f(self.ring_mass),
            hub_mass: f(self.hub_mass),
            sheared_volume: f(self.sheared_volume),
            outer_diameter: f(self.outer_diameter),
            width: f(self.width),
            bore: f(self.bore),
            ring: self.ring.map(&f),
            ring_width: f(self.ring_width),
            sheared_length: f(self.sheared_length),
        }
    }
}

/// What is sheared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sheared {
    /// Rubber.
    Rubber,
    /// Silicone oil.
    Oil,
}

/// A damper by its dimensions.
#[derive(Debug)]
pub struct Shape {
    /// The type.
    pub declaration: &'static Declaration,
    /// What is sheared.
    pub sheared: Sheared,
    /// How many of its parameters are dimensions, the inertia of the ring among them: the first ones.
    dimensions: usize,
    /// What the dimensions come to: kg m², then as they are declared.
    parts: fn(&[Number; MOST]) -> Parts<Number>,
}

impl Shape {
    /// What the values of its parameters come to.
    pub fn parts_of(&self, values: &[f64]) -> Parts<f64> {
        (self.parts)(&variables(values, self.dimensions)).map(|x| x.value)
    }

    /// Indices of the parameters that are properties of its compound or oil.
    #[doc(hidden)]
    pub fn material(&self) -> std::ops::Range<usize> {
        self.dimensions..self.declaration.parameters.len()
    }

    /// The same with the derivatives by its dimensions.
    fn with_derivatives(&self, values: &[f64]) -> Parts<Number> {
        (self.parts)(&variables(values, self.dimensions))
    }
}

fn variables(values: &[f64], dimensions: usize) -> [Number; MOST] {
    Dual::variables(std::array::from_fn(|i| if i < dimensions { values[i] } else { 0.0 }))
}

/// All shapes.
pub static SHAPES: [&Shape; 4] = [&sleeve::SHAPE, &disc::SHAPE, &wedge::SHAPE, &housing::SHAPE];

/// The shape of a type; `None` where the type is no damper by its dimensions.
pub fn shape(declaration: &Declaration) -> Option<&'static Shape> {
    SHAPES.into_iter().find(|s| s.declaration == declaration)
}

const M_PER_MM: f64 = 1e-3;

/// A dimension: a study gives it, or its bounds.
const fn dimension(names: (&'static str, &'static str, &'static str), range: Range) -> Parameter {
    of_material(names, range, |_| (1.0, 1.0), |_| 1.0)
}

const OUTER_DIAMETER: Parameter = dimension(("outer_diameter_mm", "D/mm", "Outer diameter."), Range::Positive);
const RING_WALL: Parameter = dimension(("ring_wall_mm", "wall/mm", "Radial height of the ring's section."), Range::Positive);
const RING_DENSITY: Parameter = dimension(
    ("ring_density_kg_m3", "rho/kg/m³", "Density of the ring: 7850 of steel, 7200 of cast iron."),
    Range::Within(500.0, 25_000.0),
);
const FACES: Parameter = dimension(("faces", "faces", "How many faces of the ring are bonded: 1 or 2."), Range::Within(1.0, 2.0));
const MODULUS: Parameter = of_material(
    ("relaxed_modulus_mpa", "Gr/MPa", "Shear modulus of the compound at low frequency."),
    Range::Positive,
    |_| (0.1, 10.0),
    |_| 1.0,
);

/// Volume of a ring per length, m².
fn annulus(inner: Number, outer: Number) -> Number {
    (outer.powi(2) - inner.powi(2)) * std::f64::consts::PI
}

/// Polar second moment of its section, m⁴.
fn polar(inner: Number, outer: Number) -> Number {
    (outer.powi(4) - inner.powi(4)) * std::f64::consts::FRAC_PI_2
}

/// B of a sleeve of some length, m³: 4 pi L r1² r2²/(r2² - r1²).
fn sleeve_factor(inner: Number, outer: Number, length: Number) -> Number {
    length * inner.powi(2) * outer.powi(2) / (outer.powi(2) - inner.powi(2)) * (4.0 * std::f64::consts::PI)
}

/// Density of rubber where no compound is named, kg/m³: assumption.
const RUBBER_DENSITY: f64 = 1150.0;
/// Density of silicone oil where none is named, kg/m³: assumption, 960 to 980 for all viscosities that matter.
const OIL_DENSITY: f64 = 970.0;

impl Sheared {
    /// Density where none is named, kg/m³: assumption.
    #[doc(hidden)]
    pub fn density(self) -> f64 {
        match self {
            Self::Rubber => RUBBER_DENSITY,
            Self::Oil => OIL_DENSITY,
        }
    }
}

/// Derivatives of the inertia of a housing with respect to the declared parameters of a law; none where it has no housing.
pub(crate) fn hub_derivatives(law: &dyn Law) -> Vec<f64> {
    if law.hub_inertia() == 0.0 { Vec::new() } else { law.parts_by_dimensions().map_or_else(Vec::new, |p| p.hub_inertia.by.to_vec()) }
}

/// Derivatives of the logarithm of the strain per twist with respect to the declared parameters of a law, by their index; zero where it is given by the material.
pub(crate) fn strain_derivatives(law: &dyn Law) -> Vec<f64> {
    law.parts_by_dimensions().map_or_else(Vec::new, |p| p.strain_per_twist.by.map(|d| d / p.strain_per_twist.value).to_vec())
}
