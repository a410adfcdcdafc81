//! The file of a campaign: many cases of studies, each with other values of some keys.

use super::bounds::{CASES_PER_SHARD, POINTS_OF_SAMPLE, POSITIVE, RELATIVE_ERROR, SEED, SETS_OF_ENGINES};
use crate::input::error::At;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("anyOf" = [{ "required": ["vary"] }, { "required": ["sample"] }]))]
pub(crate) struct RawCampaign {
    /// The study, relative to this file; may be left out where the variants of a `[[vary]]` name studies.
    #[schemars(extend("examples" = ["engine/study.toml"]))]
    pub study: Option<At<String>>,
    /// What is computed of each case: its given designs, its optima, its front, its designs within tolerances, or the dampers that several engines share.
    #[schemars(extend("examples" = ["optimise"]))]
    pub each: RawEach,
    /// Name of the `[[vary]]` whose values are the folders of the tables; without it the first one.
    #[schemars(extend("examples" = ["family"]))]
    pub partition: Option<At<String>>,
    /// Of given designs that differ in their parameters only: relative error that the values of objectives may have, by tables that tell their own error. Those of a larger one, and those of about 4000 cases that may be the best, are computed exactly; without it all are.
    #[schemars(transform = RELATIVE_ERROR.of_number(), extend("examples" = [0.001]))]
    pub tolerance: Option<At<f64>>,
    /// Cases of a shard; without it as many as take about a minute, measured where the campaign is planned.
    #[schemars(transform = CASES_PER_SHARD.of_number(), extend("examples" = [1000]))]
    pub cases_per_shard: Option<At<i64>>,
    /// What varies: every value of each with every value of the others.
    #[serde(default)]
    pub vary: Vec<At<RawVary>>,
    /// Points that are drawn of further keys, the same for every combination of what varies.
    pub sample: Option<At<RawSample>>,
    /// Which engines share dampers (`each = "platform"`).
    pub platform: Option<At<RawPlatform>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawPlatform {
    /// Name of the `[[vary]]` whose values are the engines.
    #[schemars(extend("examples" = ["engine"]))]
    pub engines: At<String>,
    /// Names of those whose values the damper of an engine is good for all together, as loads are.
    #[serde(default)]
    #[schemars(extend("examples" = [["load_fraction"]]))]
    pub loads: Vec<At<String>>,
    /// The objective of each engine, in the unit of its column, that counts as one; without it the best that a damper of the family reaches for its study alone.
    #[schemars(extend("additionalProperties" = POSITIVE.described("Target of the engine of this name.", 0.45), "examples" = [{ "six": 0.45, "v10": 0.3 }]))]
    pub targets: Option<At<BTreeMap<String, At<f64>>>>,
    /// Sets of engines whose common damper is sought, at most, to tell that no other assignment is better, besides those of a first assignment.
    #[schemars(transform = SETS_OF_ENGINES.of_number(), extend("default" = 2000, "examples" = [500]))]
    pub sets: Option<At<i64>>,
}

/// What is computed of a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawEach {
    Evaluate,
    Optimise,
    Front,
    Robust,
    Platform,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = [{ "required": ["key", "values"] }, { "required": ["key", "files"] }, { "required": ["variant"] }]))]
pub(crate) struct RawVary {
    /// Its column in the tables; without it the last part of its key.
    #[schemars(extend("pattern" = "^[A-Za-z_][A-Za-z0-9_]*$", "examples" = ["load_fraction"]))]
    pub name: Option<At<String>>,
    /// Key of the study, or behind `engine.` of its engine file, as `--set` takes it.
    #[schemars(extend("examples" = ["load_fraction"]))]
    pub key: Option<At<String>>,
    /// Values of the key, one after the other.
    #[schemars(with = "Option<Vec<serde_json::Value>>", extend("minItems" = 1, "examples" = [[0.5, 0.75, 1]]))]
    pub values: Option<At<Vec<At<toml::Value>>>>,
    /// Files as values of the key: a pattern with `*`, relative to this file.
    #[schemars(extend("examples" = ["engines/*.toml"]))]
    pub files: Option<At<String>>,
    /// Variants that give several keys at once, or other studies.
    #[serde(default)]
    pub variant: Vec<RawVariant>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawVariant {
    /// Its name in the tables.
    #[schemars(extend("examples" = ["cold"]))]
    pub name: At<String>,
    /// Another study, relative to this file.
    #[schemars(extend("examples" = ["other/study.toml"]))]
    pub study: Option<At<String>>,
    /// Values of keys, as `--set` takes them.
    #[serde(default)]
    #[schemars(extend("examples" = [["load_fraction=0.5", "duty=[]"]]))]
    pub set: Vec<At<String>>,
}

/// How points are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawMethodOfSampling {
    Sobol,
    LatinHypercube,
    Full,
    File,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSample {
    /// Sobol's sequence, shifted at random; a Latin hypercube; a full grid of the middles of equal shares; or the rows of a table.
    #[schemars(extend("examples" = ["sobol"]))]
    pub method: RawMethodOfSampling,
    /// How many points; of a full grid, how many of each key. Of `indices` this many for each of the keys and twice more.
    #[schemars(transform = POINTS_OF_SAMPLE.of_number(), extend("examples" = [64]))]
    pub points: Option<At<i64>>,
    /// Seed of what is random.
    #[schemars(transform = SEED.of_number(), extend("default" = 1, "examples" = [1]))]
    pub seed: Option<At<i64>>,
    /// Whether points are drawn in pairs that tell how much of the variance of each result each key makes (Sobol's indices by Saltelli's scheme).
    #[serde(default)]
    #[schemars(extend("default" = false, "examples" = [true]))]
    pub indices: bool,
    /// Table of points, relative to this file: a column a key, a row a point.
    #[schemars(extend("examples" = ["points.csv"]))]
    pub file: Option<At<String>>,
    /// A key and how it is distributed.
    #[serde(default)]
    pub of: Vec<At<RawSampled>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = [{ "required": ["uniform"] }, { "required": ["normal"] }, { "required": ["table"] }]))]
pub(crate) struct RawSampled {
    /// Key of the study, or behind `engine.` of its engine file, as `--set` takes it.
    #[schemars(extend("examples" = ["engine.station.pulley.inertia_kg_m2"]))]
    pub key: At<String>,
    /// Its column in the tables; without it the last part of its key.
    #[schemars(extend("pattern" = "^[A-Za-z_][A-Za-z0-9_]*$", "examples" = ["pulley_kg_m2"]))]
    pub name: Option<At<String>>,
    /// Lowest and highest value, all between them as likely.
    #[schemars(extend("minItems" = 2, "maxItems" = 2, "examples" = [[0.9, 1.1]]))]
    pub uniform: Option<At<Vec<At<f64>>>>,
    /// Gauss's distribution.
    pub normal: Option<RawNormal>,
    /// Values with their shares.
    pub table: Option<RawShares>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawNormal {
    /// Mean of all values.
    #[schemars(extend("examples" = [1]))]
    pub mean: At<f64>,
    /// Standard deviation.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [0.05]))]
    pub deviation: At<f64>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawShares {
    /// The values.
    #[schemars(extend("minItems" = 1, "examples" = [[0.9, 1, 1.1]]))]
    pub values: At<Vec<At<f64>>>,
    /// Share of each; they add up to 1.
    #[schemars(extend("items" = { "type": "number", "exclusiveMinimum": 0, "maximum": 1 }, "minItems" = 1, "examples" = [[0.25, 0.5, 0.25]]))]
    pub shares: At<Vec<At<f64>>>,
}
