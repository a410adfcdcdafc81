//! Where a law is asked for its dynamic stiffness, and that of a spring and a damper.

use crate::numerics::C64;

/// Where a law is asked for its stiffness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Operating {
    /// Circular frequency of the motion, rad/s.
    pub omega: f64,
    /// Speed of the shaft, rad/s.
    pub shaft_speed: f64,
}

/// A spring and a viscous damper side by side: S = k + i omega c.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringAndDamper {
    /// N m/rad.
    pub stiffness: f64,
    /// N m s/rad.
    pub damping: f64,
}

impl SpringAndDamper {
    /// S = k + i omega c, N m/rad.
    pub fn dynamic_stiffness(self, omega: f64) -> C64 {
        C64::new(self.stiffness, omega * self.damping)
    }
}
