//! A web cut in its middle: what it carries there, by the motion of its nodes.
//!
//! Moments and forces are what the elements of the web on both sides of the cut exert by their stiffness, the mean of both: they differ by the inertia of a quarter web.

use super::row::Join;
use crate::numerics::C64;
use crate::rotor::beam::Beam;
use crate::rotor::shaft::{Answer, Dissipation, Six};
use nalgebra::{SVector, Vector3};

/// A load of a web in its middle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WebLoad {
    /// Moment in the plane of the throw, N m, positive as of a pin pressed towards the axis.
    Moment,
    /// Moment about the direction of the web, N m: its twist, and the bending of the crank across the plane of the throw.
    Across,
    /// Force along the web, N, of the part before it towards the pin.
    Shear,
    /// Moment about the direction of the axis, N m: bending of the web edgewise.
    Edgewise,
}

impl WebLoad {
    /// All of them, as their answers stand.
    pub const ALL: [Self; 4] = [Self::Moment, Self::Across, Self::Shear, Self::Edgewise];

    /// What of force and moment on the part before the cut it is; `outwards` and `tangential`: of the throw.
    fn of([outwards, tangential]: &[Vector3<f64>; 2], load: Self) -> Six {
        let (force, moment) = match load {
            Self::Moment => (Vector3::zeros(), *tangential),
            Self::Across => (Vector3::zeros(), -outwards),
            Self::Shear => (-outwards, Vector3::zeros()),
            Self::Edgewise => (Vector3::zeros(), Vector3::z()),
        };
        Six::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
    }
}

/// A web cut in its middle.
#[derive(Debug, Clone, PartialEq)]
pub struct WebSection {
    /// Of each load, but for what its material dissipates.
    pub(crate) answers: [Answer; 4],
    pub(crate) dissipation: Dissipation,
}

impl WebSection {
    /// Of the two joins of a web, the first from node `first`.
    pub(super) fn new(first: usize, joins: &[Join], directions: &[Vector3<f64>; 2]) -> Self {
        let beam = |i: usize| match &joins[i] {
            Join::Beam(beam, dissipation) => (beam, *dissipation),
            Join::Torsion(..) => unreachable!("a web is of beams"),
        };
        let ((before, dissipation), (behind, _)) = (beam(0), beam(1));
        let half = |beam: &Beam, end: usize, part: &Six| -> SVector<f64, 12> { beam.through_ends()[end].transpose() * part * 0.5 };
        let answer = |load: WebLoad| -> Answer {
            let part = WebLoad::of(directions, load);
            let sides = [(first, half(before, 1, &part)), (first + 1, half(behind, 0, &part))];
            let terms_of = |(node, factors): &(usize, SVector<f64, 12>)| {
                let node = *node;
                factors.iter().enumerate().map(move |(k, factor)| (node + k / 6, k % 6, *factor)).collect::<Vec<_>>()
            };
            sides.iter().flat_map(terms_of).filter(|(_, _, factor)| *factor != 0.0).collect()
        };
        Self { answers: WebLoad::ALL.map(answer), dissipation }
    }

    /// A load by the motion of all nodes at a frequency.
    #[doc(hidden)]
    pub fn load(&self, load: WebLoad, motion: &nalgebra::DVector<C64>, omega: f64) -> C64 {
        let answer = &self.answers[load as usize];
        answer.iter().map(|(node, k, factor)| motion[6 * node + k] * *factor).sum::<C64>() * self.dissipation.factor(omega)
    }
}
