//! An assembly of openTorsion as JSON ("TORS": `components` with `elements`, joined by `structure`), one shaft line of disks and shafts. A disk adds to the node where it
//! stands and a shaft leads to the next node, as in `Parser.from_tors` of openTorsion; a continuous shaft is of steel with G = 80 GPa and 8000 kg/m³ where the file says
//! no density, dimensions in mm, half its inertia at each end.

use super::{FoundChain, FoundStation};
use crate::input::error::{InputError, Mistake, Place, read_bytes};
use crate::input::letters::fault;
use serde::Deserialize;
use std::path::Path;

/// Shear modulus that openTorsion takes, Pa.
const SHEAR_MODULUS: f64 = 80e9;
/// Density that it takes, kg/m³.
const DENSITY: f64 = 8000.0;
const M_PER_MM: f64 = crate::units::M_PER_MM;

#[derive(Deserialize)]
struct Assembly {
    components: Vec<Component>,
    #[serde(default)]
    structure: Vec<(String, String)>,
}

#[derive(Deserialize)]
struct Component {
    name: String,
    elements: Vec<Element>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Element {
    #[serde(default)]
    name: String,
    #[serde(rename = "type")]
    kind: String,
    #[serde(default)]
    inertia: f64,
    #[serde(default)]
    stiffness: f64,
    #[serde(default)]
    damping: f64,
    #[serde(default)]
    length: f64,
    #[serde(default)]
    inner_diameter: f64,
    #[serde(default)]
    outer_diameter: f64,
    density: Option<f64>,
    excitation: Option<serde_json::Value>,
}

/// A shaft: stiffness, damping, inertia.
type Shaft = (f64, f64, f64);

impl Element {
    fn shaft(&self, of: &str) -> Result<Option<Shaft>, String> {
        match self.kind.as_str() {
            "Disk" => Ok(None),
            "ShaftDiscrete" => Ok(Some((self.stiffness, self.damping, self.inertia))),
            "ShaftContinuous" => {
                let fourth = |mm: f64| (mm * M_PER_MM).powi(4);
                let polar = std::f64::consts::PI / 32.0 * (fourth(self.outer_diameter) - fourth(self.inner_diameter));
                let length = self.length * M_PER_MM;
                if polar <= 0.0 || length <= 0.0 {
                    return Err(format!("found a shaft of `{of}` without length or section, expected both above zero"));
                }
                Ok(Some((SHEAR_MODULUS * polar / length, self.damping, self.density.unwrap_or(DENSITY) * polar * length)))
            }
            "GearElement" => Err(format!(
                "found the gear `{of}`, expected a chain of disks and shafts: join parts of other speeds by `gear_ratio_to_next`"
            )),
            other => Err(format!("found an element of type `{other}` in `{of}`, expected Disk, ShaftDiscrete or ShaftContinuous")),
        }
    }
}

/// Reads it.
///
/// # Errors
/// [`InputError`] that tells what is not understood.
pub(super) fn read(path: &Path) -> Result<FoundChain, InputError> {
    let wrong = |message: String| -> InputError { Mistake { message, place: Place::File(path.to_path_buf()), help: None }.into() };
    let bytes = read_bytes(path).map_err(wrong)?;
    let assembly: Assembly = serde_json::from_slice(&bytes).map_err(|e| wrong(format!("found no assembly of openTorsion: {e}")))?;
    let order = in_order(&assembly).map_err(wrong)?;
    let mut line = Line::default();
    for component in order {
        for element in &component.elements {
            if element.excitation.is_some() {
                let words = format!("excitation of `{}`: the engine file says how the engine excites the chain", component.name);
                line.found.left_out.push(words);
            }
            let values = [element.inertia, element.stiffness, element.damping];
            if values.iter().any(|x| !(0.0..=1e20).contains(x)) {
                return Err(wrong(format!("found a value of `{}` that is below zero or above 1e20", component.name)));
            }
            match element.shaft(&component.name).map_err(wrong)? {
                None => line.disk(component, element),
                Some(shaft) => line.shaft(component, element, shaft).map_err(wrong)?,
            }
        }
    }
    let found = line.end().map_err(wrong)?;
    if let Some(fault) = found.stations.iter().find_map(|s| fault(&s.name)) {
        return Err(wrong(format!("found {fault}")));
    }
    if let Some(s) = found.stations.iter().find(|s| s.inertia <= 0.0) {
        return Err(wrong(format!("found no inertia at `{}`, expected one above zero", s.name)));
    }
    Ok(found)
}

/// A line as far as it was read.
#[derive(Default)]
struct Line {
    found: FoundChain,
    /// Whether the last element is a shaft: the node at its end is not a station yet.
    open: bool,
    /// Inertia that the shaft brings to that node.
    carried: f64,
}

impl Line {
    /// The station at the node, made where there is none.
    fn here(&mut self, component: &Component, element: &Element) -> &mut FoundStation {
        if self.open || self.found.stations.is_empty() {
            let inertia = std::mem::take(&mut self.carried);
            self.found.stations.push(FoundStation { name: name(component, element, &self.found), inertia, ..FoundStation::default() });
            self.open = false;
        }
        let last = self.found.stations.len() - 1;
        &mut self.found.stations[last]
    }

