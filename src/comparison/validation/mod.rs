//! Published tables against our own numbers, each with its role: given to the model, fitted, predicted, a misprint, or without explanation; and the
//! formulas that only their sources use.

mod absorbers;
mod amplitudes;
mod chain;
pub mod comparison;
pub mod entry;
mod fatigue;
pub mod fixed_points;
mod frequencies;
mod modes;
mod multiaxial;
mod notches;
mod predicted;
pub mod rounds;
mod text_values;
pub mod torsion_cases;
pub mod verdict;
mod von_mises;

pub use amplitudes::AmplitudeRow;
pub use comparison::{Comparison, compare};
pub use entry::{Entry, Kind, Role};
pub use notches::{Inverse, inverse};
pub use verdict::{Check, Ranked, Spread, Verdict};
