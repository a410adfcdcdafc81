//! What limits and bounds cost an optimum, from its multipliers.

use super::{Outcome, Role, Space};

/// A parameter is on a bound where it is nearer than this share of the upper one.
const ON_BOUND: f64 = 1e-9;
/// Multipliers below this are what an interior-point method leaves of zero.
const ROUNDING: f64 = 1e-9;

/// A parameter that lies on a bound.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct OnBound {
    /// Index of the absorber.
    pub absorber: usize,
    /// Index of the parameter in its declaration.
    pub parameter: usize,
    /// The bound.
    pub bound: f64,
    /// Whether it is the upper one.
    pub upper: bool,
    /// Per cent of the objective that one per cent further would bring; nothing for a bound of zero.
    pub price: Option<f64>,
}

/// Per cent of the objective that one per cent more of each limit would bring.
#[doc(hidden)]
pub fn prices(outcome: &Outcome, limits: usize) -> Vec<f64> {
    let mut prices = vec![0.0; limits];
    for (row, multiplier) in outcome.rows.rows.iter().zip(&outcome.multipliers) {
        if let Role::Limit(limit) = row.role {
            prices[limit] += multiplier;
        }
    }
    prices.iter_mut().filter(|p| **p < ROUNDING).for_each(|p| *p = 0.0);
    prices
}

/// Bounds on which parameters lie, and what one per cent further would bring.
#[doc(hidden)]
pub fn on_bounds(space: &Space, outcome: &Outcome) -> Vec<OnBound> {
    let mut list = Vec::new();
    for ((v, w), [low, high]) in space.variables.iter().zip(&outcome.point).zip(&outcome.bounds) {
        let x = v.value(*w);
        for (bound, multiplier, upper) in [(v.lower, low, false), (v.upper, high, true)] {
            if (x - bound).abs() <= ON_BOUND * v.upper {
                // a coordinate is nearly the logarithm of its value
                let price = (bound > 0.0).then(|| multiplier * bound / v.slope(bound));
                list.push(OnBound { absorber: v.absorber, parameter: v.parameter, bound, upper, price });
            }
        }
    }
    list
}
