//! Tolerances that a design is to hold within.

use crate::absorber::types::parameter_keys;
use crate::input::error::At;
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawRobust {
    /// By the key of a parameter its tolerance as a share, from 1e-6 to 0.9: 0.1 is 10 % more or less.
    #[schemars(extend("minProperties" = 1, "propertyNames" = { "enum": parameter_keys() },
        "additionalProperties" = share("Tolerance of the parameter of this key."), "examples" = [{"stiffness_n_m_per_rad": 0.1}]))]
    pub tolerance: At<BTreeMap<String, At<f64>>>,
    /// Random designs within the tolerances, beside the exact worst case.
    #[schemars(extend("examples" = [{"percentile": 95, "samples": 1000, "distribution": "uniform"}]))]
    pub sampling: Option<RawSampling>,
}

/// A share of a parameter.
pub(super) fn share(about: &str) -> Value {
    json!({ "type": "number", "minimum": 1e-6, "maximum": 0.9, "description": about, "examples": [0.1] })
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSampling {
    /// Per cent of the designs that are no worse.
    #[schemars(extend("minimum" = 1, "maximum" = 99.9, "examples" = [95]))]
    pub percentile: At<f64>,
    /// Number of random designs.
    #[schemars(extend("minimum" = 100, "maximum" = 1000000, "examples" = [1000]))]
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
