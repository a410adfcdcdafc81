//! Tolerances that a design is to hold within.

use super::bounds::{PERCENTILE, POSITIVE, SAMPLES, TOLERANCE, YIELD_PERCENT};
use super::prove::RawProve;
use crate::absorber::SHAPES;
use crate::absorber::types::parameter_keys;
use crate::input::error::At;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("anyOf" = [{ "required": ["tolerance"] }, { "required": ["process"] }]))]
pub(crate) struct RawRobust {
    /// By the key of a parameter its tolerance as a share: 0.1 is 10 % more or less.
    #[schemars(extend("minProperties" = 1, "propertyNames" = { "enum": parameter_keys() },
        "additionalProperties" = TOLERANCE.described("Tolerance of the parameter of this key.", 0.1), "examples" = [{"stiffness_n_m_per_rad": 0.1}]))]
    pub tolerance: Option<At<BTreeMap<String, At<f64>>>>,
    /// What the making of dampers by their dimensions scatters, more or less: a dimension by its key, in its unit; `hardness_shore_a` of rubber; `viscosity_percent` of oil; `temperature_k` of either, about its reference.
    #[schemars(extend("minProperties" = 1, "propertyNames" = { "enum": process_keys() },
        "additionalProperties" = POSITIVE.described("Tolerance, in the unit of the key.", 0.2),
        "examples" = [{"rubber_thickness_mm": 0.2, "hardness_shore_a": 5}]))]
    pub process: Option<At<BTreeMap<String, At<f64>>>>,
    /// Whether optima within the tolerances are sought beside those as drawn, which takes several times as long.
    #[schemars(extend("default" = true, "examples" = [false]))]
    pub search: Option<bool>,
    /// Random designs within the tolerances, beside the exact worst case.
    #[schemars(extend("examples" = [{"percentile": 95, "samples": 1000, "distribution": "uniform"}]))]
    pub sampling: Option<RawSampling>,
    /// Asks for a proof of what no combination within the tolerances is worse than, of the objective and of every limit.
    #[schemars(extend("examples" = [{"gap": 1e-3, "boxes": 100_000}]))]
    pub prove: Option<At<RawProve>>,
    /// Asks for the tolerances that each design can bear under the limits of the study; `{}` for the widest that keep their ratio, within which no limit was found to be broken.
    #[schemars(extend("examples" = [{"cost": {"rubber_thickness_mm": 3, "hardness_shore_a": 5}}]))]
    pub allocate: Option<At<RawAllocate>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawAllocate {
    /// Per cent of the random designs of `sampling` that are to hold all limits; without it every one within the tolerances, as far as it is searched.
    #[schemars(transform = YIELD_PERCENT.of_number(), extend("examples" = [99]))]
    pub yield_percent: Option<At<f64>>,
    /// What each tolerance costs as wide as it is given, in any currency, by its key: half as wide it costs twice as much. With it the cheapest are found.
    #[schemars(extend("minProperties" = 1, "propertyNames" = { "enum": scattered_keys() },
        "additionalProperties" = POSITIVE.described("Cost of the tolerance of this key.", 3.0),
        "examples" = [{"rubber_thickness_mm": 3, "hardness_shore_a": 5}]))]
    pub cost: Option<At<BTreeMap<String, At<f64>>>>,
}

/// Keys of all that scatters.
fn scattered_keys() -> Vec<&'static str> {
    let mut keys = parameter_keys();
    for key in process_keys() {
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    keys
}

/// Keys of what a process scatters: dimensions, and what of a compound or oil does.
pub(crate) fn process_keys() -> Vec<&'static str> {
    let mut keys: Vec<&'static str> = Vec::new();
    let dimensions = SHAPES.iter().flat_map(|s| s.drawn().iter().map(|p| p.key));
    for key in dimensions.chain([HARDNESS, VISCOSITY, TEMPERATURE]) {
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    keys
}

/// Key of the scatter of hardness.
pub(crate) const HARDNESS: &str = "hardness_shore_a";
/// Key of the scatter of temperature.
pub(crate) const TEMPERATURE: &str = "temperature_k";
/// Key of the scatter of viscosity.
pub(crate) const VISCOSITY: &str = "viscosity_percent";

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSampling {
    /// Per cent of the designs that are no worse.
    #[schemars(transform = PERCENTILE.of_number(), extend("examples" = [95]))]
    pub percentile: At<f64>,
    /// Number of random designs.
    #[schemars(transform = SAMPLES.of_number(), extend("examples" = [1000]))]
    pub samples: At<i64>,
    /// How deviations are distributed; of normal ones the tolerance is three standard deviations.
    #[schemars(extend("examples" = ["uniform"]))]
    pub distribution: RawDistribution,
}

#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawDistribution {
    Uniform,
    Normal,
}
