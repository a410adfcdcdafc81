//! Dense complex LU of the whole system, rings as bodies of their own: slow, and independent of every other method.

use super::bodies::Bodies;
use super::{Grid, Quantity, Response, ResponseError, Work};
use crate::absorber::{Mounted, Operating};
use crate::drivetrain::System;
use crate::numerics::{C64, I, ZERO};
use crate::units::RAD_PER_S_PER_RPM;
use nalgebra::{DMatrix, DVector};

/// Dense solution with full pivoting.
#[derive(Debug)]
pub struct Dense<'a> {
    system: &'a System,
    grid: &'a Grid,
}

impl<'a> Dense<'a> {
    /// For the speeds of `grid`.
    pub fn new(system: &'a System, grid: &'a Grid) -> Self {
        Self { system, grid }
    }

    /// Angles of all bodies, stations first, rad.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where the system is singular.
    pub fn angles(&self, design: &[Mounted], order: usize, speed_rpm: f64) -> Result<(Bodies, DVector<C64>), ResponseError> {
        let excited = self.system.excitation.orders[order];
        let omega = excited.omega(speed_rpm);
        let bodies = Bodies::new(self.system, design);
        let n = bodies.len();
        let mut torque = DVector::from_element(n, ZERO);
        self.system.torque(order, speed_rpm, &mut torque.as_mut_slice()[..self.system.chain.len()]);
        let mut matrix = DMatrix::from_fn(n, n, |i, j| {
            let inertia = if i == j { omega * omega * bodies.inertia[i] } else { 0.0 };
            bodies.stiffness[(i, j)] - inertia + I * (omega * bodies.damping[(i, j)] + bodies.hysteresis[(i, j)])
        });
        for (index, law) in &bodies.laws {
            let s = law.dynamic_stiffness(Operating { omega, shaft_speed: speed_rpm * RAD_PER_S_PER_RPM });
            let (host, ring) = bodies.rings[*index];
            for (i, j, sign) in [(host, host, 1.0), (ring, ring, 1.0), (host, ring, -1.0), (ring, host, -1.0)] {
                matrix[(i, j)] += s * sign;
            }
        }
        if torque.iter().all(|t| *t == ZERO) {
            return Ok((bodies, torque));
        }
        let angles = matrix.full_piv_lu().solve(&torque).filter(|x| x.iter().all(|y| y.is_finite()));
        angles.map(|x| (bodies, x)).ok_or_else(|| ResponseError::unbounded(excited, speed_rpm))
    }
}

impl Response for Dense<'_> {
    super::method::identity!("dense");

    fn phasor(&self, design: &[Mounted], quantity: Quantity, at: (usize, f64), work: &mut Work) -> Result<C64, ResponseError> {
        let (order, speed_rpm) = at;
        work.dense_solves += 1;
        let (bodies, x) = self.angles(design, order, speed_rpm)?;
        let twist = bodies.between(&self.system.chain, quantity).of(|body| x[body]);
        let omega = self.system.excitation.orders[order].omega(speed_rpm);
        Ok(match quantity {
            Quantity::ShaftTorque(s) => twist * self.system.chain.shaft_stiffness(s, omega),
            _ => quantity.of_angle(twist, omega),
        })
    }
}
