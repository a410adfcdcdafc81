//! The flexible crank in an engine file.

use super::bounds::{BEARING_STIFFNESS, DAMPING_TIME, LOOSE_RATIO, LOSS_FACTOR, NOT_NEGATIVE, OIL_PRESSURE, POSITIVE, REACH, WEB_FACTOR};
use super::step::RawStep;
use crate::input::error::At;
use schemars::JsonSchema;
use serde::Deserialize;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawFlexible {
    /// How much stiffer webs are than beams from axis to axis: estimated from the dimensions, or given. Required without `matrices`.
    #[schemars(extend("examples" = ["estimate"]))]
    pub web_factors: Option<RawWebFactors>,
    /// In place of beams: the crank by the matrices of a finite-element program, free, with hub and flywheel, without rods, reduced to points of its bearings, its pins and both ends.
    pub matrices: Option<At<RawMatrices>>,
    /// Density of the crank; without it that of `masses`.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [7850]))]
    pub density_kg_m3: Option<At<f64>>,
    /// Loss factor of the crank: its stiffness is k (1 + i eta).
    #[schemars(transform = LOSS_FACTOR.of_number(), extend("examples" = [0.01]))]
    pub loss_factor: At<f64>,
    /// Whether gyroscopic and centrifugal terms count. With `matrices` it asks for `gyroscopic` and `turning`.
    #[schemars(extend("default" = true, "examples" = [false]))]
    pub rotating: Option<bool>,
    /// Every main bearing.
    pub bearing: RawBearing,
    /// The bearing that holds the crank along its axis.
    pub thrust_bearing: RawThrust,
    /// What is before the first main bearing.
    pub front: Option<RawEnd>,
    /// What is behind the last main bearing.
    pub rear: Option<RawEnd>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawWebFactors {
    /// By a fit to 48 throws of solid finite elements: 10 % (root of the mean square), 31 % at most.
    Estimate,
    /// As given, for instance fitted to a throw of finite elements.
    Given(RawGivenFactors),
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawGivenFactors {
    /// On the stiffness in bending in the plane of the throw.
    #[schemars(transform = WEB_FACTOR.of_number(), extend("examples" = [5.05]))]
    pub bending: At<f64>,
    /// On the stiffness in twisting.
    #[schemars(transform = WEB_FACTOR.of_number(), extend("examples" = [10.07]))]
    pub twist: At<f64>,
    /// On the stiffness in bending about the axis of the crank.
    #[schemars(transform = WEB_FACTOR.of_number(), extend("examples" = [1.05]))]
    pub edge: At<f64>,
}

/// Files relative to the engine file, in any format that `hartog matrices` reads.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawMatrices {
    /// Stiffness of the free crank.
    #[schemars(extend("examples" = ["crank_stiffness.mtx"]))]
    pub stiffness: At<String>,
    /// Mass, over the same unknowns.
    #[schemars(extend("examples" = ["crank_mass.mtx"]))]
    pub mass: At<String>,
    /// Gyroscopic matrix of turning axes, per rad/s.
    #[schemars(extend("examples" = ["crank_gyroscopic.mtx"]))]
    pub gyroscopic: Option<At<String>>,
    /// Centrifugal matrix of turning axes with the stiffness of tension, per rad²/s².
    #[schemars(extend("examples" = ["crank_turning.mtx"]))]
    pub turning: Option<At<String>>,
    /// A line an unknown, `node.component`; where the matrices do not name them themselves.
    #[schemars(extend("examples" = ["unknowns.dof"]))]
    pub dof: Option<At<String>>,
    /// Places of the nodes: columns node, x, y, z.
    #[schemars(extend("examples" = ["nodes.csv"]))]
    pub nodes: At<String>,
    /// Units of all of them: m, kg and N, or mm, t and N.
    #[schemars(extend("examples" = ["mm_t"]))]
    pub units: RawMatrixUnits,
    /// Along which axis the crank lies, from the hub to the flywheel.
    #[serde(default)]
    #[schemars(extend("default" = "z", "examples" = ["x"]))]
    pub axis: RawCrankAxis,
    /// Node in the middle of the hub.
    #[schemars(extend("minimum" = 1, "examples" = [1]))]
    pub hub: At<i64>,
    /// Node in the middle of the flywheel.
    #[schemars(extend("minimum" = 1, "examples" = [90]))]
    pub flywheel: At<i64>,
    /// Of each throw in turn, the node of its pin, or those of its rods.
    #[schemars(extend("minItems" = 1, "examples" = [[[8], [20]]]))]
    pub pins: At<Vec<Vec<i64>>>,
    /// Of each main journal in turn an odd number of nodes along it, the middle one in its middle; where `missing_bearings` leaves a bearing out they carry nothing.
    #[schemars(extend("minItems" = 2, "examples" = [[[2, 3, 4], [14, 15, 16], [26, 27, 28]]]))]
    pub journals: At<Vec<Vec<i64>>>,
}

#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawMatrixUnits {
    /// m, kg, N, s.
    Si,
    /// mm, t, N, s.
    MmT,
}

