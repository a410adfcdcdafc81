//! Steady motion of a design with one absorber whose twist is not small: harmonic balance, followed along its curve over speed, with the stability of each motion.
//!
//! The chain and the other absorbers are linear: at each harmonic the hub moves by what it does under the torque alone, less its receptance times the torque of the absorber. What is left to find are the
//! harmonics of the twist, and of the hub where it acts by more than the ring's inertia.

mod arc;
pub mod balance;
pub mod curve;
mod equivalent;
mod harmonic_matrix;
mod in_time;
mod linear;
mod newton;
pub mod stability;

pub use balance::{Balance, Steady};
pub use curve::{Curve, CurvePoint};
pub use stability::Stability;
