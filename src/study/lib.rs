//! Studies of hartog: their files, and what is computed of them.

#![deny(missing_docs)]

pub mod analysis;
pub mod input;

use hartog_physics::{absorber, crankshaft, drivetrain, engine, fatigue, numerics, objective, optimise, response, rotor, sizing, units};

pub use analysis::{Error, Results, RunError};
pub use input::{InputError, PartsError, Study};
