//! Objectives: a peak over the speed range.

use crate::response::Quantity;

/// How orders combine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub enum Over {
    /// Half peak-to-peak of all orders together, with phase.
    Synthesis,
    /// The largest single order.
    Orders,
    /// Share of the crank's strength that is used, all orders together: the inverse of its margin by a criterion of the study (an index).
    Margin(usize),
}

/// The largest value over the speed range of some quantities.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Measure {
    /// The largest of these counts (several for the torque of all shafts); all of one unit.
    pub quantities: Vec<Quantity>,
    /// How orders combine.
    pub over: Over,
}

impl Measure {
    /// The quantity, where the measure is the synthesis of one: what surrogate peaks answer for.
    pub(crate) fn synthesised(&self) -> Option<Quantity> {
        match (self.over, self.quantities.as_slice()) {
            (Over::Synthesis, [quantity]) => Some(*quantity),
            _ => None,
        }
    }
}

/// An upper limit of a measure.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// What is limited.
    pub measure: Measure,
    /// rad or N m; positive.
    pub limit: f64,
}
