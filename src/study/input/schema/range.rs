//! A value, two bounds, or a list, as typed.

use super::bounds::{Bounds, NOT_NEGATIVE};
use crate::input::error::At;
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::{Value, json};

/// Value or bounds.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawRange {
    /// One value.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [0.076]))]
    Fixed(At<f64>),
    /// Two bounds.
    #[schemars(transform = NOT_NEGATIVE.of_list(), extend("minItems" = 2, "maxItems" = 2, "examples" = [[0.01, 0.2]]))]
    Between(At<Vec<At<f64>>>),
    /// A list of values.
    #[schemars(transform = NOT_NEGATIVE.of_list(), extend("minItems" = 1, "examples" = [[0.03, 0.076]]))]
    Each(At<Vec<At<f64>>>),
}

/// Two bounds alone, for the schema: reading takes a range, and says what is expected where it is another choice.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(crate) struct RawBounds {
    /// Two bounds.
    #[schemars(extend("minItems" = 2, "maxItems" = 2, "examples" = [[0.01, 0.2]]))]
    #[expect(dead_code, reason = "a shape, never a value")]
    pub between: Vec<f64>,
}

/// Two bounds within a range, for the schema.
pub(super) fn between(bounds: &Bounds, example: [f64; 2]) -> Value {
    let item = bounds.schema();
    json!({ "between": { "type": "array", "description": "Two bounds.", "items": item, "minItems": 2, "maxItems": 2, "examples": [example] } })
}
