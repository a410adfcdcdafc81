//! What ties a ring to its hub: a complex dynamic stiffness.

use super::declaration::Declaration;
use crate::numerics::C64;
use std::fmt::Debug;

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

/// The law of a ring: torque from hub to ring per twist between them, S(omega, shaft speed), N m/rad. A law is passive (Im S >= 0 for omega > 0).
///
/// Everything else hartog knows of a type is in its [`Declaration`]: the response methods ask for S and its derivatives and know no types.
pub trait Law: Debug + Send + Sync {
    /// The type, with its parameters.
    fn declaration(&self) -> &'static Declaration;

    /// Values of the declared parameters in their order, ring inertia first.
    fn values(&self) -> Vec<f64>;

    /// Inertia of the ring, kg m²: the first of the values.
    fn ring_inertia(&self) -> f64;

    /// S, N m/rad.
    fn dynamic_stiffness(&self, at: Operating) -> C64;

    /// Derivatives of S with respect to the declared parameters after the ring inertia, one each.
    fn derivatives(&self, at: Operating) -> Vec<C64>;

    /// The spring and the damper, where S is that of constant ones: methods then need no S at every frequency, and methods in time apply.
    fn spring_and_damper(&self) -> Option<SpringAndDamper> {
        None
    }

    /// Whether S depends on the speed of the shaft.
    fn depends_on_speed(&self) -> bool {
        false
    }

    /// S at many points.
    fn dynamic_stiffness_each(&self, at: &[Operating], out: &mut [C64]) {
        for (out, at) in out.iter_mut().zip(at) {
            *out = self.dynamic_stiffness(*at);
        }
    }

    /// Mean power dissipated at one frequency by a twist of this amplitude (rad, zero to peak), W: omega Im S |twist|²/2.
    fn dissipated_power(&self, at: Operating, twist_amplitude: f64) -> f64 {
        match self.spring_and_damper() {
            Some(s) => 0.5 * s.damping * (at.omega * twist_amplitude).powi(2),
            None => 0.5 * at.omega * self.dynamic_stiffness(at).im * twist_amplitude * twist_amplitude,
        }
    }
}
