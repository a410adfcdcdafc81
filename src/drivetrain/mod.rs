//! The torsional system: stations and shafts with their modes, the torque on them, and natural frequencies with absorbers.

pub mod chain;
pub mod modes;
pub mod natural;
pub mod system;

pub use chain::{Chain, Station};
pub use modes::Modes;
pub use system::System;
