//! Undamped tuned absorber: a ring on a spring.

use super::Ring;

/// Undamped tuned absorber: a ring on a spring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Undamped {
    /// kg m².
    pub ring_inertia: f64,
    /// N m/rad, not negative.
    pub stiffness: f64,
}

impl Ring for Undamped {
    fn ring_inertia(&self) -> f64 {
        self.ring_inertia
    }
    fn stiffness(&self) -> f64 {
        self.stiffness
    }
    fn damping(&self) -> f64 {
        0.0
    }
    fn with(&self, ring_inertia: f64, stiffness: f64, _damping: f64) -> Self {
        Self { ring_inertia, stiffness }
    }
}
