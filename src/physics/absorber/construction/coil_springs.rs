//! A ring on coil springs of steel that lie along a circle, each between a seat of the hub and one of the ring, and a viscous damper beside them.
//!
//! The twist shortens each of N springs by R theta: S = N k R² + i omega c with k = G d⁴/(8 D³ n) = G d/(8 C³ n) of a wire of diameter d in n active coils, C = D/d, and shear at the inside of the coil of K 8 F D/(pi d³), F = k R theta, with the
//! factor of curvature K = (4 C - 1)/(4 C - 4) + 0.615/C \[Wahl 1963\]: K G R/(pi C² d n) per twist. For C from 4 to 12. The coils touch the ring from inside: R = ri - (D + d)/2. Springs that are set so far that none comes loose act both ways;
//! the stress of that is not in it. Two more coils lie at the ends. Their friction at the ring and centrifugal force are left out, and so is the inertia of the springs.

use super::law::build;
use super::shape::{M_PER_MM, OUTER_DIAMETER, RING_DENSITY, RING_WALL, SPRINGS, Shape, Unfit, annulus, dimension, polar};
use crate::absorber::law::Declaration;
use crate::absorber::parameter::{DAMPING, Parameter, RING_INERTIA, Range};
use crate::absorber::parts::{MOST, Medium, Number, Parts};
use crate::numerics::dual::Dual;
use crate::units::PA_PER_GPA;
use std::f64::consts::{PI, TAU};

/// Coils at the ends of a spring, which do not act.
const END_COILS: f64 = 2.0;

/// A ring on coil springs of steel.
pub static COIL_SPRINGS: Declaration = Declaration {
    name: "coil_springs",
    about: "A ring on coil springs of steel with a damper beside them, by its dimensions.",
    parameters: &[
        RING_INERTIA,
        Parameter { about: "Outer diameter of the damper, that of its ring.", ..OUTER_DIAMETER },
        RING_WALL,
        SPRINGS,
        dimension(("wire_diameter_mm", "d/mm", "Diameter of the wire."), Range::Positive, (|_| (9.0, 11.0), |_| 10.0)),
        dimension(
            ("spring_index", "C", "Mean diameter of a coil over that of its wire."),
            Range::Within(3.0, 20.0),
            (|_| (4.0, 4.4), |_| 4.0),
        ),
        dimension(("active_coils", "n", "How many coils of a spring act."), Range::Within(1.0, 100.0), (|_| (2.7, 3.3), |_| 3.0)),
        RING_DENSITY,
        dimension(("shear_modulus_gpa", "G/GPa", "Shear modulus of the wire: 79 of steel."), Range::Positive, (|_| (77.0, 81.0), |_| 79.0)),
        DAMPING,
    ],
    build: |v| build(&SHAPE, v),
    closed_forms: &[],
};

pub(super) static SHAPE: Shape =
    Shape { declaration: &COIL_SPRINGS, medium: Medium::Coils, dimensions: 9, parts, tightest_at_least: &[1], crowded };

fn parts(d: &[Number; MOST]) -> Parts<Number> {
    let [inertia, diameter, wall, count, wire, index, coils, density, modulus] = *d;
    let outer = diameter * (0.5 * M_PER_MM);
    let inner = outer - wall * M_PER_MM;
    let (wire, modulus) = (wire * M_PER_MM, modulus * PA_PER_GPA);
    let mean = wire * index;
    let coil = mean + wire;
    let radius = inner - coil * 0.5;
    let rate = modulus * wire / (index.powi(3) * coils * 8.0);
    let four = index * 4.0;
    let one = Dual::constant(1.0);
    let curvature = (four - one) / (four - Dual::constant(4.0)) + Dual::constant(0.615) / index;
    let ring_width = inertia / (density * polar(inner, outer));
    Parts {
        factor: count * rate * radius.powi(2),
        strain_per_twist: Dual::constant(0.0),
        stress_per_twist: curvature * modulus * radius / (index.powi(2) * wire * coils * PI),
        hub_inertia: Dual::constant(0.0),
        ring_mass: density * annulus(inner, outer) * ring_width,
        hub_mass: Dual::constant(0.0),
        element_volume: count * (coils + Dual::constant(END_COILS)) * mean * wire.powi(2) * (0.25 * PI * PI),
        outer_diameter: outer * 2.0,
        width: if coil.value > ring_width.value { coil } else { ring_width },
        bore: (inner - coil) * 2.0,
        ring: [inner, outer],
        ring_width,
        element_length: coil,
        radius,
    }
}

/// Springs pressed flat, one behind the other round their circle.
fn crowded(values: &[f64], parts: &Parts<f64>) -> Option<Unfit> {
    let (taken, there) = (values[3] * (values[6] + END_COILS) * values[4] * M_PER_MM, TAU * parts.radius);
    (taken >= there).then_some(Unfit::Springs { taken, there })
}
