//! Ring on springs of two stages with dry friction: a pack of steel springs, or the secondary mass of a dual-mass flywheel, which carries the torque of what it drives.
//!
//! Torque of the springs k1 d up to a twist d1 either way, k1 d1 + k2 (d - d1) beyond; of friction M tanh(d'/v), which is Coulomb's at rates well above v and takes 4 M A a cycle at an amplitude A
//! \[Den Hartog 1956, section 8.10\]; of a damper c d'. What the ring drives resists it with the torque T0 against the direction of rotation, J (d'' + hub'') = -spring - friction - c d' - T0: the ring lags behind its
//! hub, d < 0, at rest by what T0 twists the springs, and T0 decides in which stage they work. At twists so small that its rates stay below v, friction
//! holds the ring like a damper M/v: what it does at its own amplitude is found by harmonic balance.

use super::dynamic_stiffness::Operating;
use super::large_twist::{Instant, LargeTwist, Reaction};
use super::law::{Declaration, Law};
use super::parameter::{DAMPING, Parameter, RING_INERTIA, Range, STIFFNESS, of_material};
use crate::numerics::C64;
use crate::numerics::elementary::Elementary;
use crate::units::RAD_PER_DEG;
use std::sync::Arc;

/// Ring on springs of two stages.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoStage {
    /// kg m².
    pub ring_inertia: f64,
    /// k1 of the first stage, N m/rad, positive: without it nothing decides the mean twist.
    pub stiffness: f64,
    /// c, N m s/rad, not negative.
    pub damping: f64,
    /// k2 beyond it, N m/rad, positive.
    pub second_stiffness: f64,
    /// d1 at which it begins, degrees, positive.
    pub second_from: f64,
    /// M, N m, not negative.
    pub friction: f64,
    /// v, rad/s, positive.
    pub friction_rate: f64,
    /// T0, N m, not negative: from the hub to the ring in the direction of rotation.
    pub carried: f64,
}

const SECOND_STIFFNESS: Parameter = of_material(
    ("second_stiffness_n_m_per_rad", "k2/N m/rad", "Stiffness beyond the first stage."),
    Range::Positive,
    |_| (1.0, 1e7),
    |_| 1e4,
);
const SECOND_FROM: Parameter = of_material(
    ("second_stage_from_deg", "from/deg", "Twist either way at which the second stage begins."),
    Range::Positive,
    |_| (1e-3, 100.0),
    |_| 1.0,
);
const FRICTION: Parameter =
    of_material(("friction_n_m", "friction/N m", "Torque of dry friction."), Range::NotNegative, |_| (0.0, 1e4), |_| 1.0);
const FRICTION_RATE: Parameter = of_material(
    ("friction_rate_rad_per_s", "v/rad/s", "Rate of twist at which friction has 0.76 of its torque; below it acts like a damper."),
    Range::Positive,
    |_| (1e-4, 100.0),
    |_| 0.1,
);
/// Torque of what the ring drives. A ring that carries torque is tuned below all orders.
#[doc(hidden)]
pub const CARRIED: Parameter = of_material(
    (
        "carried_torque_n_m",
        "carried/N m",
        "Mean torque that the springs carry from the hub to the ring, which drives a load with it and lags behind the hub.",
    ),
    Range::NotNegative,
    |_| (0.0, 1e5),
    |_| 1.0,
);

/// A spring that leaves no doubt of the mean twist.
const HELD: Parameter = Parameter { range: Range::Positive, ..STIFFNESS };

/// Ring on springs of two stages.
pub static TWO_STAGE: Declaration = Declaration {
    name: "two_stage",
    about: "A ring on springs of two stages with dry friction, as in a dual-mass flywheel.",
    parameters: &[RING_INERTIA, HELD, DAMPING, SECOND_STIFFNESS, SECOND_FROM, FRICTION, FRICTION_RATE, CARRIED],
    build: |v| {
        let [ring_inertia, stiffness, damping, second_stiffness, second_from, friction, friction_rate, carried] =
            std::array::from_fn(|i| v[i]);
        let own = TwoStage { ring_inertia, stiffness, damping, second_stiffness, second_from, friction, friction_rate, carried };
        Arc::new(own)
    },
    closed_forms: &[],
};

impl TwoStage {
    /// Torque of the springs and its slope.
    fn spring(&self, twist: f64) -> (f64, f64) {
        let from = self.second_from * RAD_PER_DEG;
        if twist.abs() <= from {
            return (self.stiffness * twist, self.stiffness);
        }
        (twist.signum() * (self.stiffness * from + self.second_stiffness * (twist.abs() - from)), self.second_stiffness)
    }

    /// Whether the springs rest in their first stage under the torque that is carried.
    fn rests_in_first(&self) -> bool {
        self.carried <= self.stiffness * self.second_from * RAD_PER_DEG
    }

    /// Damping of the smallest twists.
    fn creeping(&self) -> f64 {
        self.damping + self.friction / self.friction_rate
    }
}

impl Law for TwoStage {
    fn declaration(&self) -> &'static Declaration {
        &TWO_STAGE
    }
    fn values(&self) -> Vec<f64> {
        let Self { ring_inertia, stiffness, damping, second_stiffness, second_from, friction, friction_rate, carried } = *self;
        vec![ring_inertia, stiffness, damping, second_stiffness, second_from, friction, friction_rate, carried]
    }
    fn ring_inertia(&self) -> f64 {
        self.ring_inertia
    }
    fn dynamic_stiffness(&self, at: Operating) -> C64 {
        let slope = if self.rests_in_first() { self.stiffness } else { self.second_stiffness };
        C64::new(slope, at.omega * self.creeping())
    }
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        let in_first = self.rests_in_first();
        let one = |counts: bool| C64::from(if counts { 1.0 } else { 0.0 });
        let rate = |by: f64| C64::new(0.0, at.omega * by);
        let (by_friction, by_rate) = (1.0 / self.friction_rate, -self.friction / (self.friction_rate * self.friction_rate));
        vec![C64::default(), one(in_first), rate(1.0), one(!in_first), C64::default(), rate(by_friction), rate(by_rate), C64::default()]
    }
    fn large_twist(&self) -> Option<&dyn LargeTwist> {
        Some(self)
    }
}

impl LargeTwist for TwoStage {
    fn reactions(&self, at: &Instant) -> (Reaction, Reaction) {
        let (spring, slope) = self.spring(at.twist);
        let share = hyperbolic_tangent(at.rate / self.friction_rate);
        let rubbing = self.damping * at.rate + self.friction * share;
        let by_rate = self.damping + self.friction * (1.0 - share * share) / self.friction_rate;
        let inertia = self.ring_inertia * (at.acceleration + at.hub_acceleration);
        let own =
            Reaction { value: inertia + spring + rubbing + self.carried, by: [slope, by_rate, self.ring_inertia, 0.0, self.ring_inertia] };
        (own, Reaction { value: inertia, by: [0.0, 0.0, self.ring_inertia, 0.0, self.ring_inertia] })
    }
    fn is_ring(&self) -> bool {
        true
    }
    fn counts_when_small(&self) -> bool {
        self.friction == 0.0
    }
}

/// tanh x, by the same elementary functions on every processor.
fn hyperbolic_tangent(x: f64) -> f64 {
    let e = (-2.0 * x.abs()).exponential();
    x.signum() * (1.0 - e) / (1.0 + e)
}
