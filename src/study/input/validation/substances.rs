//! Compounds and oils by their names: those that hartog carries, and those of a study's own files.

use super::material_laws::{Temperatures, celsius, kraus, law, strain_life};
use super::named::file;
use crate::absorber::construction::{shape, words_of};
use crate::absorber::{Declaration, Medium, Substance, Valid};
use crate::input::error::{At, Check, InputError, Source};
use crate::input::schema::bounds::{Bounds, DENSITY, EXPONENT, FLOW_INDEX, GLASS_RATIO, NOT_NEGATIVE, SHORE_A, TEMPERATURE};
use crate::input::schema::material_states::{RawAmplitude, RawMaterialStates};
use crate::input::schema::substance::{RawOil, RawRubber, RawSubstances, RawValid};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, OnceLock};

/// The tables that hartog carries, by their files.
const CARRIED: [(&str, &str); 2] = [
    ("studies/materials/rubber.toml", include_str!("../../../../studies/materials/rubber.toml")),
    ("studies/materials/silicone_oils.toml", include_str!("../../../../studies/materials/silicone_oils.toml")),
];

/// m²/s per mm²/s.
const M2_PER_MM2: f64 = 1e-6;

/// Compounds and oils that a study can name.
#[derive(Debug, Clone, Default)]
pub(crate) struct Substances(Vec<Arc<Substance>>);

impl Substances {
    /// One by its name; a mistake with what exists of its kind where there is none. None of what is no compound and no oil.
    pub(super) fn find(&self, check: &mut Check, name: &At<String>, medium: Medium) -> Option<Arc<Substance>> {
        let found = self.0.iter().find(|s| s.name == *name.get_ref());
        if let Some(found) = found.filter(|s| s.medium == medium) {
            return Some(found.clone());
        }
        let (kind, other) = match medium {
            Medium::Rubber => ("a compound of rubber", "an oil"),
            Medium::Oil => ("an oil", "a compound of rubber"),
            Medium::Leaves | Medium::Coils | Medium::Field => return None,
        };
        let names: Vec<&str> = self.0.iter().filter(|s| s.medium == medium).map(|s| s.name.as_str()).collect();
        let is = if found.is_some() { format!(", {other}") } else { String::new() };
        check.wrong_with_help(name, format!("found `{}`{is}, expected {kind}", name.get_ref()), format!("there are {}", names.join(", ")));
        None
    }
}

/// Those that hartog carries.
fn carried() -> &'static Vec<Arc<Substance>> {
    static LIST: OnceLock<Vec<Arc<Substance>>> = OnceLock::new();
    LIST.get_or_init(|| {
        let read =
            |(path, text): (&str, &str)| of_file(&Source::new(Path::new(path), text)).expect("the tables that hartog carries are right");
        CARRIED.into_iter().flat_map(read).collect()
    })
}

/// Those that hartog carries, and those of a study's own files.
pub(super) fn substances(check: &mut Check, files: &[At<String>], folder: &Path) -> Substances {
    let mut all = carried().clone();
    for name in files {
        let Some(path) = file(check, name, folder, "a table of compounds and oils") else { continue };
        match Source::read(&path).and_then(|source| of_file(&source)) {
            Ok(own) => {
                for substance in own {
                    if all.iter().any(|s| s.name == substance.name) {
                        check.wrong(
                            name,
                            format!("found `{}` in it, which another table has, too, expected different names", substance.name),
                        );
                    }
                    all.push(substance);
                }
            }
            Err(mut error) => check.mistakes.append(&mut error.mistakes),
        }
    }
    Substances(all)
}

