//! A ring bonded to the hub by discs of rubber whose thickness grows with the radius: the strain is the same everywhere.
//! It is taken as sheared along the axis alone: by finite elements B is too small by about a third of the square of thickness over radius.

use super::law::build;
use super::shape::{FACES, M_PER_MM, MODULUS, OUTER_DIAMETER, RING_DENSITY, RING_WALL, Shape, annulus, dimension, polar};
use crate::absorber::fractional_zener::{EXPONENT, GLASS_RATIO};
use crate::absorber::law::Declaration;
use crate::absorber::maxwell::RELAXATION_TIME;
use crate::absorber::parameter::{Parameter, RING_INERTIA, Range};
use crate::absorber::parts::{MOST, Medium, Number, Parts};
use crate::numerics::dual::Dual;
use std::f64::consts::TAU;

/// A ring bonded by wedges of rubber.
pub static WEDGE: Declaration = Declaration {
    name: "wedge",
    about: "A ring bonded to its hub by rubber whose thickness grows with the radius, by its dimensions.",
    parameters: &[
        RING_INERTIA,
        OUTER_DIAMETER,
        RING_WALL,
        dimension(
            ("thickness_over_radius", "kappa", "Axial thickness of the rubber over the radius."),
            Range::Within(1e-3, 1.0),
            (|_| (0.072, 0.088), |_| 0.08),
        ),
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

pub(super) static SHAPE: Shape = Shape::sheared(&WEDGE, Medium::Rubber, 6, parts);

/// The ring is taken as flat: its width is that of its inertia over a rectangular section; the flanges of the hub are not part of the width.
fn parts(d: &[Number; MOST]) -> Parts<Number> {
    let [inertia, diameter, wall, slope, faces, density, ..] = *d;
    let outer = diameter * (0.5 * M_PER_MM);
    let inner = outer - wall * M_PER_MM;
    let ring_width = inertia / (density * polar(inner, outer));
    let cubes = outer.powi(3) - inner.powi(3);
    Parts {
        factor: faces * cubes / slope * (TAU / 3.0),
        strain_per_twist: Dual::constant(1.0) / slope,
        stress_per_twist: Dual::constant(0.0),
        hub_inertia: Dual::constant(0.0),
        ring_mass: density * annulus(inner, outer) * ring_width,
        hub_mass: Dual::constant(0.0),
        element_volume: faces * slope * cubes * (TAU / 3.0),
        outer_diameter: outer * 2.0,
        width: ring_width + faces * slope * outer,
        bore: inner * 2.0,
        ring: [inner, outer],
        ring_width,
        element_length: slope * outer,
        radius: Dual::constant(0.0),
    }
}
