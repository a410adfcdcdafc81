//! Centrifugal pendulums for small swing: the centrifugal field is their spring, so that they are tuned to an order instead of a frequency.
//!
//! N masses m with their centres R0 from the axis and a tuning order n move like a ring of inertia J = N m R0² with S = J n² Omega² + i omega c, c = J c_p/m for a damping c_p of the swing in N s/m
//! \[Den Hartog 1956, section 5.7\]. A simple pendulum of length r on a pivot at R has n = sqrt(R/r) with R0 = R + r; the twist of that ring is the arc s over R0. Inertia of the masses about
//! their own centres belongs to the ring where they turn with the swing and to the hub where they are hung on two rollers. Large swing is that of pendulums
//! on paths. Not modelled: gravity at low speed and pendulums out of step.

use super::closed_forms::EngineMode;
use super::dynamic_stiffness::{Operating, OperatingOver};
use super::law::{ClosedForm, Declaration, Law};
use super::parameter::{DAMPING, Follows, Parameter, RING_INERTIA, Range};
use crate::numerics::taylor::Taylor;
use crate::numerics::{C64, I};
use std::sync::Arc;

/// Pendulums as the ring that moves like them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pendulum {
    /// N m R0², kg m².
    pub ring_inertia: f64,
    /// n, above zero.
    pub tuning_order: f64,
    /// N m s/rad, not negative.
    pub damping: f64,
}

pub(super) const TUNING_ORDER: Parameter = Parameter {
    key: "tuning_order",
    label: "tuned to",
    about: "Order that the pendulums are tuned to.",
    range: Range::Positive,
    extensive: false,
    dissipative: false,
    material: false,
    follows: Follows::Nothing,
    bounds: |_| (0.25, 12.0),
    typical: |_| 3.0,
};

/// Pendulums as the ring that moves like them.
pub static PENDULUM: Declaration = Declaration {
    name: "pendulum",
    about: "Centrifugal pendulums of small swing.",
    parameters: &[RING_INERTIA, TUNING_ORDER, DAMPING],
    build: |v| Arc::new(Pendulum { ring_inertia: v[0], tuning_order: v[1], damping: v[2] }),
    closed_forms: &CLOSED_FORMS,
};

pub(super) static CLOSED_FORMS: [ClosedForm; 2] = [
    ClosedForm { name: "pendulum_order_3", every_mode: true, is_optimum: false, values: |ring, engine| start(ring, engine, 3.0) },
    ClosedForm { name: "pendulum_order_6", every_mode: false, is_optimum: false, values: |ring, engine| start(ring, engine, 6.0) },
];

/// Tuned to an order, with a hundredth of critical damping at the frequency of the mode: a start, no optimum.
fn start(ring_inertia: f64, engine: EngineMode, order: f64) -> Vec<f64> {
    vec![ring_inertia, order, 0.02 * ring_inertia * engine.omega]
}

impl Law for Pendulum {
    fn declaration(&self) -> &'static Declaration {
        &PENDULUM
    }
    fn values(&self) -> Vec<f64> {
        vec![self.ring_inertia, self.tuning_order, self.damping]
    }
    fn ring_inertia(&self) -> f64 {
        self.ring_inertia
    }
    fn dynamic_stiffness(&self, at: Operating) -> C64 {
        let stiffness = self.ring_inertia * (self.tuning_order * at.shaft_speed).powi(2);
        C64::new(stiffness, at.omega * self.damping)
    }
    fn over(&self, values: &[Taylor], at: &OperatingOver) -> Option<Taylor> {
        let tuned = values[1].times(&at.shaft_speed);
        Some(values[0].times(&tuned.times(&tuned)).plus(&values[2].times(&at.omega).times_number(I)))
    }
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        let tuned = (self.tuning_order * at.shaft_speed).powi(2);
        vec![C64::from(tuned), C64::from(2.0 * self.ring_inertia * tuned / self.tuning_order), C64::new(0.0, at.omega)]
    }
    fn depends_on_speed(&self) -> bool {
        true
    }
}
