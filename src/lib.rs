//! Design of torsional vibration absorbers for engine crankshafts.
//!
//! ```
//! use hartog::Study;
//!
//! fn main() -> Result<(), hartog::Error> {
//!     let results = Study::read("studies/den_hartog.toml")?.run()?;
//!     let best = &results.optima[0];
//!     println!("{}: {:.6}°", best.design.name, best.optimum.value().to_degrees());
//!     Ok(())
//! }
//! ```
//!
//! It prints the number that `hartog run studies/den_hartog.toml` prints. Three longer programs stand in `studies/examples`: one evaluates a design,
//! one optimises two absorbers together, one brings an absorber law of its own.
//!
//! # Model
//!
//! A crankshaft with flywheel, pulley and absorber is a chain of rigid inertias joined by shafts. Its angles theta (about uniform
//! rotation) obey
//!
//! ```text
//! J theta'' + C theta' + K theta = T(t)
//! ```
//!
//! with diagonal J (kg m²), tridiagonal C (N m s/rad) and K (N m/rad; hysteretic shafts have k (1 + i eta)), and the torque T (N m) that gas
//! and moving masses put on each throw. At constant speed the torque is periodic in the working cycle (one revolution for two strokes,
//! two for four), so each **order** n (events per revolution, in halves for four strokes) can be solved by itself.
//!
//! | symbol | meaning | unit |
//! | --- | --- | --- |
//! | Omega | speed of the crankshaft | rad/s (`speed_rpm`: rpm) |
//! | omega = n Omega | circular frequency of order n | rad/s |
//! | theta | angle of a station; crank angle where the engine is meant | rad |
//! | J, k, c | inertia, stiffness, damping | kg m², N m/rad, N m s/rad |
//! | S = k + i omega c | complex stiffness of a link | N m/rad |
//! | z(omega) | dynamic stiffness an absorber adds to its station | N m/rad |
//! | H(omega) | receptance: angle per unit torque at a station | rad/(N m) |
//! | mu | ring inertia over engine inertia | 1 |
//!
//! **Phasors.** Y stands for Re(Y e^{i omega t}); magnitudes are zero to peak. Crank angle zero is the firing dead centre of the cylinder that
//! fires at 0°; angles, torques and twists are positive in the direction of rotation.
//!
//! **Peak of a sum.** "Half peak-to-peak" is (largest - smallest)/2 over the cycle of the sum of all orders with their phases. Order zero,
//! the mean torque, is left out: it turns the whole engine.
//!
//! **Damping ratios** are named by what they divide by: `c/(2 J omega_absorber)` or `c/(2 J omega_engine)`, see [`absorber::closed_forms`].
//!
//! # Map
//!
//! A row imports only from rows above it (a test proves that).
//!
//! | module | holds |
//! | --- | --- |
//! | [`guide`] | the chapters that explain the use of the program; text only |
//! | [`units`] | every conversion factor |
//! | [`numerics`] | physics-free mathematics |
//! | [`engine`] | kinematics, pressure, forces, orders, layout: the torque harmonics of a throw |
//! | [`absorber`] | one file a type: its law, derivatives, parameters and closed-form optima; absorbers on stations and on each other |
//! | [`rotor`] | a shaft in bending, torsion and axial motion, in axes that turn with it |
//! | [`drivetrain`] | stations and shafts, their modes, natural frequencies with absorbers |
//! | [`response`] | response methods, one file each, in frequency and in time; power |
//! | [`fatigue`] | criteria of mean stress (Goodman and others), endurance factors, class rules, multiaxial criteria |
//! | [`crankshaft`] | the crank as a beam on its bearings, stress concentration, critical locations and their margins |
//! | [`sizing`] | piston pin, connecting rod and crank from operating data; the rounds that make them agree |
//! | [`objective`] | measures, conditions, the search of peaks over speed with their gradients, surrogates for searches |
//! | [`optimise`] | problem, variables, starts, gradient-free search, minimax, front, proof |
//! | [`input`] | schema, validation (where a TOML key is checked), tables, errors: the only place that reads files |
//! | [`analysis`] | a whole study: calibrate, evaluate, optimise, margins |
//! | [`benchmark`] | what `hartog chart` measures: speed against accuracy, growth, energy, stability |
//! | [`validation`] | what `hartog compare` does: published tables, formulas that only their sources use; proofs held against dense solutions |
//! | [`report`] | text, tables and plots: the only place that writes files |
//! | [`cli`] | one file a command |
//!
//! Sources are listed in [`guide::references`].

#![deny(missing_docs)]

#[cfg(feature = "program")]
pub mod cli;
pub mod guide;

#[cfg(feature = "program")]
#[doc(inline)]
pub use hartog_comparison::{benchmark, validation};
#[doc(inline)]
pub use hartog_physics::{
    absorber, crankshaft, drivetrain, engine, fatigue, numerics, objective, optimise, response, rotor, sizing, units,
};
#[cfg(feature = "program")]
#[doc(inline)]
pub use hartog_report as report;
#[doc(inline)]
pub use hartog_study::{Error, InputError, PartsError, Results, RunError, Study, analysis, input};
