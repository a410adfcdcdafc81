//! Limits that an optimum holds beside a jump of their measure, as where a balance of heat is lost.

use super::OptimumResult;
use super::sensitivities::Sensitivity;
use crate::input::LimitSpec;
use crate::objective::holds;

/// A change of a parameter that breaks a limit which is not used up.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(hidden)]
pub struct Jump {
    /// Index of the absorber.
    pub absorber: usize,
    /// Index of the parameter in its declaration.
    pub parameter: usize,
    /// Relative.
    pub change: f64,
}

/// A limit of which less than this share is left breaks at any drift.
const LEAST_LEFT: f64 = 0.01;
/// Relative change of a parameter over what is left of a limit, below which no steady rise breaks it: assumption, measures rise with the twentieth power of a parameter at most.
const STEADY: f64 = 0.05;

impl OptimumResult {
    /// The least change of a parameter at which a limit breaks (`ratio`: of the measure to it), where that is so small that the measure jumps there, as where a balance of heat is lost. `None` of a design that is held
    /// within tolerances: its drifts are from their edges, `ratio` is of what is drawn.
    #[doc(hidden)]
    pub fn jump(&self, limit: &LimitSpec, ratio: f64) -> Option<Jump> {
        if self.load_cases.iter().any(|case| case.deviation.is_some()) {
            return None;
        }
        let left = 1.0 - ratio;
        let own = self.sensitivities.iter().filter(|s| s.limited && s.key == limit.of.key && s.place == limit.of.place);
        let jump = |s: &Sensitivity, change: f64| Jump { absorber: s.absorber, parameter: s.parameter, change };
        let both = own.flat_map(|s| [s.drift.0.map(|d| jump(s, d)), s.drift.1.map(|d| jump(s, -d))]).flatten();
        let least = both.min_by(|a, b| a.change.abs().total_cmp(&b.change.abs()))?;
        (holds(ratio) && left > LEAST_LEFT && least.change.abs() < STEADY * left).then_some(least)
    }
}
