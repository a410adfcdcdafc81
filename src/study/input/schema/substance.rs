//! A file of compounds and oils.

use super::bounds::{DENSITY, EXPONENT, FLOW_INDEX, GLASS_RATIO, NOT_NEGATIVE, POSITIVE, SHORE_A, TEMPERATURE};
use super::material_states::{RawAmplitude, RawLife, RawTemperatureLaw};
use crate::input::error::At;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSubstances {
    /// Families of rubber by their names.
    #[serde(default)]
    pub rubber: BTreeMap<String, RawRubber>,
    /// Families of oil by their names.
    #[serde(default)]
    pub oil: BTreeMap<String, RawOil>,
}

/// Compounds of one family: they differ by hardness.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawRubber {
    /// What it is, in words.
    #[schemars(extend("minLength" = 1, "examples" = ["EPDM with carbon black"]))]
    pub about: At<String>,
    /// Stiffness at infinite frequency over that at none.
    #[schemars(transform = GLASS_RATIO.of_number(), extend("examples" = [500]))]
    pub glass_ratio: At<f64>,
    /// Exponent of the fractional derivative.
    #[schemars(transform = EXPONENT.of_number(), extend("examples" = [0.25]))]
    pub fractional_exponent: At<f64>,
    /// Relaxation time at the reference temperature.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [4e-14]))]
    pub relaxation_time_s: At<f64>,
    /// How it follows temperature.
    #[schemars(extend("examples" = [{"wlf": {"c1": 7.22, "c2_k": 124.6, "reference_c": 23}}]))]
    pub temperature: At<RawTemperatureLaw>,
    /// Temperature that it bears for long.
    #[schemars(transform = TEMPERATURE.of_number(), extend("examples" = [120]))]
    pub limit_c: At<f64>,
    /// Cycles of strain that it bears.
    pub life: Option<At<RawLife>>,
    /// Price of a kilogram, in any currency.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [6]))]
    pub price_per_kg: At<f64>,
    /// Where its numbers hold.
    pub valid: At<RawValid>,
    /// By the key of each number its role (published, fitted, assumed) and source.
    #[schemars(extend("additionalProperties" = { "type": "string", "description": "Role and source of the number of this key.", "examples": ["assumed: engineering estimate"] },
        "examples" = [{"limit_c": "assumed: engineering estimate"}]))]
    pub sources: BTreeMap<String, At<String>>,
    /// Its compounds.
    #[schemars(extend("minItems" = 1))]
    pub grade: At<Vec<RawCompound>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawCompound {
    /// Its name in studies.
    #[schemars(extend("minLength" = 1, "examples" = ["epdm_60"]))]
    pub name: At<String>,
    /// Hardness, Shore A.
    #[schemars(transform = SHORE_A.of_number(), extend("examples" = [60]))]
    pub hardness_shore_a: At<f64>,
    /// Shear modulus at low frequency, at the reference of strain.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [0.8]))]
    pub relaxed_modulus_mpa: At<f64>,
    /// How it follows its strain.
    #[schemars(extend("examples" = [{"kraus": {"storage_ratio": 1.8, "loss_ratio": 2, "critical_strain": 0.02, "exponent": 0.55, "reference_strain": 0.05}}]))]
    pub strain: Option<At<RawAmplitude>>,
    /// Density.
    #[schemars(transform = DENSITY.of_number(), extend("examples" = [1150]))]
    pub density_kg_m3: At<f64>,
    /// Thermal conductivity.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [0.25]))]
    pub conductivity_w_per_m_k: At<f64>,
}

/// Oils of one family: they differ by viscosity, to which the relaxation time is tied.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawOil {
    /// What it is, in words.
    #[schemars(extend("minLength" = 1, "examples" = ["silicone oil"]))]
    pub about: At<String>,
    /// Width of the transition from Newtonian to shear-thinning.
    #[schemars(transform = EXPONENT.of_number(), extend("examples" = [0.8]))]
    pub transition_exponent: At<f64>,
    /// Flow index of the shear-thinning branch.
    #[schemars(transform = FLOW_INDEX.of_number(), extend("examples" = [0.3]))]
    pub flow_index: At<f64>,
    /// How it follows temperature.
    #[schemars(extend("examples" = [{"silicone_oil": {"reference_c": 25}}]))]
    pub temperature: At<RawTemperatureLaw>,
    /// Density.
    #[schemars(transform = DENSITY.of_number(), extend("examples" = [970]))]
    pub density_kg_m3: At<f64>,
    /// Thermal conductivity.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [0.16]))]
    pub conductivity_w_per_m_k: At<f64>,
    /// Temperature that it bears for long.
    #[schemars(transform = TEMPERATURE.of_number(), extend("examples" = [150]))]
    pub limit_c: At<f64>,
    /// By the key of each number its role (published, fitted, assumed) and source.
    #[schemars(extend("additionalProperties" = { "type": "string", "description": "Role and source of the number of this key.", "examples": ["assumed: engineering estimate"] },
        "examples" = [{"limit_c": "assumed: engineering estimate"}]))]
    pub sources: BTreeMap<String, At<String>>,
    /// Its grades.
    #[schemars(extend("minItems" = 1))]
    pub grade: At<Vec<RawGrade>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawGrade {
    /// Its name in studies.
    #[schemars(extend("minLength" = 1, "examples" = ["silicone_100000"]))]
    pub name: At<String>,
    /// Kinematic viscosity at the reference temperature and low frequency.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [100000]))]
    pub viscosity_mm2_per_s: At<f64>,
    /// Relaxation time there.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [0.003]))]
    pub relaxation_time_s: At<f64>,
    /// Price of a kilogram, in any currency.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [16]))]
    pub price_per_kg: At<f64>,
    /// Where its numbers hold.
    pub valid: At<RawValid>,
}

/// Where numbers hold: the least and the most.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawValid {
    /// Frequencies.
    #[schemars(transform = NOT_NEGATIVE.of_list(), extend("minItems" = 2, "maxItems" = 2, "examples" = [[1, 1000]]))]
    pub frequency_hz: At<Vec<At<f64>>>,
    /// Temperatures.
    #[schemars(transform = TEMPERATURE.of_list(), extend("minItems" = 2, "maxItems" = 2, "examples" = [[-30, 140]]))]
    pub temperature_c: At<Vec<At<f64>>>,
    /// Amplitudes of shear strain, zero to peak: 0.05 for 5 %.
    #[schemars(transform = NOT_NEGATIVE.of_list(), extend("minItems" = 2, "maxItems" = 2, "examples" = [[0.005, 0.15]]))]
    pub strain: At<Vec<At<f64>>>,
}
