//! The crank's dimensions in an engine file.

use super::word::word;
use crate::drivetrain::throw_stiffness::ThrowFormula;
use crate::input::error::At;
use serde::{Deserialize, Deserializer};

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawCrank {
    pub pitch_mm: RawEach,
    pub crankpin_diameter_mm: At<f64>,
    pub crankpin_length_mm: At<f64>,
    pub crankpin_bore_mm: Option<At<f64>>,
    pub crankpin_fillet_mm: At<f64>,
    pub crankpin_recess_mm: Option<At<f64>>,
    pub journal_diameter_mm: At<f64>,
    pub journal_length_mm: RawEach,
    pub journal_bore_mm: Option<At<f64>>,
    pub journal_fillet_mm: At<f64>,
    pub journal_recess_mm: Option<At<f64>>,
    pub web_thickness_mm: At<f64>,
    pub web_breadth_mm: At<f64>,
    pub oil_bore: Option<RawOilBore>,
    #[serde(default)]
    pub missing_bearings: Vec<At<i64>>,
    pub rod_spacing_mm: Option<At<f64>>,
    pub bearing_stiffness_n_per_m: Option<At<f64>>,
    pub young_modulus_gpa: Option<At<f64>>,
    pub unbalance_kg_m: Option<At<f64>>,
    pub counterweight_kg_m: Option<At<f64>>,
    pub stiffness_formula: Option<At<RawFormula>>,
    pub masses: Option<RawMasses>,
    #[serde(default)]
    pub assumed: Vec<At<String>>,
}

/// A formula by its word.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RawFormula(pub ThrowFormula);

impl<'de> Deserialize<'de> for RawFormula {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        word(deserializer, ThrowFormula::ALL, ThrowFormula::name).map(Self)
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawMasses {
    pub density_kg_m3: At<f64>,
    pub web_height_mm: At<f64>,
    pub web_centre_mm: At<f64>,
    pub counterweight: Option<RawSector>,
    #[serde(default)]
    pub rings: Vec<RawRing>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSector {
    pub outer_radius_mm: At<f64>,
    pub inner_radius_mm: At<f64>,
    pub angle_deg: At<f64>,
    pub thickness_mm: At<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawRing {
    pub diameter_mm: At<f64>,
    pub bore_mm: Option<At<f64>>,
    pub length_mm: At<f64>,
    #[serde(default)]
    pub cut: bool,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawStep {
    pub diameter_mm: At<f64>,
    pub bore_mm: Option<At<f64>>,
    pub length_mm: At<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawEach {
    All(At<f64>),
    Each(At<Vec<At<f64>>>),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawOilBore {
    pub diameter_mm: At<f64>,
    pub angle_deg: Option<At<f64>>,
}
