//! The table of a study that names published numbers.

use super::bounds::POSITIVE;
use crate::input::error::At;
use schemars::JsonSchema;
use serde::Deserialize;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("minProperties" = 2))]
pub(crate) struct RawPublished {
    /// The engine's name in the tables.
    #[schemars(extend("examples" = ["V10"]))]
    pub engine: At<String>,
    /// The publication that the tables are of: studies of one are summed up together.
    #[schemars(extend("examples" = ["Villalva 2014"]))]
    pub source: Option<At<String>>,
    /// Inertias and stiffnesses of the chain.
    #[schemars(extend("examples" = ["published/chain.csv"]))]
    pub chain: Option<At<String>>,
    /// Natural frequencies of the chain.
    #[schemars(extend("examples" = ["published/natural_frequencies.csv"]))]
    pub frequencies: Option<At<String>>,
    /// Natural frequencies of the crank by itself in bending, torsion and axial motion, for an engine with `crank.flexible`.
    #[schemars(extend("examples" = ["published/modes.csv"]))]
    pub modes: Option<At<String>>,
    /// Largest equivalent stresses of von Mises over the cycle at speeds, for an engine with `crank.flexible` and a multiaxial criterion of its fatigue.
    #[schemars(extend("examples" = ["published/von_mises.csv"]))]
    pub von_mises: Option<At<String>>,
    /// Absorbers of the designs.
    #[schemars(extend("examples" = ["published/absorbers.csv"]))]
    pub absorbers: Option<At<String>>,
    /// Amplitudes of orders at speeds.
    #[schemars(extend("examples" = ["published/amplitudes.csv"]))]
    pub amplitudes: Option<At<String>>,
    /// Quantities of the engine.
    #[schemars(extend("examples" = ["published/engines.csv"]))]
    pub engines: Option<At<String>>,
    /// Stresses and safety factors of the designs.
    #[schemars(extend("examples" = ["published/fatigue.csv"]))]
    pub fatigue: Option<At<String>>,
    /// Stresses of critical points.
    #[schemars(extend("examples" = ["published/stresses.csv"]))]
    pub stresses: Option<At<String>>,
    /// Stress concentration factors.
    #[schemars(extend("examples" = ["published/factors.csv"]))]
    pub factors: Option<At<String>>,
    /// Multiaxial safety factors.
    #[schemars(extend("examples" = ["published/multiaxial.csv"]))]
    pub multiaxial: Option<At<String>>,
    /// Invariants of stress histories.
    #[schemars(extend("examples" = ["published/histories.csv"]))]
    pub histories: Option<At<String>>,
    /// Critical planes of points.
    #[schemars(extend("examples" = ["published/planes.csv"]))]
    pub planes: Option<At<String>>,
    /// Designs that the publication recommends, with where it does so and why.
    #[schemars(extend("examples" = ["published/choices.csv"]))]
    pub choices: Option<At<String>>,
    /// Deviations that are within tolerance.
    #[serde(default)]
    #[schemars(extend("examples" = [{"frequency": 1}]))]
    pub tolerance_percent: RawTolerances,
}

#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawTolerances {
    /// Of natural frequencies.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [1]))]
    pub frequency: Option<At<f64>>,
    /// Of critical speeds.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [1]))]
    pub critical_speed: Option<At<f64>>,
    /// Of stiffnesses of absorbers.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [2]))]
    pub stiffness: Option<At<f64>>,
    /// Of dampings of absorbers.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [2]))]
    pub damping: Option<At<f64>>,
    /// Of amplitudes, the median.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [10]))]
    pub amplitude_median: Option<At<f64>>,
    /// Of amplitudes, the worst.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [30]))]
    pub amplitude_worst: Option<At<f64>>,
    /// Of safety factors.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [10]))]
    pub safety_factor: Option<At<f64>>,
    /// Of multiaxial safety factors.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [5]))]
    pub multiaxial_factor: Option<At<f64>>,
}
