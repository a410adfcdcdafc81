//! Ring on a spring, S = k: what a tuned absorber would be without its damper.

use super::closed_forms::{brock_unity_ring, den_hartog_brock_ring, h_infinity_ring};
use super::dynamic_stiffness::{Operating, OperatingOver, SpringAndDamper};
use super::law::{ClosedForm, Declaration, Law};
use super::parameter::{RING_INERTIA, STIFFNESS};
use crate::numerics::C64;
use crate::numerics::taylor::Taylor;
use std::sync::Arc;

/// Ring on a spring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Undamped {
    /// kg m².
    pub ring_inertia: f64,
    /// N m/rad, not negative.
    pub stiffness: f64,
}

/// Ring and spring; searches start from the stiffness of the tuned rules.
pub static UNDAMPED: Declaration = Declaration {
    name: "undamped",
    about: "A ring on a spring without damper.",
    parameters: &[RING_INERTIA, STIFFNESS],
    build: |v| Arc::new(Undamped { ring_inertia: v[0], stiffness: v[1] }),
    closed_forms: &[
        ClosedForm {
            name: "brock_unity",
            every_mode: false,
            is_optimum: true,
            values: |ring, mode| vec![ring, brock_unity_ring(ring, mode).stiffness],
        },
        ClosedForm {
            name: "den_hartog_brock",
            every_mode: false,
            is_optimum: true,
            values: |ring, mode| vec![ring, den_hartog_brock_ring(ring, mode).stiffness],
        },
        ClosedForm {
            name: "h_infinity",
            every_mode: true,
            is_optimum: true,
            values: |ring, mode| vec![ring, h_infinity_ring(ring, mode).stiffness],
        },
    ],
};

impl Law for Undamped {
    fn declaration(&self) -> &'static Declaration {
        &UNDAMPED
    }
    fn values(&self) -> Vec<f64> {
        vec![self.ring_inertia, self.stiffness]
    }
    fn ring_inertia(&self) -> f64 {
        self.ring_inertia
    }
    fn dynamic_stiffness(&self, _: Operating) -> C64 {
        C64::from(self.stiffness)
    }
    fn over(&self, values: &[Taylor], _: &OperatingOver) -> Option<Taylor> {
        Some(values[1])
    }
    fn quotient(&self, values: &[f64], _: Operating) -> Option<[C64; 2]> {
        Some([C64::from(values[1]), C64::from(1.0)])
    }
    fn derivatives(&self, _: Operating) -> Vec<C64> {
        vec![C64::default(), C64::from(1.0)]
    }
    fn spring_and_damper(&self) -> Option<SpringAndDamper> {
        Some(SpringAndDamper { stiffness: self.stiffness, damping: 0.0 })
    }
}
