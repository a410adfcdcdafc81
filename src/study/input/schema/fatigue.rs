//! The fatigue table of a study.

use super::bounds::{NOMINAL_FACTOR, NOT_NEGATIVE, POSITIVE, TEMPERATURE_OF_STEEL};
use super::keyword::by_word;
use crate::crankshaft::{MarginCriterion, TorsionCase};
use crate::fatigue::endurance::RELIABILITIES;
use crate::input::error::At;
use schemars::JsonSchema;
use serde::Deserialize;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawFatigue {
    /// Criteria that the margin is found by.
    #[schemars(extend("minItems" = 1, "uniqueItems" = true, "examples" = [["goodman", "iacs_m53"]]))]
    pub criteria: At<Vec<At<RawCriterion>>>,
    /// Strengths of the crank.
    #[schemars(extend("examples" = [{"tensile_strength_mpa": 1000}]))]
    pub material: RawMaterial,
    /// Pressure that bends the crank: that of the brake curve, or that which excites it.
    #[serde(default)]
    #[schemars(extend("default" = "brake_curve", "examples" = ["excitation"]))]
    pub pressure: RawCrankPressure,
    /// Factors that lessen the fatigue limit.
    #[schemars(extend("examples" = [{"surface": "ground"}]))]
    pub endurance: Option<RawEndurance>,
    /// Whether compression by mean bending helps, or counts as tension.
    #[serde(default)]
    #[schemars(extend("default" = "signed", "examples" = ["as_tension"]))]
    pub mean_bending: RawMeanBending,
    /// Margins at two instants of the cycle beside the full one, torsion by a case of Villalva (2014), section 7.2: all torques summed up to the flywheel, each throw by itself, or the differences of vibratory torques.
    #[schemars(extend("examples" = ["c"]))]
    pub torsion_case: Option<At<RawTorsionCase>>,
    /// Whether factors of concentration are lessened by notch sensitivity.
    #[serde(default)]
    #[schemars(extend("default" = false, "examples" = [true]))]
    pub notch_sensitivity: bool,
    /// What the class rule asks further.
    #[serde(default)]
    #[schemars(extend("examples" = [{"manufacture": "grain_flow"}]))]
    pub iacs_m53: RawClassRule,
    /// A fillet with its stress concentration.
    #[serde(default)]
    pub fillet: Vec<RawFillet>,
}

/// A criterion by its word: the words are those of the criteria themselves.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RawCriterion(pub MarginCriterion);

by_word!(RawCriterion, "Criterion", MarginCriterion::all(), MarginCriterion::name, Self);

/// A torsion case by its letter.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RawTorsionCase(pub TorsionCase);

by_word!(RawTorsionCase, "TorsionCase", TorsionCase::ALL, TorsionCase::name, Self);

/// Pressure that bends the crank.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawCrankPressure {
    #[default]
    BrakeCurve,
    Excitation,
}

#[derive(Debug, Default, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawMeanBending {
    #[default]
    Signed,
    AsTension,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawMaterial {
    /// Tensile strength.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [1000]))]
    pub tensile_strength_mpa: At<f64>,
    /// Yield strength.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [700]))]
    pub yield_strength_mpa: Option<At<f64>>,
    /// Fatigue limit in reversed bending; without it, estimated from the tensile strength.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [450]))]
    pub bending_fatigue_limit_mpa: Option<At<f64>>,
    /// Fatigue limit in reversed torsion.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [270]))]
    pub torsion_fatigue_limit_mpa: Option<At<f64>>,
    /// Largest stress of the fatigue limit in bending from zero.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [620]))]
    pub repeated_bending_fatigue_limit_mpa: Option<At<f64>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawEndurance {
    /// Load that the factor of size is for.
    #[serde(default)]
    #[schemars(extend("default" = "bending", "examples" = ["axial"]))]
    pub load: RawLoad,
    /// Finish of the surface.
    #[schemars(extend("examples" = ["ground"]))]
    pub surface: RawSurface,
    /// Temperature of the crank.
    #[schemars(transform = TEMPERATURE_OF_STEEL.of_number(), extend("default" = 20, "examples" = [90]))]
    pub temperature_c: Option<At<f64>>,
    /// Reliability, one of the tabulated values.
    #[schemars(extend("enum" = RELIABILITIES, "default" = 50, "examples" = [99]))]
    pub reliability_percent: Option<At<f64>>,
}

#[derive(Debug, Default, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawLoad {
    #[default]
    Bending,
    Axial,
}

#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawSurface {
    Ground,
    Machined,
    HotRolled,
    Forged,
}

#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawClassRule {
    /// How the crank is made.
    #[serde(default)]
    #[schemars(extend("default" = "free_forged", "examples" = ["grain_flow"]))]
    pub manufacture: RawManufacture,
    /// Additional bending stress of the rule.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("default" = 10, "examples" = [10]))]
    pub additional_bending_mpa: Option<At<f64>>,
}

#[derive(Debug, Default, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawManufacture {
    GrainFlow,
    #[default]
    FreeForged,
    CastColdRolled,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawFillet {
    /// Its name in tables.
    #[schemars(extend("examples" = ["crankpin"]))]
    pub name: At<String>,
    /// The throw; without it all of them.
    #[schemars(extend("minimum" = 1, "examples" = [1]))]
    pub throw: Option<At<i64>>,
    /// Whether it is at a crankpin or a journal.
    #[serde(default)]
    #[schemars(extend("default" = "crankpin", "examples" = ["journal"]))]
    pub on: RawPlace,
    /// Its factors: given, of a table of stresses per unit load, or by formula.
    #[schemars(extend("examples" = ["iacs_m53"]))]
    pub factors: At<RawFactors>,
}

#[derive(Debug, Default, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawPlace {
    #[default]
    Crankpin,
    Journal,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawFactors {
    /// Factors of the nominal stresses.
    Given(RawGiven),
    /// A table of stresses per unit load.
    #[schemars(extend("examples" = ["unit_loads.csv"]))]
    UnitLoads(At<String>),
    /// Factors by IACS UR M53.
    IacsM53,
    /// Factors by the FVV, 1973.
    #[serde(rename = "fvv_1973")]
    Fvv1973,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawGiven {
    /// Factor of the nominal bending stress.
    #[schemars(transform = NOMINAL_FACTOR.of_number(), extend("examples" = [3.2]))]
    pub bending: At<f64>,
    /// Factor of the nominal torsional stress.
    #[schemars(transform = NOMINAL_FACTOR.of_number(), extend("examples" = [1.8]))]
    pub torsion: At<f64>,
}
