//! A value, two bounds, or a list, as typed.

use crate::input::error::At;
use serde::Deserialize;

#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawRange {
    Fixed(At<f64>),
    Between(At<Vec<At<f64>>>),
    Each(At<Vec<At<f64>>>),
}
