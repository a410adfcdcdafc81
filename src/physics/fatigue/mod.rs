//! Fatigue: from stresses to safety factors. Knows nothing of engines or chains.

pub mod class_rules;
pub mod endurance;
pub mod mean_stress;
pub mod multiaxial;
#[doc(hidden)]
pub mod shaft_rules;

pub use class_rules::ClassRule;
pub use mean_stress::{Criterion, Cycle, Strength};
