//! Measures of dampers by their dimensions, as typed.

use super::bounds::{NOT_NEGATIVE, POSITIVE};
use crate::input::error::At;
use schemars::JsonSchema;
use serde::Deserialize;

#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawMass {
    /// The absorber by its number; without it all together. Types by their dimensions have a mass.
    #[schemars(extend("minimum" = 1, "examples" = [1]))]
    pub absorber: Option<At<i64>>,
    /// Largest value allowed.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [8]))]
    pub max_kg: Option<At<f64>>,
}

#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawVolume {
    /// The absorber by its number; without it all together. Types by their dimensions have a volume.
    #[schemars(extend("minimum" = 1, "examples" = [1]))]
    pub absorber: Option<At<i64>>,
    /// Largest value allowed.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [3]))]
    pub max_l: Option<At<f64>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawCost {
    /// The absorber by its number; without it all together. Types by their dimensions have a cost.
    #[schemars(extend("minimum" = 1, "examples" = [1]))]
    pub absorber: Option<At<i64>>,
    /// Whatever the size, in the currency of the tables of compounds and oils, whose prices are added.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("default" = 0, "examples" = [20]))]
    pub fixed: Option<At<f64>>,
    /// Per kg of the ring, of springs and of pendulum masses.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [3]))]
    pub ring_per_kg: At<f64>,
    /// Per kg of a housing.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("default" = 0, "examples" = [5]))]
    pub housing_per_kg: Option<At<f64>>,
    /// Per mm of the outer diameter.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("default" = 0, "examples" = [0.05]))]
    pub per_mm_of_diameter: Option<At<f64>>,
    /// Largest value allowed.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [60]))]
    pub max: Option<At<f64>>,
}

/// Room for an absorber.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("anyOf" = [{ "required": ["outer_diameter_mm"] }, { "required": ["width_mm"] }, { "required": ["bore_mm"] }]))]
pub(crate) struct RawEnvelope {
    /// The absorber by its number; a type by its dimensions.
    #[schemars(extend("minimum" = 1, "examples" = [1]))]
    pub absorber: At<i64>,
    /// Largest outer diameter.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [270]))]
    pub outer_diameter_mm: Option<At<f64>>,
    /// Largest width.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [60]))]
    pub width_mm: Option<At<f64>>,
    /// Smallest diameter that is free inside.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [100]))]
    pub bore_mm: Option<At<f64>>,
}
