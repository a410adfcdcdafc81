//! Absorbers in a study. Their types and keys are those of the declarations in [`crate::absorber`]: a new type needs nothing here.

use super::bounds::{NOT_NEGATIVE, POSITIVE, RING_DENSITY};
use super::material_states::RawMaterialStates;
use super::range::RawRange;
use crate::absorber::construction::shape;
use crate::absorber::types::closed_form_names;
use crate::absorber::{Declaration, TYPES};
use crate::input::error::At;
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, EnumAccess, Error, MapAccess, VariantAccess, Visitor};
use std::collections::BTreeMap;
use std::fmt;
use std::sync::OnceLock;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawAbsorber {
    /// Its name, where another ring sits on it.
    #[schemars(extend("minLength" = 1, "maxLength" = 100, "examples" = ["inner"]))]
    pub name: Option<At<String>>,
    /// What carries it: a station, or the ring of an absorber before it.
    #[schemars(extend("examples" = [{"station": "pulley"}]))]
    pub on: RawOn,
    /// Inertia of the hub, added to the station.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("default" = 0, "examples" = [0.004]))]
    pub hub_inertia_kg_m2: Option<At<f64>>,
    /// Its type with the values of its parameters.
    #[serde(rename = "type")]
    #[schemars(extend("examples" = [{"tuned": {"ring_inertia_kg_m2": 0.076, "stiffness_n_m_per_rad": 40000, "damping_n_m_s_per_rad": 25}}]))]
    pub kind: RawType,
    /// How its material follows temperature, age and strain, and how it cools.
    pub material: Option<At<RawMaterialStates>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawOn {
    /// The station that carries it.
    #[schemars(extend("examples" = ["pulley"]))]
    Station(At<String>),
    /// The absorber, by its name, whose ring carries it.
    #[schemars(extend("examples" = ["inner"]))]
    Ring(At<String>),
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawLocked {
    /// Inertia of a ring that is fixed to its hub.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [0.076]))]
    pub ring_inertia_kg_m2: At<f64>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSeeded {
    /// The closed form that gives stiffness and damping.
    #[schemars(extend("enum" = closed_form_names(), "examples" = ["den_hartog_brock"]))]
    pub by: At<String>,
    /// Inertia of the ring.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [0.076]))]
    pub ring_inertia_kg_m2: At<f64>,
    /// The inertia that the ratio of the closed form is taken with: `modal`, that of the first elastic mode referred to the station, or `whole_chain`, the sum of all.
    #[serde(default)]
    #[schemars(extend("default" = "modal", "examples" = ["whole_chain"]))]
    pub engine_inertia: RawEngineInertia,
}

#[derive(Debug, Default, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawEngineInertia {
    #[default]
    Modal,
    WholeChain,
}

/// A ring on what was measured.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawMeasured {
    /// Inertia of the ring.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [0.076]))]
    pub ring_inertia_kg_m2: At<f64>,
    /// A table of complex stiffness over frequency and temperature.
    #[schemars(extend("examples" = ["measured.csv"]))]
    pub file: At<String>,
    /// The temperature, where the table has several.
    #[schemars(extend("examples" = [60]))]
    pub temperature_c: Option<At<f64>>,
}

/// A ring on a Prony series.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawProny {
    /// Inertia of the ring.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [0.076]))]
    pub ring_inertia_kg_m2: At<f64>,
    /// Stiffness at low frequency: of rubber; an oil has none.
    #[schemars(transform = NOT_NEGATIVE.of_number(), extend("examples" = [60000]))]
    pub stiffness_n_m_per_rad: At<f64>,
    /// Springs, each in series with a damper, beside it.
    #[schemars(extend("minItems" = 1, "examples" = [[{"stiffness_n_m_per_rad": 20000, "relaxation_time_s": 0.001}]]))]
    pub branches: At<Vec<RawBranch>>,
}

