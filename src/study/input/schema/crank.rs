//! The crank's dimensions in an engine file.

use super::bounds::{BEARING_STIFFNESS, NOT_NEGATIVE, POSITIVE, SECTOR, SIGNED_ANGLE};
use super::flexible::RawFlexible;
use super::keyword::by_word;
use crate::drivetrain::throw_stiffness::ThrowFormula;
use crate::input::error::At;
use schemars::JsonSchema;
use serde::Deserialize;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawCrank {
    /// Distance from throw to throw.
    #[schemars(extend("examples" = [{"all": 130}]))]
    pub pitch_mm: RawEach,
    /// Diameter of the crankpin.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [72]))]
    pub crankpin_diameter_mm: At<f64>,
    /// Length of the crankpin.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [40]))]
    pub crankpin_length_mm: At<f64>,
    /// Bore of the crankpin.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("default" = 0, "examples" = [20]))]
    pub crankpin_bore_mm: Option<At<f64>>,
    /// Radius of the crankpin fillet.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [4]))]
    pub crankpin_fillet_mm: At<f64>,
    /// Recess of the crankpin fillet.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("default" = 0, "examples" = [1]))]
    pub crankpin_recess_mm: Option<At<f64>>,
    /// Diameter of the main journal.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [82]))]
    pub journal_diameter_mm: At<f64>,
    /// Length of the main journals.
    #[schemars(extend("examples" = [{"all": 38}]))]
    pub journal_length_mm: RawEach,
    /// Bore of the main journal.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("default" = 0, "examples" = [0]))]
    pub journal_bore_mm: Option<At<f64>>,
    /// Radius of the journal fillet.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [4]))]
    pub journal_fillet_mm: At<f64>,
    /// Recess of the journal fillet.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("default" = 0, "examples" = [0]))]
    pub journal_recess_mm: Option<At<f64>>,
    /// Thickness of the webs.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [24]))]
    pub web_thickness_mm: At<f64>,
    /// Breadth of the webs.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [110]))]
    pub web_breadth_mm: At<f64>,
    /// Oil bore of the crankpin.
    #[schemars(extend("examples" = [{"diameter_mm": 6}]))]
    pub oil_bore: Option<RawOilBore>,
    /// Numbers of the main bearings that are not there, from 1.
    #[serde(default)]
    #[schemars(extend("items" = { "type": "integer", "minimum": 1 }, "default" = [], "examples" = [[2]]))]
    pub missing_bearings: Vec<At<i64>>,
    /// Distance between the two rods of a throw of a V engine.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [22]))]
    pub rod_spacing_mm: Option<At<f64>>,
    /// Stiffness of the main bearings; rigid without it.
    #[schemars(transform = BEARING_STIFFNESS.of_number(), extend("examples" = [1e9]))]
    pub bearing_stiffness_n_per_m: Option<At<f64>>,
    /// Young's modulus.
    #[schemars(transform = POSITIVE.of_number(), extend("default" = 206, "examples" = [206]))]
    pub young_modulus_gpa: Option<At<f64>>,
    /// Unbalance of a throw.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("default" = 0, "examples" = [0.1]))]
    pub unbalance_kg_m: Option<At<f64>>,
    /// Counterweight of a throw: its mass times the distance of its centre of gravity from the axis. A study of margins asks for it.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("default" = 0, "examples" = [0.05]))]
    pub counterweight_kg_m: Option<At<f64>>,
    /// Formula for the torsional stiffness of a throw, where stations give none.
    #[schemars(extend("examples" = ["ker_wilson"]))]
    pub stiffness_formula: Option<At<RawFormula>>,
    /// Masses of the webs, for the inertias of throws, where stations give none.
    pub masses: Option<RawMasses>,
    /// The crank in bending, torsion and axial motion on its bearings.
    pub flexible: Option<At<RawFlexible>>,
    /// Keys of this table whose values are assumptions.
    #[serde(default)]
    #[schemars(extend("default" = [], "examples" = [["web_thickness_mm"]]))]
    pub assumed: Vec<At<String>>,
}

/// A formula by its word.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RawFormula(pub ThrowFormula);

by_word!(RawFormula, "Formula", ThrowFormula::ALL, ThrowFormula::name, Self);

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawMasses {
    /// Density of the crank.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [7850]))]
    pub density_kg_m3: At<f64>,
    /// Height of a web.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [180]))]
    pub web_height_mm: At<f64>,
    /// Centre of a web from the axis, towards the pin.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [20]))]
    pub web_centre_mm: At<f64>,
    /// Sector of a counterweight on each web.
    pub counterweight: Option<RawSector>,
    /// Rings round the axis of each throw.
    #[serde(default)]
    #[schemars(extend("default" = [], "examples" = [[{"diameter_mm": 200, "length_mm": 20}]]))]
    pub rings: Vec<RawRing>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSector {
    /// Its outer radius.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [110]))]
    pub outer_radius_mm: At<f64>,
    /// Its inner radius.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [45]))]
    pub inner_radius_mm: At<f64>,
    /// Its angle.
    #[schemars(transform = SECTOR.of_number(), extend("examples" = [120]))]
    pub angle_deg: At<f64>,
    /// Its thickness.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [24]))]
    pub thickness_mm: At<f64>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawRing {
    /// Outer diameter.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [200]))]
    pub diameter_mm: At<f64>,
    /// Inner diameter.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("default" = 0, "examples" = [80]))]
    pub bore_mm: Option<At<f64>>,
    /// Length.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [20]))]
    pub length_mm: At<f64>,
    /// Whether it is cut away in place of added.
    #[serde(default)]
    #[schemars(extend("default" = false, "examples" = [true]))]
    pub cut: bool,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawEach {
    /// The same everywhere.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [130]))]
    All(At<f64>),
    /// A value each.
    #[schemars(transform = POSITIVE.of_list(), extend("examples" = [[130, 130, 140]]))]
    Each(At<Vec<At<f64>>>),
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawOilBore {
    /// Diameter of the bore.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [6]))]
    pub diameter_mm: At<f64>,
    /// Angle of its mouth from the top of the pin.
    #[schemars(transform = SIGNED_ANGLE.of_number(), extend("default" = 0, "examples" = [45]))]
    pub angle_deg: Option<At<f64>>,
}
