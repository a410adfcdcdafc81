//! Ring on a spring with a viscous damper beside it: the textbook's absorber, S = k + i omega c.

use super::closed_forms::{EngineMode, brock_unity_ring, den_hartog_brock_ring, h_infinity_ring};
use super::dynamic_stiffness::{Operating, OperatingOver, SpringAndDamper};
use super::law::{ClosedForm, Declaration, Law};
use super::parameter::{DAMPING, RING_INERTIA, STIFFNESS};
use crate::numerics::taylor::Taylor;
use crate::numerics::{C64, I};
use std::sync::Arc;

/// Ring on a spring with a viscous damper beside it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tuned {
    /// kg m².
    pub ring_inertia: f64,
    /// N m/rad, not negative.
    pub stiffness: f64,
    /// N m s/rad, not negative.
    pub damping: f64,
}

/// Ring, spring and damper.
pub static TUNED: Declaration = Declaration {
    name: "tuned",
    about: "A ring on a spring with a damper beside it.",
    parameters: &[RING_INERTIA, STIFFNESS, DAMPING],
    build: |v| Arc::new(Tuned { ring_inertia: v[0], stiffness: v[1], damping: v[2] }),
    closed_forms: &[
        ClosedForm { name: "brock_unity", every_mode: false, is_optimum: true, values: |ring, mode| values(ring, mode, brock_unity_ring) },
        ClosedForm {
            name: "den_hartog_brock",
            every_mode: false,
            is_optimum: true,
            values: |ring, mode| values(ring, mode, den_hartog_brock_ring),
        },
        ClosedForm { name: "h_infinity", every_mode: true, is_optimum: true, values: |ring, mode| values(ring, mode, h_infinity_ring) },
    ],
};

fn values(ring_inertia: f64, mode: EngineMode, rule: fn(f64, EngineMode) -> SpringAndDamper) -> Vec<f64> {
    let s = rule(ring_inertia, mode);
    vec![ring_inertia, s.stiffness, s.damping]
}

impl Law for Tuned {
    fn declaration(&self) -> &'static Declaration {
        &TUNED
    }
    fn values(&self) -> Vec<f64> {
        vec![self.ring_inertia, self.stiffness, self.damping]
    }
    fn ring_inertia(&self) -> f64 {
        self.ring_inertia
    }
    fn dynamic_stiffness(&self, at: Operating) -> C64 {
        C64::new(self.stiffness, at.omega * self.damping)
    }
    fn over(&self, values: &[Taylor], at: &OperatingOver) -> Option<Taylor> {
        Some(values[1].plus(&values[2].times(&at.omega).times_number(I)))
    }
    fn quotient(&self, values: &[f64], at: Operating) -> Option<[C64; 2]> {
        Some([C64::new(values[1], at.omega * values[2]), C64::from(1.0)])
    }
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        vec![C64::default(), C64::from(1.0), C64::new(0.0, at.omega)]
    }
    fn spring_and_damper(&self) -> Option<SpringAndDamper> {
        Some(SpringAndDamper { stiffness: self.stiffness, damping: self.damping })
    }
}
