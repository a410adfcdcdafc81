//! The method of a study.

use super::direct::Direct;
use super::error::ResponseError;
use super::grid::Grid;
use super::joint::JointReceptance;
use super::method::Response;
use super::quantity::Quantity;
use super::receptance::Receptance;
use super::work::Work;
use crate::absorber::Mounted;
use crate::drivetrain::System;
use crate::numerics::C64;

/// The method of a study.
#[derive(Debug)]
pub enum Method<'a> {
    /// Solve the whole system at every point.
    Direct(Direct<'a>),
    /// Solve the base once, add the absorber as a rank-one change.
    Receptance(Receptance<'a>),
    /// The same for several absorbers, as a change of their number in rank.
    Joint(JointReceptance<'a>),
}

impl Method<'_> {
    /// Solves spent on tables.
    #[doc(hidden)]
    pub fn setup(&self) -> Work {
        match self {
            Self::Direct(_) => Work::default(),
            Self::Receptance(m) => m.setup,
            Self::Joint(m) => m.setup,
        }
    }
}

impl Response for Method<'_> {
    fn name(&self) -> &'static str {
        match self {
            Self::Direct(m) => m.name(),
            Self::Receptance(m) => m.name(),
            Self::Joint(m) => m.name(),
        }
    }
    fn grid(&self) -> &Grid {
        match self {
            Self::Direct(m) => m.grid(),
            Self::Receptance(m) => m.grid(),
            Self::Joint(m) => m.grid(),
        }
    }
    fn system(&self) -> &System {
        match self {
            Self::Direct(m) => m.system(),
            Self::Receptance(m) => m.system(),
            Self::Joint(m) => m.system(),
        }
    }
    fn phasor(&self, design: &[Mounted], quantity: Quantity, at: (usize, f64), work: &mut Work) -> Result<C64, ResponseError> {
        match self {
            Self::Direct(m) => m.phasor(design, quantity, at, work),
            Self::Receptance(m) => m.phasor(design, quantity, at, work),
            Self::Joint(m) => m.phasor(design, quantity, at, work),
        }
    }
    fn sweep(&self, design: &[Mounted], quantity: Quantity, out: &mut Vec<C64>, work: &mut Work) -> Result<(), ResponseError> {
        match self {
            Self::Direct(m) => m.sweep(design, quantity, out, work),
            Self::Receptance(m) => m.sweep(design, quantity, out, work),
            Self::Joint(m) => m.sweep(design, quantity, out, work),
        }
    }
    fn sweep_each(&self, design: &[Mounted], quantities: &[Quantity], work: &mut Work) -> Result<Vec<Vec<C64>>, ResponseError> {
        match self {
            Self::Direct(m) => m.sweep_each(design, quantities, work),
            Self::Receptance(m) => m.sweep_each(design, quantities, work),
            Self::Joint(m) => m.sweep_each(design, quantities, work),
        }
    }
    fn squares(&self, design: &[Mounted], quantity: Quantity, out: &mut Vec<f64>, work: &mut Work) -> Result<(), ResponseError> {
        match self {
            Self::Direct(m) => m.squares(design, quantity, out, work),
            Self::Receptance(m) => m.squares(design, quantity, out, work),
            Self::Joint(m) => m.squares(design, quantity, out, work),
        }
    }
}
