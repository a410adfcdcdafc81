//! The sizing file.

use super::absorber::RawKind;
use super::bounds::{
    BORE_TO_STROKE, CRANK_TO_ROD, EYE_RATIO, FRACTION_OF_EACH_MODE, FRICTION, INERTIA, LENGTH_MM, NOT_NEGATIVE, POINTS_OF_SIZING, POSITIVE,
    SAFETY_FACTOR, TEMPERATURE_OF_STEEL,
};
use super::crank::RawFormula;
use super::engine::{RawLayout, RawPressure};
use super::fatigue::RawSurface;
use super::study::RawSpeeds;
use crate::fatigue::endurance::RELIABILITIES;
use crate::input::error::At;
use schemars::JsonSchema;
use serde::Deserialize;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("dependentRequired" = { "front": ["absorber"] }))]
pub(crate) struct RawSizing {
    /// Its name in tables and plots.
    #[schemars(extend("minLength" = 1, "maxLength" = 100, "examples" = ["four in line"]))]
    pub name: At<String>,
    /// Strokes of the cycle.
    #[schemars(extend("enum" = [2, 4], "examples" = [4]))]
    pub strokes: At<i64>,
    /// Speeds at which every part has to hold.
    #[schemars(extend("examples" = [{"from": 1000, "to": 6000, "step": 500}]))]
    pub speed_rpm: At<RawSpeeds>,
    /// Safety factor of the sizes.
    #[schemars(transform = SAFETY_FACTOR.of_number(), extend("examples" = [2]))]
    pub design_factor: At<f64>,
    /// Safety factor against buckling of the rod.
    #[schemars(transform = SAFETY_FACTOR.of_number(), extend("examples" = [3]))]
    pub buckling_factor: At<f64>,
    /// Reliability, one of the tabulated values.
    #[schemars(extend("enum" = RELIABILITIES, "examples" = [99]))]
    pub reliability_percent: At<f64>,
    /// Torque of the crank: of a rigid shaft, or of the torsional response.
    #[schemars(extend("examples" = ["response"]))]
    pub torsion: At<RawTorsion>,
    /// Bending of the crank between the bearings of a throw, or over all bearings.
    #[schemars(extend("examples" = ["own_bearings"]))]
    pub bending: RawBending,
    /// Slider-crank mechanism.
    pub mechanism: RawMechanism,
    /// How the cylinders stand and fire.
    pub layout: RawLayout,
    /// Pressure of the gas.
    pub pressure: At<RawPressure>,
    /// Materials of the parts.
    pub material: RawMaterials,
    /// Places and loads of the bearings.
    pub bearings: RawBearings,
    /// Dimensions that are given, not found.
    #[serde(default)]
    pub given: RawGiven,
    /// The torsional chain round the crank.
    pub chain: RawSizedChain,
    /// An absorber that is optimised with the crank.
    #[schemars(extend("examples" = [{"type": "tuned", "ring_inertia_kg_m2": 0.02}]))]
    pub absorber: Option<At<RawSizedAbsorber>>,
    /// Sizes of the crank against that of the ring.
    #[schemars(extend("examples" = [{"ring_inertia_kg_m2": [0.005, 0.05], "points": 10}]))]
    pub front: Option<At<RawSizingFront>>,
    /// Printed rounds that the sizes are compared with.
    #[schemars(extend("examples" = ["published/rounds.csv"]))]
    pub published: Option<At<String>>,
    /// Worked examples of books, inputs and results, that the functions of sizing are compared with by `hartog compare`.
    #[schemars(extend("examples" = ["published/examples.csv"]))]
    pub worked_examples: Option<At<String>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawTorsion {
    Rigid,
    Response,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawBending {
    OwnBearings,
    AllBearings,
}

/// What sets the stroke.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawBasis {
    /// The stroke.
    #[schemars(transform = LENGTH_MM.of_number(), extend("examples" = [90]))]
    StrokeMm(At<f64>),
    /// Displacement of the engine.
    #[serde(rename = "displacement_cm3")]
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [1600]))]
    DisplacementCm3(At<f64>),
    /// Brake power with its mean effective pressure.
    Power(RawPower),
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawPower {
    /// Brake power.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [60]))]
    pub power_kw: At<f64>,
    /// Brake mean effective pressure.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [9]))]
    pub mean_effective_pressure_bar: At<f64>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawMechanism {
    /// What sets the stroke.
    #[schemars(extend("examples" = [{"stroke_mm": 90}]))]
    pub basis: At<RawBasis>,
    /// Bore over stroke.
    #[schemars(transform = BORE_TO_STROKE.of_number(), extend("examples" = [1]))]
    pub bore_to_stroke: At<f64>,
    /// Crank radius over length of the rod.
    #[schemars(transform = CRANK_TO_ROD.of_number(), extend("examples" = [0.27]))]
    pub crank_to_rod: At<f64>,
    /// Piston with pin and rings.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [0.5]))]
    pub piston_mass_kg: At<f64>,
    /// Friction coefficient of piston and liner.
    #[schemars(transform = FRICTION.of_number(), extend("examples" = [0.05]))]
    pub liner_friction: At<f64>,
    /// Pressure below the piston, absolute.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [1]))]
    pub crankcase_pressure_bar: At<f64>,
    /// Radius of all fillets.
    #[schemars(transform = LENGTH_MM.of_number(), extend("examples" = [3]))]
    pub fillet_radius_mm: At<f64>,
    /// Clearance between pin and eye.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [1]))]
    pub eye_clearance_mm: At<f64>,
    /// Least ratio of outer to inner diameter of an eye.
    #[schemars(transform = EYE_RATIO.of_number(), extend("examples" = [1.2]))]
    pub least_eye_ratio: At<f64>,
    /// Density of the rod.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [7850]))]
    pub density_kg_m3: At<f64>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawMaterials {
    /// Material of the piston pin.
    pub piston_pin: RawPart,
    /// Material of the rod.
    pub rod: RawPart,
    /// Material of the crank.
    pub crank: RawPart,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawPart {
    /// Tensile strength.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [900]))]
    pub tensile_strength_mpa: At<f64>,
    /// Yield strength.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [650]))]
    pub yield_strength_mpa: At<f64>,
    /// Yield strength in shear.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [375]))]
    pub shear_yield_strength_mpa: At<f64>,
    /// Finish of the surface.
    #[schemars(extend("examples" = ["machined"]))]
    pub surface: RawSurface,
    /// Temperature of the part.
    #[schemars(transform = TEMPERATURE_OF_STEEL.of_number(), extend("examples" = [90]))]
    pub temperature_c: At<f64>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawBearings {
    /// From the bearing before a throw to its middle.
    #[schemars(transform = LENGTH_MM.of_number(), extend("examples" = [50]))]
    pub before_throw_mm: At<f64>,
    /// From the middle of a throw to the bearing after it.
    #[schemars(transform = LENGTH_MM.of_number(), extend("examples" = [50]))]
    pub after_throw_mm: At<f64>,
    /// From the last bearing to the flywheel.
    #[schemars(transform = LENGTH_MM.of_number(), extend("examples" = [60]))]
    pub before_flywheel_mm: At<f64>,
    /// From the flywheel to the bearing after it.
    #[schemars(transform = LENGTH_MM.of_number(), extend("examples" = [40]))]
    pub after_flywheel_mm: At<f64>,
    /// Weight of the flywheel.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [150]))]
    pub flywheel_weight_n: At<f64>,
    /// Tension of the belt at the pulley.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [300]))]
    pub belt_tension_n: At<f64>,
}

#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawGiven {
    /// Diameter of the piston pin.
    #[schemars(transform = LENGTH_MM.of_number(), extend("examples" = [22]))]
    pub pin_diameter_mm: Option<At<f64>>,
    /// Thickness of the rod's shank.
    #[schemars(transform = LENGTH_MM.of_number(), extend("examples" = [5]))]
    pub shank_thickness_mm: Option<At<f64>>,
    /// Outer over inner diameter of the small eye.
    #[schemars(transform = EYE_RATIO.of_number(), extend("examples" = [1.4]))]
    pub small_eye_ratio: Option<At<f64>>,
    /// Outer over inner diameter of the big eye.
    #[schemars(transform = EYE_RATIO.of_number(), extend("examples" = [1.3]))]
    pub big_eye_ratio: Option<At<f64>>,
    /// Diameter of the crankpin.
    #[schemars(transform = LENGTH_MM.of_number(), extend("examples" = [45]))]
    pub crankpin_diameter_mm: Option<At<f64>>,
    /// Length of the crankpin.
    #[schemars(transform = LENGTH_MM.of_number(), extend("examples" = [28]))]
    pub crankpin_length_mm: Option<At<f64>>,
    /// Diameter of the journal.
    #[schemars(transform = LENGTH_MM.of_number(), extend("examples" = [50]))]
    pub journal_diameter_mm: Option<At<f64>>,
    /// Thickness of the webs.
    #[schemars(transform = LENGTH_MM.of_number(), extend("examples" = [16]))]
    pub web_thickness_mm: Option<At<f64>>,
    /// Breadth of the webs.
    #[schemars(transform = LENGTH_MM.of_number(), extend("examples" = [70]))]
    pub web_breadth_mm: Option<At<f64>>,
    /// Diameter of the flywheel's seat.
    #[schemars(transform = LENGTH_MM.of_number(), extend("examples" = [40]))]
    pub seat_diameter_mm: Option<At<f64>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSizedChain {
    /// Inertia of the pulley.
    #[schemars(transform = INERTIA.of_number(), extend("examples" = [0.005]))]
    pub pulley_inertia_kg_m2: At<f64>,
    /// From the pulley to the first throw.
    #[schemars(transform = LENGTH_MM.of_number(), extend("examples" = [60]))]
    pub pulley_distance_mm: At<f64>,
    /// Inertia of the flywheel.
    #[schemars(transform = INERTIA.of_number(), extend("examples" = [0.15]))]
    pub flywheel_inertia_kg_m2: At<f64>,
    /// Formula for the torsional stiffness of a throw.
    #[schemars(extend("examples" = ["ker_wilson"]))]
    pub stiffness_formula: At<RawFormula>,
    /// Fraction of critical damping of every mode.
    #[schemars(transform = FRACTION_OF_EACH_MODE.of_number(), extend("examples" = [0.01]))]
    pub fraction_of_critical: At<f64>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSizedAbsorber {
    /// Type of the absorber.
    #[serde(rename = "type")]
    #[schemars(with = "RawKind", extend("examples" = ["tuned"]))]
    pub kind: At<String>,
    /// Inertia of the ring.
    #[schemars(transform = INERTIA.of_number(), extend("examples" = [0.02]))]
    pub ring_inertia_kg_m2: At<f64>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSizingFront {
    /// Smallest and largest size of the ring.
    #[schemars(transform = INERTIA.of_list(), extend("minItems" = 2, "maxItems" = 2, "examples" = [[0.005, 0.05]]))]
    pub ring_inertia_kg_m2: At<Vec<At<f64>>>,
    /// Points of the front.
    #[schemars(transform = POINTS_OF_SIZING.of_number(), extend("examples" = [10]))]
    pub points: At<i64>,
}
