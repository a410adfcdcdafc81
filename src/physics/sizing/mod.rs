//! Piston pin, connecting rod and crank sized from operating data, after \[Fialho & Almeida 2019\].
//!
//! A round takes the masses of the last one, computes the forces of rod and crank over the cycle, sizes every section for static strength and for
//! infinite life, and computes the masses of what it has sized. Rounds follow each other until nothing changes.

pub mod bodies;
pub mod crank;
pub mod cycle;
pub mod eye;
mod failure;
#[doc(hidden)]
pub mod fit;
mod load_cases;
pub mod piston_pin;
pub mod rod;
mod round;
mod rounds;
pub mod section;
mod specification;
pub mod stepped_shaft;
pub mod web;

pub use failure::SizingError;
pub use round::{Behind, Margin, Round};
pub use rounds::{Sized, size};
pub use specification::{Bearings, Bending, Given, Material, Sizes, Specification, TorqueCase};
