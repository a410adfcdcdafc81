//! Journals and pins cut where they meet their webs: what each carries there, by the motion of its nodes.
//!
//! Force and moment are what the round element beside the web exerts by its stiffness on its node at the face of the web, exact for an element that nothing loads between its ends but its own inertia.

use super::row::{Join, Row};
use crate::rotor::shaft::{Answer, Dissipation};
use nalgebra::{SVector, Vector3};

/// Where a throw is cut, from its front.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cut {
    /// Of the journal before the front web.
    JournalFront,
    /// Of the pin behind the front web.
    PinFront,
    /// Of the pin before the rear web.
    PinRear,
    /// Of the journal behind the rear web.
    JournalRear,
}

impl Cut {
    /// All of them, as sections of a throw stand.
    pub const ALL: [Self; 4] = [Self::JournalFront, Self::PinFront, Self::PinRear, Self::JournalRear];
}

/// What the part behind a cut exerts on the part before it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SectionLoad {
    /// Force outwards along the throw, N.
    Outwards,
    /// Force across it in the direction of rotation, N.
    Tangential,
    /// Force along the axis, N.
    Axial,
    /// Moment about the outward direction, N m: bends across the plane of the throw.
    AboutOutwards,
    /// Moment about the tangential direction, N m: bends in the plane of the throw.
    AboutTangential,
    /// Torque, N m.
    Torque,
}

impl SectionLoad {
    /// All of them, as their answers stand.
    pub const ALL: [Self; 6] = [Self::Outwards, Self::Tangential, Self::Axial, Self::AboutOutwards, Self::AboutTangential, Self::Torque];

    /// Its column among those of all sections ([`super::WebLoads::of_rounds`]).
    pub fn column(self, throw: usize, cut: Cut) -> usize {
        (throw * Cut::ALL.len() + cut as usize) * Self::ALL.len() + self as usize
    }
}

/// A journal or a pin cut at the face of a web.
#[derive(Debug, Clone, PartialEq)]
pub struct RoundSection {
    /// Of each load, but for what its material dissipates.
    pub(crate) answers: [Answer; 6],
    pub(crate) dissipation: Dissipation,
}

impl RoundSection {
    /// Cut at an end of the element behind node `first`.
    fn new(row: &Row, (first, end): (usize, usize), [outwards, tangential]: &[Vector3<f64>; 2]) -> Self {
        let Join::Beam(beam, dissipation) = &row.joins[first] else { unreachable!("journals and pins are of beams") };
        let through = beam.through_ends()[end];
        let answer = |load: SectionLoad| -> Answer {
            let direction = match load {
                SectionLoad::Outwards | SectionLoad::AboutOutwards => *outwards,
                SectionLoad::Tangential | SectionLoad::AboutTangential => *tangential,
                SectionLoad::Axial | SectionLoad::Torque => Vector3::z(),
            };
            let part = match load {
                SectionLoad::Outwards | SectionLoad::Tangential | SectionLoad::Axial => 0,
                SectionLoad::AboutOutwards | SectionLoad::AboutTangential | SectionLoad::Torque => 3,
            };
            let factors: SVector<f64, 12> = through.fixed_rows::<3>(part).transpose() * direction;
            let term = |(k, factor): (usize, &f64)| (first + k / 6, k % 6, *factor);
            factors.iter().enumerate().map(term).filter(|(_, _, factor)| *factor != 0.0).collect()
        };
        Self { answers: SectionLoad::ALL.map(answer), dissipation: *dissipation }
    }
}

/// Journals and pin of a throw cut at the faces of its webs, whose nodes on the axis are given: a web has three nodes, the half of a journal or pin in it is an element of its own.
pub(super) fn round_sections(row: &Row, [front, rear]: [usize; 2], directions: &[Vector3<f64>; 2]) -> [RoundSection; 4] {
    [(front - 2, 1), (front + 3, 0), (rear - 4, 1), (rear + 1, 0)].map(|at| RoundSection::new(row, at, directions))
}
