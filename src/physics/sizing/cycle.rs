//! Forces of a cylinder unit over the cycle, along and across rod and crank.

use crate::engine::forces::{Moment, unit_forces};
use crate::engine::pressure::{sample_angle, samples};
use crate::engine::{Geometry, Pressure};
use crate::numerics::elementary::Elementary;
use crate::numerics::table_lookup;
use crate::units::{DEG_PER_RAD, RAD_PER_S_PER_RPM};

/// Every so many samples of the pressure: one degree.
const STRIDE: usize = 10;

/// Forces over a working cycle at one speed, N, a value each degree from firing dead centre.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Cycle {
    /// rpm.
    pub speed_rpm: f64,
    /// Whether the engine fires.
    pub filling: Gas,
    /// Degrees.
    pub crank_deg: Vec<f64>,
    /// Of the rod at the piston pin, along the rod: tension is positive.
    pub rod_tension_small: Vec<f64>,
    /// The same across the rod, the way it swings after dead centre.
    pub rod_across_small: Vec<f64>,
    /// Of the rod at the crankpin, along the rod: tension is positive.
    pub rod_tension_big: Vec<f64>,
    /// Across it.
    pub rod_across_big: Vec<f64>,
    /// On the crankpin, away from the crank's axis.
    pub radial: Vec<f64>,
    /// On the crankpin, in the direction of rotation.
    pub tangential: Vec<f64>,
    /// Of the liner on the piston.
    pub liner: Vec<f64>,
    /// On the piston by the gas, towards the crank.
    pub gas: Vec<f64>,
}

/// Samples of a cycle.
#[doc(hidden)]
pub fn samples_of_cycle(strokes: u32) -> usize {
    samples(strokes) / STRIDE
}

/// What fills the cylinder.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Gas {
    /// What burns.
    #[default]
    Fired,
    /// As much pressure as under the piston: the engine is driven with nothing in its cylinders.
    None,
}

/// Pressure over the cycle at a speed, linear between the speeds of its table, Pa absolute.
fn pressure_at(pressure: &Pressure, geometry: &Geometry, (strokes, cylinders): (u32, usize), speed_rpm: f64) -> Vec<f64> {
    let speeds = pressure.speeds_rpm();
    let trace = |index| pressure.trace(index, geometry, strokes, cylinders);
    let within = speed_rpm.clamp(speeds[0], speeds[speeds.len() - 1]);
    if speeds.len() == 1 {
        return trace(0);
    }
    let (i, fraction) = table_lookup::interval(speeds, within);
    trace(i).iter().zip(trace(i + 1)).map(|(a, b)| a + (b - a) * fraction).collect()
}

impl Cycle {
    /// Forces by Newton and Euler's equations, with Coulomb friction at the liner.
    pub(super) fn new(
        geometry: &Geometry,
        pressure: &Pressure,
        (strokes, cylinders): (u32, usize),
        (speed_rpm, filling): (f64, Gas),
    ) -> Self {
        let trace = match filling {
            Gas::Fired => pressure_at(pressure, geometry, (strokes, cylinders), speed_rpm),
            Gas::None => vec![geometry.crankcase_pressure; samples(strokes)],
        };
        let omega = speed_rpm * RAD_PER_S_PER_RPM;
        let mut cycle = Self { speed_rpm, filling, ..Self::default() };
        for (j, &pressure) in trace.iter().enumerate().step_by(STRIDE) {
            let theta = sample_angle(j);
            let forces = unit_forces(geometry, Moment { pressure, theta, omega });
            let (sin_beta, cos_beta) = geometry.slider_crank.lean(theta).angle.sine_cosine();
            let (sine, cosine) = theta.sine_cosine();
            let ([px, py], [qx, qy]) = (forces.small_end, forces.big_end);
            cycle.crank_deg.push(theta * DEG_PER_RAD);
            // the rod points from the crankpin to the piston along (cos beta, -sin beta)
            cycle.rod_tension_small.push(-(px * cos_beta - py * sin_beta));
            cycle.rod_across_small.push(-(px * sin_beta + py * cos_beta));
            cycle.rod_tension_big.push(qx * cos_beta - qy * sin_beta);
            cycle.rod_across_big.push(qx * sin_beta + qy * cos_beta);
            cycle.radial.push(qx * cosine + qy * sine);
            cycle.tangential.push(-qx * sine + qy * cosine);
            cycle.liner.push(forces.liner);
            cycle.gas.push((pressure - geometry.crankcase_pressure) * geometry.piston_area());
        }
        cycle
    }

    /// Torque on the throw, N m.
    pub fn torque(&self, crank_radius: f64) -> Vec<f64> {
        self.tangential.iter().map(|t| t * crank_radius).collect()
    }
}

/// A history later by `deg` degrees of a cycle of `cycle_deg`.
pub(super) fn delayed(history: &[f64], deg: f64, cycle_deg: f64) -> Vec<f64> {
    let n = history.len();
    let shift = deg / cycle_deg * n as f64;
    let delayed_sample = |j: usize| {
        let x = (j as f64 - shift).rem_euclid(n as f64);
        let i = x.floor() as usize % n;
        let fraction = x - x.floor();
        history[i] + (history[(i + 1) % n] - history[i]) * fraction
    };
    (0..n).map(delayed_sample).collect()
}
