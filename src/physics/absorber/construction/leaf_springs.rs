//! A ring on leaf springs of steel that stand radially, clamped in the hub, their ends in slots of the ring: guided along the circle, free to turn, without friction.
//!
//! Each of N leaves (length L, width b, thickness t) is a cantilever with a force at its end, which a twist moves by r theta, r being the inner radius of the ring:
//! S = N (3 E I/L³) r² with I = b t³/12, and at the clamp a stress of bending of 3 E t r/(2 L²) per twist \[Timoshenko 1956\]. Beams of small deflection without shear (t/L below a tenth: 1 %); leaves that are many times as wide as
//! thick are stiffer, by 1/(1 - nu²) = 1.10 at most. Stress concentration at the clamp, and what centrifugal force stiffens, are left out. The damping is that of oil squeezed between the leaves, by the figures of makers
//! ([`crate::absorber::spring_pack`]). The inertia of the leaves is left out.

use super::law::build;
use super::shape::{M_PER_MM, OUTER_DIAMETER, RING_DENSITY, RING_WALL, SPRINGS, Shape, Unfit, annulus, dimension, polar};
use crate::absorber::law::Declaration;
use crate::absorber::parameter::{Parameter, RING_INERTIA, Range};
use crate::absorber::parts::{MOST, Medium, Number, Parts};
use crate::absorber::spring_pack::{DAMPING_FACTOR, DYNAMIC_RATIO, REFERENCE_FREQUENCY};
use crate::numerics::dual::Dual;
use crate::units::PA_PER_GPA;
use std::f64::consts::PI;

/// A ring on leaf springs of steel.
pub static LEAF_SPRINGS: Declaration = Declaration {
    name: "leaf_springs",
    about: "A ring on leaf springs of steel in oil, by its dimensions.",
    parameters: &[
        RING_INERTIA,
        Parameter { about: "Outer diameter of the damper, that of its ring.", ..OUTER_DIAMETER },
        RING_WALL,
        Parameter { bounds: |_| (20.0, 28.0), typical: |_| 24.0, ..SPRINGS },
        dimension(
            ("leaf_length_mm", "L/mm", "Radial length of a leaf, from its clamp to the ring."),
            Range::Positive,
            (|_| (45.0, 55.0), |_| 50.0),
        ),
        dimension(("leaf_thickness_mm", "t/mm", "Thickness of a leaf."), Range::Positive, (|_| (2.2, 2.8), |_| 2.5)),
        dimension(
            ("leaf_over_width", "b/w", "Width of a leaf over the width of the ring."),
            Range::Within(0.05, 1.0),
            (|_| (0.72, 0.88), |_| 0.8),
        ),
        RING_DENSITY,
        dimension(
            ("youngs_modulus_gpa", "E/GPa", "Modulus of elasticity of the leaves: 206 of steel."),
            Range::Positive,
            (|_| (200.0, 212.0), |_| 206.0),
        ),
        DAMPING_FACTOR,
        DYNAMIC_RATIO,
        REFERENCE_FREQUENCY,
    ],
    build: |v| build(&SHAPE, v),
    closed_forms: &[],
};

pub(super) static SHAPE: Shape =
    Shape { declaration: &LEAF_SPRINGS, medium: Medium::Leaves, dimensions: 9, parts, tightest_at_least: &[1], crowded };

fn parts(d: &[Number; MOST]) -> Parts<Number> {
    let [inertia, diameter, wall, count, length, thickness, share, density, modulus] = *d;
    let outer = diameter * (0.5 * M_PER_MM);
    let slot = outer - wall * M_PER_MM;
    let (length, thickness, modulus) = (length * M_PER_MM, thickness * M_PER_MM, modulus * PA_PER_GPA);
    let clamp = slot - length;
    let ring_width = inertia / (density * polar(slot, outer));
    let breadth = share * ring_width;
    Parts {
        factor: count * modulus * breadth * thickness.powi(3) * slot.powi(2) / length.powi(3) * 0.25,
        strain_per_twist: Dual::constant(0.0),
        stress_per_twist: modulus * thickness * slot / length.powi(2) * 1.5,
        hub_inertia: Dual::constant(0.0),
        ring_mass: density * annulus(slot, outer) * ring_width,
        hub_mass: Dual::constant(0.0),
        element_volume: count * length * thickness * breadth,
        outer_diameter: outer * 2.0,
        width: ring_width,
        bore: clamp * 2.0,
        ring: [slot, outer],
        ring_width,
        element_length: breadth,
        radius: slot,
    }
}

/// Leaves side by side round the clamp.
fn crowded(values: &[f64], parts: &Parts<f64>) -> Option<Unfit> {
    let (taken, there) = (values[3] * values[5] * M_PER_MM, PI * parts.bore);
    (taken >= there).then_some(Unfit::Springs { taken, there })
}
