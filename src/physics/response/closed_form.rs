//! One elastic mode of the engine with one absorber, solved by hand: the two-mass system of the closed-form rules, with the engine's damping.

use super::method::RESONANT;
use super::{Grid, Quantity, Response, ResponseError, Work};
use crate::absorber::{Condensed, Mounted, Operating};
use crate::drivetrain::System;
use crate::numerics::{C64, ZERO};
use crate::units::RAD_PER_S_PER_RPM;

/// The first elastic mode with at most one absorber. What the mode does not move is zero.
#[derive(Debug)]
pub struct ClosedForm<'a> {
    system: &'a System,
    grid: &'a Grid,
    /// The mode.
    mode: usize,
    /// Its viscous (1/s) and hysteretic (1/s²) damping.
    viscous: f64,
    hysteretic: f64,
}

impl<'a> ClosedForm<'a> {
    /// Of the first elastic mode; nothing where there is none.
    pub fn new(system: &'a System, grid: &'a Grid) -> Option<Self> {
        let mode = system.modes.elastic().next()?;
        let bodies = crate::response::bodies::Bodies::new(system, &[]);
        let shape = system.modes.shapes.column(mode);
        let along = |matrix: &nalgebra::DMatrix<f64>| shape.dot(&(matrix * shape));
        Some(Self { system, grid, mode, viscous: along(&bodies.damping), hysteretic: along(&bodies.hysteresis) })
    }
}

impl Response for ClosedForm<'_> {
    super::method::identity!("closed_form");

    fn phasor(&self, design: &[Mounted], quantity: Quantity, at: (usize, f64), work: &mut Work) -> Result<C64, ResponseError> {
        let (order, speed_rpm) = at;
        let system = self.system;
        let shape = |station: usize| system.modes.shapes[(station, self.mode)];
        let excited = system.excitation.orders[order];
        let omega = excited.omega(speed_rpm);
        work.modal_solves += 1;
        if design.len() > 1 {
            return Err(ResponseError::NotApplicable { method: "closed_form", why: "it takes one absorber" });
        }
        let mut torque = vec![ZERO; system.chain.len()];
        system.torque(order, speed_rpm, &mut torque);
        let force: C64 = torque.iter().enumerate().map(|(s, t)| t * shape(s)).sum();
        if force == ZERO {
            return Ok(ZERO);
        }
        let natural = system.modes.omega[self.mode];
        let engine = C64::new(natural * natural - omega * omega, omega * self.viscous + self.hysteretic);
        // coordinate of the mode over the ring's denominator, which is zero where an undamped ring resonates
        let at = Operating { omega, shaft_speed: speed_rpm * RAD_PER_S_PER_RPM };
        let condensed = Condensed::new(design, at);
        let z = condensed.hubs.first().map(|hub| (hub, shape(hub.station)));
        let (determinant, denominator) = match &z {
            None => (engine, C64::from(1.0)),
            Some((z, phi)) => (engine * z.denominator + z.numerator * (phi * phi), z.denominator),
        };
        if determinant.norm() <= RESONANT * omega * omega * denominator.norm() {
            return Err(ResponseError::unbounded(excited, speed_rpm));
        }
        let q = force / determinant;
        let y = match quantity {
            Quantity::ShaftTorque(s) => system.chain.shaft_stiffness(s, omega) * q * denominator * system.chain.link(s).of(shape),
            Quantity::RingTwist(_) => z.map_or(ZERO, |(_, phi)| q * phi * condensed.rings[0].twist),
            Quantity::Twist { .. } | Quantity::Motion(..) => {
                quantity.of_angle(q * denominator * quantity.difference(&system.chain).map_or(0.0, |twist| twist.of(shape)), omega)
            }
        };
        if y.is_finite() { Ok(y) } else { Err(ResponseError::unbounded(excited, speed_rpm)) }
    }
}
