//! The study file.

use super::absorber::{RawAbsorber, RawOptimised};
use super::bounds::{
    BURN_DURATION, BURN_START, COMBUSTION, COMPRESSION_RATIO, FITTED_BOOST, FITTED_DAMPING, FITTED_LOSS_FACTOR, FITTED_PRESSURE_SCALE,
    HEAT_CAPACITY_RATIO, LOAD, ORDER_LIMIT, POINTS_OF_FRONT, POSITIVE, RANDOM_STARTS, RELATIVE_ERROR, SEED, SHARE_OF_TIME, WIEBE_EXPONENT,
};
use super::catalogue::RawCatalogue;
use super::fatigue::RawFatigue;
use super::keyword::by_word;
use super::material_states::RawTemperatures;
use super::measure::RawMeasure;
use super::prove::RawProveOptima;
use super::published::RawPublished;
use super::range::{RawBounds, RawRange, between};
use super::robust::RawRobust;
use crate::input::error::At;
use crate::objective::Condition;
use schemars::JsonSchema;
use serde::Deserialize;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend(
    "dependentRequired" = { "pareto": ["optimise"] },
    "anyOf" = [{ "required": ["design"] }, { "required": ["catalogue"] }, { "required": ["optimise"] }],
    "not" = { "required": ["part_load", "load_fraction"] }
))]
pub(crate) struct RawStudy {
    /// The engine file, relative to the study.
    #[schemars(extend("examples" = ["engine.toml"]))]
    pub engine: At<String>,
    /// Keys of this file, with points between those of tables, whose values are those of an example: `check` and `run` name them until they are deleted here.
    #[serde(default)]
    #[schemars(extend("uniqueItems" = true, "examples" = [["speed_rpm"]]))]
    pub placeholder: Vec<At<String>>,
    /// The speeds of the sweep.
    #[schemars(extend("examples" = [{"from": 600, "to": 3200, "step": 10}]))]
    pub speed_rpm: At<RawSpeeds>,
    /// Highest order of the torque that is taken.
    #[schemars(transform = ORDER_LIMIT.of_number(), extend("default" = 12, "examples" = [12]))]
    pub order_limit: Option<At<f64>>,
    /// Share of the full-load mean pressure, at all speeds.
    #[schemars(transform = LOAD.of_number(), extend("default" = 1, "examples" = [0.75]))]
    pub load_fraction: Option<At<f64>>,
    /// Share of the full-load mean pressure over speed, in place of `load_fraction`.
    #[schemars(extend("examples" = [{"speed_rpm": [600, 3200], "fraction": [0.2, 0.8]}]))]
    pub part_load: Option<At<RawPartLoad>>,
    /// Speeds and loads of the engine's use with their shares of time, for means beside the worst case.
    #[serde(default)]
    pub duty: Vec<RawDuty>,
    /// Conditions in which every design is computed beside normal firing. Without `[optimise]` limits are to hold in them, too, but for a locked or lost absorber; with it in its own `conditions`.
    #[schemars(extend("minItems" = 1, "uniqueItems" = true, "examples" = [["misfire", "hot"]]))]
    pub conditions: Option<At<Vec<At<RawCondition>>>>,
    /// How cylinders differ, for the condition `unequal_cylinders`.
    #[schemars(extend("examples" = [{"combustion": [0.05, -0.05, 0.02, -0.02, 0.03, -0.03]}]))]
    pub scatter: Option<At<RawScatter>>,
    /// Temperatures of the conditions `cold` and `hot`.
    #[schemars(extend("examples" = [{"cold_c": -20, "hot_c": 90}]))]
    pub temperatures: Option<RawTemperatures>,
    /// Files of compounds and oils of one's own, relative to the study, beside those that hartog carries.
    #[serde(default)]
    #[schemars(extend("uniqueItems" = true, "examples" = [["compounds.toml"]]))]
    pub compounds: Vec<At<String>>,
    /// What of the crank the response is computed with: its torsional chain, or the flexible crank of the engine file; `auto`: the chain where the measured difference is below `response.tolerance`.
    #[schemars(extend("default" = "chain", "examples" = ["flexible"]))]
    pub crank: Option<At<RawCrankModel>>,
    /// How the response is computed.
    #[serde(default)]
    pub response: RawResponse,
    /// A given design: a name and its absorbers.
    #[serde(default)]
    pub design: Vec<RawDesign>,
    /// Absorbers one can buy: all are judged, the best are kept as designs.
    #[serde(default)]
    pub catalogue: Vec<RawCatalogue>,
    /// What is minimised (a margin: maximised); the first is the main one. Without any: the synthesised twist from the first to the last station.
    #[serde(default)]
    #[schemars(extend("examples" = [[{"peak_twist": {"from": "pulley", "to": "flywheel"}}]]))]
    pub objective: Vec<At<RawMeasure>>,
    /// A measure with a limit that every optimum holds.
    #[serde(default)]
    #[schemars(extend("examples" = [[{"dissipated_power": {"max_w": 150}}]]))]
    pub constraint: Vec<At<RawMeasure>>,
    /// Families of absorbers that are optimised.
    pub optimise: Option<RawOptimise>,
    /// Tolerances within which a design is to be good.
    #[schemars(extend("examples" = [{"tolerance": {"stiffness_n_m_per_rad": 0.1, "damping_n_m_s_per_rad": 0.3}}]))]
    pub robust: Option<At<RawRobust>>,
    /// A front of two or three measures, or of the objective against the size of the ring.
    #[schemars(extend("examples" = [{"points": 40, "of": ["peak_twist", "margin"]}]))]
    pub pareto: Option<At<RawPareto>>,
    /// Printed tables that results are compared with by `hartog compare`.
    pub published: Option<At<RawPublished>>,
    /// Inputs of the engine that are fitted to measured amplitudes.
    pub calibrate: Option<At<RawCalibrate>>,
    /// How the margin of the crank is judged.
    pub fatigue: Option<At<RawFatigue>>,
}