/// Checks a file of compounds and oils.
fn of_file(source: &Source) -> Result<Vec<Arc<Substance>>, InputError> {
    let raw: RawSubstances = source.parse()?;
    let mut check = Check::new(source);
    let mut list: Vec<(Substance, &At<String>)> = Vec::new();
    raw.rubber.values().for_each(|family| list.extend(of_rubber(&mut check, family)));
    raw.oil.values().for_each(|family| list.extend(of_oil(&mut check, family)));
    for (i, (substance, name)) in list.iter().enumerate() {
        if list[..i].iter().any(|other| other.0.name == substance.name) {
            check.wrong(*name, format!("found `{}` a second time, expected different names", substance.name));
        }
    }
    if check.mistakes.is_empty() {
        Ok(list.into_iter().map(|(substance, _)| Arc::new(substance)).collect())
    } else {
        Err(InputError::sorted(check.mistakes))
    }
}

fn of_rubber<'r>(check: &mut Check, raw: &'r RawRubber) -> Vec<(Substance, &'r At<String>)> {
    let glass_ratio = check.within(&raw.glass_ratio, &GLASS_RATIO);
    let exponent = check.within(&raw.fractional_exponent, &EXPONENT);
    let relaxation_time = check.positive(&raw.relaxation_time_s);
    let temperature = law(check, raw.temperature.get_ref());
    let limit = celsius(check, &raw.limit_c);
    let life = raw.life.as_ref().map(|l| strain_life(check, l.get_ref()));
    let price = check.not_negative(&raw.price_per_kg);
    let valid = valid(check, raw.valid.get_ref());
    let keys = [
        "relaxed_modulus_mpa",
        "glass_ratio",
        "fractional_exponent",
        "relaxation_time_s",
        "temperature",
        "density_kg_m3",
        "limit_c",
        "valid",
    ];
    let sources = sources(check, &raw.sources, &keys, &raw.about);
    let mut one = |grade: &'r crate::input::schema::substance::RawCompound| {
        let modulus = check.positive(&grade.relaxed_modulus_mpa);
        let substance = Substance {
            name: grade.name.get_ref().clone(),
            about: raw.about.get_ref().clone(),
            medium: Medium::Rubber,
            grade: check.within(&grade.hardness_shore_a, &SHORE_A),
            values: vec![
                ("relaxed_modulus_mpa", modulus),
                ("glass_ratio", glass_ratio),
                ("relaxation_time_s", relaxation_time),
                ("fractional_exponent", exponent),
            ],
            temperature,
            amplitude: grade.strain.as_ref().map(|s| {
                let RawAmplitude::Kraus(raw) = s.get_ref();
                kraus(check, raw)
            }),
            life,
            density: check.within(&grade.density_kg_m3, &DENSITY),
            conductivity: check.positive(&grade.conductivity_w_per_m_k),
            limit,
            price,
            valid,
            sources: sources.clone(),
        };
        (substance, &grade.name)
    };
    raw.grade.get_ref().iter().map(&mut one).collect()
}

fn of_oil<'r>(check: &mut Check, raw: &'r RawOil) -> Vec<(Substance, &'r At<String>)> {
    let transition = check.within(&raw.transition_exponent, &EXPONENT);
    let flow_index = check.within(&raw.flow_index, &FLOW_INDEX);
    let temperature = law(check, raw.temperature.get_ref());
    let density = check.within(&raw.density_kg_m3, &DENSITY);
    let conductivity = check.positive(&raw.conductivity_w_per_m_k);
    let limit = celsius(check, &raw.limit_c);
    let keys = [
        "viscosity_mm2_per_s",
        "relaxation_time_s",
        "transition_exponent",
        "flow_index",
        "temperature",
        "density_kg_m3",
        "limit_c",
        "valid",
    ];
    let sources = sources(check, &raw.sources, &keys, &raw.about);
    let mut one = |grade: &'r crate::input::schema::substance::RawGrade| {
        let viscosity = check.positive(&grade.viscosity_mm2_per_s);
        let substance = Substance {
            name: grade.name.get_ref().clone(),
            about: raw.about.get_ref().clone(),
            medium: Medium::Oil,
            grade: viscosity,
            values: vec![
                ("viscosity_pa_s", viscosity * M2_PER_MM2 * density),
                ("relaxation_time_s", check.positive(&grade.relaxation_time_s)),
                ("transition_exponent", transition),
                ("flow_index", flow_index),
            ],
            temperature,
            amplitude: None,
            life: None,
            density,
            conductivity,
            limit,
            price: check.not_negative(&grade.price_per_kg),
            valid: valid(check, grade.valid.get_ref()),
            sources: sources.clone(),
        };
        (substance, &grade.name)
    };
    raw.grade.get_ref().iter().map(&mut one).collect()
}

