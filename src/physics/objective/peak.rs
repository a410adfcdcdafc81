//! A local maximum over speed.

use super::measure::Over;
use crate::numerics::elementary::Elementary;
use crate::numerics::synthesis::Extremes;
use crate::response::Quantity;

/// Speeds, values and angles closer than this are the same.
const SAME: f64 = 1e-5;

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
    /// Whether another is the same peak of the same branch, met from elsewhere.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        let equal = |a: f64, b: f64| (a - b).abs() <= SAME * a.abs();
        let angles = match (&self.extremes, &other.extremes) {
            (Some(a), Some(b)) => {
                let turned = |x: f64, y: f64| (0.5 * (x - y)).sine().abs();
                turned(a.angle_max, b.angle_max).max(turned(a.angle_min, b.angle_min)) < SAME
            }
            _ => self.order == other.order,
        };
        self.quantity == other.quantity && angles && equal(self.speed_rpm, other.speed_rpm) && equal(self.value, other.value)
    }

    /// A value at no speed.
    pub(super) fn nowhere(value: f64, over: Over, quantity: Quantity) -> Self {
        let (weight, speed_rpm, order, order_value, extremes) = (1.0, 0.0, 0, 0.0, None);
        Self { value, weight, over, speed_rpm, order, order_value, quantity, extremes, place: Place::Nowhere }
    }
}
