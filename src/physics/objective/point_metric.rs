//! A measure at one speed: half the distance of the extremes of a sum of orders, or how much of the crank's strength it uses (by a multiaxial criterion the whole sum).

use super::measure::{Over, Within};
use crate::crankshaft::{Known, Margin, Torque};
use crate::numerics::C64;
use crate::numerics::extremes::Most;
use crate::numerics::lazy_extremes::Screen;
use crate::numerics::synthesis::{Extremes, Synthesiser};
use crate::response::Quantity;

/// The value of a synthesis, with what it counts at each speed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PointMetric<'a> {
    kind: Kind<'a>,
    within: &'a Within,
}

/// What is made of a sum of orders.
#[derive(Debug, Clone, Copy)]
enum Kind<'a> {
    /// Half peak-to-peak.
    HalfRange,
    /// Share of the strength that is used at the worst location of a shaft.
    Used {
        /// The crank.
        margin: &'a Margin,
        /// Index of the criterion.
        criterion: usize,
        /// Index of the shaft.
        shaft: usize,
        /// What is known of the design's own torques.
        known: Option<&'a Known>,
    },
}

/// A value, and what bounds the sum behind it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Above {
    pub value: f64,
    pub most: Most,
}

impl<'a> PointMetric<'a> {
    /// Of a quantity in a measure.
    pub fn of(over: Over, quantity: Quantity, within: &'a Within, margin: Option<&'a Margin>, known: Option<&'a Known>) -> Self {
        let kind = match (over, quantity, margin) {
            (Over::Margin(criterion), Quantity::ShaftTorque(shaft), Some(margin)) => Kind::Used { margin, criterion, shaft, known },
            _ => Kind::HalfRange,
        };
        Self { kind, within }
    }

    /// What a value counts at a speed.
    pub fn weight(&self, speed_rpm: f64) -> f64 {
        self.within.weight(speed_rpm)
    }

    /// The value of a sum with these extremes.
    pub fn value(&self, speed_rpm: f64, extremes: &Extremes, phasors: &[C64]) -> f64 {
        let torque = Torque { extremes: *extremes, phasors };
        let value = match self.kind {
            Kind::HalfRange => extremes.half_peak_to_peak,
            Kind::Used { margin, criterion, shaft, known } => {
                margin.most_used_above(criterion, shaft, speed_rpm, &torque, (1.0, 0.0), known).map_or(0.0, |u| u.value)
            }
        };
        value * self.weight(speed_rpm)
    }

    /// The value of a sum where it may reach `wanted` if it is up to `rise` times as large, else minus infinity; with what bounds the sum.
    pub(crate) fn value_above(&self, screen: &mut Screen, speed_rpm: f64, y: &[C64], (rise, wanted): (f64, f64)) -> Above {
        let weight = self.weight(speed_rpm);
        let can_matter = |most: Most| self.may_reach(speed_rpm, (most.half_peak_to_peak * rise, most.middle * rise), wanted);
        match self.kind {
            Kind::HalfRange => {
                let found = screen.extremes_if(y, can_matter);
                Above { value: found.0.map_or(f64::NEG_INFINITY, |e| e.half_peak_to_peak * weight), most: found.1 }
            }
            Kind::Used { margin, criterion, shaft, known } => {
                let (extremes, most) = match known {
                    Some(known) => known.extremes_if((shaft, speed_rpm), screen, y, can_matter),
                    None => screen.extremes_if(y, can_matter),
                };
                let used = extremes.and_then(|extremes| {
                    let torque = Torque { extremes, phasors: y };
                    margin.most_used_above(criterion, shaft, speed_rpm, &torque, (rise, wanted / weight), known)
                });
                Above { value: used.map_or(f64::NEG_INFINITY, |u| u.value * weight), most }
            }
        }
    }

    /// Whether the value asks for the whole sum, not only for its extremes.
    pub(crate) fn asks_for_all(&self) -> bool {
        matches!(self.kind, Kind::Used { margin, criterion, .. } if margin.is_multiaxial(criterion))
    }

    /// Whether its peaks over speed may sit on ridges.
    pub(crate) fn has_ridges(&self) -> bool {
        matches!(self.kind, Kind::Used { margin, criterion, .. } if margin.has_ridges(criterion))
    }

