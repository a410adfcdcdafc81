//! States of an absorber's material, as typed.

use super::range::RawRange;
use crate::input::error::At;
use serde::Deserialize;
use std::collections::BTreeMap;

/// Temperatures of the conditions `cold` and `hot`.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawTemperatures {
    pub cold_c: Option<At<f64>>,
    pub hot_c: Option<At<f64>>,
}

/// What is said of a material.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawMaterialStates {
    pub temperature: Option<At<RawTemperatureLaw>>,
    pub ageing: Option<RawAgeing>,
    pub cooling: Option<At<RawCooling>>,
    pub geometry: Option<At<RawGeometry>>,
    pub amplitude: Option<At<RawAmplitude>>,
    #[serde(default)]
    pub properties: BTreeMap<String, RawRange>,
}

/// How a material follows temperature.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawTemperatureLaw {
    Wlf(RawWlf),
    Arrhenius(RawArrhenius),
    Exponential(RawExponential),
    SiliconeOil(RawSiliconeOil),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawWlf {
    pub c1: At<f64>,
    pub c2_k: At<f64>,
    pub reference_c: At<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawArrhenius {
    pub activation_kj_per_mol: At<f64>,
    pub reference_c: At<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawExponential {
    pub per_k: At<f64>,
    pub reference_c: At<f64>,
    pub between_c: At<Vec<At<f64>>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSiliconeOil {
    pub reference_c: At<f64>,
}

/// Factors on parameters by their keys.
pub(crate) type RawAgeing = At<BTreeMap<String, At<f64>>>;

/// How heat leaves an absorber.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawCooling {
    pub air_c: At<f64>,
    pub hub_c: At<f64>,
    pub to_air: RawToAir,
    pub to_hub_w_per_k: At<f64>,
    pub limit_c: At<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawToAir {
    WPerK(At<f64>),
    Disc(RawDisc),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawDisc {
    pub diameter_mm: At<f64>,
    pub width_mm: At<f64>,
}

/// How a material follows the amplitude of its strain.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawAmplitude {
    Kraus(RawKraus),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawKraus {
    pub storage_ratio: At<f64>,
    pub loss_ratio: At<f64>,
    pub critical_strain: At<f64>,
    pub exponent: At<f64>,
    pub reference_strain: At<f64>,
}

/// What of a material is sheared.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawGeometry {
    Sleeve(RawSleeve),
    Faces(RawFaces),
    Wedges(RawWedges),
    Gap(RawGap),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSleeve {
    pub inner_diameter_mm: At<f64>,
    pub outer_diameter_mm: At<f64>,
    pub length_mm: At<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawFaces {
    pub inner_diameter_mm: At<f64>,
    pub outer_diameter_mm: At<f64>,
    pub thickness_mm: At<f64>,
    pub count: At<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawWedges {
    pub inner_diameter_mm: At<f64>,
    pub outer_diameter_mm: At<f64>,
    pub thickness_over_radius: At<f64>,
    pub count: At<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawGap {
    pub inner_diameter_mm: At<f64>,
    pub outer_diameter_mm: At<f64>,
    pub width_mm: At<f64>,
    pub gap_mm: At<f64>,
}
