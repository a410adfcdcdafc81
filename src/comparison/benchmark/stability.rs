//! Where methods fail: every method on every scenario, with the outcome each pair declares.
//!
//! The reference is the dense LU of the whole system, or a solution in closed form. The same limits hold for every pair: right within a thousandth (closer where a method is
//! exact), rough within a tenth, wrong beyond. What a pair comes to must be what is declared of it; anything else is a defect.

use super::methods::Candidate;
use crate::absorber::Mounted;
use crate::drivetrain::System;
use crate::numerics::C64;
use crate::response::{Dense, Grid, Quantity, Response, ResponseError, Work};

/// What a method is declared to make of a scenario; errors are the largest difference over the largest value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outcome {
    /// Within this error, at most `RIGHT`.
    Right(f64),
    /// Between `RIGHT` and `ROUGH`.
    Rough,
    /// An error that says this.
    Refused(&'static str),
    /// Off by at least this, at least `ROUGH`, and known to be.
    Wrong(f64),
}
use Outcome::{Refused, Right, Rough, Wrong};

/// Largest error of a right answer: the default tolerance of a study.
pub(crate) const RIGHT: f64 = 1e-3;
/// Largest error of a rough one.
pub(crate) const ROUGH: f64 = 0.1;

/// A system with a known solution.
#[derive(Debug, Clone)]
pub struct Scenario {
    /// In a few words.
    pub name: &'static str,
    /// Chain and torque.
    pub system: System,
    /// Absorbers.
    pub design: Vec<Mounted>,
    /// A twist.
    pub quantity: Quantity,
    /// rpm.
    pub speeds: Vec<f64>,
    /// Phasors speed by speed, where they are known without a solution; else the dense LU is the reference.
    pub known: Option<Vec<C64>>,
    /// Declared for the methods in frequency of [`Candidate::ALL`], but the reference.
    pub declared: [Outcome; 8],
    /// Declared for those in time: average and linear acceleration, central difference, exponential.
    pub in_time: [Outcome; 4],
}

/// What a method made of a scenario.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// The method.
    pub candidate: Candidate,
    /// As declared.
    pub declared: Outcome,
    /// Error found, or the refusal.
    pub found: Result<f64, ResponseError>,
}

impl Cell {
    /// What it came to, whatever was declared: right, rough, wrong or refused.
    pub fn word(&self) -> &'static str {
        match &self.found {
            Err(_) => "refused",
            Ok(e) if *e <= RIGHT => "right",
            Ok(e) if *e <= ROUGH => "rough",
            Ok(_) => "wrong",
        }
    }

    /// Whether it came as declared.
    #[doc(hidden)]
    pub fn as_declared(&self) -> bool {
        match (&self.declared, &self.found) {
            (Right(tolerance), Ok(e)) => *e <= tolerance.min(RIGHT),
            (Rough, Ok(_)) => self.word() == "rough",
            (Wrong(least), Ok(e)) => *e >= least.max(ROUGH),
            (Refused(words), Err(e)) => e.to_string().contains(words),
            _ => false,
        }
    }
}

impl Scenario {
    /// Every method on it.
    pub fn cells(&self) -> Vec<Cell> {
        let grid = Grid::new(&self.speeds, &[]);
        let mut exact = Vec::new();
        let reference = match &self.known {
            Some(known) => {
                exact.clone_from(known);
                Ok(())
            }
            None => Dense::new(&self.system, &grid).sweep(&self.design, self.quantity, &mut exact, &mut Work::default()),
        };
        let largest = exact.iter().map(|y| y.norm()).fold(0.0, f64::max);
        let error = |candidate: Candidate| -> Result<f64, ResponseError> {
            let Some(method) = candidate.build(&self.system, &grid, &self.design, self.quantity) else {
                return Err(ResponseError::NotApplicable { method: candidate.method(), why: "there is no elastic mode" });
            };
            let mut found = Vec::new();
            method.sweep(&self.design, self.quantity, &mut found, &mut Work::default())?;
            reference?;
            let difference = found.iter().zip(&exact).map(|(a, b)| (a - b).norm());
            // the largest that is not a number is not a number
            Ok(difference.fold(0.0, |m: f64, d| if d > m || d.is_nan() { d } else { m }) / largest)
        };
        let pairs = Candidate::ALL.into_iter().zip(self.declared.into_iter().chain(self.in_time));
        pairs.map(|(candidate, declared)| Cell { candidate, declared, found: error(candidate) }).collect()
    }
}
