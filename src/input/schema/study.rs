//! The study file.

use super::absorber::{RawAbsorber, RawOptimised};
use super::fatigue::RawFatigue;
use super::material_states::RawTemperatures;
use super::measure::RawMeasure;
use super::range::RawRange;
use super::robust::RawRobust;
use crate::input::error::At;
use serde::Deserialize;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawStudy {
    pub engine: At<String>,
    pub speed_rpm: At<RawSpeeds>,
    pub order_limit: Option<At<f64>>,
    pub load_fraction: Option<At<f64>>,
    pub part_load: Option<At<RawPartLoad>>,
    #[serde(default)]
    pub duty: Vec<RawDuty>,
    pub conditions: Option<At<Vec<At<RawCondition>>>>,
    pub scatter: Option<At<RawScatter>>,
    pub temperatures: Option<RawTemperatures>,
    #[serde(default)]
    pub response: RawResponse,
    #[serde(default)]
    pub design: Vec<RawDesign>,
    #[serde(default)]
    pub catalogue: Vec<RawCatalogue>,
    #[serde(default)]
    pub objective: Vec<At<RawMeasure>>,
    #[serde(default)]
    pub constraint: Vec<At<RawMeasure>>,
    pub optimise: Option<RawOptimise>,
    pub robust: Option<At<RawRobust>>,
    pub pareto: Option<At<RawPareto>>,
    pub published: Option<At<RawPublished>>,
    pub calibrate: Option<At<RawCalibrate>>,
    pub fatigue: Option<At<RawFatigue>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawCondition {
    Firing,
    Misfire,
    UnequalCylinders,
    Cold,
    Hot,
    Aged,
    AbsorberLocked,
    AbsorberLost,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawScatter {
    pub combustion: At<Vec<At<f64>>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSpeeds {
    pub from: At<f64>,
    pub to: At<f64>,
    pub step: At<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawPartLoad {
    pub speed_rpm: At<Vec<At<f64>>>,
    pub fraction: At<Vec<At<f64>>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawDuty {
    pub speed_rpm: At<f64>,
    pub load_fraction: At<f64>,
    pub share: At<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawResponse {
    #[serde(default)]
    pub method: RawMethod,
    pub tolerance: Option<At<f64>>,
    pub refine_peaks: Option<bool>,
}

#[derive(Debug, Default, Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawMethod {
    Receptance,
    Direct,
    #[default]
    Auto,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawDesign {
    pub name: At<String>,
    #[serde(default)]
    pub absorber: Vec<RawAbsorber>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawOnStation {
    pub station: At<String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawCatalogue {
    pub file: At<String>,
    pub on: RawOnStation,
    pub best: At<i64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawOptimise {
    pub seed: Option<At<i64>>,
    pub random_starts: Option<At<i64>>,
    pub conditions: Option<At<Vec<At<RawCondition>>>>,
    pub absorber: At<Vec<RawOptimised>>,
    pub combined: Option<At<RawCombined>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawCombined {
    pub of: At<Vec<At<String>>>,
    pub targets: At<Vec<At<f64>>>,
    pub weights: Option<At<Vec<At<f64>>>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawPareto {
    pub points: At<i64>,
    pub against: Option<RawAgainst>,
    pub of: Option<At<Vec<At<String>>>>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawAgainst {
    #[serde(rename = "ring_inertia_kg_m2")]
    RingInertia(At<Vec<At<f64>>>),
    InertiaRatio(At<Vec<At<f64>>>),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawPublished {
    pub engine: At<String>,
    pub frequencies: Option<At<String>>,
    pub absorbers: Option<At<String>>,
    pub amplitudes: Option<At<String>>,
    pub engines: Option<At<String>>,
    pub fatigue: Option<At<String>>,
    pub stresses: Option<At<String>>,
    pub factors: Option<At<String>>,
    pub multiaxial: Option<At<String>>,
    pub histories: Option<At<String>>,
    pub least_amplitude_deg: Option<At<f64>>,
    #[serde(default)]
    pub tolerance_percent: RawTolerances,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawTolerances {
    pub frequency: Option<At<f64>>,
    pub critical_speed: Option<At<f64>>,
    pub stiffness: Option<At<f64>>,
    pub damping: Option<At<f64>>,
    pub amplitude_median: Option<At<f64>>,
    pub amplitude_worst: Option<At<f64>>,
    pub safety_factor: Option<At<f64>>,
    pub multiaxial_factor: Option<At<f64>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawCalibrate {
    pub designs: At<Vec<At<String>>>,
    #[serde(default)]
    pub exclude: Vec<At<RawExcluded>>,
    pub tuned_by_hand: Option<At<Vec<At<String>>>>,
    pub pressure_scale: Option<At<RawRange>>,
    pub compression_ratio: Option<At<RawRange>>,
    pub heat_capacity_ratio: Option<At<RawRange>>,
    pub boost_bar: Option<At<RawRange>>,
    pub burn_start_deg: Option<At<RawRange>>,
    pub burn_duration_deg: Option<At<RawRange>>,
    pub wiebe_exponent: Option<At<RawRange>>,
    pub throw_damping_n_m_s_per_rad: Option<At<RawRange>>,
    pub shaft_damping_n_m_s_per_rad: Option<At<RawRange>>,
    pub shaft_loss_factor: Option<At<RawRange>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawExcluded {
    pub design: At<String>,
    pub order: At<f64>,
    pub speed_rpm: At<f64>,
}
