//! Multiaxial criteria on many points, a few hundred at a time.

use crate::fatigue::multiaxial::invariants::Invariants;
use crate::fatigue::multiaxial::{Criterion, Grid, Limits, Undefined, Verdict, evaluate};
use crate::input::tables::PointHistory;
use rayon::prelude::*;

/// Points evaluated at a time.
#[doc(hidden)]
pub const CHUNK: usize = 256;
/// Points kept for each criterion.
const WORST: usize = 5;
/// Points whose factors are drawn beside each other.
const FEW: usize = 100;

/// What the criteria say of a point.
#[derive(Debug, Clone)]
pub struct PointResult {
    /// Its name.
    pub name: String,
    /// One a criterion.
    pub verdicts: Vec<Verdict>,
    /// Of its history.
    pub invariants: Invariants,
}

impl PointResult {
    /// The smallest factor.
    pub fn smallest(&self) -> f64 {
        self.verdicts.iter().map(|v| v.safety_factor).fold(f64::INFINITY, f64::min)
    }
}

/// What is kept of all points: memory does not grow with their number.
#[derive(Debug, Clone, Default)]
#[doc(hidden)]
pub struct Summary {
    /// How many there were.
    pub points: usize,
    /// For each criterion the points with the smallest factors, smallest first.
    pub worst: Vec<Vec<(String, Verdict)>>,
    /// The point asked for; `None` for the one with the smallest factor.
    pub asked: Option<String>,
    /// The point asked for, or that with the smallest factor by any criterion, with its history.
    pub critical: Option<(PointHistory, PointResult)>,
    /// Every point with its factors, as long as there are no more than `FEW`.
    pub few: Vec<PointResult>,
}

/// Evaluates some points, in parallel; in their order.
///
/// # Errors
/// [`Undefined`] where the limits leave no constant for a criterion.
pub fn points(points: &[PointHistory], limits: &Limits, grid: Grid) -> Result<Vec<PointResult>, Undefined> {
    let one = |p: &PointHistory| {
        let (verdicts, invariants) = evaluate(&p.history, limits, &Criterion::ALL, grid)?;
        Ok(PointResult { name: p.name.clone(), verdicts, invariants })
    };
    points.par_iter().map(one).collect()
}

impl Summary {
    /// Takes a point into account.
    pub fn take(&mut self, point: &PointHistory, result: &PointResult) {
        self.points += 1;
        self.worst.resize(result.verdicts.len(), Vec::new());
        for (list, verdict) in self.worst.iter_mut().zip(&result.verdicts) {
            let place = list.partition_point(|w| w.1.safety_factor <= verdict.safety_factor);
            if place < WORST {
                list.insert(place, (result.name.clone(), verdict.clone()));
                list.truncate(WORST);
            }
        }
        let shown = match &self.asked {
            Some(name) => *name == point.name,
            None => self.critical.as_ref().is_none_or(|c| result.smallest() < c.1.smallest()),
        };
        if shown {
            self.critical = Some((point.clone(), result.clone()));
        }
        if self.points <= FEW {
            self.few.push(result.clone());
        } else {
            self.few.clear();
        }
    }
}
