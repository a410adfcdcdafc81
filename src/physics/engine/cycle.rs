//! Loads of a throw over one working cycle at one speed.

use super::forces::{Moment, UnitForces, unit_forces};
use super::pressure::{sample_angle, samples};
use super::{Engine, Geometry, Source};
use crate::numerics::elementary::Elementary;
use crate::numerics::table_lookup;
use crate::units::{RAD_PER_DEG, RAD_PER_S_PER_RPM};
use std::sync::OnceLock;

/// Pressure that what the gas does is taken from, Pa.
const GAUGE: f64 = 1e5;

/// Loads of every throw, sampled over the cycle from the firing of the cylinder that fires at 0°.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ThrowLoads {
    /// Crank angle of every sample, rad.
    pub theta: Vec<f64>,
    /// Force of each rod on its crankpin, N, in axes of the engine: one row a cylinder. First along the middle of the banks, away from the crankshaft; then
    /// across it, the way the pin moves when it passes there.
    pub rod_force: Vec<Vec<[f64; 2]>>,
    /// Torque, mean included, N m: one row a throw.
    pub torque: Vec<Vec<f64>>,
}

impl ThrowLoads {
    /// Force of the rods of a throw together: one row a throw.
    pub fn pin_force(&self) -> Vec<Vec<[f64; 2]>> {
        let rods = self.rod_force.len() / self.torque.len().max(1);
        let together = |rods: &[Vec<[f64; 2]>], j: usize| rods.iter().fold([0.0; 2], |sum, rod| [sum[0] + rod[j][0], sum[1] + rod[j][1]]);
        self.rod_force.chunks(rods.max(1)).map(|own| (0..self.theta.len()).map(|j| together(own, j)).collect()).collect()
    }
}

/// Loads of an engine at any speed; keeps the pressure at the tabulated ones.
#[derive(Debug, Clone)]
pub struct Cycle<'a> {
    engine: &'a Engine,
    geometry: &'a Geometry,
    speeds_rpm: &'a [f64],
    traces: Vec<Vec<f64>>,
    parts: OnceLock<Vec<[OnThrow; 2]>>,
}

/// Torque on a throw, N m, and force on its pin along the cylinder and across it, N.
type OnThrow = [f64; 3];

fn on_throw(geometry: &Geometry, at: Moment) -> OnThrow {
    let UnitForces { torque, big_end: [x, y], .. } = unit_forces(geometry, at);
    [torque, x, y]
}

impl<'a> Cycle<'a> {
    /// Of an engine; nothing where the torque comes from a table.
    pub fn new(engine: &'a Engine) -> Option<Self> {
        let Source::Cylinder { geometry, pressure } = &engine.source else { return None };
        let (speeds_rpm, cylinders) = (pressure.speeds_rpm(), engine.layout.firing_deg.len());
        let traces = pressure.traces(geometry, engine.strokes, cylinders);
        Some(Self { engine, geometry, speeds_rpm, traces, parts: OnceLock::new() })
    }

