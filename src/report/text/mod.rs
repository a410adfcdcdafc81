//! What is printed: tables that line up, and sentences.
pub mod calibration;
pub mod chart;
pub mod check;
pub mod comparison;
pub mod crank;
pub mod fatigue;
pub mod margin;
mod run;
mod table;
pub(crate) use run::summary;
pub use run::{choice, conditions, designs, optimum};
pub use table::table;
