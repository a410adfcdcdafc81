//! Loads of a throw over one working cycle at one speed.

use super::forces::{Moment, UnitForces, unit_forces};
use super::pressure::{sample_angle, samples};
use super::{Engine, Source};
use crate::numerics::nearest;
use crate::units::{RAD_PER_DEG, RAD_PER_S_PER_RPM};

/// Loads of every throw, sampled over the cycle from the firing of the cylinder that fires at 0°.
#[derive(Debug, Clone, PartialEq)]
pub struct ThrowLoads {
    /// Torque, mean included, N m: one row a throw.
    pub torque: Vec<Vec<f64>>,
    /// Force of the rods on the crankpin, N: one row a throw. First along the middle of the banks, away from the crankshaft; then across it, the way the
    /// pin moves when it passes there.
    pub pin_force: Vec<Vec<[f64; 2]>>,
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
    let unit: Vec<UnitForces> = (0..n).map(|j| unit_forces(geometry, Moment { pressure: gas[j], theta: sample_angle(j), omega })).collect();
    let mut loads = ThrowLoads { torque: Vec::new(), pin_force: Vec::new() };
    for throw in 0..engine.layout.throws() {
        let (mut sum, mut force) = (vec![0.0; n], vec![[0.0; 2]; n]);
        for (firing, axis) in engine.layout.firing_on_throw(throw).iter().zip(axes(engine, throw)) {
            let shift = (firing / engine.cycle_deg() * n as f64).round() as usize;
            let (sine, cosine) = axis.sin_cos();
            for j in 0..n {
                let UnitForces { torque, big_end: [x, y], .. } = unit[(j + n - shift % n) % n];
                sum[j] += torque;
                force[j][0] += x * cosine - y * sine;
                force[j][1] += x * sine + y * cosine;
            }
        }
        loads.torque.push(sum);
        loads.pin_force.push(force);
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
