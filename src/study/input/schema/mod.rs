//! Files as typed: keys, units and choices, nothing checked but grammar and type.

pub mod absorber;
pub mod bounds;
pub mod campaign;
pub mod catalogue;
pub mod crank;
pub mod engine;
pub mod fatigue;
pub mod flexible;
pub mod json;
mod keyword;
pub mod material;
pub mod material_states;
pub mod measure;
pub mod measure_of_construction;
pub mod prove;
pub mod published;
pub mod range;
pub mod robust;
pub mod sizing;
pub mod step;
pub mod study;
pub mod substance;
