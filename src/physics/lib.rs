//! The physics of hartog and its optimiser: what is computed, from plain values; no file, no text.

#![deny(missing_docs)]

pub mod absorber;
pub mod crankshaft;
pub mod drivetrain;
pub mod engine;
pub mod fatigue;
pub mod numerics;
pub mod objective;
pub mod optimise;
pub mod response;
pub mod rotor;
pub mod sizing;
pub mod units;
