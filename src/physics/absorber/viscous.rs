//! Untuned viscous absorber: a ring in a Newtonian fluid, without spring, S = i omega c.

use super::closed_forms::viscous_damping;
use super::dynamic_stiffness::{Operating, OperatingOver, SpringAndDamper};
use super::law::{ClosedForm, Declaration, Law};
use super::parameter::{DAMPING, Follows, Parameter, RING_INERTIA};
use crate::numerics::taylor::Taylor;
use crate::numerics::{C64, I};
use std::sync::Arc;

/// Ring in a Newtonian fluid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viscous {
    /// kg m².
    pub ring_inertia: f64,
    /// N m s/rad, not negative.
    pub damping: f64,
}

/// Ring and damper.
pub static VISCOUS: Declaration = Declaration {
    name: "viscous",
    about: "A ring in oil, without spring.",
    parameters: &[RING_INERTIA, Parameter { follows: Follows::Factor, ..DAMPING }],
    build: |v| Arc::new(Viscous { ring_inertia: v[0], damping: v[1] }),
    closed_forms: &[ClosedForm {
        name: "viscous_untuned",
        every_mode: true,
        is_optimum: true,
        values: |ring, mode| vec![ring, viscous_damping(ring, mode)],
    }],
};

impl Law for Viscous {
    fn declaration(&self) -> &'static Declaration {
        &VISCOUS
    }
    fn values(&self) -> Vec<f64> {
        vec![self.ring_inertia, self.damping]
    }
    fn ring_inertia(&self) -> f64 {
        self.ring_inertia
    }
    fn dynamic_stiffness(&self, at: Operating) -> C64 {
        C64::new(0.0, at.omega * self.damping)
    }
    fn over(&self, values: &[Taylor], at: &OperatingOver) -> Option<Taylor> {
        Some(values[1].times(&at.omega).times_number(I))
    }
    fn quotient(&self, values: &[f64], at: Operating) -> Option<[C64; 2]> {
        Some([C64::new(0.0, at.omega * values[1]), C64::from(1.0)])
    }
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        vec![C64::default(), C64::new(0.0, at.omega)]
    }
    fn spring_and_damper(&self) -> Option<SpringAndDamper> {
        Some(SpringAndDamper { stiffness: 0.0, damping: self.damping })
    }
}
