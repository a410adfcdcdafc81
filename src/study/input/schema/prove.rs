//! How closely something is proved.

use crate::input::error::At;
use crate::optimise::Effort;
use schemars::JsonSchema;
use serde::Deserialize;
use std::ops::RangeInclusive;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawProve {
    /// Share of a value above which no combination within the tolerances is to lie.
    #[schemars(extend("minimum" = GAPS.start(), "maximum" = GAPS.end(), "default" = EFFORT.gap, "examples" = [1e-4]))]
    pub gap: Option<At<f64>>,
    /// Boxes that the ranges of speeds and tolerances are cut into, at most; 0: nothing is proved.
    #[schemars(extend("minimum" = BOXES.start(), "maximum" = BOXES.end(), "default" = EFFORT.boxes, "examples" = [1_000_000]))]
    pub boxes: Option<At<i64>>,
}

/// The same of an optimum.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawProveOptima {
    /// Share of an optimum below which no design is to lie.
    #[schemars(extend("minimum" = GAPS.start(), "maximum" = GAPS.end(), "default" = EFFORT.gap, "examples" = [1e-4]))]
    pub gap: Option<At<f64>>,
    /// Boxes that the range of the free parameters is cut into, at most; 0: nothing is proved.
    #[schemars(extend("minimum" = BOXES.start(), "maximum" = BOXES.end(), "default" = EFFORT.boxes, "examples" = [1_000_000]))]
    pub boxes: Option<At<i64>>,
    /// Whether each proof is written as a table, `proof_<design>.csv`, that `hartog check --proof` confirms by other means: boxes that cover the bounds, each with the speeds that exclude it.
    #[schemars(extend("default" = false, "examples" = [true]))]
    pub file: Option<bool>,
}

/// Gaps and numbers of boxes that a proof may be asked for.
pub(crate) const GAPS: RangeInclusive<f64> = 1e-8..=0.5;
pub(crate) const BOXES: RangeInclusive<i64> = 0..=1_000_000_000;
/// What a proof costs and shows where a study says nothing of it.
pub(crate) const EFFORT: Effort = Effort { gap: 1e-3, boxes: 4_000 };
