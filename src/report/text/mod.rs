//! What is printed: tables that line up, and sentences.
pub mod calibration;
pub mod chart;
pub mod check;
pub mod comparison;
pub mod crank;
mod curves;
pub mod fatigue;
pub mod margin;
mod model;
mod run;
mod sizing;
mod table;
pub use curves::curves;
pub(crate) use model::{crank_pressure, duty, reciprocating};
pub(crate) use run::summary;
pub use run::{choice, conditions, designs, optimum};
pub(crate) use sizing::{rounds, sizing};
pub use table::table;
