//! State space, exact between samples: the torque is a straight line from sample to sample, and the step is the matrix exponential.
//!
//! The convolution of \[Villalva 2014\] section 5.3 without its transient. Stable for any step; the only error is that of the torque's
//! straight lines, of second order in the step.

use super::bodies::Bodies;
use super::periodic::{self, Motion, Step};
use super::power::Power;
use super::{Grid, Quantity, Response, ResponseError, Work};
use crate::absorber::Mounted;
use crate::drivetrain::System;
use crate::numerics::C64;
use crate::numerics::matrix_exponential::matrix_exponential;
use nalgebra::DMatrix;

/// Places and weights of Gauss's rule with five points on a unit step.
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_5),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_2),
    (0.5, 0.284_444_444_444_444_4),
    (0.769_234_655_052_841_6, 0.239_314_335_249_683_2),
    (0.953_089_922_969_332, 0.118_463_442_528_094_5),
];

/// Exact steps at a number of steps a cycle.
#[derive(Debug)]
pub struct Exponential<'a> {
    system: &'a System,
    grid: &'a Grid,
    steps: usize,
}

impl<'a> Exponential<'a> {
    /// For the speeds of `grid`; `steps` in a working cycle.
    pub fn new(system: &'a System, grid: &'a Grid, steps: usize) -> Self {
        Self { system, grid, steps }
    }

    fn bodies(&self, design: &[Mounted]) -> Result<Bodies, ResponseError> {
        let bodies = Bodies::new(self.system, design);
        periodic::check("exponential", self.system, &bodies, self.steps)?;
        Ok(bodies)
    }

    fn cycle(&self, bodies: &Bodies, speed_rpm: f64, work: &mut Work) -> Result<Motion, ResponseError> {
        work.time_steps += 2 * self.steps as u64;
        let step = step(bodies, self.step_seconds(speed_rpm));
        periodic::motion("exponential", self.system, bodies, speed_rpm, self.steps, &step)
    }

    fn step_seconds(&self, speed_rpm: f64) -> f64 {
        periodic::cycle_seconds(self.system, speed_rpm) / self.steps as f64
    }

    /// Power by the integral over every step, under the straight lines that the torque is held to: the motion between the samples is exact too,
    /// and Gauss's rule with five points integrates it to rounding.
    ///
    /// # Errors
    /// Those of a phasor.
    pub fn power(&self, design: &[Mounted], speed_rpm: f64, work: &mut Work) -> Result<Power, ResponseError> {
        let bodies = self.bodies(design)?;
        let motion = self.cycle(&bodies, speed_rpm, work)?;
        let dt = self.step_seconds(speed_rpm);
        let mut power = Power::default();
        for (place, weight) in GAUSS {
            let part = step(&bodies, place * dt);
            let within = (0..self.steps).map(|j| {
                let (now, next) = (&motion.torques[j], &motion.torques[(j + 1) % self.steps]);
                let torque = now + (next - now) * place;
                let state = &part.state * &motion.states[j] + &part.now * now + &part.next * &torque;
                periodic::power_of(&bodies, &state, &torque)
            });
            let mean = periodic::mean(within, self.steps);
            power.input += weight * mean.input;
            power.dissipated += weight * mean.dissipated;
        }
        Ok(power)
    }
}

/// exp of the step of (state, torque, change of torque over the step): its first rows take all three to the next state.
fn step(bodies: &Bodies, dt: f64) -> Step {
    let n = bodies.len();
    let mut whole = DMatrix::zeros(4 * n, 4 * n);
    for i in 0..n {
        whole[(i, n + i)] = dt;
        for j in 0..n {
            whole[(n + i, j)] = -dt * bodies.stiffness[(i, j)] / bodies.inertia[i];
            whole[(n + i, n + j)] = -dt * bodies.damping[(i, j)] / bodies.inertia[i];
        }
        whole[(n + i, 2 * n + i)] = dt / bodies.inertia[i];
        whole[(2 * n + i, 3 * n + i)] = 1.0;
    }
    let exact = matrix_exponential(&whole);
    let block = |from: usize, width: usize| exact.view((0, from), (2 * n, width)).into_owned();
    let (held, ramp) = (block(2 * n, n), block(3 * n, n));
    Step { state: block(0, 2 * n), now: held - &ramp, next: ramp }
}

impl Response for Exponential<'_> {
    super::method::identity!("exponential");

    fn phasor(&self, design: &[Mounted], quantity: Quantity, at: (usize, f64), work: &mut Work) -> Result<C64, ResponseError> {
        let (order, speed_rpm) = at;
        Ok(self.all_orders_at(design, quantity, speed_rpm, work)?[order])
    }

    /// A cycle gives all orders at once.
    fn all_orders_at(&self, design: &[Mounted], quantity: Quantity, speed_rpm: f64, work: &mut Work) -> Result<Vec<C64>, ResponseError> {
        let bodies = self.bodies(design)?;
        self.cycle(&bodies, speed_rpm, work)?.phasors(self.system, &bodies, quantity, speed_rpm)
    }
}
