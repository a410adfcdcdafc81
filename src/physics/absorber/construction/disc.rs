//! A ring bonded to the hub by flat discs of rubber on one of its faces or on both.

use super::law::build;
use super::shape::{FACES, M_PER_MM, MODULUS, OUTER_DIAMETER, RING_DENSITY, RING_WALL, Shape, annulus, dimension, polar};
use crate::absorber::fractional_zener::{EXPONENT, GLASS_RATIO};
use crate::absorber::law::Declaration;
use crate::absorber::maxwell::RELAXATION_TIME;
use crate::absorber::parameter::{Parameter, RING_INERTIA, Range};
use crate::absorber::parts::{MOST, Medium, Number, Parts};
use crate::numerics::dual::Dual;

/// A ring bonded by flat discs of rubber.
pub static DISC: Declaration = Declaration {
    name: "disc",
    about: "A ring bonded to its hub by flat discs of rubber, by its dimensions.",
    parameters: &[
        RING_INERTIA,
        OUTER_DIAMETER,
        RING_WALL,
        dimension(("rubber_thickness_mm", "t/mm", "Axial thickness of each disc of rubber."), Range::Positive, (|_| (7.2, 8.8), |_| 8.0)),
        FACES,
        RING_DENSITY,
        MODULUS,
        GLASS_RATIO,
        Parameter { range: Range::Positive, ..RELAXATION_TIME },
        EXPONENT,
    ],
    build: |v| build(&SHAPE, v),
    closed_forms: &[],
};

pub(super) static SHAPE: Shape = Shape::sheared(&DISC, Medium::Rubber, 6, parts);

/// The discs are as wide as the ring; the flanges of the hub are not part of the width.
fn parts(d: &[Number; MOST]) -> Parts<Number> {
    let [inertia, diameter, wall, thickness, faces, density, ..] = *d;
    let outer = diameter * (0.5 * M_PER_MM);
    let inner = outer - wall * M_PER_MM;
    let thickness = thickness * M_PER_MM;
    let ring_width = inertia / (density * polar(inner, outer));
    Parts {
        factor: faces * polar(inner, outer) / thickness,
        strain_per_twist: outer / thickness,
        stress_per_twist: Dual::constant(0.0),
        hub_inertia: Dual::constant(0.0),
        ring_mass: density * annulus(inner, outer) * ring_width,
        hub_mass: Dual::constant(0.0),
        element_volume: faces * annulus(inner, outer) * thickness,
        outer_diameter: outer * 2.0,
        width: ring_width + faces * thickness,
        bore: inner * 2.0,
        ring: [inner, outer],
        ring_width,
        element_length: thickness,
        radius: Dual::constant(0.0),
    }
}
