//! Forces in one cylinder unit, and the torque on its throw.
//!
//! Axes of the cylinder: x along it, away from the crankshaft; y across it, the way the crankpin moves at firing dead centre. The crankpin is at
//! r (cos theta, sin theta), the rod leans by beta with L sin beta = r sin theta.
mod balance;
mod newton_euler;
mod traditional;
mod unit_forces;
pub(crate) use balance::gas_force;
pub use balance::{Moment, UnitForces};
pub use newton_euler::newton_euler;
pub use traditional::traditional;
pub use unit_forces::{friction_torque, gas_torque, inertia_for_growth, inertia_force_across, inertia_torque_per_omega2, unit_forces};
