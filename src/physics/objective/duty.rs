//! The points of a duty: speeds and loads at which the engine runs for shares of its time.

use crate::drivetrain::System;

/// A point of a duty.
#[derive(Debug)]
pub struct DutyLoad {
    /// Share of the time.
    pub share: f64,
    /// rpm.
    pub speed_rpm: f64,
    /// The engine at the load of the point.
    pub system: System,
}
