//! A proof of an optimum: no design within the bounds is better by more than a gap.
//!
//! The box of the free parameters is cut into smaller ones until each is excluded. At one speed an output is a Möbius function of the dynamic stiffness of the ring, so a first-order Taylor model of
//! each order's phasor over a box is known with its rest; a measure at that speed is at least a linear function of the parameters over the box, and no less than that over all speeds. A box goes where
//! such a function, or a convex combination of several (of other speeds, limits and conditions), is nowhere below what the optimum is to be better than. Half the range of a sum of orders is at least half
//! the difference of its values at two angles; it is at least pi/4 of a single order's amplitude, not that amplitude.
//!
//! Speeds come as they are needed: where the middle of a box looks better than the optimum at all speeds so far, its true peaks are found, and their speeds join; where it is better, the search goes
//! on from there. A bound over some speeds, and without what has no enclosure, is a bound over all.

mod asked;
mod boxes;
mod form;

use super::minimax;
use super::search::is_lower;
use super::{Optimum, Problem};
use crate::response::Work;
use boxes::prove;

/// What a proof may cost, and how close it is to come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// Share of the optimum below which no design is to be proved to lie.
    pub gap: f64,
    /// Boxes, at most.
    pub boxes: u64,
}

/// A box of designs: free parameters with their values, as keys and ranges.
pub type Ranges = Vec<(&'static str, f64, f64)>;

/// What was proved of an optimum.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Proof {
    /// No design within the bounds (that holds all limits) is below it, in the unit of the objective; `None` where no design holds all limits, or nothing is proved.
    pub lower_bound: Option<f64>,
    /// Boxes that were looked at.
    pub boxes: u64,
    /// Better designs that were found in them, each of which led to a better optimum.
    pub better: usize,
    /// What came of it.
    pub verdict: Verdict,
}

/// How a proof ends.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// No design is below the optimum by more than the gap.
    Proved,
    /// No design holds all limits.
    Impossible,
    /// The boxes did not suffice, or what the rest is worse by has no enclosure; the box that says least.
    Open(Ranges),
    /// There is none.
    None(Reason),
}

impl Verdict {
    /// The word used in tables.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Proved => "proved",
            Self::Impossible => "impossible",
            Self::Open(_) => "open",
            Self::None(_) => "none",
        }
    }
}

/// Why there is no proof.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Reason {
    /// Objectives are added up.
    Sum,
    /// The objective has no enclosure.
    Objective,
    /// The law of a type has none.
    Law,
    /// More parameters are free than models have variables.
    Parameters,
    /// Absorbers on rings.
    Absorbers,
    /// Tolerances.
    Tolerances,
    /// A better design is known, but the search does not go on from there.
    Unfinished,
    /// Nothing may vary.
    NothingFree,
}

impl Reason {
    /// In words, after "not proved: ".
    pub fn words(self) -> &'static str {
        match self {
            Self::Sum => "the objective is a sum",
            Self::Objective => "the objective has no enclosure",
            Self::Law => "the type of absorber has no enclosure",
            Self::Parameters => "more than six parameters are free",
            Self::Absorbers => "an absorber sits on a ring",
            Self::Tolerances => "within tolerances",
            Self::Unfinished => "a better design is known, from which the search does not go on",
            Self::NothingFree => "nothing is free",
        }
    }
}

/// A proof, or a point of the box whose design is better than the optimum.
enum Found {
    Proof(Proof),
    Better(Vec<f64>),
}

/// Better optima that a proof leads to, at most.
const MOST_BETTER: usize = 10;

/// Proves that no design within the bounds is below an optimum by more than the gap; where one is better, the search goes on from there, and the better optimum is proved. Of an optimum that breaks a limit it proves that no
/// design holds all of them, or finds one that does.
#[doc(hidden)]
pub fn settle(problem: &Problem, optimum: &mut Optimum, effort: Effort) -> Proof {
    let mut boxes = 0;
    for better in 0..=MOST_BETTER {
        let mut work = Work::default();
        let found = prove(problem, optimum, effort, &mut boxes, &mut work);
        optimum.stages.search += work;
        let point = match found {
            Found::Proof(proof) => return Proof { boxes, better, ..proof },
            Found::Better(point) => point,
        };
        match minimax::minimise(problem, &point, &mut optimum.stages.minimax) {
            Ok(outcome) if is_lower(&outcome, &optimum.outcome) => optimum.replace(problem, outcome),
            _ => return Proof { lower_bound: None, boxes, better, verdict: Verdict::None(Reason::Unfinished) },
        }
    }
    Proof { lower_bound: None, boxes, better: MOST_BETTER, verdict: Verdict::None(Reason::Unfinished) }
}

impl Proof {
    /// There is none, for a reason.
    #[doc(hidden)]
    pub fn none(reason: Reason) -> Self {
        Self { lower_bound: None, boxes: 0, better: 0, verdict: Verdict::None(reason) }
    }
}
