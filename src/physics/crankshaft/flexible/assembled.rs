//! A crank put together, whatever it is made of.

use super::round_section::RoundSection;
use super::web_section::WebSection;
use crate::drivetrain::{Chain, Station};
use crate::rotor::shaft::{Answer, Dissipation, Shaft};
use crate::rotor::structure::Unknown;
use nalgebra::Vector3;
use std::ops::Range;

/// What a throw weighs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Balance {
    /// Of pin, webs and journals about the axis as drawn, and of what is on the pin, kg m².
    pub steel: f64,
    /// kg m².
    pub on_pin: f64,
    /// Of its station, kg m².
    pub station: f64,
    /// Both counterweights, kg; zero without.
    pub counterweight: f64,
    /// Factor on the density of its steel.
    pub density: f64,
    /// Moment of counterweights that its station leaves no inertia for, kg m; zero where they are there.
    pub left_out: f64,
}

/// A crank put together.
#[derive(Debug, Clone, PartialEq)]
pub struct Assembled {
    /// Nodes, beams, bodies, bearings.
    pub shaft: Shaft,
    /// Node of each station of the chain.
    pub stations: Vec<usize>,
    /// Of each shaft length of the chain: a twist of it, its stiffness against that, N m/rad, and how that dissipates.
    pub shafts: Vec<(Answer, f64, Dissipation)>,
    /// Nodes of the rods of each throw.
    pub rods: Vec<Vec<usize>>,
    /// Both webs on the axis, of each throw; none of a crank by matrices, whose webs are not known.
    pub webs: Vec<[usize; 2]>,
    /// Both webs cut in their middle, of each throw; none as of `webs`.
    pub sections: Vec<[WebSection; 2]>,
    /// Journals and pin cut at the faces of the webs, of each throw; none as of `webs`.
    pub rounds: Vec<[RoundSection; 4]>,
    /// Outwards and in the direction of rotation, of each throw.
    pub directions: Vec<[Vector3<f64>; 2]>,
    /// Points of all main journals.
    pub journals: Vec<Vec<usize>>,
    /// Those of the main bearings that are there.
    pub bearings: Vec<Vec<usize>>,
    /// Stations of the throws.
    pub throws: Range<usize>,
    /// Of each throw; none as of `webs`.
    pub balance: Vec<Balance>,
    /// Unknowns of matrices as their files have them, by those of the shaft; none of a crank of beams.
    pub written: Vec<(Unknown, Answer)>,
    /// kg, with all that is on it.
    pub mass: f64,
}

/// What is on a crank.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[doc(hidden)]
pub enum Carried {
    /// Rods, hub, flywheel and bearings: as it runs.
    All,
    /// Hub and flywheel, nothing else: free at both ends.
    Ends,
    /// Nothing.
    Nothing,
}

/// Station before the first throw and behind the last, where the chain has them; why it is no crank between them otherwise.
pub(super) fn ends(chain: &Chain, throws: usize) -> Result<Range<usize>, String> {
    if !chain.is_row() {
        return Err("the chain is a tree or has gears: a flexible crank wants stations in a row".to_owned());
    }
    let first = chain.stations.iter().position(|s| !s.throws.is_empty()).unwrap_or(0);
    let in_order = |t: usize| chain.stations.get(first + t).is_some_and(|s| s.throws == [t]);
    match (0..throws).find(|t| !in_order(*t)) {
        Some(t) => Err(format!("throw {} has no station of its own behind that of the one before it", t + 1)),
        None => Ok(first..first + throws),
    }
}

/// How a shaft of the chain dissipates by itself.
pub(super) fn dissipation(s: &Station) -> Dissipation {
    let time = if s.stiffness_to_next > 0.0 { s.damping_to_next / s.stiffness_to_next } else { 0.0 };
    Dissipation { loss_factor: s.loss_factor_to_next, time }
}
