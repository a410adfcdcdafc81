//! A length of shaft.

use super::bounds::{NOT_NEGATIVE, POSITIVE};
use crate::input::error::At;
use schemars::JsonSchema;
use serde::Deserialize;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawStep {
    /// Outer diameter.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [60]))]
    pub diameter_mm: At<f64>,
    /// Inner diameter.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("default" = 0, "examples" = [20]))]
    pub bore_mm: Option<At<f64>>,
    /// Length.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [120]))]
    pub length_mm: At<f64>,
}
