//! When the minimax method ends, and how much limits weigh against the objective until then.

use super::Rows;
use super::problem::PENALTY;

/// A decrease below this is none.
pub(super) const DECREASE: f64 = 1e-12;
/// Of a design that misses a limit nobody needs that many digits: decrease over what it costs at which its weight grows.
const DECREASE_MISSED: f64 = 1e-9;
/// No heavier weight helps where the first step with one promises to lessen by no more than this share what limits are missed by.
const LITTLE: f64 = 1e-3;
/// A limit that is missed by less than this holds.
pub(super) const HELD: f64 = 1e-8;
/// Where one is missed for the sake of the objective, its weight grows by this factor, up to that: a limit may cost more than the first weight is.
const HEAVIER: f64 = 10.0;
const HEAVIEST: f64 = 1e6;

/// Why the iteration ended.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum Stop {
    /// The model promises no decrease worth having.
    Converged,
    /// Limits are missed, and no step promises to miss them by less.
    OutOfReach,
    /// Steps became as small as rounding without reaching the decrease the model promised: the peaks are not smooth there.
    SmallSteps,
    /// The limit of iterations.
    Iterations,
    /// The quadratic model had no solution.
    NoModel,
    /// Nothing can vary.
    NothingFree,
}

impl Stop {
    /// In words.
    pub fn reason(self) -> &'static str {
        match self {
            Self::Converged => "converged: no step promises a decrease above 1e-12",
            Self::OutOfReach => "no step promises to miss the limits by less",
            Self::SmallSteps => "steps became too small to measure a decrease",
            Self::Iterations => "iteration limit",
            Self::NoModel => "the quadratic model could not be solved",
            Self::NothingFree => "nothing is free to vary",
        }
    }
}

/// What comes of what a step promises.
pub(super) enum Verdict {
    Try,
    /// Limits weigh more from now on.
    Heavier,
    Stop(Stop),
}

/// Weight of the worst excess over a limit, and that of the step before.
pub(super) struct Weight {
    pub now: f64,
    before: f64,
}

impl Weight {
    pub fn first() -> Self {
        Self { now: PENALTY, before: PENALTY }
    }

    /// Of a step from a point that costs `here`.
    pub fn verdict(&mut self, rows: &Rows, here: f64, promised: f64) -> Verdict {
        if rows.excess() <= HELD {
            return if promised < DECREASE { Verdict::Stop(Stop::Converged) } else { Verdict::Try };
        }
        let has_grown = self.now > self.before;
        self.before = self.now;
        if has_grown && promised < LITTLE * self.now * rows.excess() {
            return Verdict::Stop(Stop::OutOfReach);
        }
        if promised >= DECREASE_MISSED * here {
            return Verdict::Try;
        }
        if self.now >= HEAVIEST {
            return Verdict::Stop(Stop::OutOfReach);
        }
        self.now *= HEAVIER;
        Verdict::Heavier
    }
}
