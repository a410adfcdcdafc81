//! A length of shaft.

use crate::input::error::At;
use schemars::JsonSchema;
use serde::Deserialize;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawStep {
    /// Outer diameter.
    #[schemars(extend("exclusiveMinimum" = 0, "examples" = [60]))]
    pub diameter_mm: At<f64>,
    /// Inner diameter.
    #[schemars(extend("minimum" = 0, "default" = 0, "examples" = [20]))]
    pub bore_mm: Option<At<f64>>,
    /// Length.
    #[schemars(extend("exclusiveMinimum" = 0, "examples" = [120]))]
    pub length_mm: At<f64>,
}
