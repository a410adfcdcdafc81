//! Rubber or spring-and-fluid absorber: a ring on a spring with a viscous damper beside it.

use super::Ring;

/// Rubber or spring-and-fluid absorber: a ring on a spring with a viscous damper beside it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tuned {
    /// kg m².
    pub ring_inertia: f64,
    /// N m/rad, not negative.
    pub stiffness: f64,
    /// N m s/rad, not negative.
    pub damping: f64,
}

impl Ring for Tuned {
    fn ring_inertia(&self) -> f64 {
        self.ring_inertia
    }
    fn stiffness(&self) -> f64 {
        self.stiffness
    }
    fn damping(&self) -> f64 {
        self.damping
    }
    fn with(&self, ring_inertia: f64, stiffness: f64, damping: f64) -> Self {
        Self { ring_inertia, stiffness, damping }
    }
}
