//! Radial force of a rod on its crankpin, outwards from the axis of the crank, as complex amplitudes of engine orders: what bends a flexible crank beside the torque.
//!
//! As the torque it is linear in the gauge pressure and in the square of the speed. The rotating part of the rod gives order zero only.

use super::Geometry;
use super::cycle::crank_fixed;
use super::forces::{Moment, unit_forces};
use super::pressure::{each_revolution, sample_angle};
use crate::units::RAD_PER_S_PER_RPM;

/// N.
fn radial(geometry: &Geometry, at: Moment) -> f64 {
    crank_fixed(unit_forces(geometry, at).big_end, at.theta)[0]
}

/// Of the moving masses over a cycle, per (rad/s)².
pub(super) fn of_masses(geometry: &Geometry, strokes: u32) -> Vec<f64> {
    let smooth = Geometry { liner_friction: 0.0, ..geometry.clone() };
    each_revolution(strokes, |theta| radial(&smooth, Moment { pressure: smooth.crankcase_pressure, theta, omega: 1.0 }))
}

/// Of the gas and of liner friction over a cycle: all but what the moving masses do without friction.
pub(super) fn of_gas(geometry: &Geometry, masses: &[f64], trace: &[f64], speed_rpm: f64) -> Vec<f64> {
    let omega = speed_rpm * RAD_PER_S_PER_RPM;
    let force_at = |(j, (&pressure, own)): (usize, (&f64, &f64))| {
        radial(geometry, Moment { pressure, theta: sample_angle(j), omega }) - own * omega * omega
    };
    trace.iter().zip(masses).enumerate().map(force_at).collect()
}
