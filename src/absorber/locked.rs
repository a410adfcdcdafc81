//! A ring that turns with its hub: what is left of an absorber that has seized.

use super::Ring;

/// A dead inertia on the hub; the limit of infinite stiffness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Locked {
    /// kg m²; zero where the ring is lost.
    pub ring_inertia: f64,
}

impl Ring for Locked {
    fn ring_inertia(&self) -> f64 {
        self.ring_inertia
    }
    fn stiffness(&self) -> f64 {
        f64::INFINITY
    }
    fn damping(&self) -> f64 {
        0.0
    }
    fn with(&self, ring_inertia: f64, _: f64, _: f64) -> Self {
        Self { ring_inertia }
    }
}
