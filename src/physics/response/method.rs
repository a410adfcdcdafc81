//! What every response method offers.

use super::error::ResponseError;
use super::grid::Grid;
use super::quantity::Quantity;
use super::work::Work;
use crate::absorber::Mounted;
use crate::drivetrain::System;
use crate::numerics::C64;

/// Word, speeds and system of a method that holds its grid and system in fields of these names.
macro_rules! identity {
    ($name:literal) => {
        fn name(&self) -> &'static str {
            $name
        }
        fn grid(&self) -> &$crate::response::Grid {
            self.grid
        }
        fn system(&self) -> &$crate::drivetrain::System {
            self.system
        }
    };
}
pub(super) use identity;

/// A modal stiffness below this share of the inertia forces is rounding: nothing damps a resonance met exactly.
pub(super) const RESONANT: f64 = 1e-14;

/// A method that computes the steady response.
pub trait Response: Sync {
    /// Its word in studies.
    fn name(&self) -> &'static str;

    /// Speeds of its sweeps.
    fn grid(&self) -> &Grid;

    /// What it computes the response of.
    fn system(&self) -> &System;

    /// Indices of the orders.
    fn orders(&self) -> std::ops::Range<usize> {
        0..self.system().orders()
    }

    /// The phasor of one order (an index) at any speed (rpm).
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance; others where the method cannot take the system.
    fn phasor(&self, design: &[Mounted], quantity: Quantity, at: (usize, f64), work: &mut Work) -> Result<C64, ResponseError>;

    /// Phasors of `quantity` for all orders at any speed.
    ///
    /// # Errors
    /// Those of [`Self::phasor`].
    fn all_orders_at(&self, design: &[Mounted], quantity: Quantity, speed_rpm: f64, work: &mut Work) -> Result<Vec<C64>, ResponseError> {
        self.orders().map(|order| self.phasor(design, quantity, (order, speed_rpm), work)).collect()
    }

    /// Phasors of `quantity` at all grid speeds and orders (speed by speed).
    ///
    /// # Errors
    /// Those of [`Self::phasor`].
    fn sweep(&self, design: &[Mounted], quantity: Quantity, out: &mut Vec<C64>, work: &mut Work) -> Result<(), ResponseError> {
        out.clear();
        for &speed in &self.grid().speed_rpm {
            out.extend(self.all_orders_at(design, quantity, speed, work)?);
        }
        Ok(())
    }

    /// Phasors of several quantities at once, one sweep each: costs little more than one where every point is solved anew.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance.
    fn sweep_each(&self, design: &[Mounted], quantities: &[Quantity], work: &mut Work) -> Result<Vec<Vec<C64>>, ResponseError> {
        let one = |q: &Quantity| {
            let mut out = Vec::new();
            self.sweep(design, *q, &mut out, work).map(|()| out)
        };
        quantities.iter().map(one).collect()
    }

    /// Squares of the magnitudes of `quantity` at all grid speeds and orders (speed by speed).
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance.
    fn squares(&self, design: &[Mounted], quantity: Quantity, out: &mut Vec<f64>, work: &mut Work) -> Result<(), ResponseError> {
        let mut phasors = Vec::new();
        self.sweep(design, quantity, &mut phasors, work)?;
        out.clear();
        out.extend(phasors.iter().map(|y| y.norm_sqr()));
        Ok(())
    }
}
