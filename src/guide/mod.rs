//! The guide: how to use the program, in chapters, in the order of use. It is text only.

/// See `src/guide/first_study.md`.
#[cfg_attr(any(doc, doctest), doc = include_str!("first_study.md"))]
pub mod first_study {}

/// See `src/guide/reading_results.md`.
#[cfg_attr(any(doc, doctest), doc = include_str!("reading_results.md"))]
pub mod reading_results {}

/// See `src/guide/own_engine.md`.
#[cfg_attr(any(doc, doctest), doc = include_str!("own_engine.md"))]
pub mod own_engine {}

/// See `src/guide/absorbers_and_materials.md`.
#[cfg_attr(any(doc, doctest), doc = include_str!("absorbers_and_materials.md"))]
pub mod absorbers_and_materials {}

/// See `src/guide/measures_and_limits.md`.
#[cfg_attr(any(doc, doctest), doc = include_str!("measures_and_limits.md"))]
pub mod measures_and_limits {}

/// See `src/guide/crank_and_fatigue.md`.
#[cfg_attr(any(doc, doctest), doc = include_str!("crank_and_fatigue.md"))]
pub mod crank_and_fatigue {}

/// See `src/guide/sizing.md`.
#[cfg_attr(any(doc, doctest), doc = include_str!("sizing.md"))]
pub mod sizing {}

/// See `src/guide/tolerances_and_survival.md`.
#[cfg_attr(any(doc, doctest), doc = include_str!("tolerances_and_survival.md"))]
pub mod tolerances_and_survival {}

/// See `src/guide/campaigns.md`.
#[cfg_attr(any(doc, doctest), doc = include_str!("campaigns.md"))]
pub mod campaigns {}

/// See `src/guide/outputs.md`.
#[cfg_attr(any(doc, doctest), doc = include_str!("outputs.md"))]
pub mod outputs {}

/// See `src/guide/other_programs.md`.
#[cfg_attr(any(doc, doctest), doc = include_str!("other_programs.md"))]
pub mod other_programs {}

/// See `src/guide/from_rust.md`.
#[cfg_attr(any(doc, doctest), doc = include_str!("from_rust.md"))]
pub mod from_rust {}

/// See `src/guide/how_it_works.md`.
#[cfg_attr(any(doc, doctest), doc = include_str!("how_it_works.md"))]
pub mod how_it_works {}

/// See `src/guide/dissertations.md`.
#[cfg_attr(any(doc, doctest), doc = include_str!("dissertations.md"))]
pub mod dissertations {}

/// See `src/guide/references.md`.
#[cfg_attr(any(doc, doctest), doc = include_str!("references.md"))]
pub mod references {}

/// See `src/guide/contributing.md`.
#[cfg_attr(any(doc, doctest), doc = include_str!("contributing.md"))]
pub mod contributing {}
