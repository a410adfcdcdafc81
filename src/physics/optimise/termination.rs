//! When the minimax method ends, and how much limits weigh against the objective until then.

use super::Rows;
use super::problem::PENALTY;

/// A decrease below this is none.
pub(super) const DECREASE: f64 = 1e-12;
/// The same of a design that misses a limit, as a share of what it costs: such a design needs fewer digits.
const DECREASE_MISSED: f64 = 1e-9;
/// A step that lessens the excess over limits by no more than this share of it does not help to meet them.
const LITTLE: f64 = 1e-3;
/// A limit that is missed by less than this holds.
const HELD: f64 = 1e-8;
/// Where a limit is missed for the sake of the objective, its weight grows by this factor: a limit may cost more than the first weight is.
const HEAVIER: f64 = 10.0;
/// No weight grows beyond this.
const HEAVIEST: f64 = 1e6;

/// Why the iteration ended.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum Stop {
    /// The model promises no decrease worth having.
    Converged,
    /// Steps became as small as rounding without reaching the decrease the model promised: the peaks are not smooth there.
    SmallSteps,
    /// The limit of iterations.
    Iterations,
    /// The quadratic model had no solution.
    NoModel,
    /// Nothing can vary.
    NothingFree,
    /// Limits are missed, and no step promises to miss them by less.
    OutOfReach,
}

impl Stop {
    /// In words.
    pub fn reason(self) -> &'static str {
        match self {
            Self::Converged => "converged: no step promises a decrease above 1e-12",
            Self::SmallSteps => "steps became too small to measure a decrease",
            Self::Iterations => "iteration limit",
            Self::NoModel => "the quadratic model could not be solved",
            Self::NothingFree => "nothing is free to vary",
            Self::OutOfReach => "no step promises to miss the limits by less",
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

    /// What comes of a step that promises so much, from a point that costs `here`.
    pub fn verdict(&mut self, rows: &Rows, here: f64, promised: f64) -> Verdict {
        if rows.excess() <= HELD {
            return if promised < DECREASE { Verdict::Stop(Stop::Converged) } else { Verdict::Try };
        }
        let is_missed = !rows.hold();
        // the first step with a heavier weight tells whether that helps
        let has_grown = self.now > self.before;
        self.before = self.now;
        let helps_little = has_grown && is_missed && promised < LITTLE * self.now * rows.excess();
        if !helps_little && promised >= if is_missed { DECREASE_MISSED * here } else { DECREASE } {
            return Verdict::Try;
        }
        if self.now >= HEAVIEST {
            return Verdict::Stop(if is_missed { Stop::OutOfReach } else { Stop::Converged });
        }
        self.now *= HEAVIER;
        Verdict::Heavier
    }
}
