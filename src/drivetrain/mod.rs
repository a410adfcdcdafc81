//! The torsional system: stations and shafts with their modes, the torque on them, and natural frequencies with absorbers.

pub mod chain;
mod characteristic;
mod difference;
pub mod modes;
pub mod natural;
pub mod system;
pub mod throw_inertia;
pub mod throw_stiffness;

pub use chain::{Chain, Joint, Station};
pub(crate) use difference::Difference;
pub use modes::Modes;
pub use system::System;