/// A spring in series with a damper.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawBranch {
    /// Stiffness of the spring.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [20000]))]
    pub stiffness_n_m_per_rad: At<f64>,
    /// Damping of the damper over that stiffness.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [0.001]))]
    pub relaxation_time_s: At<f64>,
}

/// A type with its values.
#[derive(Debug)]
pub(crate) enum RawType {
    /// A declared type, a value for each of its parameters.
    Declared(&'static Declaration, Vec<Option<At<f64>>>),
    Locked(RawLocked),
    Seeded(RawSeeded),
    Measured(RawMeasured),
    Prony(RawProny),
}

/// A type by its word.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RawKind(pub &'static Declaration);

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RawSize {
    /// Inertia of the ring.
    #[serde(rename = "ring_inertia_kg_m2")]
    RingInertia(RawRange),
    /// Inertia of the ring over the one that `engine_inertia` names: that of the first elastic mode at its station, or of the whole chain.
    InertiaRatio(RawRange),
    /// What a ring of rectangular section fills.
    Box(At<RawBox>),
}

/// What a ring of rectangular section fills.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawBox {
    /// Bore of the ring.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [120]))]
    pub inner_diameter_mm: At<f64>,
    /// Outer diameter of the ring.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [220]))]
    pub outer_diameter_mm: At<f64>,
    /// Width of the ring.
    #[schemars(transform = POSITIVE.of_number(), extend("examples" = [30]))]
    pub width_mm: At<f64>,
    /// Density of the ring.
    #[schemars(transform = RING_DENSITY.of_number(), extend("examples" = [7850]))]
    pub density_kg_m3: At<f64>,
}

/// A family of absorbers: besides these keys, bounds of any parameter of a type.
#[derive(Debug)]
pub(crate) struct RawOptimised {
    pub name: Option<At<String>>,
    pub on: RawOn,
    pub hub_inertia_kg_m2: Option<At<f64>>,
    pub types: At<Vec<At<RawKind>>>,
    pub size: RawSize,
    pub engine_inertia: RawEngineInertia,
    pub material: BTreeMap<String, At<RawMaterialStates>>,
    pub bounds: Vec<(&'static str, RawRange)>,
}

/// Words that messages list: they live as long as the program.
#[derive(Debug)]
struct Words {
    /// What may stand after `type.`.
    types: Vec<&'static str>,
    /// What may stand in `types`.
    kinds: Vec<&'static str>,
    /// Keys of each type.
    keys: Vec<Vec<&'static str>>,
    /// Keys of a family.
    family: Vec<&'static str>,
}

const OWN_KEYS: [&str; 7] = ["name", "on", "hub_inertia_kg_m2", "types", "size", "engine_inertia", "material"];

fn words() -> &'static Words {
    static WORDS: OnceLock<Words> = OnceLock::new();
    WORDS.get_or_init(|| {
        let kinds: Vec<&'static str> = TYPES.iter().map(|t| t.name).collect();
        let keys: Vec<Vec<&'static str>> = TYPES.iter().map(|t| t.parameters.iter().map(|p| p.key).collect()).collect();
        let mut family = OWN_KEYS.to_vec();
        for key in keys.iter().flat_map(|k| &k[1..]) {
            if !family.contains(key) {
                family.push(key);
            }
        }
        Words { types: kinds.iter().copied().chain(["locked", "seeded", "measured", "prony"]).collect(), kinds, keys, family }
    })
}

/// One of some words, as its index.
struct Word(&'static [&'static str], bool);

impl<'de> DeserializeSeed<'de> for Word {
    type Value = usize;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<usize, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

impl Visitor<'_> for Word {
    type Value = usize;
    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(if self.1 { "variant identifier" } else { "field identifier" })
    }
    fn visit_str<E: Error>(self, word: &str) -> Result<usize, E> {
        let unknown = || if self.1 { E::unknown_variant(word, self.0) } else { E::unknown_field(word, self.0) };
        self.0.iter().position(|w| *w == word).ok_or_else(unknown)
    }
}

/// Values of a declared type; a compound or oil may stand for those that are properties of one.
struct Values(usize);

