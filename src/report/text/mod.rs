//! What is printed: tables that line up, and sentences.
pub(crate) mod allocation;
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
pub(crate) mod limits;
pub mod margin;
mod materials;
mod model;
pub(crate) mod order_sheets;
mod plausibility;
pub(crate) mod prices;
mod proof;
pub mod publications;
mod robust;
mod run;
mod sizing;
mod strain;
pub(crate) mod table;
mod to_be_computed;
mod torsion_cases;
pub(crate) mod verdict;
mod whole;
pub mod width;
pub use answer::answer;
pub use buildability::bounds;
pub use catalogue::catalogue;
pub use check_in_brief::check_in_brief;
pub use classification::criticals;
pub use curves::curves;
pub use designs::designs;
pub use fit_law::fit_law;
pub use flexible::crank_models;
pub use large_twist::large_twist;
pub use life::life;
pub use materials::{heat, made_of, simplest};
pub(crate) use model::crank_pressure;
pub use model::{duty, reciprocating};
pub use plausibility::{implausible, placeholders};
pub use proof::confirmed;
pub(crate) use robust::scattered;
pub use robust::{robust, tolerances};
pub use run::choices;
pub use run::summary;
pub use run::{conditions, optimum};
pub use sizing::{brief as sizing_in_brief, examples, rounds, sizing};
pub use strain::strain;
pub use table::dash;
pub use table::table;
pub(crate) use torsion_cases::torsion_cases;
pub use whole::{notes, whole};

/// Numbers of things, but for those of which there are none.
pub(crate) fn counted(counts: &[(usize, &str)]) -> String {
    counts.iter().filter(|(n, _)| *n > 0).map(|(n, things)| format!("{n} {things}")).collect::<Vec<_>>().join(", ")
}

/// A value with four significant digits.
pub(crate) fn short(x: f64) -> String {
    if x.is_finite() { table::significant(x, 4) } else { "unbounded".into() }
}
