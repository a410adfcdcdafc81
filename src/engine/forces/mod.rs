//! Forces in one cylinder unit, and the torque on its throw.
//!
//! Axes of the cylinder: x along it, away from the crankshaft; y across it, the way the crankpin moves at firing dead centre. The crankpin is at
//! r (cos theta, sin theta), the rod leans by beta with L sin beta = r sin theta.

mod newton_euler;
mod traditional;

pub use newton_euler::newton_euler;
pub use traditional::traditional;

use super::{Geometry, RodModel};
use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::brent::BrentRoot;

/// A moment of the cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Cylinder pressure, Pa absolute.
    pub pressure: f64,
    /// Crank angle from firing dead centre, rad.
    pub theta: f64,
    /// Speed, rad/s.
    pub omega: f64,
}

/// Forces at a moment, N, as (x, y).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnitForces {
    /// Of the rod on the piston, at its pin.
    pub small_end: [f64; 2],
    /// Of the rod on the crankpin.
    pub big_end: [f64; 2],
    /// Of the liner on the piston, along y.
    pub liner: f64,
    /// Friction of the liner on the piston, along x, against its motion.
    pub friction: f64,
    /// On the crank, N m, positive in the direction of rotation.
    pub torque: f64,
}

/// The forces, by the method that the rod's data allow: two masses by the traditional one, a rigid body by Newton and Euler's.
pub fn unit_forces(geometry: &Geometry, at: Moment) -> UnitForces {
    match geometry.rod {
        RodModel::TwoMasses { .. } => traditional(geometry, at),
        RodModel::Body { .. } => newton_euler(geometry, at),
    }
}

/// Force of the rod on the piston along x where friction of the liner takes part: the piston asks for `wanted` without it, and the normal force is
/// |slope x + offset| for a force x. `motion`: dx/dtheta of the piston, towards the crankshaft. One of the two signs of the normal force fits, since
/// friction times slope is below one.
fn with_friction(geometry: &Geometry, motion: f64, wanted: f64, (slope, offset): (f64, f64)) -> f64 {
    let mu = geometry.liner_friction;
    if mu == 0.0 || motion == 0.0 {
        return wanted;
    }
    // a piston on its way to the crankshaft is held back, away from it: the rod has to bear less
    let pull = -mu * motion.signum();
    let force = |sign: f64| (wanted + pull * sign * offset) / (1.0 - pull * sign * slope);
    let up = force(1.0);
    if slope * up + offset >= 0.0 { up } else { force(-1.0) }
}

/// Force of the gas on the piston towards the crankshaft, N.
fn gas_force(geometry: &Geometry, pressure: f64) -> f64 {
    (pressure - geometry.crankcase_pressure) * geometry.piston_area()
}

/// Torque of a force on the crankpin, N m.
fn torque_of(geometry: &Geometry, theta: f64, big_end: [f64; 2]) -> f64 {
    let (sine, cosine) = theta.sin_cos();
    geometry.slider_crank.crank_radius * (cosine * big_end[1] - sine * big_end[0])
}

/// Torque of the gas on the crank, N m, positive in the direction of rotation: (p - p_crankcase) A dx/dtheta (virtual work; the same as
/// F sin(theta + beta)/cos(beta) r of \[Villalva 2014\] eq. (3.74)). `pressure` in Pa absolute, `theta` in rad from firing dead centre.
pub fn gas_torque(geometry: &Geometry, pressure: f64, theta: f64) -> f64 {
    gas_force(geometry, pressure) * geometry.slider_crank.motion(theta).slope
}

/// Torque that liner friction takes from the crank, N m; not above zero.
pub fn friction_torque(geometry: &Geometry, at: Moment) -> f64 {
    if geometry.liner_friction == 0.0 {
        return 0.0;
    }
    let without = Geometry { liner_friction: 0.0, ..geometry.clone() };
    unit_forces(geometry, at).torque - unit_forces(&without, at).torque
}

/// Torque of the moving masses at constant speed, divided by the square of the speed, kg m² (N m per (rad/s)²), by virtual work: -m x'' x' of what
/// oscillates \[Villalva 2014\] eq. (3.69), where the double angle takes a cosine, not the printed sine; and -dI beta'' beta' of the inertia of a rigid
/// rod beyond that of its two masses.
pub fn inertia_torque_per_omega2(geometry: &Geometry, theta: f64) -> f64 {
    let motion = geometry.slider_crank.motion(theta);
    let lean = geometry.slider_crank.lean(theta);
    -geometry.oscillating_mass() * motion.curvature * motion.slope - geometry.excess_inertia() * lean.curvature * lean.slope
}

/// Samples of a revolution in which peaks of inertia forces are looked for.
const SAMPLES: usize = 720;
/// Multiples of m a b between which an inertia is looked for.
const MULTIPLES: (f64, f64) = (0.25, 4.0);

/// Largest force of the moving masses on the crankpin across the cylinder, per square of the speed, N/(rad/s)², if the rod had this inertia.
pub fn inertia_force_across(geometry: &Geometry, inertia: f64) -> f64 {
    let rod = RodModel::Body { centre_from_big_end: geometry.rod_centre(), inertia };
    let body = Geometry { rod, ..geometry.clone() };
    let force = |j: usize| {
        let theta = std::f64::consts::TAU * j as f64 / SAMPLES as f64;
        newton_euler(&body, Moment { pressure: body.crankcase_pressure, theta, omega: 1.0 }).big_end[1].abs()
    };
    (0..SAMPLES).map(force).fold(0.0, f64::max)
}

/// Inertia of the rod, as a multiple of m a b (a, b: its centre to the eyes), at which doubling it raises the largest inertia force across the cylinder by
/// the share `growth`; nothing where no multiple from 1/4 to 4 does.
pub fn inertia_for_growth(geometry: &Geometry, growth: f64) -> Option<f64> {
    let unit = geometry.two_mass_inertia();
    let missing = |multiple: f64| {
        let own = inertia_force_across(geometry, multiple * unit);
        inertia_force_across(geometry, 2.0 * multiple * unit) / own - 1.0 - growth
    };
    let crosses = missing(MULTIPLES.0) * missing(MULTIPLES.1) < 0.0;
    if unit <= 0.0 || !crosses {
        return None;
    }
    let solver = BrentRoot::new(MULTIPLES.0, MULTIPLES.1, 1e-9);
    let found = Executor::new(Missing(missing), solver).configure(|s| s.max_iters(100)).timer(false).run().ok()?;
    found.state.best_param
}

struct Missing<F>(F);

impl<F: Fn(f64) -> f64> CostFunction for Missing<F> {
    type Param = f64;
    type Output = f64;
    fn cost(&self, x: &f64) -> Result<f64, Error> {
        Ok((self.0)(*x))
    }
}