impl<'de> DeserializeSeed<'de> for Values {
    type Value = Vec<Option<At<f64>>>;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_struct(TYPES[self.0].name, &words().keys[self.0], self)
    }
}

impl<'de> Visitor<'de> for Values {
    type Value = Vec<Option<At<f64>>>;
    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "struct {}", TYPES[self.0].name)
    }
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let keys = &words().keys[self.0];
        let mut values: Vec<Option<At<f64>>> = keys.iter().map(|_| None).collect();
        while let Some(key) = map.next_key_seed(Word(keys, false))? {
            values[key] = Some(map.next_value()?);
        }
        let named = |i: usize| shape(TYPES[self.0]).is_some_and(|s| s.material().contains(&i));
        let known = |(i, v): (usize, Option<At<f64>>)| if v.is_some() || named(i) { Ok(v) } else { Err(A::Error::missing_field(keys[i])) };
        values.into_iter().enumerate().map(known).collect()
    }
}

impl<'de> Deserialize<'de> for RawType {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Type;
        impl<'de> Visitor<'de> for Type {
            type Value = RawType;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("enum RawType")
            }
            fn visit_enum<A: EnumAccess<'de>>(self, data: A) -> Result<RawType, A::Error> {
                let (index, variant) = data.variant_seed(Word(&words().types, true))?;
                match words().types[index] {
                    "locked" => variant.newtype_variant().map(RawType::Locked),
                    "seeded" => variant.newtype_variant().map(RawType::Seeded),
                    "measured" => variant.newtype_variant().map(RawType::Measured),
                    "prony" => variant.newtype_variant().map(RawType::Prony),
                    _ => variant.newtype_variant_seed(Values(index)).map(|values| RawType::Declared(TYPES[index], values)),
                }
            }
        }
        deserializer.deserialize_enum("RawType", &words().types, Type)
    }
}

impl<'de> Deserialize<'de> for RawKind {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Kind;
        impl<'de> Visitor<'de> for Kind {
            type Value = RawKind;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("enum RawKind")
            }
            fn visit_enum<A: EnumAccess<'de>>(self, data: A) -> Result<RawKind, A::Error> {
                let (index, variant) = data.variant_seed(Word(&words().kinds, true))?;
                variant.unit_variant()?;
                Ok(RawKind(TYPES[index]))
            }
        }
        deserializer.deserialize_enum("RawKind", &words().kinds, Kind)
    }
}

impl<'de> Deserialize<'de> for RawOptimised {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Family;
        impl<'de> Visitor<'de> for Family {
            type Value = RawOptimised;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("struct RawOptimised")
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<RawOptimised, A::Error> {
                let (mut name, mut on, mut hub, mut types, mut size) = (None, None, None, None, None);
                let mut material = BTreeMap::new();
                let (mut engine_inertia, mut bounds) = (RawEngineInertia::default(), Vec::new());
                while let Some(key) = map.next_key_seed(Word(&words().family, false))? {
                    match words().family[key] {
                        "name" => name = Some(map.next_value()?),
                        "on" => on = Some(map.next_value()?),
                        "hub_inertia_kg_m2" => hub = Some(map.next_value()?),
                        "types" => types = Some(map.next_value()?),
                        "size" => size = Some(map.next_value()?),
                        "engine_inertia" => engine_inertia = map.next_value()?,
                        "material" => material = map.next_value()?,
                        parameter => bounds.push((parameter, map.next_value()?)),
                    }
                }
                Ok(RawOptimised {
                    name,
                    on: on.ok_or_else(|| A::Error::missing_field("on"))?,
                    hub_inertia_kg_m2: hub,
                    types: types.ok_or_else(|| A::Error::missing_field("types"))?,
                    size: size.ok_or_else(|| A::Error::missing_field("size"))?,
                    engine_inertia,
                    material,
                    bounds,
                })
            }
        }
        deserializer.deserialize_struct("RawOptimised", &words().family, Family)
    }
}
