//! Numbers of the text: inputs of the engine, and peaks of pin force, throw torque and vibratory torque at named speeds.

use super::predicted::speed_of as speed_of_condition;
use super::{Entry, Kind, Role, Uncertainty};
use crate::analysis::RunError;
use crate::drivetrain::System;
use crate::engine::cycle::{ThrowLoads, throw_loads};
use crate::engine::{Pressure, Source};
use crate::input::published::PublishedQuantity;
use crate::input::{DesignSpec, Published, Study};
use crate::objective::{Measure, Over, PeakFinder};
use crate::response::{Direct, Grid, Method, Quantity, Work};
use crate::units::{M_PER_MM, N_PER_KN, RAD_PER_S_PER_RPM, W_PER_KW};

/// A peak further off than this is not the same quantity.
const FAR: f64 = 50.0;

fn entry(q: &PublishedQuantity, design: &str, computed: Option<f64>, role: Role, note: String) -> Entry {
    Entry {
        table: "text".into(),
        design: design.into(),
        quantity: q.name.replace('_', " "),
        kind: Kind::Other,
        unit: q.unit.clone(),
        published: q.value.as_ref().ok().copied(),
        computed,
        uncertainty: Uncertainty::default(),
        role,
        note,
    }
}

/// Inputs of the engine as printed beside those of the engine file.
pub fn inputs(study: &Study, published: &Published) -> Vec<Entry> {
    let Source::Cylinder { geometry, pressure } = &study.engine.source else { return Vec::new() };
    let torque = |of: &dyn Fn((f64, f64)) -> f64| match pressure {
        Pressure::Otto(o) => o.speeds_rpm.iter().copied().zip(o.brake_torque.iter().copied()).map(of).reduce(f64::max),
        _ => None,
    };
    let study_value = |name: &str| match name {
        "piston_diameter" => Some((geometry.bore / M_PER_MM, "mm")),
        "crank_radius" => Some((geometry.slider_crank.crank_radius / M_PER_MM, "mm")),
        "rod_length" => Some((geometry.slider_crank.rod_length / M_PER_MM, "mm")),
        "rod_mass" => Some((geometry.rod_mass, "kg")),
        "piston_mass" => Some((geometry.piston_mass, "kg")),
        "bank_angle" => study.engine.layout.bank_angle_deg.map(|b| (b, "deg")),
        "rated_power" => torque(&|(speed, torque)| torque * speed * RAD_PER_S_PER_RPM / W_PER_KW).map(|p| (p, "kW")),
        "max_torque" => torque(&|(_, torque)| torque).map(|t| (t, "N m")),
        _ => None,
    };
    let given = |q: &PublishedQuantity| {
        let (value, unit) = study_value(&q.name)?;
        let same = q.unit == unit;
        let note = if same { "input of the engine file".into() } else { format!("input of the engine file: {value} {unit}") };
        Some(entry(q, "", Some(value).filter(|_| same), Role::Given, note))
    };
    published.quantities.iter().filter_map(given).collect()
}

/// A peak as the text names it: `crankpin_force_max_power_peak`, `throw_torque_applied_peak_max_speed`,
/// `vibratory_torque_peak_max_torque_unity`.
struct Named<'a> {
    what: &'static str,
    condition: &'static str,
    design: &'a str,
}

fn named(name: &str) -> Option<Named<'_>> {
    let what = ["crankpin_force", "throw_torque_applied", "vibratory_torque"].into_iter().find(|w| name.starts_with(w))?;
    // longest first: `max_speed` must not be found in another word
    let condition = ["max_torque", "max_power", "max_speed"].into_iter().find(|c| name.contains(c))?;
    let (_, rest) = name.split_once(condition)?;
    Some(Named { what, condition, design: rest.trim_start_matches('_').trim_end_matches("peak").trim_end_matches('_') })
}

