//! Stresses and safety factors of the crank by our own loads, beside the printed ones: by the method of the source (two instants of the cycle, torsion by
//! its cases, its own factors on round sections), and by the full cycle with the chain's torque. Lengths of the crank are assumed, so that this tells orders of
//! magnitude and which designs do better, no more.

use super::notches::published_factors;
use super::{Entry, Kind, Role, Uncertainty};
use crate::analysis::torsion_case::{self, at_bearings, in_the_middle, most_used};
use crate::analysis::{RunError, margins};
use crate::crankshaft::loads::CrankModel;
use crate::crankshaft::torsion_cases::{Instants, PerLoad, stresses};
use crate::crankshaft::{MarginCriterion, Place, TorsionCase, section};
use crate::drivetrain::System;
use crate::fatigue::{Criterion, Cycle, Strength};
use crate::input::published::PublishedFatigue;
use crate::input::{DesignSpec, Published, Study};
use crate::numerics::synthesis::Extremes;
use crate::response::Grid;
use crate::units::PA_PER_MPA;

/// A speed that the tables name.
pub(crate) fn speed_of(published: &Published, condition: &str) -> Option<f64> {
    let key = if condition == "max_speed" { "speed_max".to_owned() } else { format!("speed_{condition}") };
    published.quantities.iter().find(|q| q.name == key).and_then(|q| q.value.as_ref().ok().copied())
}

/// Extremes of the torque of every shaft at one speed.
fn torques(system: &System, design: &DesignSpec, speed_rpm: f64) -> Result<Vec<Extremes>, RunError> {
    let found = torsion_case::torques(system, &design.absorbers, &Grid::new(&[speed_rpm], &[]));
    let rows = found.map_err(|error| RunError { what: format!("design `{}`", design.name), error })?;
    Ok(rows.iter().map(|row| row[0]).collect())
}

/// Entries beside every printed safety factor, and beside the finite-element stresses.
///
/// # Errors
/// [`RunError`] where a design has no finite response.
pub fn entries(study: &Study, published: &Published, system: &System, strength: Option<Strength>) -> Result<Vec<Entry>, RunError> {
    let (Some(crank), Some(factors), Some(strength)) = (&study.crank, published_factors(published), strength) else {
        return Ok(Vec::new());
    };
    let together = in_the_middle(crank);
    let Some(model) = CrankModel::thesis(&study.engine, &together) else { return Ok(Vec::new()) };
    let round = |diameter: f64, bore: f64, bending: f64, torsion: f64| PerLoad {
        bending: section::bending(diameter, bore) * bending,
        on_web: false,
        torsion: section::torsion(diameter, bore) * torsion,
    };
    let per_load = [
        round(crank.pin_diameter, crank.pin_bore, factors[0], factors[1]),
        round(crank.journal_diameter, crank.journal_bore, factors[2], factors[3]),
    ];
    let mut list = Vec::new();
    let mut known: Vec<(String, Instants)> = Vec::new();
    for f in &published.fatigue {
        let (Some(speed), Some(case)) = (speed_of(published, &f.condition), TorsionCase::of(&f.torsion_case)) else { continue };
        if !(study.speeds_rpm[0]..=study.speeds_rpm[study.speeds_rpm.len() - 1]).contains(&speed) {
            continue;
        }
        if !known.iter().any(|k| k.0 == f.condition) {
            known.push((f.condition.clone(), Instants::new(&study.engine, &model.at(speed))));
        }
        let Some((_, at)) = known.iter().find(|k| k.0 == f.condition) else { continue };
        let design = &study.designs[f.design];
        let Some(vibratory) = at_bearings(&study.chain, crank.throws(), &torques(system, design, speed)?) else { continue };
        let place = usize::from(f.fillet == "journal");
        let own = stresses(case, at, &vibratory, per_load, strength).cycles[place];
        list.extend(beside(f, &design.name, own, strength));
    }
    list.extend(full_cycle(study, published, system)?);
    Ok(list)
}

