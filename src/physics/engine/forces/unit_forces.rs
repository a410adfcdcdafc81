//! Forces of a cylinder and the torque on its throw.

use super::balance::{Moment, UnitForces, gas_force};
use super::newton_euler::newton_euler;
use super::traditional::traditional;
use crate::engine::{Geometry, RodModel};
use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::brent::BrentRoot;

/// The forces, by the method that the rod's data allow: two masses by the traditional one, a rigid body by Newton and Euler's.
pub fn unit_forces(geometry: &Geometry, at: Moment) -> UnitForces {
    match geometry.rod {
        RodModel::TwoMasses { .. } => traditional(geometry, at),
        RodModel::Body { .. } => newton_euler(geometry, at),
    }
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
