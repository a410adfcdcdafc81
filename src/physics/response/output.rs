//! Quantities of several points that are solved together.

use super::batch::Block;
use super::lane::{LANES, Lane};
use super::{Quantity, Rate};
use crate::drivetrain::Chain;

/// What a quantity is made of, in a block of points.
#[derive(Debug)]
pub(super) enum Output {
    /// Of a station.
    Angle(usize),
    /// Of a station.
    Motion(usize, Rate),
    /// Twists of links that follow each other.
    Row(std::ops::Range<usize>),
    /// Twists of links with their weights.
    Path(Vec<(usize, f64)>),
    /// Of a link.
    Torque(usize),
    /// Of an absorber.
    Ring(usize),
}

impl Output {
    /// Of a quantity.
    pub fn of(chain: &Chain, quantity: Quantity) -> Self {
        match quantity {
            Quantity::Twist { from, to: None } => Self::Angle(from),
            Quantity::Twist { from, to: Some(to) } if from < to && chain.is_row() => Self::Row(from..to),
            Quantity::Twist { from, to: Some(to) } => Self::Path(chain.path(from, to)),
            Quantity::ShaftTorque(s) => Self::Torque(s),
            Quantity::RingTwist(a) => Self::Ring(a),
            Quantity::Motion(station, rate) => Self::Motion(station, rate),
        }
    }

    /// At every point of a block that is solved.
    pub fn value(&self, chain: &Chain, block: &Block) -> Lane {
        match self {
            Self::Angle(station) => block.x[*station],
            Self::Row(links) => block.twist[links.clone()].iter().fold(Lane::ZERO, |sum, twist| sum.plus(twist)),
            Self::Path(path) => path.iter().fold(Lane::ZERO, |sum, (link, weight)| sum.plus(&block.twist[*link].times(*weight))),
            Self::Torque(s) => {
                let mut torque = block.twist[*s];
                (0..LANES).for_each(|l| torque.set(l, chain.shaft_stiffness(*s, block.omega[l]) * torque.get(l)));
                torque
            }
            Self::Ring(a) => block.ring[*a],
            Self::Motion(station, rate) => {
                let mut angle = block.x[*station];
                (0..LANES).for_each(|l| angle.set(l, rate.of(angle.get(l), block.omega[l])));
                angle
            }
        }
    }
}
