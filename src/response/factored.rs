//! The system at one frequency, absorbers condensed onto their stations: a row of stations factored with exchange of rows, a tree from its leaves to
//! its root.

use super::{Quantity, ResponseError, Work};
use crate::absorber::{Condensed, Mounted, Operating};
use crate::drivetrain::System;
use crate::numerics::sparse::Sparse;
use crate::numerics::tridiagonal::Singular;
use crate::numerics::{C64, ZERO};
use crate::units::RAD_PER_S_PER_RPM;

/// The factored system at one frequency.
///
/// The column of a station with absorbers is scaled by their denominators d (see [`Condensed`]), so that the
/// unknown there is q = theta/d: finite and exact where an undamped ring resonates.
pub(crate) struct Factored<'a> {
    system: &'a System,
    /// Circular frequency, rad/s.
    pub omega: f64,
    pub matrix: Sparse,
    /// Right-hand side, then unknowns.
    pub x: Vec<C64>,
    scale: Vec<C64>,
    /// The absorbers.
    pub condensed: Condensed,
    /// Of each absorber on a station, the denominators of the others there.
    pub others: Vec<C64>,
}

impl<'a> Factored<'a> {
    pub fn new(system: &'a System) -> Self {
        let n = system.chain.len();
        Self {
            system,
            omega: 0.0,
            matrix: if system.chain.is_row() { Sparse::row(n) } else { Sparse::tree((0..n - 1).map(|i| system.chain.next(i)).collect()) },
            x: vec![ZERO; n],
            scale: vec![C64::from(1.0); n],
            condensed: Condensed::default(),
            others: Vec::new(),
        }
    }

    /// Assembles and factors at the frequency of an order at a speed.
    pub fn factor(&mut self, design: &[Mounted], order: usize, speed_rpm: f64) -> Result<(), ResponseError> {
        let order = self.system.excitation.orders[order];
        let at = Operating { omega: order.omega(speed_rpm), shaft_speed: speed_rpm * RAD_PER_S_PER_RPM };
        self.factor_at(design, at).map_err(|_| ResponseError::unbounded(order, speed_rpm))
    }

    /// The same at any frequency and speed.
    pub(crate) fn factor_at(&mut self, design: &[Mounted], at: Operating) -> Result<(), Singular> {
        let (omega, chain, n) = (at.omega, &self.system.chain, self.system.chain.len());
        self.omega = omega;
        for (i, diagonal) in self.matrix.diagonal().iter_mut().enumerate() {
            *diagonal = chain.ground_stiffness(i, omega);
        }
        for i in 0..n - 1 {
            let s = chain.shaft_stiffness(i, omega);
            let gear = chain.gear(i);
            self.matrix.diagonal()[i] += s;
            self.matrix.diagonal()[chain.next(i)] += s * (gear * gear);
            self.matrix.set_link(i, -s * gear);
        }
        self.others.clear();
        self.scale.fill(C64::from(1.0));
        self.condensed.set(design, at);
        for (hub, z) in self.condensed.hubs.iter().enumerate() {
            let h = z.station;
            // the diagonal and everything scaled so far, times the new denominator, plus the new numerator times the old scale
            let diagonal = self.matrix.diagonal()[h];
            self.matrix.scale_column(h, z.denominator);
            self.matrix.diagonal()[h] = diagonal * z.denominator + z.numerator * self.scale[h];
            for (others, _) in self.others.iter_mut().zip(&self.condensed.hubs[..hub]).filter(|o| o.1.station == h) {
                *others *= z.denominator;
            }
            self.others.push(self.scale[h]);
            self.scale[h] *= z.denominator;
        }
        self.matrix.factor()
    }

    /// Solves for the torque of an order (an index) at a speed.
    pub fn solve(&mut self, design: &[Mounted], (order, speed_rpm): (usize, f64), work: &mut Work) -> Result<(), ResponseError> {
        work.direct_solves += 1;
        self.factor(design, order, speed_rpm)?;
        self.system.torque(order, speed_rpm, &mut self.x);
        self.matrix.solve(&mut self.x);
        Ok(())
    }

    /// Phasors of quantities under the torque of an order (an index) at a speed, given to `put` one by one; zero, even at a resonance, where
    /// there is no torque.
    pub fn phasors(
        &mut self,
        design: &[Mounted],
        quantities: &[Quantity],
        at: (usize, f64),
        work: &mut Work,
        mut put: impl FnMut(usize, C64),
    ) -> Result<(), ResponseError> {
        self.system.torque(at.0, at.1, &mut self.x);
        let still = self.x.iter().all(|t| *t == ZERO);
        if !still {
            self.solve(design, at, work)?;
        }
        for (i, quantity) in quantities.iter().enumerate() {
            let y = if still { ZERO } else { self.output(*quantity, &self.x) };
            if !y.is_finite() {
                return Err(ResponseError::unbounded(self.system.excitation.orders[at.0], at.1));
            }
            put(i, y);
        }
        Ok(())
    }

    pub fn phasor(&mut self, design: &[Mounted], quantity: Quantity, at: (usize, f64), work: &mut Work) -> Result<C64, ResponseError> {
        let mut found = ZERO;
        self.phasors(design, &[quantity], at, work, |_, y| found = y)?;
        Ok(found)
    }

    /// Angle of a station from a solution.
    pub fn angle(&self, station: usize, x: &[C64]) -> C64 {
        self.scale[station] * x[station]
    }

    /// The quantity from a solution.
    pub fn output(&self, quantity: Quantity, x: &[C64]) -> C64 {
        let theta = |i: usize| self.angle(i, x);
        match quantity {
            Quantity::Twist { .. } | Quantity::Acceleration(_) => {
                quantity.difference(&self.system.chain).map_or(ZERO, |twist| twist.of(theta)) * quantity.per_angle(self.omega)
            }
            Quantity::ShaftTorque(s) => self.system.chain.shaft_stiffness(s, self.omega) * self.system.chain.link(s).of(theta),
            Quantity::RingTwist(a) => {
                let ring = &self.condensed.rings[a];
                self.hub(ring.hub, ring.twist, x)
            }
        }
    }

    /// A factor times the angle of a station over the denominator of a hub on it.
    pub fn hub(&self, hub: usize, factor: C64, x: &[C64]) -> C64 {
        self.others[hub] * factor * x[self.condensed.hubs[hub].station]
    }
}
