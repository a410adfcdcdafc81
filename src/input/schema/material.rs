//! A material file.

use crate::input::error::At;
use serde::Deserialize;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawMaterialFile {
    pub tensile_strength_mpa: At<f64>,
    pub yield_strength_mpa: Option<At<f64>>,
    pub bending_fatigue_limit_mpa: At<f64>,
    pub torsion_fatigue_limit_mpa: At<f64>,
    pub repeated_bending_fatigue_limit_mpa: Option<At<f64>>,
}