fn beside(f: &PublishedFatigue, design: &str, own: Cycle, strength: Strength) -> [Entry; 3] {
    let note = "the source's method with our loads; lengths of the crank are assumed";
    let entry = |what: &str, kind: Kind, unit: &str, published: f64, computed: f64| Entry {
        table: f.table.clone(),
        design: design.into(),
        quantity: format!("{what} by our loads, case {}, {}, {}", f.torsion_case, f.condition.replace('_', " "), f.fillet),
        kind,
        unit: unit.into(),
        published: Some(published),
        computed: Some(computed),
        uncertainty: Uncertainty::default(),
        role: Role::Predicted,
        note: note.into(),
    };
    [
        entry("stress amplitude", Kind::OwnStress, "MPa", f.cycle.amplitude / PA_PER_MPA, own.amplitude / PA_PER_MPA),
        entry("stress mean", Kind::OwnStress, "MPa", f.cycle.mean / PA_PER_MPA, own.mean / PA_PER_MPA),
        entry("safety factor", Kind::OwnMargin, "-", f.safety_factor, Criterion::Goodman.safety_factor(own, strength)),
    ]
}

/// Our own cycle of stress at the conditions of the tables: beside the finite elements (no absorber), and as safety factors of every design.
fn full_cycle(study: &Study, published: &Published, system: &System) -> Result<Vec<Entry>, RunError> {
    let conditions: Vec<&str> = ["max_torque", "max_power", "max_speed"].into_iter().filter(|c| speed_of(published, c).is_some()).collect();
    let speeds: Vec<f64> = conditions.iter().filter_map(|c| speed_of(published, c)).collect();
    let Some(model) = margins::model(study, &system.excitation.harmonics, &Grid::new(&speeds, &[])).filter(|_| !speeds.is_empty()) else {
        return Ok(Vec::new());
    };
    let criterion = model.criteria.iter().position(|c| *c == MarginCriterion::MeanStress(Criterion::Goodman));
    let Some(criterion) = criterion else { return Ok(Vec::new()) };
    let printed = |condition: &str, design: usize, place: Place| {
        let same = |f: &&PublishedFatigue| {
            (f.design, f.condition.as_str(), f.fillet.as_str()) == (design, condition, place.name())
                && TorsionCase::of(&f.torsion_case) == Some(TorsionCase::C)
        };
        published.fatigue.iter().find(same).map(|f| f.safety_factor)
    };
    let mut list = Vec::new();
    for (condition, speed) in conditions.iter().zip(&speeds) {
        for (design_index, design) in study.designs.iter().enumerate() {
            let torques = torques(system, design, *speed)?;
            for place in [Place::Crankpin, Place::Journal] {
                let Some((name, used)) = most_used(&model, criterion, place, *speed, &torques) else { continue };
                let entry = |quantity: String, kind: Kind, unit: &str, published: Option<f64>, computed: f64, note: String| Entry {
                    table: "-".into(),
                    design: design.name.clone(),
                    quantity,
                    kind,
                    unit: unit.into(),
                    published,
                    computed: Some(computed),
                    uncertainty: Uncertainty::default(),
                    role: Role::Predicted,
                    note,
                };
                let words = condition.replace('_', " ");
                list.push(entry(
                    format!("safety factor over the full cycle, {words}, {}", place.name()),
                    Kind::FullCycleMargin,
                    "-",
                    printed(condition, design_index, place),
                    1.0 / used.value,
                    format!("at {name}, bending on the section of the web, the chain's torque, beside the printed case C; lengths of the crank are assumed"),
                ));
                let fem = published.stresses.iter().find(|s| s.model.contains("fem") && s.condition == *condition);
                if let (Some(fem), Place::Crankpin, true) = (fem, place, design.absorbers.is_empty()) {
                    let mut own = entry(
                        format!("largest von Mises stress over the full cycle, {words}, beside finite elements"),
                        Kind::FullCycleStress,
                        "MPa",
                        Some(fem.von_mises / PA_PER_MPA),
                        (used.cycle.amplitude + used.cycle.mean) / PA_PER_MPA,
                        format!("amplitude and mean at {name}, bending on the section of the web; lengths of the crank are assumed"),
                    );
                    own.table.clone_from(&fem.table);
                    list.push(own);
                }
            }
        }
    }
    Ok(list)
}
