//! States of an absorber's material, as typed.

use super::bounds::{
    ACTIVATION, CYCLES, KRAUS_EXPONENT, KRAUS_RATIO, LIFE_EXPONENT, NOT_NEGATIVE, POSITIVE, SHARE_PER_KELVIN, STRAIN, TEMPERATURE,
};
use super::range::RawRange;
use crate::absorber::types::parameter_keys;
use crate::input::error::At;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;

/// Temperatures of the conditions `cold` and `hot`.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawTemperatures {
    /// Temperature of the condition `cold`.
    #[schemars(transform = TEMPERATURE.of_number(), extend("examples" = [-20]))]
    pub cold_c: Option<At<f64>>,
    /// Temperature of the condition `hot`.
    #[schemars(transform = TEMPERATURE.of_number(), extend("examples" = [90]))]
    pub hot_c: Option<At<f64>>,
}

/// What is said of a material.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawMaterialStates {
    /// The compound or oil by its name, of a type by its dimensions: one, or in a family several, of which the best is taken. Its table has all of its numbers.
    #[schemars(extend("minItems" = 1, "uniqueItems" = true, "examples" = [["epdm_60"]]))]
    pub of: Option<At<Vec<At<String>>>>,
    /// How stiffness or viscosity follows temperature.
    #[schemars(extend("examples" = [{"wlf": {"c1": 8.86, "c2_k": 101.6, "reference_c": 50}}]))]
    pub temperature: Option<At<RawTemperatureLaw>>,
    /// By the key of a parameter its factor in the condition `aged`.
    #[schemars(extend("minProperties" = 1, "propertyNames" = { "enum": parameter_keys() }, "additionalProperties" = POSITIVE.described("Factor on the parameter of this key.", 1.25),
        "examples" = [{"stiffness_n_m_per_rad": 1.25}]))]
    pub ageing: Option<RawAgeing>,
    /// How heat leaves the absorber.
    pub cooling: Option<At<RawCooling>>,
    /// What of the material is sheared.
    pub geometry: Option<At<RawGeometry>>,
    /// How rubber follows its strain.
    pub amplitude: Option<At<RawAmplitude>>,
    /// Cycles of strain that the material bears, counted over the duty.
    pub life: Option<At<RawLife>>,
    /// By the key of a material parameter its value or bounds, in a family.
    #[serde(default)]
    #[schemars(extend("propertyNames" = { "enum": parameter_keys() }, "examples" = [{"loss_factor": {"fixed": 0.2}}]))]
    pub properties: BTreeMap<String, RawRange>,
}

