//! What is to be small at one speed, from the extremes of a sum of orders: half their distance, or how much of the crank's strength they use.

use super::margin::Margin;
use super::measure::Over;
use crate::numerics::synthesis::Extremes;
use crate::response::Quantity;

/// The value of a synthesis.
#[derive(Debug, Clone, Copy)]
pub enum Level<'a> {
    /// Half peak-to-peak.
    HalfRange,
    /// Share of the strength that is used at the worst spot of a shaft.
    Used {
        /// The crank.
        margin: &'a Margin,
        /// Index of the criterion.
        criterion: usize,
        /// Index of the shaft.
        shaft: usize,
    },
}

impl<'a> Level<'a> {
    /// Of a quantity in a measure.
    pub fn of(over: Over, quantity: Quantity, margin: Option<&'a Margin>) -> Self {
        match (over, quantity, margin) {
            (Over::Margin(criterion), Quantity::ShaftTorque(shaft), Some(margin)) => Self::Used { margin, criterion, shaft },
            _ => Self::HalfRange,
        }
    }

    /// The value.
    pub fn value(&self, speed_rpm: f64, extremes: &Extremes) -> f64 {
        match self {
            Self::HalfRange => extremes.half_peak_to_peak,
            Self::Used { margin, criterion, shaft } => margin.most_used(*criterion, *shaft, speed_rpm, extremes).map_or(0.0, |u| u.value),
        }
    }

    /// No value is above this where half peak-to-peak and size of the middle are not above these.
    pub fn at_most(&self, speed_rpm: f64, half_peak_to_peak: f64, middle: f64) -> f64 {
        match self {
            Self::HalfRange => half_peak_to_peak,
            Self::Used { margin, criterion, shaft } => margin.at_most(*criterion, *shaft, speed_rpm, half_peak_to_peak, middle),
        }
    }

    /// No value is above this where the magnitudes of the orders add up to `sum`.
    pub fn bound(&self, speed_rpm: f64, sum: f64) -> f64 {
        self.at_most(speed_rpm, sum, sum)
    }

    /// Derivatives by half peak-to-peak and by the middle of the extremes.
    pub fn slopes(&self, speed_rpm: f64, extremes: &Extremes) -> (f64, f64) {
        match self {
            Self::HalfRange => (1.0, 0.0),
            Self::Used { margin, criterion, shaft } => {
                margin.most_used(*criterion, *shaft, speed_rpm, extremes).map_or((0.0, 0.0), |u| u.slopes)
            }
        }
    }
}
