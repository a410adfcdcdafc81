//! The engine file.

use super::bounds::{
    BANK_ANGLE, BURN_DURATION, BURN_START, COMPRESSION_RATIO, FRACTION, FRACTION_OF_CRITICAL, FRICTION, HEAT_CAPACITY_RATIO, MAGNIFIER,
    NOT_NEGATIVE, POSITIVE, PRESSURE_SCALE, SIGNED_ANGLE, WIEBE_EXPONENT,
};
use super::crank::RawCrank;
use super::step::RawStep;
use crate::input::error::At;
use schemars::JsonSchema;
use serde::Deserialize;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("anyOf" = [{ "required": ["geometry"] }, { "properties": { "pressure": { "required": ["harmonics"] } } }]))]
pub(crate) struct RawEngine {
    /// Its name in tables and plots.
    #[schemars(extend("minLength" = 1, "maxLength" = 100, "examples" = ["MWM TD 226-6"]))]
    pub name: At<String>,
    /// Strokes of the cycle.
    #[schemars(extend("enum" = [2, 4], "examples" = [4]))]
    pub strokes: At<i64>,
    /// Keys of this file, with points between those of tables, whose values are those of an example: `check` and `run` name them until they are deleted here.
    #[serde(default)]
    #[schemars(extend("uniqueItems" = true, "examples" = [["geometry.bore_mm", "geometry.piston_mass_kg"]]))]
    pub placeholder: Vec<At<String>>,
    /// What of the moving masses the inertias of the stations leave out: `mean` adds the mean of piston and rod, `none` adds nothing. Without it `none` where all inertias of stations are given, and `mean` for those of throws that follow from dimensions.
    #[schemars(extend("examples" = ["mean"]))]
    pub reciprocating_inertia: Option<At<RawReciprocating>>,
    /// Slider-crank mechanism; required unless the torque comes from harmonics.
    pub geometry: Option<At<RawGeometry>>,
    /// How the cylinders stand and fire.
    pub layout: RawLayout,
    /// Pressure of the gas: a cycle, measured pressure, or harmonics of the torque.
    pub pressure: At<RawPressure>,
    /// Dimensions of the crank, for stiffnesses, masses and fatigue.
    pub crank: Option<At<RawCrank>>,
    /// A mass-elastic table in place of `[[station]]`.
    #[schemars(extend("examples" = [{"file": "chain.csv"}]))]
    pub chain: Option<RawChain>,
    /// Damping of the whole chain, beside that of stations and shafts.
    #[schemars(extend("examples" = [{"fraction_of_critical": 0.01}]))]
    pub damping: Option<RawDamping>,
    /// A station of the chain, from the free end; each leads to the next unless `next` says otherwise.
    #[serde(default)]
    pub station: Vec<RawStation>,
}

/// Damping of the whole chain.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawDamping {
    /// Dynamic magnifier of the shafts: their loss factor is its inverse.
    #[schemars(transform = MAGNIFIER.of_number(), extend("examples" = [30]))]
    pub dynamic_magnifier: Option<At<f64>>,
    /// Fraction of critical damping of the first elastic mode, by shafts whose damping is proportional to their stiffness.
    #[schemars(transform = FRACTION_OF_CRITICAL.of_number(), extend("examples" = [0.01]))]
    pub fraction_of_critical: Option<At<f64>>,
    /// Damping proportional to inertia and stiffness.
    #[schemars(extend("examples" = [{"inertia_per_s": 1, "stiffness_s": 1e-5}]))]
    pub rayleigh: Option<RawRayleigh>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawRayleigh {
    /// Damping over inertia.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [1]))]
    pub inertia_per_s: At<f64>,
    /// Damping over stiffness.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [1e-5]))]
    pub stiffness_s: At<f64>,
}

/// What of the moving masses is part of the chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawReciprocating {
    None,
    Mean,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = [
    { "required": ["rod_rotating_fraction"], "properties": { "rod_centre_from_big_end_mm": false, "rod_inertia_kg_m2": false } },
    { "required": ["rod_centre_from_big_end_mm", "rod_inertia_kg_m2"], "properties": { "rod_rotating_fraction": false } }
]))]
pub(crate) struct RawGeometry {
    /// Bore of the cylinder.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [105]))]
    pub bore_mm: At<f64>,
    /// Crank radius: half the stroke.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [60]))]
    pub crank_radius_mm: At<f64>,
    /// Length of the rod between its eyes.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [192]))]
    pub rod_length_mm: At<f64>,
    /// Piston with pin and rings.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [1.6]))]
    pub piston_mass_kg: At<f64>,
    /// The whole rod.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [2.1]))]
    pub rod_mass_kg: At<f64>,
    /// Share of the rod's mass that rotates; in place of its centre and inertia.
    #[schemars(transform = FRACTION.of_number(), extend("examples" = [0.667]))]
    pub rod_rotating_fraction: Option<At<f64>>,
    /// Centre of gravity of the rod from its big end, with `rod_inertia_kg_m2`.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [60]))]
    pub rod_centre_from_big_end_mm: Option<At<f64>>,
    /// Inertia of the rod about its centre of gravity.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [0.02]))]
    pub rod_inertia_kg_m2: Option<At<f64>>,
    /// Exact motion of the piston, or its first two orders.
    #[serde(default)]
    #[schemars(extend("default" = "exact", "examples" = ["truncated"]))]
    pub kinematics: RawKinematics,
    /// Pressure below the piston, absolute.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("default" = 1, "examples" = [1]))]
    pub crankcase_pressure_bar: Option<At<f64>>,
    /// Friction coefficient of piston and liner.
    #[schemars(transform = FRICTION.of_number(), extend("default" = 0, "examples" = [0.05]))]
    pub liner_friction: Option<At<f64>>,
}