    /// The engine.
    pub(crate) fn engine(&self) -> &'a Engine {
        self.engine
    }

    /// Of its slider-crank mechanism.
    pub(crate) fn geometry(&self) -> &'a Geometry {
        self.geometry
    }

    /// Crank angle of every `stride`-th sample, rad.
    pub fn theta(&self, stride: usize) -> Vec<f64> {
        (0..samples(self.engine.strokes) / stride).map(|j| sample_angle(j * stride)).collect()
    }

    /// The loads at a speed, at every `stride`-th sample of the pressure (a divisor of their number). Gas pressure is linear between the tabulated
    /// speeds and held at their ends.
    pub fn loads(&self, speed_rpm: f64, stride: usize) -> ThrowLoads {
        let mut loads = ThrowLoads::default();
        self.loads_into(speed_rpm, stride, &mut loads);
        loads
    }

    /// The same in the place of others.
    pub(crate) fn loads_into(&self, speed_rpm: f64, stride: usize, loads: &mut ThrowLoads) {
        let unit = self.unit(speed_rpm, stride);
        let n = unit.len();
        if loads.theta.len() != n {
            loads.theta = self.theta(stride);
        }
        loads.torque.resize_with(self.engine.layout.throws(), Vec::new);
        loads.rod_force.resize_with(self.engine.layout.firing_deg.len(), Vec::new);
        let mut rods = loads.rod_force.iter_mut();
        for (throw, sum) in loads.torque.iter_mut().enumerate() {
            sum.clear();
            sum.resize(n, 0.0);
            let on_throw = self.engine.layout.firing_on_throw(throw).iter().zip(axes(self.engine, throw));
            for ((firing, axis), own) in on_throw.zip(&mut rods) {
                let shift = (firing / self.engine.cycle_deg() * n as f64).round() as usize;
                let (sine, cosine) = axis.sine_cosine();
                let (late, early) = unit.split_at(n - shift % n);
                own.clear();
                own.extend(early.iter().chain(late).map(|[_, x, y]| [x * cosine - y * sine, x * sine + y * cosine]));
                let torques = early.iter().chain(late).map(|on| on[0]);
                sum.iter_mut().zip(torques).for_each(|(sum, torque)| *sum += torque);
            }
        }
    }

    /// What the cylinder that fires at 0° does to its throw, at every `stride`-th sample. Without friction that is linear in the gauge pressure and in the square of the speed, whatever the rod.
    fn unit(&self, speed_rpm: f64, stride: usize) -> Vec<OnThrow> {
        let moments = self.moments(speed_rpm, stride).into_iter();
        if self.geometry.liner_friction != 0.0 {
            return moments.map(|m| on_throw(self.geometry, m)).collect();
        }
        let ambient = self.geometry.crankcase_pressure;
        let parts = self.parts.get_or_init(|| {
            let part = |theta, pressure, omega| on_throw(self.geometry, Moment { pressure, theta, omega });
            let gas = |theta| part(theta, ambient + GAUGE, 0.0).map(|x| x / GAUGE);
            (0..samples(self.engine.strokes)).map(sample_angle).map(|theta| [gas(theta), part(theta, ambient, 1.0)]).collect()
        });
        let loads_at = |(m, [gas, inertia]): (Moment, &[OnThrow; 2])| -> OnThrow {
            let (gauge, omega2) = (m.pressure - ambient, m.omega * m.omega);
            std::array::from_fn(|i| gauge * gas[i] + omega2 * inertia[i])
        };
        moments.zip(parts.iter().step_by(stride)).map(loads_at).collect()
    }

    /// Pressure, angle and speed of the cylinder that fires at 0°, at every `stride`-th sample.
    #[doc(hidden)]
    pub fn moments(&self, speed_rpm: f64, stride: usize) -> Vec<Moment> {
        let n = samples(self.engine.strokes) / stride;
        let (i, fraction) = if self.traces.len() == 1 { (0, 0.0) } else { table_lookup::held(self.speeds_rpm, speed_rpm) };
        let (low, high) = (&self.traces[i], &self.traces[(i + 1).min(self.traces.len() - 1)]);
        let gas = |j: usize| low[j] + (high[j] - low[j]) * fraction;
        let omega = speed_rpm * RAD_PER_S_PER_RPM;
        (0..n).map(|j| j * stride).map(|j| Moment { pressure: gas(j), theta: sample_angle(j), omega }).collect()
    }
}

/// The loads at a speed, at every sample; nothing where the torque comes from a table.
pub fn throw_loads(engine: &Engine, speed_rpm: f64) -> Option<ThrowLoads> {
    Some(Cycle::new(engine)?.loads(speed_rpm, 1))
}

/// Angle of the crankpin of every throw from the middle of the banks when the cylinder that fires at 0° fires, rad in the direction of rotation.
pub fn pin_angles(engine: &Engine) -> Vec<f64> {
    (0..engine.layout.throws()).map(|t| axes(engine, t)[0] - engine.layout.firing_on_throw(t)[0] * RAD_PER_DEG).collect()
}

/// A force in axes of the engine as (radial, tangential) on a pin at `angle`: outwards, and in the direction of rotation.
pub fn crank_fixed([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sine, cosine) = angle.sine_cosine();
    [x * cosine + y * sine, y * cosine - x * sine]
}

/// Angle of the cylinders of a throw from the middle of the banks, rad in the direction of rotation: cylinders fire a bank angle apart in
/// the direction in which their banks lie.
#[doc(hidden)]
pub fn axes(engine: &Engine, throw: usize) -> Vec<f64> {
    let (firing, Some(bank)) = (engine.layout.firing_on_throw(throw), engine.layout.bank_angle_deg) else { return vec![0.0] };
    let [first, second] = firing else {
        // opposed: odd cylinders in one bank
        let half = 0.5 * bank * RAD_PER_DEG;
        return vec![if throw.is_multiple_of(2) { -half } else { half }];
    };
    let forward = ((second - first - engine.layout.split_pin_deg - bank).rem_euclid(360.0) + 1e-6).rem_euclid(360.0) < 1e-3;
    let half = 0.5 * bank * RAD_PER_DEG * if forward { 1.0 } else { -1.0 };
    vec![-half, half]
}
