//! What a response is asked for.

use crate::drivetrain::{Chain, Difference};
use crate::numerics::C64;

/// A quantity that is linear in the angles, at a frequency.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
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
    /// Angular velocity or acceleration of a station, rad/s or rad/s².
    Motion(usize, Rate),
}

/// A derivative of an angle by time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
pub enum Rate {
    /// The first, rad/s.
    Velocity,
    /// The second, rad/s².
    Acceleration,
}

impl Rate {
    /// Of an angle that oscillates at omega: i omega or -omega² times it.
    pub(crate) fn of(self, angle: C64, omega: f64) -> C64 {
        match self {
            Self::Velocity => angle * C64::new(0.0, omega),
            Self::Acceleration => angle * -(omega * omega),
        }
    }

    /// Behind a number.
    #[doc(hidden)]
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Velocity => " rad/s",
            Self::Acceleration => " rad/s²",
        }
    }

    /// As tables write it.
    #[doc(hidden)]
    pub fn unit(self) -> &'static str {
        match self {
            Self::Velocity => "rad/s",
            Self::Acceleration => "rad/s2",
        }
    }
}

impl Quantity {
    /// The angles of stations that it is, or that it is a factor times (the stiffness of a shaft, a square of the frequency); nothing for the twist of a ring.
    pub(crate) fn difference(self, chain: &Chain) -> Option<Difference> {
        match self {
            Self::Twist { from, to: None } => Some(Difference { from, to: None, scale: 1.0 }),
            Self::Twist { from, to: Some(to) } => Some(chain.between(from, to)),
            Self::ShaftTorque(shaft) => Some(chain.link(shaft)),
            Self::Motion(from, _) => Some(Difference { from, to: None, scale: 1.0 }),
            Self::RingTwist(_) => None,
        }
    }

    /// Of what of the system it is, in names of stations.
    #[doc(hidden)]
    pub fn place(self, chain: &Chain) -> String {
        let name = |station: usize| chain.stations[station].name.as_str();
        match self {
            Self::Twist { from, to: Some(to) } => format!("{} to {}", name(from), name(to)),
            Self::Twist { from, to: None } | Self::Motion(from, _) => name(from).to_owned(),
            Self::ShaftTorque(shaft) => chain.shaft_name(shaft),
            Self::RingTwist(i) => format!("absorber {}", i + 1),
        }
    }

    /// What it is of the angles of its difference that oscillate at omega, but for the stiffness of a shaft.
    pub(crate) fn of_angle(self, angle: C64, omega: f64) -> C64 {
        if let Self::Motion(_, rate) = self { rate.of(angle, omega) } else { angle }
    }
}
