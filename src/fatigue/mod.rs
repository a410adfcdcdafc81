//! Fatigue: from stresses to safety factors. Knows nothing of engines or chains.

pub mod mean_stress;

pub use mean_stress::{Criterion, Cycle, Strength};
