//! Real modes of chain and rings with the diagonal of their damping matrix: the textbook shortcut.
//!
//! The damper of an absorber couples the modes strongly, and the couplings are what is left out: a viscous absorber comes out 54 % low on the
//! shipped six-cylinder. Kept to show that, and for chains that are damped lightly and alike.

use super::bodies::Bodies;
use super::method::RESONANT;
use super::{Grid, Quantity, Response, ResponseError, Work};
use crate::absorber::Mounted;
use crate::drivetrain::System;
use crate::numerics::{C64, ZERO, eigen};
use nalgebra::DMatrix;

/// Real modes with diagonal damping.
#[derive(Debug)]
pub struct Modal<'a> {
    system: &'a System,
    grid: &'a Grid,
}

/// Modes of one design.
struct Modes {
    bodies: Bodies,
    /// Squares of the circular frequencies, 1/s².
    omega2: Vec<f64>,
    shapes: DMatrix<f64>,
    viscous: Vec<f64>,
    hysteretic: Vec<f64>,
}

impl<'a> Modal<'a> {
    /// For the speeds of `grid`.
    pub fn new(system: &'a System, grid: &'a Grid) -> Self {
        Self { system, grid }
    }

    fn modes(&self, design: &[Mounted], work: &mut Work) -> Modes {
        work.eigenproblems += 1;
        let bodies = Bodies::new(self.system, design);
        let (omega2, shapes) = eigen::generalised(&bodies.stiffness, &bodies.inertia);
        let diagonal = |matrix: &DMatrix<f64>| (0..omega2.len()).map(|i| shapes.column(i).dot(&(matrix * shapes.column(i)))).collect();
        let (viscous, hysteretic) = (diagonal(&bodies.damping), diagonal(&bodies.hysteresis));
        Modes { bodies, omega2, shapes, viscous, hysteretic }
    }

    /// The damping matrix of the model itself, N m s/rad and N m/rad (hysteretic), stations then rings: M Phi d Phi' M with the diagonals d.
    #[doc(hidden)]
    pub fn own_damping(&self, design: &[Mounted]) -> (DMatrix<f64>, DMatrix<f64>) {
        let m = self.modes(design, &mut Work::default());
        let n = m.bodies.len();
        let scaled = DMatrix::from_fn(n, m.omega2.len(), |i, j| m.bodies.inertia[i] * m.shapes[(i, j)]);
        let damping_matrix =
            |d: &[f64]| DMatrix::from_fn(n, n, |i, j| d.iter().enumerate().map(|(k, d)| scaled[(i, k)] * d * scaled[(j, k)]).sum());
        (damping_matrix(&m.viscous), damping_matrix(&m.hysteretic))
    }

    fn with(&self, m: &Modes, quantity: Quantity, order: usize, speed_rpm: f64, work: &mut Work) -> Result<C64, ResponseError> {
        if !m.bodies.laws.is_empty() {
            return Err(ResponseError::NotApplicable { method: "modal", why: "the law of an absorber depends on frequency or speed" });
        }
        let excited = self.system.excitation.orders[order];
        let omega = excited.omega(speed_rpm);
        work.modal_solves += 1;
        let mut torque = vec![ZERO; self.system.chain.len()];
        self.system.torque(order, speed_rpm, &mut torque);
        if torque.iter().all(|t| *t == ZERO) {
            return Ok(ZERO);
        }
        let twist = m.bodies.between(&self.system.chain, quantity);
        let mut y = ZERO;
        for i in 0..m.omega2.len() {
            let force: C64 = torque.iter().enumerate().map(|(s, t)| t * m.shapes[(s, i)]).sum();
            let output = twist.of(|body| m.shapes[(body, i)]);
            let stiffness = C64::new(m.omega2[i] - omega * omega, omega * m.viscous[i] + m.hysteretic[i]);
            if stiffness.norm() <= RESONANT * omega * omega && force * output != ZERO {
                return Err(ResponseError::unbounded(excited, speed_rpm));
            }
            y += force * output / stiffness;
        }
        if let Quantity::ShaftTorque(s) = quantity {
            y *= self.system.chain.shaft_stiffness(s, omega);
        }
        y = quantity.of_angle(y, omega);
        if y.is_finite() { Ok(y) } else { Err(ResponseError::unbounded(excited, speed_rpm)) }
    }
}

impl Response for Modal<'_> {
    super::method::identity!("modal");

    fn phasor(&self, design: &[Mounted], quantity: Quantity, at: (usize, f64), work: &mut Work) -> Result<C64, ResponseError> {
        let (order, speed_rpm) = at;
        self.with(&self.modes(design, work), quantity, order, speed_rpm, work)
    }

    fn all_orders_at(&self, design: &[Mounted], quantity: Quantity, speed_rpm: f64, work: &mut Work) -> Result<Vec<C64>, ResponseError> {
        let modes = self.modes(design, work);
        self.orders().map(|order| self.with(&modes, quantity, order, speed_rpm, work)).collect()
    }

    /// The modes are those of the design: one eigenproblem for all speeds.
    fn sweep(&self, design: &[Mounted], quantity: Quantity, out: &mut Vec<C64>, work: &mut Work) -> Result<(), ResponseError> {
        let modes = self.modes(design, work);
        out.clear();
        for &speed in &self.grid.speed_rpm {
            for order in self.orders() {
                out.push(self.with(&modes, quantity, order, speed, work)?);
            }
        }
        Ok(())
    }
}
