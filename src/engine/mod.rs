//! From cylinder pressure to the torque of every throw, as complex amplitudes of engine orders.
pub mod cycle;
pub mod definition;
pub mod excitation;
pub mod forces;
pub mod geometry;
pub mod harmonic_table;
pub mod kinematics;
pub mod layout;
pub mod order;
pub mod pressure;
pub use definition::{Engine, Source};
pub use excitation::Excitation;
pub use geometry::{Geometry, RodModel};
pub use harmonic_table::HarmonicTable;
pub use kinematics::{Kinematics, SliderCrank};
pub use layout::Layout;
pub use order::Order;
pub use pressure::Pressure;
