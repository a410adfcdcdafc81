//! Engine orders: events per crank revolution, at half steps.

use crate::units::RAD_PER_S_PER_RPM;
use std::fmt;

/// An engine order; twice its value is stored, so that 4.5 is exact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize)]
pub struct Order(u32);

impl Order {
    /// From twice the order: `Order::from_twice(9)` is order 4.5.
    pub const fn from_twice(twice: u32) -> Self {
        Self(twice)
    }

    /// The order as a number.
    pub fn value(self) -> f64 {
        0.5 * f64::from(self.0)
    }

    /// Circular frequency at a speed of the shaft, rad/s.
    pub fn omega(self, speed_rpm: f64) -> f64 {
        self.value() * speed_rpm * RAD_PER_S_PER_RPM
    }

    /// Periods in one working cycle of a two- or four-stroke engine.
    pub fn per_cycle(self, strokes: u32) -> u32 {
        self.0 * strokes / 4
    }

    /// All orders of an engine up to `limit`: whole ones for two strokes, half ones for four.
    pub fn up_to(limit: f64, strokes: u32) -> Vec<Self> {
        let step = 4 / strokes;
        (1..).map(|i| Self(i * step)).take_while(|o| o.value() <= limit + 1e-9).collect()
    }
}

impl fmt::Display for Order {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.value().to_string())
    }
}
