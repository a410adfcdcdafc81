//! Laws of the physics: absorbers, chains, cranks, responses, fatigue, and the numerics below them. "Equals itself" and "equals the literature" are told apart in each test's first line.
#![expect(clippy::disallowed_methods, reason = "tests hold results against the elementary functions of the standard library")]

mod absorbers;
mod assignments;
mod ceilings;
mod chains;
mod construction;
mod construction_of_springs;
mod dual_mass;
mod enclosing;
mod enclosures;
mod engines;
mod examples;
mod fatigue;
mod flexible_crank;
mod forces;
mod joints;
mod large_twist;
mod laws;
mod load;
mod methods;
mod multiaxial;
mod numerics;
mod optima;
mod pairs;
mod peaks;
mod pendulum_travel;
mod planes;
mod prony;
mod proofs;
mod responses;
mod rotor;
mod shaft;
mod shaft_rules;
mod sheared_sections;
mod stiff_shafts;
#[path = "../support.rs"]
mod support;
mod trees;
mod unseen_peaks;