    fn disk(&mut self, component: &Component, element: &Element) {
        let here = self.here(component, element);
        here.inertia += element.inertia;
        here.damping_to_ground += element.damping;
    }

    /// A shaft behind a disk, or behind another: both are one where nothing is between them.
    fn shaft(&mut self, component: &Component, element: &Element, (stiffness, damping, inertia): Shaft) -> Result<(), String> {
        if stiffness <= 0.0 {
            return Err(format!("found shaft `{}` without stiffness, expected one above zero", component.name));
        }
        let half = inertia / 2.0;
        if self.open && self.carried + half == 0.0 {
            let Some(here) = self.found.stations.last_mut() else { return Ok(()) };
            if here.damping_to_next > 0.0 || damping > 0.0 {
                let of = &component.name;
                return Err(format!("found shaft `{of}` behind another with damping and no inertia between them, expected a disk there"));
            }
            here.stiffness_to_next = 1.0 / (1.0 / here.stiffness_to_next + 1.0 / stiffness);
            return Ok(());
        }
        let here = self.here(component, element);
        here.inertia += half;
        (here.stiffness_to_next, here.damping_to_next) = (stiffness, damping);
        (self.open, self.carried) = (true, half);
        Ok(())
    }

    /// The chain; a shaft at its end has a station there where it brings inertia.
    fn end(mut self) -> Result<FoundChain, String> {
        if self.open {
            if self.carried == 0.0 {
                return Err("found a shaft without inertia at the end of the line, expected a disk there".into());
            }
            let inertia = self.carried;
            self.found.stations.push(FoundStation { name: "end".into(), inertia, ..FoundStation::default() });
        }
        Ok(self.found)
    }
}

/// The name of a component where it is new, with that of its element otherwise.
fn name(component: &Component, element: &Element, found: &FoundChain) -> String {
    let is_new = |name: &str| found.stations.iter().all(|s| s.name != name);
    if is_new(&component.name) {
        return component.name.clone();
    }
    let both = format!("{} {}", component.name, element.name).trim().to_owned();
    if is_new(&both) {
        return both;
    }
    let mut numbered = (2..).map(|i| format!("{both} {i}"));
    numbered.find(|n| is_new(n)).unwrap_or(both)
}

/// Components along the line: each leads to at most one other.
fn in_order(assembly: &Assembly) -> Result<Vec<&Component>, String> {
    let component = |place: &str| place.rsplit_once('.').map_or(place, |p| p.0).to_owned();
    let joints: Vec<(String, String)> = assembly.structure.iter().map(|(a, b)| (component(a), component(b))).collect();
    let mut starts = assembly.components.iter().filter(|c| joints.iter().all(|(_, to)| *to != c.name));
    let first = starts.next().ok_or("found components in a ring, expected a line")?;
    if let Some(second) = starts.next() {
        return Err(format!("found `{}` and `{}` without a component before them, expected one line", first.name, second.name));
    }
    let mut order = vec![first];
    loop {
        let last = order[order.len() - 1];
        let mut next = joints.iter().filter(|(from, _)| *from == last.name);
        let Some((_, to)) = next.next() else { break };
        if next.next().is_some() {
            return Err(format!("found branches behind `{}`, expected one line", last.name));
        }
        let Some(found) = assembly.components.iter().find(|c| c.name == *to) else {
            return Err(format!("found `{to}` in the structure, expected one of the components"));
        };
        if order.iter().any(|c| c.name == found.name) {
            return Err(format!("found `{to}` a second time in the line, expected each component once"));
        }
        order.push(found);
    }
    Ok(order)
}
