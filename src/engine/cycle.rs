//! Loads of a throw over one working cycle at one speed: traditional method, the rod split in two masses.

use super::forces::{gas_torque, inertia_torque_per_omega2};
use super::pressure::{sample_angle, samples};
use super::{Engine, Geometry, Source};
use crate::numerics::nearest;
use crate::units::{RAD_PER_DEG, RAD_PER_S_PER_RPM};

/// Loads of every throw, sampled over the cycle from the firing of the cylinder that fires at 0°.
#[derive(Debug, Clone, PartialEq)]
pub struct ThrowLoads {
    /// Torque, mean included, N m: one row a throw.
    pub torque: Vec<Vec<f64>>,
    /// Force of the rods on the crankpin away from the cylinders, along the middle of the banks, N: one row a throw; the
    /// rotating masses of the rods are included.
    pub compression: Vec<Vec<f64>>,
}

/// The loads at a speed; nothing where the torque comes from a table. Gas pressure is linear between the tabulated speeds.
pub fn throw_loads(engine: &Engine, speed_rpm: f64) -> Option<ThrowLoads> {
    let Source::Cylinder { geometry, pressure } = &engine.source else { return None };
    let cylinders = engine.layout.firing_deg.len();
    let table = pressure.speeds_rpm();
    let trace = |i| pressure.trace(i, geometry, engine.strokes, cylinders);
    let gas = if table.len() == 1 {
        trace(0)
    } else {
        let (i, fraction) = nearest::interval(table, speed_rpm);
        trace(i).iter().zip(trace(i + 1)).map(|(a, b)| a + (b - a) * fraction).collect()
    };
    let omega = speed_rpm * RAD_PER_S_PER_RPM;
    let n = samples(engine.strokes);
    let torque: Vec<f64> = (0..n)
        .map(|j| gas_torque(geometry, gas[j], sample_angle(j)) + omega * omega * inertia_torque_per_omega2(geometry, sample_angle(j)))
        .collect();
    let mut loads = ThrowLoads { torque: Vec::new(), compression: Vec::new() };
    for throw in 0..engine.layout.throws() {
        let (mut sum, mut force) = (vec![0.0; n], vec![0.0; n]);
        for (firing, axis) in engine.layout.firing_on_throw(throw).iter().zip(axes(engine, throw)) {
            let shift = (firing / engine.cycle_deg() * n as f64).round() as usize;
            for j in 0..n {
                let own = (j + n - shift % n) % n;
                sum[j] += torque[own];
                force[j] += rod_compression(geometry, gas[own], sample_angle(own), omega, axis);
            }
        }
        loads.torque.push(sum);
        loads.compression.push(force);
    }
    Some(loads)
}

/// Angle of the cylinders of a throw from the middle of the banks, rad in the direction of rotation: cylinders fire a bank angle apart in
/// the direction in which their banks lie.
fn axes(engine: &Engine, throw: usize) -> Vec<f64> {
    let (firing, Some(bank)) = (engine.layout.firing_on_throw(throw), engine.layout.bank_angle_deg) else { return vec![0.0] };
    let forward = ((firing[1] - firing[0] - bank).rem_euclid(360.0) + 1e-6).rem_euclid(360.0) < 1e-3;
    let half = 0.5 * bank * RAD_PER_DEG * if forward { 1.0 } else { -1.0 };
    vec![-half, half]
}

/// Force of one rod on the crankpin away from the cylinders: piston force (gas less oscillating mass) along the cylinder and, through the
/// slope tan(beta) of the rod, across it; less the centrifugal force of the rotating part. `theta`: from the unit's dead centre, `axis`: of the
/// cylinder from the direction in which the force is wanted, both rad.
fn rod_compression(geometry: &Geometry, pressure: f64, theta: f64, omega: f64, axis: f64) -> f64 {
    let crank = &geometry.slider_crank;
    let gas = (pressure - geometry.crankcase_pressure) * geometry.piston_area();
    let piston = gas - geometry.oscillating_mass() * crank.motion(theta).curvature * omega * omega;
    let sin_beta = crank.crank_radius / crank.rod_length * theta.sin();
    let tan_beta = sin_beta / (1.0 - sin_beta * sin_beta).sqrt();
    let rotating = geometry.rod_rotating_fraction * geometry.rod_mass * crank.crank_radius * omega * omega;
    piston * (axis.cos() + tan_beta * axis.sin()) - rotating * (theta + axis).cos()
}
