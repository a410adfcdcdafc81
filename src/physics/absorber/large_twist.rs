//! Laws whose twist is not small: equations in time of a ring, or of what moves like one, and of the torque that its hub has to give it.

use std::fmt::Debug;

/// What moves, at an instant; angles about uniform rotation.
#[derive(Debug, Clone, Copy, Default)]
pub struct Instant {
    /// Twist of the ring against its hub, rad.
    pub twist: f64,
    /// Its rate, rad/s.
    pub rate: f64,
    /// rad/s².
    pub acceleration: f64,
    /// Vibratory rate of the hub, rad/s.
    pub hub_rate: f64,
    /// rad/s².
    pub hub_acceleration: f64,
    /// Mean speed of the shaft, rad/s.
    pub shaft_speed: f64,
}

/// A value with its derivatives by twist, rate, acceleration, rate of the hub and acceleration of the hub.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Reaction {
    /// N m.
    pub value: f64,
    /// In that order.
    pub by: [f64; 5],
}

/// Equations of a law in time. Both are linear in the two accelerations.
pub trait LargeTwist: Debug + Send + Sync {
    /// Equation of the ring's own motion, zero in motion, and torque that the hub gives to all of the absorber, N m. Not finite where the law ends.
    fn reactions(&self, at: &Instant) -> (Reaction, Reaction);

    /// Whether the hub acts on the ring by the ring's inertia alone, and the ring on the hub: T = J (twist'' + hub'').
    fn is_ring(&self) -> bool;

    /// Degree of its equations, where they are polynomials in twist, rates and accelerations together: so many samples of a cycle then hold all of them.
    fn degree(&self) -> Option<usize> {
        None
    }

    /// Whether what it does at small twist, whatever the torque, is judged beside its own amplitude: not where dry friction holds it fast.
    fn counts_when_small(&self) -> bool {
        true
    }

    /// Largest twist that it can make, rad; nothing where there is no such end.
    fn largest_twist(&self) -> Option<f64> {
        None
    }

    /// Twist after which all is as before, rad: a full turn of a mass on its circle. A motion about any of these places is the same motion; nothing where there is none.
    fn full_turn(&self) -> Option<f64> {
        None
    }
}