    /// No value is above this where half peak-to-peak and size of the middle are not above these.
    pub fn at_most(&self, speed_rpm: f64, half_peak_to_peak: f64, middle: f64) -> f64 {
        let most = match self.kind {
            Kind::HalfRange => half_peak_to_peak,
            Kind::Used { margin, criterion, shaft, .. } => margin.at_most(criterion, shaft, speed_rpm, half_peak_to_peak, middle),
        };
        most * self.weight(speed_rpm)
    }

    /// No value is above this where half peak-to-peak and size of the middle are not above `size`: at or above [`Self::at_most`], and quicker.
    pub(crate) fn rough_bound(&self, speed_rpm: f64, size: f64) -> f64 {
        let most = match self.kind {
            Kind::HalfRange => size,
            Kind::Used { margin, criterion, shaft, .. } => margin.rough_bound(criterion, shaft, speed_rpm, size),
        };
        most * self.weight(speed_rpm)
    }

    /// Whether [`Self::at_most`] is at or above `wanted`: a rougher bound often tells that it is not.
    pub(crate) fn may_reach(&self, speed_rpm: f64, (half_peak_to_peak, middle): (f64, f64), wanted: f64) -> bool {
        if self.rough_bound(speed_rpm, half_peak_to_peak.max(middle)) < wanted {
            return false;
        }
        let weight = self.weight(speed_rpm);
        match self.kind {
            Kind::HalfRange => half_peak_to_peak * weight >= wanted,
            Kind::Used { margin, criterion, shaft, .. } => {
                let size = (half_peak_to_peak, middle);
                wanted <= 0.0 || margin.any_bound((criterion, shaft), speed_rpm, size, |bound| bound * weight >= wanted)
            }
        }
    }

    /// No value is above this where the magnitudes of the orders add up to `sum`.
    pub fn bound(&self, speed_rpm: f64, sum: f64) -> f64 {
        self.at_most(speed_rpm, sum, sum)
    }

    /// Derivatives by changes of the sum at a speed, each given by its phasors. Exact where extremes decide; else by central differences at the location that is used most.
    pub fn derivatives(
        &self,
        synthesiser: &Synthesiser,
        speed_rpm: f64,
        (extremes, phasors): (&Extremes, &[C64]),
        changes: &[Vec<C64>],
    ) -> Vec<f64> {
        let along = |slopes: (f64, f64)| -> Vec<f64> {
            let all = synthesiser.derivatives_of(extremes, changes.iter().map(Vec::as_slice));
            all.map(|(range, middle)| slopes.0 * range + slopes.1 * middle).collect()
        };
        let torque = Torque { extremes: *extremes, phasors };
        let most = match self.kind {
            Kind::HalfRange => None,
            Kind::Used { margin, criterion, shaft, .. } => margin.most_used(criterion, shaft, speed_rpm, &torque),
        };
        let mut by_change: Vec<f64> = match (self.kind, most) {
            (Kind::HalfRange, _) => along((1.0, 0.0)),
            (Kind::Used { .. }, None) => vec![0.0; changes.len()],
            (Kind::Used { margin, criterion, .. }, Some(used)) if self.asks_for_all() => changes
                .iter()
                .map(|change| {
                    let length = |y: &[C64]| y.iter().map(|y| y.norm_sqr()).sum::<f64>().sqrt();
                    let step = DIFFERENCE * length(phasors) / length(change);
                    if !step.is_finite() {
                        return 0.0;
                    }
                    let moved = |step: f64| {
                        let moved: Vec<C64> = phasors.iter().zip(change).map(|(y, d)| y + d * step).collect();
                        margin.used(criterion, used.location, speed_rpm, &Torque { extremes: *extremes, phasors: &moved }).value
                    };
                    (moved(step) - moved(-step)) / (2.0 * step)
                })
                .collect(),
            (Kind::Used { .. }, Some(used)) => along(used.slopes),
        };
        let weight = self.weight(speed_rpm);
        by_change.iter_mut().for_each(|d| *d *= weight);
        by_change
    }
}

/// Steps of differences, relative to the size of the sum: their error is its square.
pub(crate) const DIFFERENCE: f64 = 1e-5;
