//! A local maximum over speed.

use super::measure::Over;
use crate::numerics::synthesis::Extremes;
use crate::response::Quantity;

/// Where on the range a peak lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Place {
    /// Between the ends.
    Interior,
    /// At the lowest or highest speed.
    End,
    /// At no speed: a property of the design, or a mean over the duty.
    Nowhere,
}

/// A local maximum over speed, or a property of a design.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Peak {
    /// In the unit of the measure (rad, N m, W; of a margin its inverse), times the weight.
    pub value: f64,
    /// What a value counts at this speed.
    pub weight: f64,
    /// How orders combine in it.
    pub over: Over,
    /// rpm; zero at no speed.
    pub speed_rpm: f64,
    /// Index of the order (over orders) or of the largest one in the sum (synthesis, power).
    pub order: usize,
    /// Share of that order: its magnitude.
    pub order_value: f64,
    /// Which of the measure's quantities.
    pub quantity: Quantity,
    /// Where in the cycle the extremes lie (synthesis only).
    pub extremes: Option<Extremes>,
    /// Where on the range.
    pub place: Place,
}

impl Peak {
    /// A value at no speed.
    pub(super) fn nowhere(value: f64, over: Over, quantity: Quantity) -> Self {
        let (weight, speed_rpm, order, order_value, extremes) = (1.0, 0.0, 0, 0.0, None);
        Self { value, weight, over, speed_rpm, order, order_value, quantity, extremes, place: Place::Nowhere }
    }
}
