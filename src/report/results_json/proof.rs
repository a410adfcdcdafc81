//! What is proved of an optimum.

use crate::input::MeasureSpec;
use crate::optimise::{self, Verdict};
use schemars::JsonSchema;
use serde::Serialize;

/// That no design within the bounds is better.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct Proof {
    /// `proved`: to the gap that was asked for; `impossible`: no design holds all limits; `open`: the boxes did not suffice, or what the rest is worse by has no enclosure; `none`.
    verdict: &'static str,
    /// Of `none`.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'static str>,
    /// No design within bounds and limits is below it (of a margin: above).
    #[serde(skip_serializing_if = "Option::is_none")]
    lower_bound: Option<f64>,
    /// At no speed is the optimum above it (of a margin: below).
    #[serde(skip_serializing_if = "Option::is_none")]
    upper_bound: Option<f64>,
    /// Boxes of designs that were looked at.
    boxes: u64,
    /// Better optima that boxes led to.
    better_found: usize,
    /// Of `open`: the box that says least, as ranges of the free parameters.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    weakest_box: Vec<Range>,
}

/// Values of a parameter.
#[derive(Debug, Serialize, JsonSchema)]
struct Range {
    key: &'static str,
    from: f64,
    to: f64,
}

impl Proof {
    /// Of an optimum by this objective.
    pub(super) fn new(objective: &MeasureSpec, p: &optimise::Proof) -> Self {
        let (reason, ranges) = match &p.verdict {
            Verdict::None(reason) => (Some(reason.words()), &[][..]),
            Verdict::Open(ranges) => (None, ranges.as_slice()),
            Verdict::Proved | Verdict::Impossible => (None, &[][..]),
        };
        Self {
            verdict: p.verdict.word(),
            reason,
            lower_bound: p.lower_bound.map(|b| objective.unit.shown(b)),
            upper_bound: p.upper_bound.map(|b| objective.unit.shown(b)),
            boxes: p.boxes,
            better_found: p.better,
            weakest_box: ranges.iter().map(|(key, from, to)| Range { key, from: *from, to: *to }).collect(),
        }
    }
}
