//! How closely something is proved.

use super::bounds::{BOXES, GAP};
use crate::input::error::At;
use crate::optimise::Effort;
use schemars::JsonSchema;
use serde::Deserialize;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawProve {
    /// Share of a value above which no combination within the tolerances is to lie.
    #[schemars(transform = GAP.of_number(), extend("default" = EFFORT.gap, "examples" = [1e-4]))]
    pub gap: Option<At<f64>>,
    /// Boxes that the ranges of speeds and tolerances are cut into, at most; 0: nothing is proved.
    #[schemars(transform = BOXES.of_number(), extend("default" = EFFORT.boxes, "examples" = [1_000_000]))]
    pub boxes: Option<At<i64>>,
}

/// The same of an optimum.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawProveOptima {
    /// Share of an optimum below which no design is to lie.
    #[schemars(transform = GAP.of_number(), extend("default" = EFFORT.gap, "examples" = [1e-4]))]
    pub gap: Option<At<f64>>,
    /// Boxes that the range of the free parameters is cut into, at most; 0: nothing is proved.
    #[schemars(transform = BOXES.of_number(), extend("default" = EFFORT.boxes, "examples" = [1_000_000]))]
    pub boxes: Option<At<i64>>,
    /// Whether each proof is written as a table, `proof_<design>.csv`, that `hartog check --proof` confirms by other means: boxes that cover the bounds, each with the speeds that exclude it.
    #[schemars(extend("default" = false, "examples" = [true]))]
    pub file: Option<bool>,
}

/// What a proof costs and shows where a study says nothing of it.
pub(crate) const EFFORT: Effort = Effort { gap: 1e-3, boxes: 4_000 };
