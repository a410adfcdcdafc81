//! From what a study wants optimised to families of designs.

use crate::absorber::closed_forms::EngineMode;
use crate::absorber::{Declaration, Material, Surroundings};
use crate::input::{AbsorberSpec, OptimiseSpec, Size, Study};
use crate::numerics::elementary::Elementary;
use crate::optimise::{Slot, Space, Variable, starts};
use crate::units::HZ_PER_RAD_PER_S;
use std::sync::Arc;

/// Modes that each absorber of a study can be tuned to: elastic, moving its station, within reach of the torque (at least the first).
pub fn engine_modes(study: &Study, spec: &OptimiseSpec, highest_hz: f64) -> Vec<Vec<EngineMode>> {
    (0..spec.absorbers.len()).map(|i| modes_of(study, spec, i, highest_hz)).collect()
}

fn modes_of(study: &Study, spec: &OptimiseSpec, index: usize, highest_hz: f64) -> Vec<EngineMode> {
    let total = study.chain.total_inertia();
    let station = spec.station(index);
    study
        .modes
        .elastic()
        .map(|m| EngineMode {
            inertia: if spec.absorbers[index].whole_chain { total } else { study.modes.equivalent_inertia(m, station) },
            omega: study.modes.omega[m],
        })
        .filter(|m| m.inertia < 1e4 * total)
        .enumerate()
        .filter(|(i, m)| *i == 0 || m.omega * HZ_PER_RAD_PER_S <= highest_hz)
        .map(|(_, m)| m)
        .take(starts::MOST_MODES)
        .collect()
}

/// A choice of type and ring for every absorber of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// Type of each.
    pub types: Vec<&'static Declaration>,
    /// Ring inertia of each: held where given, free between the bounds of the study otherwise.
    pub rings: Vec<Option<f64>>,
}

/// The family of a choice.
pub fn family(spec: &OptimiseSpec, choice: &Choice, modes: &[Vec<EngineMode>]) -> Space {
    let mut space = Space { slots: Vec::new(), variables: Vec::new() };
    for (i, absorber) in spec.absorbers.iter().enumerate() {
        let (slot, variables) = slot(absorber, i, choice.types[i], choice.rings[i], &modes[i]);
        space.slots.push(slot);
        space.variables.extend(variables);
    }
    space
}

fn slot(
    spec: &AbsorberSpec,
    index: usize,
    declaration: &'static Declaration,
    ring_inertia: Option<f64>,
    modes: &[EngineMode],
) -> (Slot, Vec<Variable>) {
    let size = match (ring_inertia, &spec.size) {
        (Some(j), _) => (j, j),
        (None, Size::Between(a, b)) => (*a, *b),
        (None, Size::Each(list)) => (list[0], list[0]),
    };
    let surroundings = Surroundings { modes, ring_inertia: size.1 };
    let material = spec.materials.iter().find(|m| m.0 == declaration).map(|m| &m.1);
    let substance = material.and_then(|m| m.choices.first());
    let (mut values, mut variables) = (Vec::new(), Vec::new());
    for (parameter, p) in declaration.parameters.iter().enumerate() {
        let own = material.iter().flat_map(|m| &m.properties);
        let step = spec.steps.iter().find(|s| s.0 == p.key).map(|s| (s.1[0], s.1[0]));
        let named = substance.and_then(|s| s.value(p.key)).map(|x| (x, x));
        let given = step.or(named).or_else(|| own.chain(&spec.bounds).find(|b| b.0 == p.key).map(|b| b.1));
        let (lower, upper) = if parameter == 0 { size } else { given.unwrap_or_else(|| (p.bounds)(&surroundings)) };
        values.push(lower);
        if lower < upper {
            // a thousandth of the typical value: what lies below acts like zero; of a material nothing above zero does
            let scale = 1e-3 * (p.typical)(&surroundings);
            let scale = if p.material && lower > 0.0 { scale.min(lower) } else { scale };
            variables.push(Variable { absorber: index, parameter, lower, upper, scale });
        }
    }
    let known = Arc::new(material.map_or_else(Material::default, |m| m.of_type(declaration, substance, spec.temperatures)));
    (Slot { declaration, on: spec.on, hub_inertia: spec.hub_inertia, values, material: known }, variables)
}

/// An optimum that a study asks for.
#[derive(Debug, Clone)]
pub struct Family {
    /// Its name in tables.
    pub name: String,
    /// The same without the words of a further objective.
    pub family: String,
    /// Its designs.
    pub space: Space,
    /// Whether it has the main size of every absorber.
    pub is_main: bool,
    /// Whether it is proved that no design of it is better than its optimum: where the study asks for that, or where it costs little.
    pub is_proved: bool,
}

/// The first size of an absorber; nothing where it is free.
#[doc(hidden)]
pub fn main_ring(spec: &AbsorberSpec) -> Option<f64> {
    match &spec.size {
        Size::Between(..) => None,
        Size::Each(list) => list.first().copied(),
    }
}

/// The types of a study's absorbers in all combinations, those of the first absorber changing slowest.
pub fn types(spec: &OptimiseSpec) -> Vec<Vec<&'static Declaration>> {
    combinations(spec.absorbers.iter().map(|a| a.types.clone()).collect())
}

/// Names of the types of a design together.
#[doc(hidden)]
pub fn joined(types: &[&'static Declaration]) -> String {
    types.iter().map(|t| t.name).collect::<Vec<_>>().join("_")
}

/// The optima a study asks for: every combination of types with every combination of sizes.
pub fn wanted(spec: &OptimiseSpec, modes: &[Vec<EngineMode>]) -> Vec<Family> {
    let sizes = |a: &AbsorberSpec| match &a.size {
        Size::Between(..) => vec![None],
        Size::Each(list) => list.iter().copied().map(Some).collect(),
    };
    let sizes = combinations(spec.absorbers.iter().map(sizes).collect());
    let mut list = Vec::new();
    for types in types(spec) {
        for (i, rings) in sizes.iter().enumerate() {
            let mut name = format!("optimum_{}", joined(&types));
            if i > 0 {
                spec.absorbers.iter().zip(rings).for_each(|(a, ring)| name.push_str(&suffix(a, *ring)));
            }
            let space = family(spec, &Choice { types: types.clone(), rings: rings.clone() }, modes);
            let is_proved = spec.prove.effort.boxes > 0 && (spec.prove.all || i == 0 && space.slots.len() == 1);
            list.push(Family { family: name.clone(), name, space, is_main: i == 0, is_proved });
        }
    }
    list
}

fn combinations<T: Clone>(lists: Vec<Vec<T>>) -> Vec<Vec<T>> {
    lists.iter().fold(vec![Vec::new()], |all, list| {
        let with = |c: &Vec<T>| list.iter().map(|x| c.iter().cloned().chain([x.clone()]).collect()).collect::<Vec<_>>();
        all.iter().flat_map(with).collect()
    })
}

/// A ring's size in the name of an optimum, where a study gives several.
fn suffix(spec: &AbsorberSpec, ring: Option<f64>) -> String {
    let (Size::Each(list), Some(j)) = (&spec.size, ring) else { return String::new() };
    if list.len() == 1 {
        return String::new();
    }
    let alike = list.iter().filter(|other| shown(**other) == shown(j)).count() > 1;
    format!("_{}", if alike { j.to_string() } else { shown(j) })
}

/// An inertia in a name: six digits are enough to tell sizes apart.
fn shown(j: f64) -> String {
    let digits = (5 - j.abs().decimal_logarithm().floor() as i32).max(0) as usize;
    let text = format!("{j:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}
