//! Newmark's integrator \[Newmark 1959\] with free beta and gamma: average acceleration (1/4, 1/2), linear acceleration (1/6, 1/2), central difference
//! (0, 1/2).
//!
//! Error of second order in the step for gamma = 1/2. Average acceleration is stable for any step; otherwise the highest frequency of chain and
//! rings times the step must stay below 1/sqrt(gamma/2 - beta), sqrt(12) and 2 for the two others, and a longer step is refused before the run.
//! Judged by the undamped modes, rigid ones left out: the double rigid eigenvalue of the step would raise a false alarm.

use super::bodies::Bodies;
use super::periodic::{self, Motion, Step};
use super::power::Power;
use super::{Grid, Quantity, Response, ResponseError, Work};
use crate::absorber::Mounted;
use crate::drivetrain::System;
use crate::numerics::{C64, eigen};
use nalgebra::DMatrix;

/// Newmark's method at a number of steps a cycle.
#[derive(Debug)]
pub struct Newmark<'a> {
    system: &'a System,
    grid: &'a Grid,
    beta: f64,
    gamma: f64,
    steps: usize,
}

impl<'a> Newmark<'a> {
    /// For the speeds of `grid`; `steps` in a working cycle.
    pub fn new(system: &'a System, grid: &'a Grid, (beta, gamma): (f64, f64), steps: usize) -> Self {
        Self { system, grid, beta, gamma, steps }
    }

    /// Largest stable product of circular frequency and step; infinite where every step is stable.
    pub(crate) fn largest_step(&self) -> f64 {
        let missing = 0.5 * self.gamma - self.beta;
        if missing > 0.0 { 1.0 / missing.sqrt() } else { f64::INFINITY }
    }

    fn bodies(&self, design: &[Mounted]) -> Result<(Bodies, f64), ResponseError> {
        let bodies = Bodies::new(self.system, design);
        periodic::check("newmark", self.system, &bodies, self.steps)?;
        if self.gamma < 0.5 {
            return Err(ResponseError::NotApplicable { method: "newmark", why: "gamma below 1/2 feeds energy into every mode" });
        }
        let (omega2, _) = eigen::generalised(&bodies.stiffness, &bodies.inertia);
        Ok((bodies, omega2.last().map_or(0.0, |w| w.max(0.0).sqrt())))
    }

    fn cycle(&self, bodies: &Bodies, highest: f64, speed_rpm: f64, work: &mut Work) -> Result<Motion, ResponseError> {
        let dt = periodic::cycle_seconds(self.system, speed_rpm) / self.steps as f64;
        if highest * dt >= self.largest_step() {
            return Err(ResponseError::UnstableStep { method: "newmark", product: highest * dt, limit: self.largest_step(), speed_rpm });
        }
        work.time_steps += 2 * self.steps as u64;
        let unbounded = || ResponseError::unbounded(self.system.excitation.orders[0], speed_rpm);
        let step = step(bodies, dt, self.beta, self.gamma).ok_or_else(unbounded)?;
        periodic::motion("newmark", self.system, bodies, speed_rpm, self.steps, &step)
    }

    /// Power by the means of the samples: with gamma above 1/2 less is dissipated by the dampers than put in, and the step takes the rest.
    ///
    /// # Errors
    /// Those of a phasor.
    pub fn power(&self, design: &[Mounted], speed_rpm: f64, work: &mut Work) -> Result<Power, ResponseError> {
        let (bodies, highest) = self.bodies(design)?;
        Ok(self.cycle(&bodies, highest, speed_rpm, work)?.power(&bodies))
    }
}

/// The step as matrices. With a = M^-1 (F - C v - K u) at its start, the end obeys
/// (M + gamma dt C + beta dt² K) a' = F' - C (v + (1 - gamma) dt a) - K (u + dt v + (1/2 - beta) dt² a).
fn step(bodies: &Bodies, dt: f64, beta: f64, gamma: f64) -> Option<Step> {
    let n = bodies.len();
    let (k, c) = (&bodies.stiffness, &bodies.damping);
    let inertia = DMatrix::from_fn(n, n, |i, j| if i == j { bodies.inertia[i] } else { 0.0 });
    let inverse = DMatrix::from_fn(n, n, |i, j| if i == j { 1.0 / bodies.inertia[i] } else { 0.0 });
    let end = (inertia + c * (gamma * dt) + k * (beta * dt * dt)).lu();
    let beside =
        |left: &DMatrix<f64>, right: &DMatrix<f64>| DMatrix::from_fn(n, 2 * n, |i, j| if j < n { left[(i, j)] } else { right[(i, j - n)] });
    // acceleration at the start: per state, and the inverse of M per torque
    let start = -(&inverse * beside(k, c));
    let predicted = beside(k, &(c + k * dt));
    let corrected = c * ((1.0 - gamma) * dt) + k * ((0.5 - beta) * dt * dt);
    let end_state = -end.solve(&(predicted + &corrected * &start))?;
    let end_now = -end.solve(&(&corrected * &inverse))?;
    let end_next = end.solve(&DMatrix::identity(n, n))?;
    // angles and rates at the end from those at the start and both accelerations
    let stack = |of_start: &DMatrix<f64>, of_end: &DMatrix<f64>| {
        let angle = of_start * ((0.5 - beta) * dt * dt) + of_end * (beta * dt * dt);
        let rate = of_start * ((1.0 - gamma) * dt) + of_end * (gamma * dt);
        DMatrix::from_fn(2 * n, of_end.ncols(), |i, j| if i < n { angle[(i, j)] } else { rate[(i - n, j)] })
    };
    let mut state = stack(&start, &end_state);
    for i in 0..n {
        state[(i, i)] += 1.0;
        state[(i, n + i)] += dt;
        state[(n + i, n + i)] += 1.0;
    }
    Some(Step { state, now: stack(&inverse, &end_now), next: stack(&DMatrix::zeros(n, n), &end_next) })
}

impl Response for Newmark<'_> {
    super::method::identity!("newmark");

    fn phasor(&self, design: &[Mounted], quantity: Quantity, at: (usize, f64), work: &mut Work) -> Result<C64, ResponseError> {
        let (order, speed_rpm) = at;
        Ok(self.all_orders_at(design, quantity, speed_rpm, work)?[order])
    }

    /// A cycle gives all orders at once.
    fn all_orders_at(&self, design: &[Mounted], quantity: Quantity, speed_rpm: f64, work: &mut Work) -> Result<Vec<C64>, ResponseError> {
        let (bodies, highest) = self.bodies(design)?;
        self.cycle(&bodies, highest, speed_rpm, work)?.phasors(self.system, &bodies, quantity, speed_rpm)
    }
}