/// Where numbers hold.
fn valid(check: &mut Check, raw: &RawValid) -> Valid {
    let mut pair = |list: &At<Vec<At<f64>>>, bounds: &Bounds| {
        let numbers: Vec<f64> = list.get_ref().iter().map(|x| check.within(x, bounds)).collect();
        match numbers[..] {
            [low, high] if low < high => (low, high),
            _ => {
                check.wrong(list, "expected the least and the most, the least first");
                (0.0, 1.0)
            }
        }
    };
    Valid {
        frequency_hz: pair(&raw.frequency_hz, &NOT_NEGATIVE),
        celsius: pair(&raw.temperature_c, &TEMPERATURE),
        strain: pair(&raw.strain, &NOT_NEGATIVE),
    }
}

/// Roles that a number may have.
const ROLES: [&str; 3] = ["published: ", "fitted: ", "assumed: "];

/// Sources of numbers, one for each that decides a result.
fn sources(check: &mut Check, raw: &BTreeMap<String, At<String>>, keys: &[&str], at: &At<String>) -> Vec<(String, String)> {
    for words in raw.values() {
        if ROLES.iter().all(|role| !words.get_ref().starts_with(role)) {
            check.wrong(
                words,
                format!(
                    "found a source without its role, expected it after one of {}",
                    ROLES.map(|r| format!("`{}`", r.trim_end())).join(", ")
                ),
            );
        }
    }
    if let Some(key) = keys.iter().find(|k| !raw.contains_key(**k)) {
        check.wrong(at, format!("found no source of `{key}`, expected its role and source under `sources`"));
    }
    raw.iter().map(|(key, words)| (key.clone(), words.get_ref().clone())).collect()
}

/// Compounds or oils by their names.
pub(super) fn named(check: &mut Check, raw: &RawMaterialStates, declaration: &Declaration, substances: &Substances) -> Vec<Arc<Substance>> {
    let Some(at) = &raw.of else { return Vec::new() };
    let Some(shape) = shape(declaration).filter(|s| s.medium.is_sheared()) else {
        let known = words_of(Medium::is_sheared);
        check.wrong(
            at,
            format!(
                "found a compound or oil of `{}`, expected one of a type on rubber or oil by its dimensions: {}",
                declaration.name,
                known.join(", ")
            ),
        );
        return Vec::new();
    };
    if at.get_ref().is_empty() {
        check.wrong(at, "found an empty list, expected at least one compound or oil");
    }
    if let Some(law) = &raw.temperature {
        check.wrong(law, "found a law of temperature beside `of`, whose table has it, expected one of them");
    }
    let mut list: Vec<Arc<Substance>> = Vec::new();
    for name in at.get_ref() {
        let Some(found) = substances.find(check, name, shape.medium) else { continue };
        if list.iter().any(|s| s.name == found.name) {
            check.wrong(name, format!("found `{}` a second time, expected each once", found.name));
        }
        list.push(found);
    }
    list
}

/// Whether a compound or oil holds at the temperatures of the study's conditions.
pub(super) fn reaches(check: &mut Check, raw: &RawMaterialStates, substance: &Substance, temperatures: Temperatures) {
    let Some(name) = raw.of.iter().flat_map(|l| l.get_ref()).find(|n| *n.get_ref() == substance.name) else { return };
    let (low, high) = substance.valid.celsius;
    for celsius in [temperatures.cold, temperatures.hot].into_iter().flatten().filter(|t| !(low..=high).contains(t)) {
        check.wrong(
            name,
            format!("found `{}` at {celsius} °C, expected temperatures from {low} to {high} °C, at which its numbers hold", substance.name),
        );
    }
}
