//! hartog held against published tables, and against itself: speed and accuracy of its methods.

#![deny(missing_docs)]

pub mod benchmark;
pub mod validation;

use hartog_physics::{absorber, crankshaft, drivetrain, engine, fatigue, numerics, objective, optimise, response, rotor, sizing, units};
use hartog_study::{analysis, input};
