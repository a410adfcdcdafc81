//! Published tables against our own numbers, each with its role: given to the model, fitted, predicted, a misprint, or without explanation; and the
//! formulas that only their sources use. Proofs of optima against dense solutions.

mod absorbers;
mod amplitudes;
mod chain;
mod choices;
mod claims;
pub mod comparison;
pub mod entry;
mod fatigue;
mod frequencies;
mod modes;
mod multiaxial;
mod notches;
mod planes;
mod predicted;
pub mod proof;
pub mod rounds;
mod text_values;
mod uncertainty;
pub mod verdict;
mod von_mises;
pub mod worked_examples;

pub use amplitudes::AmplitudeRow;
pub use choices::{Agreement, Choices, Chosen, Placed, Ranking};
pub use comparison::{Comparison, compare};
pub use entry::{Entry, Kind, Role, Uncertainty};
pub use notches::{Inverse, inverse};
pub use verdict::{Check, Ranked, Spread, Verdict};