/// The design a word of the text means: `unity` is `tuned_unity`.
fn design_of<'a>(study: &'a Study, word: &str) -> Option<&'a DesignSpec> {
    study.designs.iter().find(|d| d.name == word || d.name.split('_').any(|part| part == word))
}

/// Peaks of the text at the speeds it names (`speed_max_torque`, `speed_max_power`, `speed_max`).
pub fn peaks(study: &Study, published: &Published, system: &System) -> Result<Vec<Entry>, RunError> {
    let speed_of = |condition: &str| {
        let found = speed_of_condition(published, condition);
        found.filter(|s| *s >= study.speeds_rpm[0] && *s <= study.speeds_rpm[study.speeds_rpm.len() - 1])
    };
    let mut loads: Vec<(f64, Option<ThrowLoads>)> = Vec::new();
    let mut entries = Vec::new();
    for q in &published.quantities {
        let Some(name) = named(&q.name) else { continue };
        let Some(speed) = speed_of(name.condition) else { continue };
        let design = design_of(study, name.design);
        let (computed, note) = match (name.what, design) {
            ("vibratory_torque", Some(design)) => {
                let found = vibratory_torque(system, design, speed)?;
                (
                    found.map(|f| f.1),
                    found.map_or_else(String::new, |f| {
                        format!("half peak-to-peak of shaft {} at {speed} rpm", system.chain.shaft_name(f.0))
                    }),
                )
            }
            ("vibratory_torque", None) => continue,
            (what, _) => {
                if !loads.iter().any(|l| l.0 == speed) {
                    loads.push((speed, throw_loads(&study.engine, speed)));
                }
                let at = loads.iter().find(|l| l.0 == speed).and_then(|l| l.1.as_ref());
                let largest = |rows: &[Vec<f64>]| rows.iter().flatten().copied().fold(0.0, f64::max);
                let compression = |rows: &[Vec<[f64; 2]>]| rows.iter().flatten().map(|f| -f[0]).fold(0.0, f64::max);
                if what == "crankpin_force" {
                    (at.map(|l| compression(&l.pin_force()) / N_PER_KN), format!("largest compression over the cycle at {speed} rpm"))
                } else {
                    (at.map(|l| largest(&l.torque)), format!("largest over the cycle at {speed} rpm"))
                }
            }
        };
        let words = q.value.as_ref().err().map_or_else(String::new, |w| format!("printed: {w}; "));
        let mut made = entry(q, design.map_or("", |d| &d.name), computed, Role::Predicted, format!("{words}{note}"));
        if name.what == "vibratory_torque" {
            made.kind = Kind::VibratoryTorque;
        }
        if design.is_some()
            && let Some(short) = made.quantity.strip_suffix(name.design)
        {
            made.quantity = short.trim_end().to_owned();
        }
        if made.deviation_percent().is_some_and(|d| d.abs() > FAR) {
            made.role = Role::Unexplained;
            made.note.push_str("; another quantity, or taken in another way");
        }
        entries.push(made);
    }
    Ok(entries)
}

/// The shaft with the largest vibratory torque at one speed, and that torque, N m.
fn vibratory_torque(system: &System, design: &DesignSpec, speed_rpm: f64) -> Result<Option<(usize, f64)>, RunError> {
    let grid = Grid::new(&[speed_rpm], &[]);
    let method = Method::Direct(Direct::new(system, &grid));
    let finder = PeakFinder::new(system, &grid, &method, false);
    let quantities = (0..system.chain.len() - 1).map(Quantity::ShaftTorque).collect();
    let peak = finder.peak(&design.absorbers, &Measure::new(quantities, Over::Synthesis), &mut Work::default());
    let peak = peak.map_err(|error| RunError { what: format!("design `{}`", design.name), error })?;
    Ok(peak.and_then(|p| match p.quantity {
        Quantity::ShaftTorque(s) => Some((s, p.value)),
        _ => None,
    }))
}
