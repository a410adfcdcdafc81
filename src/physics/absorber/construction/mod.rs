//! Dampers by their dimensions: a ring on rubber, in oil or on springs of steel, or pendulum masses, whose stiffness or tuning, strain or stress, mass and width all follow from one drawing. One file a shape.
//!
//! The inertia of the ring and its section (outer diameter, radial wall) are given; the width follows: w = 2 J/(pi rho (ro⁴ - ri⁴)). What is sheared has S = B G* or B i omega eta*
//! ([`super::geometry`]) with the compound or the oil as its law. Springs have their static stiffness by the drawing, and their damping beside it; pendulums their order. The inertia of rubber, oil and springs is left out.

mod coil_springs;
mod disc;
mod housing;
mod law;
mod leaf_springs;
mod own;
mod pendulum_masses;
mod shape;
mod sleeve;
mod wedge;

pub use coil_springs::COIL_SPRINGS;
pub use disc::DISC;
pub use housing::HOUSING;
pub use leaf_springs::LEAF_SPRINGS;
pub use pendulum_masses::PENDULUM_MASSES;
pub use shape::{Shape, Unfit};
pub use sleeve::SLEEVE;
pub use wedge::WEDGE;

use super::law::{Declaration, Law};
use super::parts::{Medium, Number, Parts};

/// All shapes.
pub static SHAPES: [&Shape; 7] =
    [&sleeve::SHAPE, &disc::SHAPE, &wedge::SHAPE, &housing::SHAPE, &leaf_springs::SHAPE, &coil_springs::SHAPE, &pendulum_masses::SHAPE];

/// The shape of a type; `None` where the type is no damper by its dimensions.
pub fn shape(declaration: &Declaration) -> Option<&'static Shape> {
    SHAPES.into_iter().find(|s| s.declaration == declaration)
}

/// Words of the shapes whose ring is carried by such media.
#[doc(hidden)]
pub fn words_of(media: impl Fn(Medium) -> bool) -> Vec<&'static str> {
    SHAPES.iter().filter(|s| media(s.medium)).map(|s| s.declaration.name).collect()
}

/// Derivatives of the inertia of a housing, or of pendulum masses about their own centres, with respect to the declared parameters of a law; none where it has none.
pub(crate) fn hub_derivatives(law: &dyn Law) -> Vec<f64> {
    if law.hub_inertia() == 0.0 { Vec::new() } else { law.parts_by_dimensions().map_or_else(Vec::new, |p| p.hub_inertia.by.to_vec()) }
}

/// Derivatives of the logarithm of the strain per twist with respect to the declared parameters of a law, by their index; zero where it is given by the material.
pub(crate) fn strain_derivatives(law: &dyn Law) -> Vec<f64> {
    logarithmic(law, |p| p.strain_per_twist)
}

/// The same of the stress of springs per twist.
pub(crate) fn stress_derivatives(law: &dyn Law) -> Vec<f64> {
    logarithmic(law, |p| p.stress_per_twist)
}

fn logarithmic(law: &dyn Law, of: impl Fn(&Parts<Number>) -> Number) -> Vec<f64> {
    law.parts_by_dimensions().map_or_else(Vec::new, |p| of(&p).by.map(|d| d / of(&p).value).to_vec())
}
