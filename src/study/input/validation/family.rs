//! A family of absorbers: types, sizes and bounds.

use super::absorbers::{engine_mode, value};
use super::material_states::{Known, MaterialSpec, Temperatures, material};
use super::rooms::{first_value, rooms};
use crate::absorber::construction::shape;
use crate::absorber::geometry::ring_inertia;
use crate::absorber::types::GIVEN_ONLY;
use crate::absorber::{Declaration, Geometry, Host, Parameter, Range, TYPES};
use crate::drivetrain::{Chain, Modes};
use crate::input::error::{At, Check};
use crate::input::schema::absorber::{RawBox, RawEngineInertia, RawOptimised, RawSize};
use crate::input::schema::bounds::RING_DENSITY;
use crate::input::schema::material_states::RawMaterialStates;
use crate::input::schema::range::RawRange;
use crate::units::M_PER_MM;
use std::collections::BTreeMap;

/// Ring inertia of what is optimised, kg m².
#[derive(Debug, Clone, PartialEq)]
pub enum Size {
    /// Given values: an optimum for each; the first is the main one.
    Each(Vec<f64>),
    /// Free between bounds.
    Between(f64, f64),
}

/// A family of absorbers.
#[derive(Debug, Clone, PartialEq)]
pub struct AbsorberSpec {
    /// What carries the hub: a station, or the ring of another absorber of the list by its index.
    pub on: Host,
    /// kg m².
    pub hub_inertia: f64,
    /// Types, each optimised by itself.
    pub types: Vec<&'static Declaration>,
    /// Ring.
    pub size: Size,
    /// Lower and upper bound (equal: held) of parameters by their keys; of the others hartog chooses wide bounds.
    pub bounds: Vec<(&'static str, (f64, f64))>,
    /// Values of dimensions of which the best is taken, by their keys.
    pub steps: Vec<(&'static str, Vec<f64>)>,
    /// Materials of types that have one.
    pub materials: Vec<(&'static Declaration, MaterialSpec)>,
    /// Of the study's conditions.
    pub temperatures: Temperatures,
    /// Whether closed forms and inertia ratios use the whole chain's inertia instead of the modal one.
    pub whole_chain: bool,
}

impl AbsorberSpec {
    /// How many optima it asks for by itself.
    pub(super) fn choices(&self) -> usize {
        let sizes = if let Size::Each(list) = &self.size { list.len() } else { 1 };
        self.types.len() * sizes
    }
}

impl AbsorberSpec {
    /// Most compounds and oils, with the steps of dimensions, of one type.
    pub(super) fn alternatives(&self) -> usize {
        let of = |t: &&'static Declaration| {
            let named = self.materials.iter().find(|m| m.0 == *t).map_or(1, |m| m.1.choices.len().max(1));
            let steps = self.steps.iter().filter(|s| t.index(s.0).is_some()).map(|s| s.1.len());
            steps.fold(named, usize::saturating_mul)
        };
        self.types.iter().map(of).max().unwrap_or(0)
    }
}

/// Lower and upper bound; the lower one may be zero only where `from_zero`.
pub(super) fn ordered(check: &mut Check, pair: &At<Vec<At<f64>>>, from_zero: bool) -> (f64, f64) {
    let [low, high] = pair.get_ref().as_slice() else {
        check.wrong(pair, format!("found {} values, expected two: a lower and an upper bound", pair.get_ref().len()));
        return (1.0, 2.0);
    };
    let (a, b) = (if from_zero { check.not_negative(low) } else { check.positive(low) }, check.positive(high));
    if b <= a {
        check.wrong(pair, format!("found bounds {a} and {b}, expected the lower one first and below the upper one"));
    }
    (a, b)
}

pub(super) fn family(
    check: &mut Check,
    raw: &RawOptimised,
    place: Option<(Host, usize)>,
    (chain, modes): (&Chain, &Modes),
    known: Known,
) -> Option<AbsorberSpec> {
    let temperatures = known.temperatures;
    let station = place.map(|p| p.1);
    let hub_inertia = raw.hub_inertia_kg_m2.as_ref().map_or(0.0, |h| check.not_negative(h));
    let mut types: Vec<&'static Declaration> = Vec::new();
    for kind in raw.types.get_ref() {
        let declaration = kind.get_ref().0;
        if types.contains(&declaration) {
            check.wrong(kind, format!("found type `{}` a second time, expected each once", declaration.name));
        }
        if GIVEN_ONLY.contains(&declaration) {
            check.wrong(
                kind,
                format!("found type `{}` in a family, expected it in a design: searches are of small twists", declaration.name),
            );
        }
        types.push(declaration);
    }
    if types.is_empty() {
        let known: Vec<&str> = TYPES.iter().map(|t| t.name).collect();
        check.wrong(&raw.types, format!("found no type, expected at least one of {}", known.join(", ")));
    }
    let whole_chain = matches!(raw.engine_inertia, RawEngineInertia::WholeChain);
    let size = size(check, raw, station.map(|s| (s, whole_chain)), (chain, modes));
    let materials = materials(check, &raw.material, (&types, None), known);
    let bounds = bounds_of(check, raw, &types);
    let steps = steps(check, raw, &types);
    let largest_ring = match &size {
        Size::Each(list) => list.iter().copied().fold(0.0, f64::max),
        Size::Between(_, most) => *most,
    };
    rooms(check, raw, (&types, largest_ring), (&bounds, &steps));
    Some(AbsorberSpec { on: place?.0, hub_inertia, types, size, bounds, steps, materials, temperatures, whole_chain })
}

/// Ring inertias; `place`: the station, and whether ratios are of the whole chain.
fn size(check: &mut Check, raw: &RawOptimised, place: Option<(usize, bool)>, (chain, modes): (&Chain, &Modes)) -> Size {
    let (range, unit) = match &raw.size {
        RawSize::RingInertia(r) => (r, Some(1.0)),
        RawSize::Box(b) => return in_box(check, b),
        RawSize::InertiaRatio(r) => (r, place.and_then(|(s, whole)| engine_mode(chain, modes, s, whole)).map(|m| m.inertia)),
    };
    if place.is_some() && unit.is_none() {
        check.wrong(&raw.types, "no elastic mode moves this station, expected `size.ring_inertia_kg_m2` instead of an inertia ratio");
    }
    let unit = unit.unwrap_or(1.0);
    match range {
        RawRange::Fixed(v) => Size::Each(vec![check.positive(v) * unit]),
        RawRange::Each(list) => {
            if list.get_ref().is_empty() {
                check.wrong(list, "found an empty list, expected at least one size");
            }
            let values: Vec<f64> = list.get_ref().iter().map(|v| check.positive(v) * unit).collect();
            for (i, v) in values.iter().enumerate() {
                if values[..i].contains(v) {
                    check.wrong(&list.get_ref()[i], "found a size a second time, expected different sizes");
                }
            }
            Size::Each(values)
        }
        RawRange::Between(pair) => {
            let (a, b) = ordered(check, pair, false);
            Size::Between(a * unit, b * unit)
        }
    }
}

/// The ring that fills a box.
fn in_box(check: &mut Check, at: &At<RawBox>) -> Size {
    let raw = at.get_ref();
    let [inner, outer, width] = [&raw.inner_diameter_mm, &raw.outer_diameter_mm, &raw.width_mm].map(|x| M_PER_MM * check.positive(x));
    let density = check.within(&raw.density_kg_m3, &RING_DENSITY);
    if inner >= outer {
        check.wrong(at, "found a packaging box that holds no ring, expected an inner diameter below the outer one");
    }
    Size::Each(vec![ring_inertia(0.5 * inner, 0.5 * outer, width, density)])
}

/// Materials by the types that have them; `sheared`: what is sheared of all.
pub(super) fn materials(
    check: &mut Check,
    raw: &BTreeMap<String, At<RawMaterialStates>>,
    (types, sheared): (&[&'static Declaration], Option<Geometry>),
    known: Known,
) -> Vec<(&'static Declaration, MaterialSpec)> {
    let mut list = Vec::new();
    for (word, raw) in raw {
        let Some(declaration) = types.iter().find(|t| t.name == word).copied() else {
            let names: Vec<&str> = types.iter().map(|t| t.name).collect();
            check.wrong(raw, format!("found a material of type `{word}`, expected one of {}", names.join(" or ")));
            continue;
        };
        let mut spec = material(check, raw.get_ref(), (declaration, sheared), known);
        for (key, range) in &raw.get_ref().properties {
            let Some(parameter) = declaration.parameters.iter().skip(1).find(|p| p.key == key) else {
                let known: Vec<&str> = declaration.parameters.iter().skip(1).map(|p| p.key).collect();
                check.wrong(raw, format!("found the property `{key}` of `{word}`, expected one of {}", known.join(", ")));
                continue;
            };
            in_range(check, parameter, range);
            spec.properties.extend(pair_of(check, range).map(|pair| (parameter.key, pair)));
        }
        list.push((declaration, spec));
    }
    list
}

/// Lower and upper bound; alike where a value is held.
fn pair_of(check: &mut Check, range: &RawRange) -> Option<(f64, f64)> {
    match range {
        RawRange::Fixed(v) => {
            let x = check.not_negative(v);
            Some((x, x))
        }
        RawRange::Between(pair) => Some(ordered(check, pair, true)),
        RawRange::Each(list) => {
            check.wrong(list, "found `each`, expected `fixed` or `between`: only sizes take several values");
            None
        }
    }
}

/// Bounds as given, for all types that have the parameter.
fn bounds_of(check: &mut Check, raw: &RawOptimised, types: &[&'static Declaration]) -> Vec<(&'static str, (f64, f64))> {
    let mut bounds = Vec::new();
    for (key, range) in &raw.bounds {
        if matches!(range, RawRange::Each(_)) && is_dimension(types, key) {
            continue;
        }
        let Some(pair) = pair_of(check, range) else { continue };
        if !types.is_empty() && types.iter().all(|t| t.index(key).is_none()) {
            let Some(at) = first_value(range) else { continue };
            let names: Vec<&str> = types.iter().map(|t| t.name).collect();
            check.wrong(at, format!("found bounds of `{key}`, expected those of a parameter of {}", names.join(" or ")));
        }
        for p in types.iter().flat_map(|t| t.parameters).filter(|p| p.key == *key) {
            in_range(check, p, range);
        }
        bounds.push((*key, pair));
    }
    let of_material = |t: &Declaration, key: &str| raw.material.get(t.name).is_some_and(|m| m.get_ref().properties.contains_key(key));
    for (key, range) in &raw.bounds {
        let mut with = types.iter().filter(|t| t.index(key).is_some()).peekable();
        if with.peek().is_some()
            && with.all(|t| of_material(t, key))
            && let Some(at) = first_value(range)
        {
            check.wrong(at, format!("found `{key}` here and among the properties of the material, expected it in one place"));
        }
    }
    for t in types {
        let of_table = |key: &str| {
            let named = raw.material.get(t.name).is_some_and(|m| m.get_ref().of.is_some());
            named && shape(t).zip(t.index(key)).is_some_and(|(s, i)| s.material().contains(&i))
        };
        let given = |key: &str| of_material(t, key) || of_table(key) || raw.bounds.iter().any(|b| b.0 == key);
        for p in t.parameters.iter().filter(|p| p.material && !given(p.key)) {
            let dimension = shape(t).zip(t.index(p.key)).is_some_and(|(s, i)| s.is_dimension(i));
            let what = if dimension { "a dimension" } else { "a property of its material" };
            let words = format!("found type `{}` without `{}`, {} that no default can decide", t.name, p.key, what);
            let help =
                format!("`{key}.fixed = …`, or `.between`; or under `material.{}` as `properties.{key}.fixed = …`", t.name, key = p.key);
            check.wrong_with_help(&raw.types, words, help);
        }
    }
    bounds
}

/// Whether a key is that of a dimension.
fn is_dimension(types: &[&'static Declaration], key: &str) -> bool {
    let of = |t: &&'static Declaration| shape(t).zip(t.index(key)).is_some_and(|(s, i)| s.is_dimension(i));
    types.iter().any(of)
}

/// Steps of dimensions, of which the best is taken.
fn steps(check: &mut Check, raw: &RawOptimised, types: &[&'static Declaration]) -> Vec<(&'static str, Vec<f64>)> {
    let mut all = Vec::new();
    for (key, range) in &raw.bounds {
        let RawRange::Each(list) = range else { continue };
        if !is_dimension(types, key) {
            continue;
        }
        if list.get_ref().is_empty() {
            check.wrong(list, "found an empty list, expected at least one step");
            continue;
        }
        for p in types.iter().flat_map(|t| t.parameters).filter(|p| p.key == *key) {
            in_range(check, p, range);
        }
        let values: Vec<f64> = list.get_ref().iter().map(|v| check.positive(v)).collect();
        for (i, v) in values.iter().enumerate().filter(|(i, v)| values[..*i].contains(v)) {
            check.wrong(&list.get_ref()[i], format!("found {v} a second time, expected different steps"));
        }
        all.push((*key, values));
    }
    all
}

/// Whether bounds lie in the range of a parameter; signs were looked at.
fn in_range(check: &mut Check, parameter: &Parameter, range: &RawRange) {
    if parameter.range == Range::NotNegative {
        return;
    }
    match range {
        RawRange::Fixed(v) => {
            value(check, parameter, v);
        }
        RawRange::Between(list) | RawRange::Each(list) => {
            for v in list.get_ref() {
                value(check, parameter, v);
            }
        }
    }
}
