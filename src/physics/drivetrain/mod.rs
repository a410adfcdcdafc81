//! The torsional system: stations and shafts with their modes, the torque on them, and natural frequencies with absorbers.

pub mod chain;
mod characteristic_equation;
pub mod flexible;
pub mod modes;
pub mod natural;
mod relative_angle;
pub mod system;
pub mod throw_inertia;
pub mod throw_stiffness;

pub use chain::{Chain, Joint, Station};
pub use flexible::FlexibleCrank;
pub use modes::Modes;
pub(crate) use relative_angle::Difference;
pub use system::System;
