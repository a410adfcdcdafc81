//! What `hartog chart` measures: speed against accuracy of every method, growth of cost, energy balance, stability, and what simpler models cost.

pub mod chart;
pub mod crank_ladder;
pub mod energy;
pub mod evolution;
pub mod growth;
mod law_scenarios;
pub mod laws;
pub mod margin_methods;
pub mod methods;
pub mod model_accuracy;
pub mod proofs;
pub mod savings;
mod scenario_parts;
pub mod scenarios;
pub mod smaller_models;
pub mod speed_accuracy;
pub mod stability;

pub use chart::{Chart, Common};
