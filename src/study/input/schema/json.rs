//! What files may hold, as JSON Schema: from the types that read them.

use super::absorber::{RawEngineInertia, RawKind, RawLocked, RawMeasured, RawOn, RawOptimised, RawProny, RawSeeded, RawSize, RawType};
use super::bounds::{Bounds, NOT_NEGATIVE};
use super::campaign::RawCampaign;
use super::engine::RawEngine;
use super::material::RawMaterialFile;
use super::material_states::RawMaterialStates;
use super::sizing::RawSizing;
use super::study::RawStudy;
use super::substance::RawSubstances;
use crate::absorber::closed_forms::EngineMode;
use crate::absorber::construction::{SHAPES, shape};
use crate::absorber::types::GIVEN_ONLY;
use crate::absorber::{Declaration, Parameter, Surroundings, TYPES};
use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Map, Value, json};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// A kind of file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileKind {
    /// What is asked of an engine and its absorbers.
    Study,
    /// An engine with its torsional chain.
    Engine,
    /// Operating data of an engine that is sized.
    Sizing,
    /// Strengths of a material, for `hartog fatigue`.
    Material,
    /// Compounds of rubber and oils for dampers.
    Compounds,
    /// Many cases of studies, for `hartog campaign`.
    Campaign,
}

impl FileKind {
    /// All of them.
    pub const ALL: [Self; 6] = [Self::Study, Self::Engine, Self::Sizing, Self::Material, Self::Compounds, Self::Campaign];

    /// Its word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Study => "study",
            Self::Engine => "engine",
            Self::Sizing => "sizing",
            Self::Material => "material",
            Self::Compounds => "compounds",
            Self::Campaign => "campaign",
        }
    }

    /// What such a file may hold: JSON Schema of 2020-12, without references.
    ///
    /// It is wider than what a study accepts: relations between keys are checked by `hartog check` alone.
    pub fn json_schema(self) -> Value {
        let settings = SchemaSettings::draft2020_12().with(|s| s.inline_subschemas = true);
        let mut generator = settings.into_generator();
        let schema = match self {
            Self::Study => generator.root_schema_for::<RawStudy>(),
            Self::Engine => generator.root_schema_for::<RawEngine>(),
            Self::Sizing => generator.root_schema_for::<RawSizing>(),
            Self::Material => generator.root_schema_for::<RawMaterialFile>(),
            Self::Compounds => generator.root_schema_for::<RawSubstances>(),
            Self::Campaign => generator.root_schema_for::<RawCampaign>(),
        };
        let mut value = schema.to_value();
        without_null(&mut value);
        if let Value::Object(map) = &mut value {
            map.insert("title".into(), format!("hartog: {} file", self.name()).into());
        }
        value
    }
}

impl FileKind {
    /// The same as text.
    #[doc(hidden)]
    pub fn json_schema_text(self) -> String {
        format!("{:#}\n", self.json_schema())
    }
}

/// TOML has no null: a key that may be left out is not required, and that is all.
fn without_null(value: &mut Value) {
    match value {
        Value::Object(map) => {
            if let Some(Value::Array(types)) = map.get_mut("type") {
                types.retain(|t| t != "null");
                if let [only] = types.as_slice() {
                    let only = only.clone();
                    map.insert("type".into(), only);
                }
            }
            if let Some(Value::Array(words)) = map.get_mut("enum") {
                words.retain(|w| !w.is_null());
            }
            if let Some(Value::Array(any)) = map.get_mut("anyOf") {
                any.retain(|s| s.get("type").is_none_or(|t| t != "null"));
                if let [Value::Object(only)] = any.as_mut_slice() {
                    let only = std::mem::take(only);
                    map.remove("anyOf");
                    // what is said of the key comes before what is said of its type
                    for (key, own) in only {
                        map.entry(key).or_insert(own);
                    }
                }
            }
            // names and formats of our own types tell a reader nothing
            for key in ["title", "format"] {
                if map.get(key).is_some_and(Value::is_string) {
                    map.remove(key);
                }
            }
            map.values_mut().for_each(without_null);
            if let Some(Value::Array(one_of)) = map.get_mut("oneOf") {
                one_of.iter_mut().for_each(of_its_value);
            }
        }
        Value::Array(list) => list.iter_mut().for_each(without_null),
        _ => {}
    }
}

/// What is said of one of several keys is of its value, not of the table round it.
fn of_its_value(choice: &mut Value) {
    let Value::Object(choice) = choice else { return };
    let table = ["type", "properties", "required", "additionalProperties"];
    let said: Vec<String> = choice.keys().filter(|k| !table.contains(&k.as_str())).cloned().collect();
    let said: Vec<(String, Value)> = said.into_iter().filter_map(|k| choice.remove_entry(&k)).collect();
    match choice.get_mut("properties").and_then(Value::as_object_mut).and_then(|keys| keys.values_mut().next()) {
        Some(Value::Object(inner)) => inner.extend(said),
        _ => choice.extend(said),
    }
}

/// One of several tables, each under its own key.
fn one_of(list: Vec<(&str, &str, Value)>) -> Schema {
    let each = list.into_iter().map(|(key, about, inner)| {
        json!({ "type": "object", "description": about, "properties": { key: inner }, "required": [key], "additionalProperties": false })
    });
    json_schema!({ "oneOf": each.collect::<Vec<Value>>() })
}

/// A table of these keys.
fn table(properties: Map<String, Value>, required: &[&str]) -> Value {
    json!({ "type": "object", "properties": properties, "required": required, "additionalProperties": false })
}

