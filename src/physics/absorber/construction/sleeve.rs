//! A ring on a sleeve of rubber: pressed or bonded between hub and ring.

use super::law::build;
use super::shape::{M_PER_MM, MODULUS, OUTER_DIAMETER, RING_DENSITY, RING_WALL, Shape, annulus, dimension, polar, sleeve_factor};
use crate::absorber::fractional_zener::{EXPONENT, GLASS_RATIO};
use crate::absorber::law::Declaration;
use crate::absorber::maxwell::RELAXATION_TIME;
use crate::absorber::parameter::{Parameter, RING_INERTIA, Range};
use crate::absorber::parts::{MOST, Medium, Number, Parts};
use crate::numerics::dual::Dual;

/// A ring on a sleeve of rubber.
pub static SLEEVE: Declaration = Declaration {
    name: "sleeve",
    about: "A ring on a sleeve of rubber, by its dimensions.",
    parameters: &[
        RING_INERTIA,
        Parameter { about: "Outer diameter of the damper, that of its ring.", ..OUTER_DIAMETER },
        RING_WALL,
        dimension(("rubber_thickness_mm", "t/mm", "Radial thickness of the rubber."), Range::Positive, (|_| (7.2, 8.8), |_| 8.0)),
        dimension(
            ("length_over_width", "L/w", "Length of the rubber over the width of the ring."),
            Range::Within(0.05, 1.0),
            (|_| (0.81, 0.99), |_| 0.9),
        ),
        RING_DENSITY,
        MODULUS,
        GLASS_RATIO,
        Parameter { range: Range::Positive, ..RELAXATION_TIME },
        EXPONENT,
    ],
    build: |v| build(&SHAPE, v),
    closed_forms: &[],
};

pub(super) static SHAPE: Shape = Shape::sheared(&SLEEVE, Medium::Rubber, 6, parts);

fn parts(d: &[Number; MOST]) -> Parts<Number> {
    let [inertia, diameter, wall, thickness, share, density, ..] = *d;
    let outer = diameter * (0.5 * M_PER_MM);
    let inner = outer - wall * M_PER_MM;
    let hub = inner - thickness * M_PER_MM;
    let width = inertia / (density * polar(inner, outer));
    let length = share * width;
    Parts {
        factor: sleeve_factor(hub, inner, length),
        strain_per_twist: inner.powi(2) / (inner.powi(2) - hub.powi(2)) * 2.0,
        stress_per_twist: Dual::constant(0.0),
        hub_inertia: Dual::constant(0.0),
        ring_mass: density * annulus(inner, outer) * width,
        hub_mass: Dual::constant(0.0),
        element_volume: annulus(hub, inner) * length,
        outer_diameter: outer * 2.0,
        width,
        bore: hub * 2.0,
        ring: [inner, outer],
        ring_width: width,
        element_length: length,
        radius: Dual::constant(0.0),
    }
}
