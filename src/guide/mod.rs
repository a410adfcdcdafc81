//! The guide: how to use the program, in chapters, in the order of use. It is text only.

#[doc = include_str!("first_study.md")]
pub mod first_study {}

#[doc = include_str!("reading_results.md")]
pub mod reading_results {}

#[doc = include_str!("own_engine.md")]
pub mod own_engine {}

#[doc = include_str!("absorbers_and_materials.md")]
pub mod absorbers_and_materials {}

#[doc = include_str!("measures_and_limits.md")]
pub mod measures_and_limits {}

#[doc = include_str!("crank_and_fatigue.md")]
pub mod crank_and_fatigue {}

#[doc = include_str!("sizing.md")]
pub mod sizing {}

#[doc = include_str!("tolerances_and_survival.md")]
pub mod tolerances_and_survival {}

#[doc = include_str!("outputs.md")]
pub mod outputs {}

#[doc = include_str!("other_programs.md")]
pub mod other_programs {}

#[doc = include_str!("from_rust.md")]
pub mod from_rust {}

#[doc = include_str!("how_it_works.md")]
pub mod how_it_works {}

#[doc = include_str!("references.md")]
pub mod references {}

#[doc = include_str!("contributing.md")]
pub mod contributing {}
