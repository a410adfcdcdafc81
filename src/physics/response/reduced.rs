//! A few modes of the engine with the absorbers kept exact.
//!
//! The lowest modes of the chain without absorbers, rigid ones included, move with all the couplings of the chain's own damping; the modes left
//! out follow as if static (residual flexibility). Absorbers act on their hubs with their exact dynamic stiffness. With all modes the method is
//! exact.

use super::method::RESONANT;
use super::{Grid, Quantity, Response, ResponseError, Work};
use crate::absorber::{Condensed, Mounted, Operating};
use crate::drivetrain::System;
use crate::numerics::{C64, I, ZERO};
use crate::units::RAD_PER_S_PER_RPM;
use nalgebra::{DMatrix, DVector};

/// Engine modes with exact absorbers.
#[derive(Debug)]
#[doc(hidden)]
pub struct Reduced<'a> {
    system: &'a System,
    grid: &'a Grid,
    /// Modes kept, rigid ones included.
    kept: usize,
    /// Elements of the modal damping matrix, viscous (1/s) and hysteretic (1/s²).
    viscous: DMatrix<f64>,
    hysteretic: DMatrix<f64>,
    /// Angle of one station per torque on another through the modes left out, rad/(N m).
    residual: DMatrix<f64>,
}

impl<'a> Reduced<'a> {
    /// The lowest `elastic` elastic modes, and all rigid ones.
    pub fn new(system: &'a System, grid: &'a Grid, elastic: usize) -> Self {
        let kept = system.modes.rigid.saturating_add(elastic).min(system.modes.omega.len());
        let bodies = crate::response::bodies::Bodies::new(system, &[]);
        let shapes = system.modes.shapes.columns(0, kept);
        let viscous = shapes.transpose() * &bodies.damping * shapes;
        let hysteretic = shapes.transpose() * &bodies.hysteresis * shapes;
        let rest = system.modes.shapes.columns(kept, system.modes.omega.len() - kept);
        let mut flexible = rest.into_owned();
        for (mut shape, omega) in flexible.column_iter_mut().zip(&system.modes.omega[kept..]) {
            shape /= omega * omega;
        }
        let residual = flexible * rest.transpose();
        Self { system, grid, kept, viscous, hysteretic, residual }
    }

    /// Dynamic stiffness of the modes kept at circular frequency `omega`.
    fn stiffness(&self, omega: f64) -> DMatrix<C64> {
        DMatrix::from_fn(self.kept, self.kept, |i, j| {
            let own = if i == j { self.system.modes.omega[i] * self.system.modes.omega[i] - omega * omega } else { 0.0 };
            own + I * (omega * self.viscous[(i, j)] + self.hysteretic[(i, j)])
        })
    }
}

impl Response for Reduced<'_> {
    super::method::identity!("reduced");

    fn phasor(&self, design: &[Mounted], quantity: Quantity, at: (usize, f64), work: &mut Work) -> Result<C64, ResponseError> {
        let (order, speed_rpm) = at;
        let (system, n) = (self.system, self.system.chain.len());
        let shapes = &system.modes.shapes;
        let excited = system.excitation.orders[order];
        let omega = excited.omega(speed_rpm);
        work.modal_solves += 1;
        let mut torque = vec![ZERO; n];
        system.torque(order, speed_rpm, &mut torque);
        if torque.iter().all(|t| *t == ZERO) {
            return Ok(ZERO);
        }
        let condensed = Condensed::new(design, Operating { omega, shaft_speed: speed_rpm * RAD_PER_S_PER_RPM });
        let z = &condensed.hubs;
        // modal coordinates under the torque, then under a unit torque on each hub
        let mut loads = DMatrix::from_element(self.kept, 1 + z.len(), ZERO);
        for i in 0..self.kept {
            loads[(i, 0)] = torque.iter().enumerate().map(|(s, t)| t * shapes[(s, i)]).sum();
            for (k, hub) in z.iter().enumerate() {
                loads[(i, k + 1)] = C64::from(shapes[(hub.station, i)]);
            }
        }
        let unbounded = || ResponseError::unbounded(excited, speed_rpm);
        let stiffness = self.stiffness(omega);
        let rounding = RESONANT * omega * omega;
        if design.is_empty() && (0..self.kept).any(|i| stiffness[(i, i)].norm() <= rounding && loads[(i, 0)] != ZERO) {
            return Err(unbounded());
        }
        let moved = stiffness.lu().solve(&loads).ok_or_else(unbounded)?;
        let through_modes = |station: usize, load: usize| (0..self.kept).map(|i| moved[(i, load)] * shapes[(station, i)]).sum::<C64>();
        let under_torque = |station: usize| {
            through_modes(station, 0) + torque.iter().enumerate().map(|(s, t)| t * self.residual[(station, s)]).sum::<C64>()
        };
        let under_hub = |station: usize, k: usize| through_modes(station, k + 1) + self.residual[(station, z[k].station)];
        // hubs obey theta = under torque - sum of under hub z theta, written for q = theta/denominator: finite where an undamped ring resonates
        let hubs = DMatrix::from_fn(z.len(), z.len(), |m, k| {
            under_hub(z[m].station, k) * z[k].numerator + if m == k { z[k].denominator } else { ZERO }
        });
        let base = DVector::from_fn(z.len(), |m, _| under_torque(z[m].station));
        let q = if design.is_empty() { base } else { hubs.lu().solve(&base).ok_or_else(unbounded)? };
        let theta = |station: usize| (0..z.len()).fold(under_torque(station), |sum, k| sum - under_hub(station, k) * z[k].numerator * q[k]);
        let y = match quantity {
            Quantity::Twist { .. } | Quantity::Motion(..) => {
                quantity.of_angle(quantity.difference(&system.chain).map_or(ZERO, |twist| twist.of(theta)), omega)
            }
            Quantity::ShaftTorque(s) => system.chain.shaft_stiffness(s, omega) * system.chain.link(s).of(theta),
            Quantity::RingTwist(r) => q[condensed.rings[r].hub] * condensed.rings[r].twist,
        };
        if y.is_finite() { Ok(y) } else { Err(unbounded()) }
    }
}
