//! Ring on a spring that stiffens with its twist, with a viscous damper beside it: torque k (delta + a delta³) + c delta'.
//!
//! At small twist it is a ring on a spring and a damper; at the amplitude A of a single frequency its spring is one of k (1 + 3/4 a A²) \[Den Hartog 1956, chapter 8\].

use super::dynamic_stiffness::{Operating, SpringAndDamper};
use super::large_twist::{Instant, LargeTwist, Reaction};
use super::law::{Declaration, Law};
use super::parameter::{DAMPING, Parameter, RING_INERTIA, Range, STIFFNESS, of_material};
use crate::numerics::C64;
use std::sync::Arc;

/// Ring on a spring that stiffens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hardening {
    /// kg m².
    pub ring_inertia: f64,
    /// k of small twists, N m/rad, positive: without it nothing decides the mean twist.
    pub stiffness: f64,
    /// N m s/rad, not negative.
    pub damping: f64,
    /// a, 1/rad², not negative.
    pub stiffening: f64,
}

const STIFFENING: Parameter = of_material(
    ("stiffening_per_rad2", "stiffening/1/rad²", "Share by which the stiffness grows with the square of the twist."),
    Range::NotNegative,
    |_| (1.0, 1e6),
    |_| 1e3,
);

/// A spring that leaves no doubt of the mean twist.
const HELD: Parameter = Parameter { range: Range::Positive, ..STIFFNESS };

/// Ring on a spring that stiffens.
pub static HARDENING: Declaration = Declaration {
    name: "hardening",
    about: "A ring on a spring that stiffens with its twist.",
    parameters: &[RING_INERTIA, HELD, DAMPING, STIFFENING],
    build: |v| Arc::new(Hardening { ring_inertia: v[0], stiffness: v[1], damping: v[2], stiffening: v[3] }),
    closed_forms: &[],
};

impl Law for Hardening {
    fn declaration(&self) -> &'static Declaration {
        &HARDENING
    }
    fn values(&self) -> Vec<f64> {
        vec![self.ring_inertia, self.stiffness, self.damping, self.stiffening]
    }
    fn ring_inertia(&self) -> f64 {
        self.ring_inertia
    }
    fn dynamic_stiffness(&self, at: Operating) -> C64 {
        C64::new(self.stiffness, at.omega * self.damping)
    }
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        vec![C64::default(), C64::from(1.0), C64::new(0.0, at.omega), C64::default()]
    }
    fn spring_and_damper(&self) -> Option<SpringAndDamper> {
        Some(SpringAndDamper { stiffness: self.stiffness, damping: self.damping })
    }
    fn large_twist(&self) -> Option<&dyn LargeTwist> {
        (self.stiffening > 0.0).then_some(self)
    }
}

impl LargeTwist for Hardening {
    fn reactions(&self, at: &Instant) -> (Reaction, Reaction) {
        let square = self.stiffening * at.twist * at.twist;
        let spring = self.stiffness * at.twist * (1.0 + square) + self.damping * at.rate;
        let inertia = self.ring_inertia * (at.acceleration + at.hub_acceleration);
        let slope = self.stiffness * (1.0 + 3.0 * square);
        let own = Reaction { value: inertia + spring, by: [slope, self.damping, self.ring_inertia, 0.0, self.ring_inertia] };
        (own, Reaction { value: inertia, by: [0.0, 0.0, self.ring_inertia, 0.0, self.ring_inertia] })
    }
    fn is_ring(&self) -> bool {
        true
    }
    fn degree(&self) -> Option<usize> {
        Some(3)
    }
}
