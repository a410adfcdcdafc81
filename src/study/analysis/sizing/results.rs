//! What sizing gives, and how it fails.

use crate::absorber::Mounted;
use crate::analysis::curves::Figure;
use crate::analysis::progress::RunError;
use crate::input::SizingStudy;
use crate::sizing::{Sized, SizingError};
use std::f64::consts::PI;

/// Largest relative change of a dimension, mass or inertia between the last two rounds.
pub(super) const TOLERANCE: f64 = 1e-6;

/// A crank that agrees with its chain.
#[derive(Debug, Clone, PartialEq)]
pub struct ByResponse {
    /// Rounds of sizing and response.
    pub rounds: usize,
    /// The absorber, where there is one.
    pub absorbers: Vec<Mounted>,
    /// Largest twist, rad.
    pub twist: f64,
    /// Largest vibratory torque in a shaft, N m.
    pub torque: f64,
    /// Lowest elastic natural frequency, Hz.
    pub frequency_hz: f64,
}

/// A crank with its absorber.
#[derive(Debug, Clone, PartialEq)]
pub struct FrontPoint {
    /// kg m²; zero without absorber.
    pub ring_inertia: f64,
    /// kg.
    pub crank_mass: f64,
    /// m.
    pub crankpin_diameter: f64,
    /// m.
    pub journal_diameter: f64,
    /// m.
    pub web_breadth: f64,
    /// m.
    pub seat_diameter: f64,
    /// Twist, torque and rounds.
    pub response: ByResponse,
}

/// What is written for `hartog run`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StudyFiles {
    /// `engine.toml`.
    pub engine: String,
    /// `study.toml`.
    pub study: String,
    /// `pressure.csv`, where the pressure is a table.
    pub pressure: Option<String>,
}

/// Everything that sizing gives.
#[derive(Debug, Clone, PartialEq)]
pub struct SizingResults {
    /// The slider-crank, of the last response where that sizes it.
    pub sized: Sized,
    /// How crank, chain and absorber came to agree, where the response sizes the crank.
    pub by_response: Option<ByResponse>,
    /// Crank mass against ring inertia.
    pub front: Vec<FrontPoint>,
    /// Engine file and study.
    pub files: StudyFiles,
    /// Forces and moments over the cycle.
    pub figures: Vec<Figure>,
}

/// Sizing that comes to no end.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SizeError {
    /// No dimensions.
    #[error(transparent)]
    Sizing(#[from] SizingError),
    /// No response of the chain.
    #[error(transparent)]
    Response(#[from] RunError),
    /// The study that follows from the sizes is one that `hartog run` would refuse.
    #[error("the sized crank makes no study for `hartog run`: {0}")]
    Chain(String),
    /// Crank and response do not settle.
    #[error(
        "crank and response of its chain still change by {change:.1e} in round {rounds}, expected {TOLERANCE:.0e}: a resonance, last at {speed_rpm:.0} rpm, comes and goes as the \
         crank gets thicker and thinner; take an absorber, more damping, another end of the speed range, or give the crankpin's diameter"
    )]
    NotConverged {
        /// Largest relative change of a dimension.
        change: f64,
        /// Rounds of sizing and response.
        rounds: usize,
        /// Where the torque was largest.
        speed_rpm: f64,
    },
}

/// Mass of the crank: all throws, and the shaft from the last bearing to the flywheel, kg.
pub fn crank_mass(study: &SizingStudy, sized: &Sized) -> f64 {
    let (spec, last) = (&study.specification, sized.last());
    let shaft = spec.density * PI / 4.0 * last.sizes.seat_diameter.powi(2) * spec.bearings.before_flywheel;
    spec.firing_deg.len() as f64 * last.throw.mass + shaft
}
