//! Tolerances that a design is to hold within.

use crate::input::error::At;
use serde::Deserialize;
use std::collections::BTreeMap;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawRobust {
    pub tolerance: At<BTreeMap<String, At<f64>>>,
    pub sampling: Option<RawSampling>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSampling {
    pub percentile: At<f64>,
    pub samples: At<i64>,
    pub distribution: RawDistribution,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawDistribution {
    Uniform,
    Normal,
}
