//! Dense complex LU of the whole system, rings as bodies of their own: slow, and independent of every other method.

use super::bodies::Bodies;
use super::{Grid, Quantity, Response, ResponseError, Work};
use crate::absorber::{Mounted, Operating};
use crate::drivetrain::System;
use crate::numerics::{C64, I, ZERO};
use crate::units::RAD_PER_S_PER_RPM;
use nalgebra::{DMatrix, DVector, Dyn, FullPivLU};

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

    /// Chain and rings at an order (an index) and a speed.
    #[doc(hidden)]
    pub fn at(&self, design: &[Mounted], (order, speed_rpm): (usize, f64)) -> AtFrequency<'a> {
        let omega = self.system.excitation.orders[order].omega(speed_rpm);
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
        AtFrequency { system: self.system, omega, bodies, factors: matrix.clone().full_piv_lu(), matrix, torque }
    }

    /// Angles of all bodies, stations first, rad.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where the system is singular.
    pub fn angles(&self, design: &[Mounted], order: usize, speed_rpm: f64) -> Result<(Bodies, DVector<C64>), ResponseError> {
        let at = self.at(design, (order, speed_rpm));
        let angles = at.under_torque().ok_or_else(|| ResponseError::unbounded(self.system.excitation.orders[order], speed_rpm))?;
        Ok((at.bodies, angles))
    }
}

/// Roundings that a solution is trusted to, of each entry of its matrix: rows and columns are exchanged for the largest pivot.
const ROUNDINGS: f64 = 64.0 * f64::EPSILON;

/// Chain and rings at one frequency.
#[doc(hidden)]
#[derive(Debug)]
pub struct AtFrequency<'a> {
    system: &'a System,
    omega: f64,
    bodies: Bodies,
    matrix: DMatrix<C64>,
    factors: FullPivLU<C64, Dyn, Dyn>,
    torque: DVector<C64>,
}

impl AtFrequency<'_> {
    /// Angles of all bodies under a torque on each; `None` where the system is singular.
    fn under(&self, torque: &DVector<C64>) -> Option<DVector<C64>> {
        if torque.iter().all(|t| *t == ZERO) {
            return Some(torque.clone());
        }
        self.factors.solve(torque).filter(|x| x.iter().all(|y| y.is_finite()))
    }

    /// The same under that of the engine.
    #[doc(hidden)]
    pub fn under_torque(&self) -> Option<DVector<C64>> {
        self.under(&self.torque)
    }

    /// What a sum of angles times numbers is off by at most, where rounding changes each entry of the matrix and each product by some units in the last place: |z| |A| |x| of them, z being the angles under the numbers as
    /// torques; `None` where the system is singular.
    #[doc(hidden)]
    pub fn doubt(&self, numbers: &DVector<C64>, angles: &DVector<C64>) -> Option<f64> {
        let z = self.under(numbers)?;
        let n = angles.len();
        let row = |i: usize| z[i].norm() * (0..n).map(|j| self.matrix[(i, j)].norm() * angles[j].norm()).sum::<f64>();
        let products: f64 = (0..n).map(|i| numbers[i].norm() * angles[i].norm()).sum();
        Some(ROUNDINGS * ((0..n).map(row).sum::<f64>() + products))
    }

    /// A unit torque on the carrier of an absorber and its opposite on the ring; these numbers times the angles are the twist of the ring, the other way round.
    fn pair(&self, absorber: usize) -> DVector<C64> {
        let (host, ring) = self.bodies.rings[absorber];
        let mut pair = DVector::from_element(self.bodies.len(), ZERO);
        pair[host] += 1.0;
        pair[ring] -= 1.0;
        pair
    }

    /// Twist of the ring of an absorber, by the angles of all bodies: that of its carrier less its own; with its doubt.
    #[doc(hidden)]
    pub fn twist(&self, absorber: usize, angles: &DVector<C64>) -> Option<(C64, f64)> {
        let pair = self.pair(absorber);
        Some((pair.dot(angles), self.doubt(&pair, angles)?))
    }

    /// Angles of all bodies under a unit torque on the carrier of an absorber and its opposite on the ring.
    #[doc(hidden)]
    pub fn under_pair(&self, absorber: usize) -> Option<DVector<C64>> {
        self.under(&self.pair(absorber))
    }

    /// A quantity with its doubt.
    #[doc(hidden)]
    pub fn trusted(&self, quantity: Quantity, angles: &DVector<C64>) -> Option<(C64, f64)> {
        let n = self.bodies.len();
        let unit = |body: usize| DVector::from_fn(n, |i, _| C64::from(f64::from(u8::from(i == body))));
        let numbers = DVector::from_fn(n, |body, _| self.output(quantity, &unit(body)));
        Some((self.output(quantity, angles), self.doubt(&numbers, angles)?))
    }

    /// A quantity, by the angles of all bodies.
    pub fn output(&self, quantity: Quantity, angles: &DVector<C64>) -> C64 {
        let twist = self.bodies.between(&self.system.chain, quantity).of(|body| angles[body]);
        match quantity {
            Quantity::ShaftTorque(s) => twist * self.system.chain.shaft_stiffness(s, self.omega),
            _ => quantity.of_angle(twist, self.omega),
        }
    }
}

impl Response for Dense<'_> {
    super::method::identity!("dense");

    fn phasor(&self, design: &[Mounted], quantity: Quantity, at: (usize, f64), work: &mut Work) -> Result<C64, ResponseError> {
        let (order, speed_rpm) = at;
        work.dense_solves += 1;
        let solved = self.at(design, at);
        let angles = solved.under_torque();
        let angles = angles.ok_or_else(|| ResponseError::unbounded(self.system.excitation.orders[order], speed_rpm))?;
        Ok(solved.output(quantity, &angles))
    }
}
