//! The sizing file.

use super::crank::RawFormula;
use super::engine::{RawLayout, RawPressure};
use super::fatigue::RawSurface;
use super::study::RawSpeeds;
use crate::input::error::At;
use serde::Deserialize;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSizing {
    pub name: At<String>,
    pub strokes: At<i64>,
    pub speed_rpm: At<RawSpeeds>,
    pub design_factor: At<f64>,
    pub buckling_factor: At<f64>,
    pub reliability_percent: At<f64>,
    pub torsion: At<RawTorsion>,
    pub bending: RawBending,
    pub mechanism: RawMechanism,
    pub layout: RawLayout,
    pub pressure: At<RawPressure>,
    pub material: RawMaterials,
    pub bearings: RawBearings,
    #[serde(default)]
    pub given: RawGiven,
    pub chain: RawSizedChain,
    pub absorber: Option<At<RawSizedAbsorber>>,
    pub front: Option<At<RawSizingFront>>,
    pub published: Option<At<String>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawTorsion {
    Rigid,
    Response,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawBending {
    OwnBearings,
    AllBearings,
}

/// What sets the stroke.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawBasis {
    StrokeMm(At<f64>),
    #[serde(rename = "displacement_cm3")]
    DisplacementCm3(At<f64>),
    Power(RawPower),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawPower {
    pub power_kw: At<f64>,
    pub mean_effective_pressure_bar: At<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawMechanism {
    pub basis: At<RawBasis>,
    pub bore_to_stroke: At<f64>,
    pub crank_to_rod: At<f64>,
    pub piston_mass_kg: At<f64>,
    pub liner_friction: At<f64>,
    pub crankcase_pressure_bar: At<f64>,
    pub fillet_radius_mm: At<f64>,
    pub eye_clearance_mm: At<f64>,
    pub least_eye_ratio: At<f64>,
    pub density_kg_m3: At<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawMaterials {
    pub piston_pin: RawPart,
    pub rod: RawPart,
    pub crank: RawPart,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawPart {
    pub tensile_strength_mpa: At<f64>,
    pub yield_strength_mpa: At<f64>,
    pub shear_yield_strength_mpa: At<f64>,
    pub surface: RawSurface,
    pub temperature_c: At<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawBearings {
    pub before_throw_mm: At<f64>,
    pub after_throw_mm: At<f64>,
    pub before_flywheel_mm: At<f64>,
    pub after_flywheel_mm: At<f64>,
    pub flywheel_weight_n: At<f64>,
    pub belt_tension_n: At<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawGiven {
    pub pin_diameter_mm: Option<At<f64>>,
    pub shank_thickness_mm: Option<At<f64>>,
    pub small_eye_ratio: Option<At<f64>>,
    pub big_eye_ratio: Option<At<f64>>,
    pub crankpin_diameter_mm: Option<At<f64>>,
    pub crankpin_length_mm: Option<At<f64>>,
    pub journal_diameter_mm: Option<At<f64>>,
    pub web_thickness_mm: Option<At<f64>>,
    pub web_breadth_mm: Option<At<f64>>,
    pub seat_diameter_mm: Option<At<f64>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSizedChain {
    pub pulley_inertia_kg_m2: At<f64>,
    pub pulley_distance_mm: At<f64>,
    pub flywheel_inertia_kg_m2: At<f64>,
    pub stiffness_formula: At<RawFormula>,
    pub fraction_of_critical: At<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSizedAbsorber {
    #[serde(rename = "type")]
    pub kind: At<String>,
    pub ring_inertia_kg_m2: At<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSizingFront {
    pub ring_inertia_kg_m2: At<Vec<At<f64>>>,
    pub points: At<i64>,
}
