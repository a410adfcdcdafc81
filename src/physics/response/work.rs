//! Work done, counted.

use super::error::ResponseError;

/// Work done, counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub struct Work {
    /// Evaluations of a whole design.
    pub evaluations: u64,
    /// Those of them that tables alone answered.
    pub surrogate_evaluations: u64,
    /// Evaluations that found no finite response, for want of damping at a resonance.
    pub unbounded_evaluations: u64,
    /// Tridiagonal systems factored, one an order and speed.
    pub direct_solves: u64,
    /// Points (order and speed) answered by receptance.
    pub receptance_points: u64,
    /// Points where receptance was near a singular base and the direct solve took over.
    pub singular_points: u64,
    /// Sums of orders with phase.
    pub syntheses: u64,
    /// Responses of a few modes, one an order and speed.
    pub modal_solves: u64,
    /// Eigenproblems of chain and rings.
    pub eigenproblems: u64,
    /// Marches along the chain, one an order and speed.
    pub marches: u64,
    /// Dense systems solved, one an order and speed.
    pub dense_solves: u64,
    /// Steps in time.
    pub time_steps: u64,
    /// Steps of Newton's method on harmonic balances.
    pub harmonic_balances: u64,
}

impl std::ops::AddAssign for Work {
    fn add_assign(&mut self, w: Self) {
        self.evaluations += w.evaluations;
        self.surrogate_evaluations += w.surrogate_evaluations;
        self.unbounded_evaluations += w.unbounded_evaluations;
        self.direct_solves += w.direct_solves;
        self.receptance_points += w.receptance_points;
        self.singular_points += w.singular_points;
        self.syntheses += w.syntheses;
        self.modal_solves += w.modal_solves;
        self.eigenproblems += w.eigenproblems;
        self.marches += w.marches;
        self.dense_solves += w.dense_solves;
        self.time_steps += w.time_steps;
        self.harmonic_balances += w.harmonic_balances;
    }
}

impl Work {
    /// Counts an evaluation that found no finite response.
    #[doc(hidden)]
    pub fn noted<T>(&mut self, found: Result<T, ResponseError>) -> Result<T, ResponseError> {
        self.unbounded_evaluations += u64::from(found.is_err());
        found
    }
}