/// How a material follows temperature.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawTemperatureLaw {
    /// The law of Williams, Landel and Ferry.
    Wlf(RawWlf),
    /// The law of Arrhenius.
    Arrhenius(RawArrhenius),
    /// A share per kelvin, as catalogues give it.
    Exponential(RawExponential),
    /// The viscosity of silicone oils.
    SiliconeOil(RawSiliconeOil),
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawWlf {
    /// First constant of Williams, Landel and Ferry.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [8.86]))]
    pub c1: At<f64>,
    /// Second constant.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [101.6]))]
    pub c2_k: At<f64>,
    /// Temperature that the values of the law are given for.
    #[schemars(transform = TEMPERATURE.of_number(), extend("examples" = [50]))]
    pub reference_c: At<f64>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawArrhenius {
    /// Activation energy.
    #[schemars(transform = ACTIVATION.of_number(), extend("examples" = [16]))]
    pub activation_kj_per_mol: At<f64>,
    /// Temperature that the values of the law are given for.
    #[schemars(transform = TEMPERATURE.of_number(), extend("examples" = [25]))]
    pub reference_c: At<f64>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawExponential {
    /// Share beta by which stiffness and loss factor of `rubber` fall per kelvin: both are multiplied by exp(-beta (T - reference_c)), as makers of couplings state it. Of other types the factor acts on damping and relaxation time.
    #[schemars(transform = SHARE_PER_KELVIN.of_number(), extend("examples" = [0.01]))]
    pub per_k: At<f64>,
    /// Temperature that the values of the law are given for.
    #[schemars(transform = TEMPERATURE.of_number(), extend("examples" = [20]))]
    pub reference_c: At<f64>,
    /// Lowest and highest temperature that the factor was measured at.
    #[schemars(transform = TEMPERATURE.of_list(), extend("examples" = [[0, 100]]))]
    pub between_c: At<Vec<At<f64>>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSiliconeOil {
    /// Temperature that the values of the law are given for.
    #[schemars(transform = TEMPERATURE.of_number(), extend("examples" = [25]))]
    pub reference_c: At<f64>,
}

/// Factors on parameters by their keys.
pub(crate) type RawAgeing = At<BTreeMap<String, At<f64>>>;

/// How heat leaves an absorber.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawCooling {
    /// Temperature of the air.
    #[schemars(transform = TEMPERATURE.of_number(), extend("examples" = [60]))]
    pub air_c: At<f64>,
    /// Temperature of the hub.
    #[schemars(transform = TEMPERATURE.of_number(), extend("examples" = [80]))]
    pub hub_c: At<f64>,
    /// Conductance to the air, or the disc it follows from.
    #[schemars(extend("examples" = [{"w_per_k": 2}]))]
    pub to_air: RawToAir,
    /// Conductance to the hub.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [1]))]
    pub to_hub_w_per_k: At<f64>,
    /// Temperature that the material bears; without it that of the compound or oil of `of`.
    #[schemars(transform = TEMPERATURE.of_number(), extend("examples" = [110]))]
    pub limit_c: Option<At<f64>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawToAir {
    /// Conductance to the air.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [2]))]
    WPerK(At<f64>),
    /// A rotating disc of the damper's own size, which its dimensions say.
    #[schemars(extend("enum" = [true], "examples" = [true]))]
    OwnDisc(At<bool>),
    /// A rotating disc of this size.
    Disc(RawDisc),
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawDisc {
    /// Diameter of the rotating disc.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [220]))]
    pub diameter_mm: At<f64>,
    /// Width of the disc.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [40]))]
    pub width_mm: At<f64>,
}

/// How a material follows the amplitude of its strain.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawAmplitude {
    /// The law of Kraus for filled rubber.
    Kraus(RawKraus),
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawKraus {
    /// Storage modulus at no strain over that at large strain.
    #[schemars(transform = KRAUS_RATIO.of_number(), extend("examples" = [2]))]
    pub storage_ratio: At<f64>,
    /// Largest loss modulus over that at large strain.
    #[schemars(transform = KRAUS_RATIO.of_number(), extend("examples" = [2]))]
    pub loss_ratio: At<f64>,
    /// Strain at which half of the filler's structure is broken.
    #[schemars(transform = STRAIN.of_number(), extend("examples" = [0.02]))]
    pub critical_strain: At<f64>,
    /// Exponent of Kraus.
    #[schemars(transform = KRAUS_EXPONENT.of_number(), extend("examples" = [0.6]))]
    pub exponent: At<f64>,
    /// Strain that the values of the law are given for.
    #[schemars(transform = STRAIN.of_number(), extend("examples" = [0.01]))]
    pub reference_strain: At<f64>,
}

/// Cycles of strain that a material bears.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawLife {
    /// Amplitude of shear strain, zero to peak.
    #[schemars(transform = STRAIN.of_number(), extend("examples" = [0.1]))]
    pub reference_strain: At<f64>,
    /// Cycles of that amplitude until it fails.
    #[schemars(transform = CYCLES.of_number(), extend("examples" = [1e8]))]
    pub reference_cycles: At<f64>,
    /// Power of the strain by which cycles become fewer.
    #[schemars(transform = LIFE_EXPONENT.of_number(), extend("examples" = [5]))]
    pub exponent: At<f64>,
}

/// What of a material is sheared.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawGeometry {
    /// A sleeve between hub and ring.
    Sleeve(RawSleeve),
    /// Layers between plane faces.
    Faces(RawFaces),
    /// Layers whose thickness grows with the radius.
    Wedges(RawWedges),
    /// Oil round a ring in its housing.
    Gap(RawGap),
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSleeve {
    /// Inner diameter of the rubber.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [180]))]
    pub inner_diameter_mm: At<f64>,
    /// Outer diameter of the rubber.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [190]))]
    pub outer_diameter_mm: At<f64>,
    /// Length of the sleeve.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [30]))]
    pub length_mm: At<f64>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawFaces {
    /// Inner diameter of the rubber.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [100]))]
    pub inner_diameter_mm: At<f64>,
    /// Outer diameter of the rubber.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [200]))]
    pub outer_diameter_mm: At<f64>,
    /// Thickness of each layer.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [8]))]
    pub thickness_mm: At<f64>,
    /// Number of layers.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [2]))]
    pub count: At<f64>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawWedges {
    /// Inner diameter of the rubber.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [100]))]
    pub inner_diameter_mm: At<f64>,
    /// Outer diameter of the rubber.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [200]))]
    pub outer_diameter_mm: At<f64>,
    /// Thickness over radius, the same everywhere: the strain is even.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [0.08]))]
    pub thickness_over_radius: At<f64>,
    /// Number of layers.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [2]))]
    pub count: At<f64>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawGap {
    /// Bore of the ring.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [100]))]
    pub inner_diameter_mm: At<f64>,
    /// Outer diameter of the ring.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [200]))]
    pub outer_diameter_mm: At<f64>,
    /// Width of the ring.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [30]))]
    pub width_mm: At<f64>,
    /// Gap of the oil at rim, bore and faces.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [0.4]))]
    pub gap_mm: At<f64>,
}