/// A typical value of a parameter in an engine of 0.5 kg m² at 1000 rad/s with a ring of 0.05 kg m².
fn typical(p: &Parameter) -> f64 {
    let modes = [EngineMode { inertia: 0.5, omega: 1e3 }];
    p.range.nearest((p.typical)(&Surroundings { modes: &modes, ring_inertia: 0.05 }))
}

fn value(p: &Parameter) -> Value {
    let mut map = json!({ "type": "number", "description": p.about, "examples": [typical(p)] });
    Bounds::of_parameter(p.range).keywords().into_iter().for_each(|(key, x)| map[key] = x);
    map
}

/// A value or bounds of a parameter of a family, within the range that all types share which have it.
fn bounds(p: &Parameter) -> Value {
    let about = |text: &str| format!("{text}: {}{}", p.about[..1].to_lowercase(), &p.about[1..]);
    let mut item = value(p);
    if TYPES.iter().flat_map(|t| t.parameters).any(|other| other.key == p.key && other.range != p.range) {
        item = NOT_NEGATIVE.schema();
    }
    let one = |key: &str, inner: Value| json!({ "type": "object", "properties": { key: inner }, "required": [key], "additionalProperties": false });
    let pair = json!({ "type": "array", "description": "Two bounds.", "items": item, "minItems": 2, "maxItems": 2 });
    // of dimensions the best of some steps may be taken
    let is_dimension = SHAPES.iter().any(|s| s.drawn().iter().any(|d| d.key == p.key));
    let steps =
        json!({ "type": "array", "description": "Steps, of which the best is taken.", "items": item, "minItems": 1, "uniqueItems": true });
    let steps = is_dimension.then(|| one("each", steps));
    let what = if is_dimension { "Value, bounds or steps" } else { "Value or bounds" };
    let choices: Vec<Value> = [one("fixed", item), one("between", pair)].into_iter().chain(steps).collect();
    json!({ "description": about(what), "oneOf": choices, "examples": [{ "fixed": typical(p) }] })
}

impl JsonSchema for RawType {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Type".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let schema_of = |t: &&'static Declaration| {
            let named = |i: usize| shape(t).is_some_and(|s| s.material().contains(&i));
            let keys: Vec<&str> = t.parameters.iter().enumerate().filter(|p| !named(p.0)).map(|p| p.1.key).collect();
            (t.name, t.about, table(t.parameters.iter().map(|p| (p.key.to_owned(), value(p))).collect(), &keys))
        };
        let mut list: Vec<_> = TYPES.iter().map(schema_of).collect();
        list.push(("locked", "A ring that is fixed to its hub.", generator.subschema_for::<RawLocked>().to_value()));
        list.push(("seeded", "A ring with stiffness and damping by a closed form.", generator.subschema_for::<RawSeeded>().to_value()));
        list.push(("measured", "A ring on measured stiffness.", generator.subschema_for::<RawMeasured>().to_value()));
        list.push(("prony", "A ring on a Prony series.", generator.subschema_for::<RawProny>().to_value()));
        one_of(list)
    }
}

impl JsonSchema for RawKind {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Kind".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let searched = TYPES.iter().filter(|t| !GIVEN_ONLY.iter().any(|g| g.name == t.name));
        json_schema!({ "type": "string", "enum": searched.map(|t| t.name).collect::<Vec<_>>() })
    }
}

impl JsonSchema for RawOptimised {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Family".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut keys = Map::new();
        let mut put = |key: &str, about: &str, own: Schema, more: Value| {
            let mut own = own.to_value();
            own["description"] = about.into();
            if let Value::Object(more) = more {
                more.into_iter().for_each(|(k, v)| own[k] = v);
            }
            keys.insert(key.to_owned(), own);
        };
        put("name", "Its name, where another ring sits on it.", generator.subschema_for::<String>(), json!({ "examples": ["inner"] }));
        put("on", "What carries it: a station, or the ring of an absorber before it.", generator.subschema_for::<RawOn>(), json!({}));
        let hub = json!({ "minimum": 0, "default": 0, "examples": [0.004] });
        put("hub_inertia_kg_m2", "Inertia of the hub, added to the station.", generator.subschema_for::<f64>(), hub);
        put(
            "types",
            "Types of which the best is found.",
            generator.subschema_for::<Vec<RawKind>>(),
            json!({ "minItems": 1, "uniqueItems": true, "examples": [["tuned", "viscous"]] }),
        );
        put("size", "Size of the ring.", generator.subschema_for::<RawSize>(), json!({}));
        let modal = json!({ "default": "modal", "examples": ["whole_chain"] });
        put("engine_inertia", "The inertia that ratios are taken with.", generator.subschema_for::<RawEngineInertia>(), modal);
        let words: Vec<&str> = TYPES.iter().map(|t| t.name).collect();
        let by_type =
            json!({ "propertyNames": { "enum": words }, "examples": [{ "rubber": { "ageing": { "stiffness_n_m_per_rad": 1.25 } } }] });
        put("material", "By type, how its material behaves.", generator.subschema_for::<BTreeMap<String, RawMaterialStates>>(), by_type);
        for p in TYPES.iter().flat_map(|t| &t.parameters[1..]) {
            keys.insert(p.key.to_owned(), bounds(p));
        }
        Schema::try_from(table(keys, &["on", "types", "size"])).unwrap_or_default()
    }
}