/// A condition by its word: the words are those of the conditions themselves.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RawCondition(pub Condition);

by_word!(RawCondition, "Condition", Condition::NAMED, Condition::name, Self);

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawScatter {
    /// Deviation of the gas torque of each cylinder, as a share; one a cylinder.
    #[schemars(transform = COMBUSTION.of_list(), extend("examples" = [[0.05, -0.05, 0.02, -0.02]]))]
    pub combustion: At<Vec<At<f64>>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSpeeds {
    /// Lowest speed.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [600]))]
    pub from: At<f64>,
    /// Highest speed; it is one of the sweep whatever the step.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [3200]))]
    pub to: At<f64>,
    /// Step of the sweep.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [10]))]
    pub step: At<f64>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawPartLoad {
    /// Ascending speeds; linear between them.
    #[schemars(transform = POSITIVE.of_list(), extend("minItems" = 1, "examples" = [[600, 3200]]))]
    pub speed_rpm: At<Vec<At<f64>>>,
    /// Share of the full-load mean pressure at each speed.
    #[schemars(transform = LOAD.of_list(), extend("minItems" = 1, "examples" = [[0.2, 0.8]]))]
    pub fraction: At<Vec<At<f64>>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawDuty {
    /// A speed of the study.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [1800]))]
    pub speed_rpm: At<f64>,
    /// Share of the full-load mean pressure.
    #[schemars(transform = LOAD.of_number(), extend("examples" = [0.6]))]
    pub load_fraction: At<f64>,
    /// Share of time; all shares add up to 1.
    #[schemars(transform = SHARE_OF_TIME.of_number(), extend("examples" = [0.25]))]
    pub share: At<f64>,
}

#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawResponse {
    /// How the response to each order is found; `auto` takes receptance where it is exact.
    #[serde(default)]
    #[schemars(extend("default" = "auto", "examples" = ["direct"]))]
    pub method: RawMethod,
    /// Relative error that searches may leave; what is reported is exact.
    #[schemars(transform = RELATIVE_ERROR.of_number(), extend("default" = 0.001, "examples" = [0.001]))]
    pub tolerance: Option<At<f64>>,
    /// Whether peaks are sought between the speeds of the sweep.
    #[schemars(extend("default" = true, "examples" = [true]))]
    pub refine_peaks: Option<bool>,
    /// Whether `response.csv` has the amplitude of every station and the torque of every shaft, order by order; without it single orders of the twist and of the hub, and all else by its sum.
    #[serde(default)]
    #[schemars(extend("default" = false, "examples" = [true]))]
    pub every_station: bool,
}

#[derive(Debug, Default, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawMethod {
    Receptance,
    Direct,
    #[default]
    Auto,
}

/// What of the crank counts.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawCrankModel {
    #[default]
    Chain,
    Flexible,
    Auto,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawDesign {
    /// Its name in tables and plots.
    #[schemars(extend("pattern" = "^(?!optimum_)[A-Za-z0-9_][A-Za-z0-9_.-]*$", "examples" = ["tuned"]))]
    pub name: At<String>,
    /// An absorber of the design; without any the bare engine.
    #[serde(default)]
    pub absorber: Vec<RawAbsorber>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawOptimise {
    /// Seed of the random starts.
    #[schemars(transform = SEED.of_number(), extend("default" = 1, "examples" = [1]))]
    pub seed: Option<At<i64>>,
    /// Random starts beside those of closed forms.
    #[schemars(transform = RANDOM_STARTS.of_number(), extend("default" = 4, "examples" = [8]))]
    pub random_starts: Option<At<i64>>,
    /// Conditions in which the optimum has to be good: the worst one counts.
    #[schemars(extend("minItems" = 1, "uniqueItems" = true, "default" = ["firing"], "examples" = [["firing", "misfire"]]))]
    pub conditions: Option<At<Vec<At<RawCondition>>>>,
    /// Whether the optimum is searched at the temperature and strain of operation, too, where a material says how these follow the motion. Without it that is so under limits only, as it takes longer, and under limits it cannot be left out; every design is reported in operation either way.
    #[schemars(extend("default" = false, "examples" = [true]))]
    pub in_operation: Option<At<bool>>,
    /// Whether it is told what each condition, limit and bound (but of sizes and dimensions) of the study costs: the optimum of each type is sought again without it, and with half of the ring, in as many searches.
    #[schemars(extend("default" = false, "examples" = [true]))]
    pub prices: Option<bool>,
    /// How closely it is proved that no design within the bounds is better, and how much that may cost. Without it the optima of one absorber of the first size of each type are proved to a gap of 0.001; with it all.
    #[schemars(extend("examples" = [{"gap": 1e-4, "boxes": 1_000_000, "file": true}]))]
    pub prove: Option<At<RawProveOptima>>,
    /// A family of absorbers; with several, all are in the design at once.
    pub absorber: At<Vec<RawOptimised>>,
    /// Several objectives as one, in units of their targets.
    #[schemars(extend("examples" = [{"of": ["peak_twist", "margin"], "targets": [0.4, 2]}]))]
    pub combined: Option<At<RawCombined>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawCombined {
    /// Objectives by their words, two or more.
    #[schemars(extend("minItems" = 2, "uniqueItems" = true, "examples" = [["peak_twist", "dissipated_power"]]))]
    pub of: At<Vec<At<String>>>,
    /// A target for each, in its unit.
    #[schemars(transform = POSITIVE.of_list(), extend("examples" = [[0.4, 150]]))]
    pub targets: At<Vec<At<f64>>>,
    /// With them the weighted sum counts; without, the largest.
    #[schemars(transform = POSITIVE.of_list(), extend("examples" = [[1, 0.5]]))]
    pub weights: Option<At<Vec<At<f64>>>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = [{ "required": ["against"] }, { "required": ["of"] }]))]
pub(crate) struct RawPareto {
    /// Points of each front.
    #[schemars(transform = POINTS_OF_FRONT.of_number(), extend("examples" = [40]))]
    pub points: At<i64>,
    /// Smallest and largest size of the ring, for a front of the objective against size.
    #[schemars(extend("examples" = [{"ring_inertia_kg_m2": [0.01, 0.2]}]))]
    pub against: Option<RawAgainst>,
    /// Two or three objectives by their words.
    #[schemars(extend("minItems" = 2, "maxItems" = 3, "uniqueItems" = true, "examples" = [["peak_twist", "margin"]]))]
    pub of: Option<At<Vec<At<String>>>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawAgainst {
    /// Smallest and largest inertia of the ring.
    #[serde(rename = "ring_inertia_kg_m2")]
    #[schemars(transform = POSITIVE.of_list(), extend("minItems" = 2, "maxItems" = 2, "examples" = [[0.01, 0.2]]))]
    RingInertia(At<Vec<At<f64>>>),
    /// Smallest and largest inertia of the ring over the one that `engine_inertia` of its absorber names.
    #[schemars(transform = POSITIVE.of_list(), extend("minItems" = 2, "maxItems" = 2, "examples" = [[0.01, 0.2]]))]
    InertiaRatio(At<Vec<At<f64>>>),
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("minProperties" = 2))]
pub(crate) struct RawCalibrate {
    /// Designs whose printed amplitudes are fitted.
    #[schemars(extend("minItems" = 1, "uniqueItems" = true, "examples" = [["none"]]))]
    pub designs: At<Vec<At<String>>>,
    /// Printed amplitudes that are left out.
    #[serde(default)]
    #[schemars(extend("examples" = [[{"design": "none", "order": 6, "speed_rpm": 2000}]]))]
    pub exclude: Vec<At<RawExcluded>>,
    /// Inputs that were fitted by hand before, named as such in tables.
    #[schemars(extend("examples" = [["throw_damping"]]))]
    pub tuned_by_hand: Option<At<Vec<At<String>>>>,
    /// Bounds of the factor on the pressure.
    #[schemars(with = "Option<RawBounds>", extend("properties" = between(&FITTED_PRESSURE_SCALE, [0.5, 2.0]), "examples" = [{"between": [0.5, 2]}]))]
    pub pressure_scale: Option<At<RawRange>>,
    /// Bounds of the compression ratio.
    #[schemars(with = "Option<RawBounds>", extend("properties" = between(&COMPRESSION_RATIO, [8.0, 20.0]), "examples" = [{"between": [8, 20]}]))]
    pub compression_ratio: Option<At<RawRange>>,
    /// Bounds of the ratio of heat capacities.
    #[schemars(with = "Option<RawBounds>", extend("properties" = between(&HEAT_CAPACITY_RATIO, [1.25, 1.4]), "examples" = [{"between": [1.25, 1.4]}]))]
    pub heat_capacity_ratio: Option<At<RawRange>>,
    /// Bounds of the inlet pressure.
    #[schemars(with = "Option<RawBounds>", extend("properties" = between(&FITTED_BOOST, [1.0, 3.0]), "examples" = [{"between": [1, 3]}]))]
    pub boost_bar: Option<At<RawRange>>,
    /// Bounds of the start of burning.
    #[schemars(with = "Option<RawBounds>", extend("properties" = between(&BURN_START, [-15.0, 5.0]), "examples" = [{"between": [-15, 5]}]))]
    pub burn_start_deg: Option<At<RawRange>>,
    /// Bounds of the duration of burning.
    #[schemars(with = "Option<RawBounds>", extend("properties" = between(&BURN_DURATION, [40.0, 90.0]), "examples" = [{"between": [40, 90]}]))]
    pub burn_duration_deg: Option<At<RawRange>>,
    /// Bounds of Wiebe's exponent.
    #[schemars(with = "Option<RawBounds>", extend("properties" = between(&WIEBE_EXPONENT, [0.5, 3.0]), "examples" = [{"between": [0.5, 3]}]))]
    pub wiebe_exponent: Option<At<RawRange>>,
    /// Bounds of the damping to ground at the throws.
    #[schemars(with = "Option<RawBounds>", extend("properties" = between(&FITTED_DAMPING, [0.1, 20.0]), "examples" = [{"between": [0.1, 20]}]))]
    pub throw_damping_n_m_s_per_rad: Option<At<RawRange>>,
    /// Bounds of the damping of the shafts.
    #[schemars(with = "Option<RawBounds>", extend("properties" = between(&FITTED_DAMPING, [0.1, 100.0]), "examples" = [{"between": [0.1, 100]}]))]
    pub shaft_damping_n_m_s_per_rad: Option<At<RawRange>>,
    /// Bounds of the loss factor of the shafts.
    #[schemars(with = "Option<RawBounds>", extend("properties" = between(&FITTED_LOSS_FACTOR, [0.001, 0.05]), "examples" = [{"between": [0.001, 0.05]}]))]
    pub shaft_loss_factor: Option<At<RawRange>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawExcluded {
    /// Design it is of.
    #[schemars(extend("examples" = ["none"]))]
    pub design: At<String>,
    /// Its order of the torque.
    #[schemars(extend("examples" = [6]))]
    pub order: At<f64>,
    /// Speed of the engine.
    #[schemars(extend("examples" = [2000]))]
    pub speed_rpm: At<f64>,
}
