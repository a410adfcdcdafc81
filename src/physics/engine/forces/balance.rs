//! What both methods share: the forces of a moment, the gas, the liner's friction, the torque of a force on the crankpin.

use crate::engine::Geometry;
use crate::numerics::elementary::Elementary;

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

/// Force of the rod on the piston along x where friction of the liner takes part: the piston asks for `wanted` without it, and the normal force is
/// |slope x + offset| for a force x. `motion`: dx/dtheta of the piston, towards the crankshaft. One of the two signs of the normal force fits, since
/// friction times slope is below one.
pub(crate) fn with_friction(geometry: &Geometry, motion: f64, wanted: f64, (slope, offset): (f64, f64)) -> f64 {
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
pub(crate) fn gas_force(geometry: &Geometry, pressure: f64) -> f64 {
    (pressure - geometry.crankcase_pressure) * geometry.piston_area()
}

/// Torque of a force on the crankpin, N m.
pub(crate) fn torque_of(geometry: &Geometry, theta: f64, big_end: [f64; 2]) -> f64 {
    let (sine, cosine) = theta.sine_cosine();
    geometry.slider_crank.crank_radius * (cosine * big_end[1] - sine * big_end[0])
}
