//! What a study asks for: inputs, conditions, limits, margins, searches, sizing, and what is found. "Equals itself" and "equals the literature" are told apart in each test's first line.
#![expect(clippy::disallowed_methods, reason = "tests hold results against the elementary functions of the standard library")]

mod allocation;
mod answers;
mod buildable;
mod calibration;
mod catalogue;
mod certificates;
mod choice;
mod comparison;
mod conditions;
mod construction;
mod crank_by_matrices;
mod crank_models;
mod crank_sizing;
mod derived;
mod dialects;
mod from_rust;
mod generated;
mod grammar;
mod headings;
mod import;
mod in_operation;
mod keys;
mod life;
mod limited;
mod limits;
mod margin;
mod matrices;
mod matrices_read;
mod measures;
mod multiaxial_margin;
mod one_order;
mod prices;
mod progress;
mod publications;
mod real_absorbers;
mod robust;
mod several_rings;
mod sized;
mod sizing;
mod strain;
#[path = "../support.rs"]
mod support;
mod unit_load_bounds;
mod units_of_keys;
mod yields;