#[derive(Debug, Clone, Copy, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawCrankAxis {
    X,
    Y,
    #[default]
    Z,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawBearing {
    /// Stiffness across the axis, alike in all directions; without it and `exponential` `crank.bearing_stiffness_n_per_m`.
    #[schemars(transform = BEARING_STIFFNESS.of_number(), extend("examples" = [1.2e9]))]
    pub stiffness_n_per_m: Option<At<f64>>,
    /// Damping across the axis; required without `exponential`.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [9e4]))]
    pub damping_n_s_per_m: Option<At<f64>>,
    /// In place of both: bearings that stiffen with the displacement of the journal. Searches and tables use the linear bearings nearest to them over cycles without absorber, and what they find is computed on the law itself by harmonic balance.
    pub exponential: Option<At<RawExponential>>,
    /// Points along the journal that share it: its middle, or three over two thirds of its length; with `matrices` those have them.
    #[schemars(extend("enum" = [1, 3], "default" = 3, "examples" = [1]))]
    pub nodes: Option<At<i64>>,
}

/// With r the displacement over the reach, stiffness k_0 (k_f/k_0)^r and damping c_0 (c_f/c_0)^r.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawExponential {
    /// Pressure of the oil over the journal (length times diameter) at the reach: with it the stiffness there, k_f.
    #[schemars(transform = OIL_PRESSURE.of_number(), extend("examples" = [40]))]
    pub pressure_mpa: At<f64>,
    /// Reach of the law over the diameter of the journal.
    #[schemars(transform = REACH.of_number(), extend("examples" = [5e-4]))]
    pub clearance_ratio: At<f64>,
    /// Stiffness in the middle over that at the reach, k_0/k_f.
    #[schemars(transform = LOOSE_RATIO.of_number(), extend("examples" = [0.01]))]
    pub loose_stiffness: At<f64>,
    /// Damping over stiffness at the reach, c_f/k_f.
    #[schemars(transform = DAMPING_TIME.of_number(), extend("examples" = [1e-4]))]
    pub damping_time_s: At<f64>,
    /// Damping in the middle over that at the reach, c_0/c_f.
    #[schemars(transform = LOOSE_RATIO.of_number(), extend("examples" = [0.1]))]
    pub loose_damping: At<f64>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawThrust {
    /// Number of the main bearing, from 1.
    #[schemars(extend("minimum" = 1, "examples" = [4]))]
    pub bearing: At<i64>,
    /// Stiffness along the axis.
    #[schemars(transform = BEARING_STIFFNESS.of_number(), extend("examples" = [5e8]))]
    pub stiffness_n_per_m: At<f64>,
    /// Damping along the axis.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [1e5]))]
    pub damping_n_s_per_m: At<f64>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawEnd {
    /// Steps of the shaft, from the end of the outer journal to the middle of the hub or flywheel.
    #[schemars(extend("minItems" = 1, "examples" = [[{"diameter_mm": 60, "length_mm": 70}]]))]
    pub shaft: At<Vec<RawStep>>,
    /// Mass of the hub or flywheel.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [8]))]
    pub mass_kg: At<f64>,
    /// Its inertia about a diameter; without it half that of its station, as of a thin disc.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [0.03]))]
    pub diametral_inertia_kg_m2: Option<At<f64>>,
    /// The ring of an absorber, which the hub or flywheel carries across the axis and in tilting, not in rotation about it; the same for every design. Without it rings have no mass but in rotation.
    pub ring: Option<RawCarriedRing>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawCarriedRing {
    /// Mass of the ring.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [5]))]
    pub mass_kg: At<f64>,
    /// Its inertia about the axis, which stiffens tilting while the crank turns.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [0.076]))]
    pub polar_inertia_kg_m2: At<f64>,
    /// Its inertia about a diameter; without it half of that about the axis, as of a thin ring.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [0.04]))]
    pub diametral_inertia_kg_m2: Option<At<f64>>,
}
