//! The fatigue table of a study.

use super::word::word;
use crate::crankshaft::MarginCriterion;
use crate::input::error::At;
use serde::{Deserialize, Deserializer};

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawFatigue {
    pub criteria: At<Vec<At<RawCriterion>>>,
    pub material: RawMaterial,
    #[serde(default)]
    pub pressure: RawCrankPressure,
    pub endurance: Option<RawEndurance>,
    #[serde(default)]
    pub mean_bending: RawMeanBending,
    #[serde(default)]
    pub notch_sensitivity: bool,
    #[serde(default)]
    pub iacs_m53: RawClassRule,
    #[serde(default)]
    pub fillet: Vec<RawFillet>,
}

/// A criterion by its word: the words are those of the criteria themselves.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RawCriterion(pub MarginCriterion);

impl<'de> Deserialize<'de> for RawCriterion {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        word(deserializer, MarginCriterion::all(), MarginCriterion::name).map(Self)
    }
}

/// Pressure that bends the crank.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawCrankPressure {
    #[default]
    BrakeCurve,
    Excitation,
}

#[derive(Debug, Default, Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawMeanBending {
    #[default]
    Signed,
    AsTension,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawMaterial {
    pub tensile_strength_mpa: At<f64>,
    pub yield_strength_mpa: Option<At<f64>>,
    pub bending_fatigue_limit_mpa: Option<At<f64>>,
    pub torsion_fatigue_limit_mpa: Option<At<f64>>,
    pub repeated_bending_fatigue_limit_mpa: Option<At<f64>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawEndurance {
    #[serde(default)]
    pub load: RawLoad,
    pub surface: RawSurface,
    pub temperature_c: Option<At<f64>>,
    pub reliability_percent: Option<At<f64>>,
}

#[derive(Debug, Default, Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawLoad {
    #[default]
    Bending,
    Axial,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawSurface {
    Ground,
    Machined,
    HotRolled,
    Forged,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawClassRule {
    #[serde(default)]
    pub manufacture: RawManufacture,
    pub additional_bending_mpa: Option<At<f64>>,
}

#[derive(Debug, Default, Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawManufacture {
    GrainFlow,
    #[default]
    FreeForged,
    CastColdRolled,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawFillet {
    pub name: At<String>,
    pub throw: Option<At<i64>>,
    #[serde(default)]
    pub on: RawPlace,
    pub factors: At<RawFactors>,
}

#[derive(Debug, Default, Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawPlace {
    #[default]
    Crankpin,
    Journal,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawFactors {
    Given(RawGiven),
    UnitLoads(At<String>),
    IacsM53,
    #[serde(rename = "fvv_1973")]
    Fvv1973,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawGiven {
    pub bending: At<f64>,
    pub torsion: At<f64>,
}