#[derive(Debug, Default, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawKinematics {
    #[default]
    Exact,
    Truncated,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawLayout {
    /// Cylinders in line.
    InLine(RawInLine),
    /// Two banks; two cylinders on each throw.
    V(RawV),
    /// Opposed cylinders, each on its own throw.
    Opposed(RawInLine),
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawInLine {
    /// Cylinders in the order they fire.
    #[schemars(extend("items" = { "type": "integer", "minimum": 1 }, "uniqueItems" = true, "minItems" = 1, "examples" = [[1, 5, 3, 6, 2, 4]]))]
    pub firing_order: At<Vec<At<i64>>>,
    /// Crank angle of each firing, ascending from 0.
    #[schemars(extend("items" = { "type": "number", "minimum": 0, "exclusiveMaximum": 720 }, "minItems" = 1, "examples" = [[0, 120, 240, 360, 480, 600]]))]
    pub firing_deg: At<Vec<At<f64>>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawV {
    /// Angle between the banks.
    #[schemars(transform = BANK_ANGLE.of_number(), extend("examples" = [90]))]
    pub bank_angle_deg: At<f64>,
    /// By how much the second pin of a throw trails the first: positive where the second cylinder fires that much later than the bank angle says.
    #[schemars(transform = SIGNED_ANGLE.of_number(), extend("default" = 0, "examples" = [18]))]
    pub split_pin_deg: Option<At<f64>>,
    /// Cylinders in the order they fire; 2t-1 and 2t are on throw t.
    #[schemars(extend("items" = { "type": "integer", "minimum": 1 }, "uniqueItems" = true, "minItems" = 2, "examples" = [[1, 2, 3, 4]]))]
    pub firing_order: At<Vec<At<i64>>>,
    /// Crank angle of each firing, ascending from 0.
    #[schemars(extend("items" = { "type": "number", "minimum": 0, "exclusiveMaximum": 720 }, "minItems" = 1, "examples" = [[0, 90, 360, 450]]))]
    pub firing_deg: At<Vec<At<f64>>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawPressure {
    /// An ideal cycle, from a torque or power curve.
    Otto(RawOtto),
    /// Burning by Wiebe's law, from mean pressures.
    Wiebe(RawWiebe),
    /// Measured pressure over the whole cycle.
    Measured(RawFile),
    /// Harmonics of the torque of a throw.
    Harmonics(RawHarmonics),
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawOtto {
    /// Ascending speeds of the curve.
    #[schemars(transform = POSITIVE.of_list(), extend("examples" = [[1000, 3000]]))]
    pub speed_rpm: At<Vec<At<f64>>>,
    /// Full-load curve: brake power or torque.
    #[schemars(extend("examples" = [{"torque_n_m": [800, 900]}]))]
    pub curve: RawCurve,
    /// Compression ratio.
    #[schemars(transform = COMPRESSION_RATIO.of_number(), extend("examples" = [16]))]
    pub compression_ratio: At<f64>,
    /// Indicated over brake mean pressure.
    #[schemars(transform = PRESSURE_SCALE.of_number(), extend("examples" = [1.2]))]
    pub pressure_scale: At<f64>,
    /// A further factor at each speed.
    #[schemars(transform = NOT_NEGATIVE.of_list(), extend("examples" = [[1.2, 1.3]]))]
    pub pressure_scale_over_speed: Option<At<Vec<At<f64>>>>,
    /// Pressure at the beginning of compression, absolute.
    #[schemars(transform = POSITIVE.of_number(), extend("default" = 1, "examples" = [1]))]
    pub inlet_pressure_bar: Option<At<f64>>,
    /// Ratio of heat capacities.
    #[schemars(transform = HEAT_CAPACITY_RATIO.of_number(), extend("default" = 1.4, "examples" = [1.35]))]
    pub heat_capacity_ratio: Option<At<f64>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
pub(crate) enum RawCurve {
    /// Brake power at each speed.
    #[serde(rename = "power_kw")]
    #[schemars(transform = NOT_NEGATIVE.of_list(), extend("examples" = [[80, 200]]))]
    Power(At<Vec<At<f64>>>),
    /// Brake torque at each speed.
    #[serde(rename = "torque_n_m")]
    #[schemars(transform = NOT_NEGATIVE.of_list(), extend("examples" = [[800, 900]]))]
    Torque(At<Vec<At<f64>>>),
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawWiebe {
    /// Ascending speeds.
    #[schemars(transform = POSITIVE.of_list(), extend("examples" = [[600, 4000]]))]
    pub speed_rpm: At<Vec<At<f64>>>,
    /// Indicated mean pressure at each speed.
    #[schemars(transform = NOT_NEGATIVE.of_list(), extend("examples" = [[12, 12]]))]
    pub indicated_mean_pressure_bar: At<Vec<At<f64>>>,
    /// Pressure at the beginning of compression, absolute.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [1.5]))]
    pub boost_bar: At<f64>,
    /// Compression ratio.
    #[schemars(transform = COMPRESSION_RATIO.of_number(), extend("examples" = [16]))]
    pub compression_ratio: At<f64>,
    /// Start of burning from firing dead centre.
    #[schemars(transform = BURN_START.of_number(), extend("examples" = [-7]))]
    pub burn_start_deg: At<f64>,
    /// Duration of burning.
    #[schemars(transform = BURN_DURATION.of_number(), extend("examples" = [60]))]
    pub burn_duration_deg: At<f64>,
    /// Wiebe's exponent m.
    #[schemars(transform = WIEBE_EXPONENT.of_number(), extend("default" = 2, "examples" = [2]))]
    pub wiebe_exponent: Option<At<f64>>,
    /// Ratio of heat capacities.
    #[schemars(transform = HEAT_CAPACITY_RATIO.of_number(), extend("default" = 1.35, "examples" = [1.35]))]
    pub heat_capacity_ratio: Option<At<f64>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawHarmonics {
    /// A table of `order`, `amplitude_n_m`, `phase_deg`, and `speed_rpm` where it has several speeds.
    #[schemars(extend("examples" = ["harmonics.csv"]))]
    pub file: At<String>,
    /// What the table holds: the whole torque of a throw, or that of the gas alone.
    #[serde(default)]
    #[schemars(extend("default" = "throw", "examples" = ["gas"]))]
    pub torque: RawTorqueOf,
}

/// What a table of harmonics holds.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawTorqueOf {
    #[default]
    Throw,
    Gas,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawFile {
    /// The table, relative to this file: `crank_deg` over a whole cycle, zero at firing dead centre (negative angles are of the stroke before it), and a column a speed, named like `1600_rpm_bar`, absolute. Torque is linear between speeds, and that of the nearest speed beyond them; one speed is taken for all.
    #[schemars(extend("examples" = ["pressure.csv"]))]
    pub file: At<String>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawChain {
    /// The table, relative to this file: a row a station with `station`, `inertia_kg_m2`, `stiffness_to_next_n_m_per_rad` (empty for the last), `throws` (several with spaces between) and any other key of a station.
    #[schemars(extend("examples" = ["chain.csv"]))]
    pub file: At<String>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawStation {
    /// Its name, once in the chain.
    #[schemars(extend("minLength" = 1, "maxLength" = 100, "pattern" = "^[^\\x00-\\x1f\\x7f]*$", "examples" = ["pulley"]))]
    pub name: At<String>,
    /// Throws that it carries, by number.
    #[serde(default)]
    #[schemars(extend("items" = { "type": "integer", "minimum": 1 }, "default" = [], "examples" = [[1]]))]
    pub throws: Vec<At<i64>>,
    /// Its inertia; without it, what follows from the dimensions of the crank.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [0.05]))]
    pub inertia_kg_m2: Option<At<f64>>,
    /// Stiffness of the shaft to the next station; none after the last.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [900000]))]
    pub stiffness_to_next_n_m_per_rad: Option<At<f64>>,
    /// Damping of the shaft to the next station.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("default" = 0, "examples" = [10]))]
    pub damping_to_next_n_m_s_per_rad: Option<At<f64>>,
    /// Loss factor of the shaft or coupling to the next station: the relative damping psi of its maker over 2 pi. That of `damping.dynamic_magnifier` is added to it.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("default" = 0, "examples" = [0.01]))]
    pub loss_factor_to_next: Option<At<f64>>,
    /// Stiffness to ground.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("default" = 0, "examples" = [0]))]
    pub stiffness_to_ground_n_m_per_rad: Option<At<f64>>,
    /// Damping to ground.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("default" = 0, "examples" = [2]))]
    pub damping_to_ground_n_m_s_per_rad: Option<At<f64>>,
    /// The station it leads to, in place of the one below it.
    #[schemars(extend("examples" = ["flywheel"]))]
    pub next: Option<At<String>>,
    /// Speed of this station over that of the next, negative where they turn in opposite directions, as an outer pair of gears makes them; the stiffness to the next is on this station's shaft, and without one the mesh is rigid.
    #[schemars(extend("anyOf" = [{ "minimum": -1000, "maximum": -0.001 }, { "minimum": 0.001, "maximum": 1000 }], "examples" = [-2.5]))]
    pub gear_ratio_to_next: Option<At<f64>>,
    /// Steps of a plain shaft to the next station, in place of its stiffness.
    #[schemars(extend("examples" = [[{"diameter_mm": 60, "length_mm": 120}]]))]
    pub shaft_to_next: Option<At<Vec<RawStep>>>,
}
