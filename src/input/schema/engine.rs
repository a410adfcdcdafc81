//! The engine file.

use super::crank::{RawCrank, RawStep};
use crate::input::error::At;
use serde::Deserialize;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawEngine {
    pub name: At<String>,
    pub strokes: At<i64>,
    pub reciprocating_inertia: Option<At<RawReciprocating>>,
    pub geometry: Option<At<RawGeometry>>,
    pub layout: RawLayout,
    pub pressure: At<RawPressure>,
    pub crank: Option<At<RawCrank>>,
    pub chain: Option<RawFile>,
    pub damping: Option<RawDamping>,
    #[serde(default)]
    pub station: Vec<RawStation>,
}

/// Damping of the whole chain.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawDamping {
    pub dynamic_magnifier: Option<At<f64>>,
    pub fraction_of_critical: Option<At<f64>>,
    pub rayleigh: Option<RawRayleigh>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawRayleigh {
    pub inertia_per_s: At<f64>,
    pub stiffness_s: At<f64>,
}

/// What of the moving masses is part of the chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawReciprocating {
    None,
    Mean,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawGeometry {
    pub bore_mm: At<f64>,
    pub crank_radius_mm: At<f64>,
    pub rod_length_mm: At<f64>,
    pub piston_mass_kg: At<f64>,
    pub rod_mass_kg: At<f64>,
    pub rod_rotating_fraction: Option<At<f64>>,
    pub rod_centre_from_big_end_mm: Option<At<f64>>,
    pub rod_inertia_kg_m2: Option<At<f64>>,
    #[serde(default)]
    pub kinematics: RawKinematics,
    pub crankcase_pressure_bar: Option<At<f64>>,
    pub liner_friction: Option<At<f64>>,
}

#[derive(Debug, Default, Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawKinematics {
    #[default]
    Exact,
    Truncated,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawLayout {
    InLine(RawInLine),
    V(RawV),
    Opposed(RawInLine),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawInLine {
    pub firing_order: At<Vec<At<i64>>>,
    pub firing_deg: At<Vec<At<f64>>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawV {
    pub bank_angle_deg: At<f64>,
    pub split_pin_deg: Option<At<f64>>,
    pub firing_order: At<Vec<At<i64>>>,
    pub firing_deg: At<Vec<At<f64>>>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawPressure {
    Otto(RawOtto),
    Wiebe(RawWiebe),
    Measured(RawFile),
    Harmonics(RawHarmonics),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawOtto {
    pub speed_rpm: At<Vec<At<f64>>>,
    pub curve: RawCurve,
    pub compression_ratio: At<f64>,
    pub pressure_scale: At<f64>,
    pub pressure_scale_over_speed: Option<At<Vec<At<f64>>>>,
    pub inlet_pressure_bar: Option<At<f64>>,
    pub heat_capacity_ratio: Option<At<f64>>,
}

#[derive(Debug, Deserialize)]
pub(crate) enum RawCurve {
    #[serde(rename = "power_kw")]
    Power(At<Vec<At<f64>>>),
    #[serde(rename = "torque_n_m")]
    Torque(At<Vec<At<f64>>>),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawWiebe {
    pub speed_rpm: At<Vec<At<f64>>>,
    pub indicated_mean_pressure_bar: At<Vec<At<f64>>>,
    pub boost_bar: At<f64>,
    pub compression_ratio: At<f64>,
    pub burn_start_deg: At<f64>,
    pub burn_duration_deg: At<f64>,
    pub wiebe_exponent: Option<At<f64>>,
    pub heat_capacity_ratio: Option<At<f64>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawHarmonics {
    pub file: At<String>,
    #[serde(default)]
    pub torque: RawTorqueOf,
}

/// What a table of harmonics holds.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawTorqueOf {
    #[default]
    Throw,
    Gas,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawFile {
    pub file: At<String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawStation {
    pub name: At<String>,
    #[serde(default)]
    pub throws: Vec<At<i64>>,
    pub inertia_kg_m2: Option<At<f64>>,
    pub stiffness_to_next_n_m_per_rad: Option<At<f64>>,
    pub damping_to_next_n_m_s_per_rad: Option<At<f64>>,
    pub loss_factor_to_next: Option<At<f64>>,
    pub stiffness_to_ground_n_m_per_rad: Option<At<f64>>,
    pub damping_to_ground_n_m_s_per_rad: Option<At<f64>>,
    pub next: Option<At<String>>,
    pub gear_ratio_to_next: Option<At<f64>>,
    pub shaft_to_next: Option<At<Vec<RawStep>>>,
}
