//! Catalogues of absorbers that can be bought, and of what they are made of.

use super::bounds::{BEST, POSITIVE, TOLERANCE};
use super::material_states::{RawGeometry, RawMaterialStates};
use crate::absorber::TYPES;
use crate::absorber::types::parameter_keys;
use crate::input::error::At;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawOnStation {
    /// The station that carries it.
    #[schemars(extend("examples" = ["pulley"]))]
    pub station: At<String>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawCatalogue {
    /// A table with `name`, `type` and the parameters of the types.
    #[schemars(extend("examples" = ["catalogue.csv"]))]
    pub file: At<String>,
    /// The station that carries the absorber.
    #[schemars(extend("examples" = [{"station": "pulley"}]))]
    pub on: RawOnStation,
    /// Ring inertia of every row, where the table has none.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [0.076]))]
    pub ring_inertia_kg_m2: Option<At<f64>>,
    /// What is sheared: with it a row may be a compound (`shear_modulus_mpa`) or an oil (`viscosity_mm2_per_s`, `density_kg_per_m3`) instead of a stiffness or a damping.
    pub geometry: Option<At<RawGeometry>>,
    /// By type how the material of its rows follows temperature, age and strain, and how it cools; what is sheared is the catalogue's `geometry` where it has one.
    #[serde(default)]
    #[schemars(extend("propertyNames" = { "enum": TYPES.map(|t| t.name) }, "examples" = [{"rubber": {"temperature": {"exponential": {"per_k": 0.006, "reference_c": 40, "between_c": [-30, 120]}}}}]))]
    pub material: BTreeMap<String, At<RawMaterialStates>>,
    /// How many are kept as designs.
    #[schemars(transform = BEST.of_number(), extend("examples" = [5]))]
    pub best: At<i64>,
    /// What the maker can vary, by the key of a parameter as a share of the catalogue's value: each of the best is tuned anew within it.
    #[schemars(extend("propertyNames" = { "enum": parameter_keys() }, "additionalProperties" = TOLERANCE.described("Share by which the maker can vary the parameter of this key.", 0.1),
        "examples" = [{"stiffness_n_m_per_rad": 0.3}]))]
    #[serde(default)]
    pub free: BTreeMap<String, At<f64>>,
}
