//! What a response is asked for.

use crate::drivetrain::{Chain, Difference};

/// A quantity that is linear in the angles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize)]
pub enum Quantity {
    /// Angle of station `from` less that of `to`, referred to the crankshaft where there are gears (`None`: the ground, so the amplitude of a
    /// station), rad.
    Twist {
        /// Index of a station.
        from: usize,
        /// Index of a station, or the ground.
        to: Option<usize>,
    },
    /// Vibratory torque of a shaft length, elastic and damping parts, N m.
    ShaftTorque(usize),
    /// Angle of the ring of an absorber (index in the design) less that of its hub, rad.
    RingTwist(usize),
}

impl Quantity {
    /// The angles of stations that it is, or that it is the stiffness of a shaft times; nothing for the twist of a ring.
    pub(crate) fn difference(self, chain: &Chain) -> Option<Difference> {
        match self {
            Self::Twist { from, to: None } => Some(Difference { from, to: None, scale: 1.0 }),
            Self::Twist { from, to: Some(to) } => Some(chain.between(from, to)),
            Self::ShaftTorque(shaft) => Some(chain.link(shaft)),
            Self::RingTwist(_) => None,
        }
    }
}
