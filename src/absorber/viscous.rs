//! Untuned viscous absorber: a ring in silicone fluid, without spring.

use super::Ring;

/// Untuned viscous absorber: a ring in silicone fluid, without spring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viscous {
    /// kg m².
    pub ring_inertia: f64,
    /// N m s/rad, not negative.
    pub damping: f64,
}

impl Ring for Viscous {
    fn ring_inertia(&self) -> f64 {
        self.ring_inertia
    }
    fn stiffness(&self) -> f64 {
        0.0
    }
    fn damping(&self) -> f64 {
        self.damping
    }
    fn with(&self, ring_inertia: f64, _stiffness: f64, damping: f64) -> Self {
        Self { ring_inertia, damping }
    }
}
