//! A material file.

use super::bounds::POSITIVE;
use crate::input::error::At;
use schemars::JsonSchema;
use serde::Deserialize;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawMaterialFile {
    /// Tensile strength.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [1000]))]
    pub tensile_strength_mpa: At<f64>,
    /// Yield strength.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [700]))]
    pub yield_strength_mpa: Option<At<f64>>,
    /// Fatigue limit in reversed bending.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [450]))]
    pub bending_fatigue_limit_mpa: At<f64>,
    /// Fatigue limit in reversed torsion.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [270]))]
    pub torsion_fatigue_limit_mpa: At<f64>,
    /// Largest stress of the fatigue limit in bending from zero; without it that of Goodman's line.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [620]))]
    pub repeated_bending_fatigue_limit_mpa: Option<At<f64>>,
}
