//! What is printed: tables that line up, and sentences.
mod answer;
mod buildability;
pub mod calibration;
mod catalogue;
mod certificate;
pub mod chart;
pub mod check;
mod check_in_brief;
mod classification;
pub mod comparison;
pub mod crank;
mod curves;
mod designs;
pub mod fatigue;
mod fit_law;
mod flexible;
pub(crate) mod judged;
pub mod keys;
mod large_twist;
mod life;
mod limits;
pub mod margin;
mod materials;
mod model;
mod plausibility;
mod robust;
mod run;
mod sizing;
mod strain;
mod table;
pub(crate) mod verdict;
mod whole;
pub mod width;
pub(crate) use answer::answer;
pub(crate) use buildability::bounds;
pub(crate) use catalogue::catalogue;
pub(crate) use check_in_brief::check_in_brief;
pub(crate) use classification::criticals;
pub use curves::curves;
pub use designs::designs;
pub(crate) use fit_law::fit_law;
pub(crate) use flexible::crank_models;
pub(crate) use large_twist::large_twist;
pub(crate) use life::life;
pub(crate) use materials::{heat, made_of, simplest};
pub(crate) use model::{crank_pressure, duty, reciprocating};
pub(crate) use plausibility::{implausible, placeholders};
pub(crate) use robust::{robust, tolerances};
pub(crate) use run::choices;
pub(crate) use run::summary;
pub use run::{conditions, optimum};
pub(crate) use sizing::{brief as sizing_in_brief, rounds, rounds_in_brief, sizing};
pub(crate) use strain::strain;
pub(crate) use table::dash;
pub use table::table;
pub(crate) use whole::{notes, whole};

/// A value with four significant digits.
pub(crate) fn short(x: f64) -> String {
    if x.is_finite() { table::significant(x, 4) } else { "unbounded".into() }
}
