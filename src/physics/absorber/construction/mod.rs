//! Dampers by their dimensions: a ring on rubber or in oil whose stiffness, damping, strain, mass and width all follow from one drawing. One file a shape.
//!
//! The inertia of the ring and its section (outer diameter, radial wall) are given; the width follows: w = 2 J/(pi rho (ro⁴ - ri⁴)). What is sheared has S = B G* or B i omega eta*
//! ([`super::geometry`]) with the compound or the oil as its law. The inertia of rubber and oil is left out.

mod disc;
mod housing;
mod law;
mod shape;
mod sleeve;
mod wedge;

pub use disc::DISC;
pub use housing::HOUSING;
pub use shape::Shape;
pub use sleeve::SLEEVE;
pub use wedge::WEDGE;

use super::law::{Declaration, Law};

/// All shapes.
pub static SHAPES: [&Shape; 4] = [&sleeve::SHAPE, &disc::SHAPE, &wedge::SHAPE, &housing::SHAPE];

/// The shape of a type; `None` where the type is no damper by its dimensions.
pub fn shape(declaration: &Declaration) -> Option<&'static Shape> {
    SHAPES.into_iter().find(|s| s.declaration == declaration)
}

/// Derivatives of the inertia of a housing with respect to the declared parameters of a law; none where it has no housing.
pub(crate) fn hub_derivatives(law: &dyn Law) -> Vec<f64> {
    if law.hub_inertia() == 0.0 { Vec::new() } else { law.parts_by_dimensions().map_or_else(Vec::new, |p| p.hub_inertia.by.to_vec()) }
}

/// Derivatives of the logarithm of the strain per twist with respect to the declared parameters of a law, by their index; zero where it is given by the material.
pub(crate) fn strain_derivatives(law: &dyn Law) -> Vec<f64> {
    law.parts_by_dimensions().map_or_else(Vec::new, |p| p.strain_per_twist.by.map(|d| d / p.strain_per_twist.value).to_vec())
}
