//! Centrifugal pendulums by their dimensions: N masses, sectors of a ring, each hung on two rollers so that it moves along its path without turning.
//!
//! Together they fill a share s of the circle from ri to ro. With the half angle alpha = pi s/N of each, its centre is at R0 = (2/3) (ro³ - ri³)/(ro² - ri²) sin(alpha)/alpha, and their width follows from the given
//! J = N m R0², as which they move ([`crate::absorber::pendulum`]). A path whose radius at rest is rho tunes them to the order n of n² = R0/rho - 1, rho = R0/(n² + 1), whatever it is farther out \[Den Hartog 1956\] section 5.7: the point that a
//! circle is about is at R0 - rho. Their inertia about their own centres turns with the hub and is added to it. For small swing: what a path does at large swing is in `circular_pendulum` and its like, by order instead of dimensions. Bores for
//! rollers and the inertia of these are left out, and so is the room that the swing asks for beyond the outer diameter: a corner moves out by about the sine of alpha times the arc.

use super::law::build;
use super::shape::{M_PER_MM, OUTER_DIAMETER, RING_DENSITY, Shape, Unfit, dimension};
use crate::absorber::law::Declaration;
use crate::absorber::parameter::{DAMPING, Parameter, RING_INERTIA, Range};
use crate::absorber::parts::{MOST, Medium, Number, Parts};
use crate::numerics::dual::Dual;
use std::f64::consts::PI;

/// Centrifugal pendulums by their dimensions.
pub static PENDULUM_MASSES: Declaration = Declaration {
    name: "pendulum_masses",
    about: "Centrifugal pendulums of small swing on two rollers each, by their dimensions.",
    parameters: &[
        Parameter { about: "Inertia of the masses as points at their centres.", ..RING_INERTIA },
        OUTER_DIAMETER,
        dimension(("mass_height_mm", "h/mm", "Radial height of a mass."), Range::Positive, (|_| (36.0, 44.0), |_| 40.0)),
        dimension(("masses", "masses", "How many masses there are."), Range::Within(2.0, 100.0), (|_| (3.0, 5.0), |_| 4.0)),
        dimension(
            ("filled_share", "share", "Share of the circle that the masses fill together."),
            Range::Within(0.05, 0.98),
            (|_| (0.72, 0.88), |_| 0.8),
        ),
        dimension(("path_radius_mm", "rho/mm", "Radius of the path at rest."), Range::Positive, (|_| (9.0, 11.0), |_| 10.0)),
        RING_DENSITY,
        DAMPING,
    ],
    build: |v| build(&SHAPE, v),
    closed_forms: &[],
};

pub(super) static SHAPE: Shape =
    Shape { declaration: &PENDULUM_MASSES, medium: Medium::Field, dimensions: 7, parts, tightest_at_least: &[1, 3], crowded };

fn parts(d: &[Number; MOST]) -> Parts<Number> {
    let [inertia, diameter, height, count, share, path, density, ..] = *d;
    let outer = diameter * (0.5 * M_PER_MM);
    let inner = outer - height * M_PER_MM;
    let path = path * M_PER_MM;
    let half_angle = share * PI / count;
    let of_arc = (outer.powi(2) + outer * inner + inner.powi(2)) / (outer + inner) * (2.0 / 3.0);
    let centre = of_arc * half_angle.sine() / half_angle;
    let area = (outer.powi(2) - inner.powi(2)) * share * PI;
    let mass = inertia / centre.powi(2);
    let width = mass / (density * area);
    let about_axis = mass * (outer.powi(2) + inner.powi(2)) * 0.5;
    Parts {
        factor: centre / path - Dual::constant(1.0),
        strain_per_twist: Dual::constant(0.0),
        stress_per_twist: Dual::constant(0.0),
        hub_inertia: about_axis - inertia,
        ring_mass: mass,
        hub_mass: Dual::constant(0.0),
        element_volume: Dual::constant(0.0),
        outer_diameter: outer * 2.0,
        width,
        bore: inner * 2.0,
        ring: [inner, outer],
        ring_width: width,
        element_length: Dual::constant(0.0),
        radius: centre,
    }
}

/// A path about a point that is not between axis and centre.
fn crowded(values: &[f64], parts: &Parts<f64>) -> Option<Unfit> {
    let (path, centre) = (values[5] * M_PER_MM, parts.radius);
    (path >= centre).then_some(Unfit::Path { path, centre })
}
