//! Stresses and safety factors of the crank by our own loads, beside the printed ones: by the method of the source (two instants of the cycle, torsion by
//! its cases, its own factors on round sections), and by the full cycle with the chain's torque. Lengths of the crank are assumed, so that this tells orders of
//! magnitude and which designs do better, no more.

use super::notches::published_factors;
use super::torsion_cases::{Case, halves};
use super::{Entry, Kind, Role, Uncertainty};
use crate::analysis::{RunError, margins};
use crate::crankshaft::loads::{CrankLoads, CrankModel};
use crate::crankshaft::{Crank, Margin, MarginCriterion, Place, Torque, section};
use crate::drivetrain::System;
use crate::fatigue::{Criterion, Cycle, Strength};
use crate::input::published::PublishedFatigue;
use crate::input::{DesignSpec, Published, Study};
use crate::numerics::synthesis::Extremes;
use crate::objective::PeakFinder;
use crate::response::{Direct, Grid, Method, Quantity, Response, Work};
use crate::units::{PA_PER_MPA, RAD_PER_DEG};
use std::f64::consts::PI;

/// From firing to the dead centre at which the exhaust stroke begins, rad.
const TO_EXHAUST: f64 = PI;

/// A speed that the tables name.
pub(crate) fn speed_of(published: &Published, condition: &str) -> Option<f64> {
    let key = if condition == "max_speed" { "speed_max".to_owned() } else { format!("speed_{condition}") };
    published.quantities.iter().find(|q| q.name == key).and_then(|q| q.value.as_ref().ok().copied())
}

/// Extremes of the torque of every shaft at one speed.
fn torques(study: &Study, system: &System, design: &DesignSpec, speed_rpm: f64) -> Result<Vec<Extremes>, RunError> {
    let grid = Grid::new(&[speed_rpm], &[]);
    let method = Method::Direct(Direct::new(system, &grid));
    let finder = PeakFinder::new(system, &grid, &method, false);
    let shafts: Vec<Quantity> = (0..study.chain.len() - 1).map(Quantity::ShaftTorque).collect();
    let sweeps = finder.method.sweep_each(&design.absorbers, &shafts, &mut Work::default());
    let sweeps = sweeps.map_err(|error| RunError { what: format!("design `{}`", design.name), error })?;
    Ok(sweeps.iter().map(|s| finder.extremes(s)[0]).collect())
}

/// Everything of one condition that no absorber changes.
struct Instants {
    /// Resultant moment at every crankpin at the largest and the smallest load, N m.
    moments: [Vec<f64>; 2],
    /// Torque of every throw then, N m.
    applied: [Vec<f64>; 2],
}

/// The two instants of \[Villalva 2014\] section 7.3.1: where a crankpin is pushed hardest towards the crankshaft, and where the exhaust stroke of the same
/// cylinder begins.
fn instants(study: &Study, loads: &CrankLoads) -> Instants {
    let n = loads.theta.len();
    let pushed = |t: usize, j: usize| -loads.on_throw(t, j)[0];
    let (mut throw, mut first) = (0, 0);
    for t in 0..loads.torque.len() {
        for j in 0..n {
            if pushed(t, j) > pushed(throw, first) {
                (throw, first) = (t, j);
            }
        }
    }
    let cycle = study.engine.cycle_deg() * RAD_PER_DEG;
    let apart = |firing: f64| {
        let d = (loads.theta[first] - firing).rem_euclid(cycle);
        d.min(cycle - d)
    };
    let firing = study.engine.layout.firing_on_throw(throw).iter().map(|f| f * RAD_PER_DEG);
    let nearest = firing.reduce(|a, b| if apart(b) < apart(a) { b } else { a }).unwrap_or(0.0);
    let second = ((nearest + TO_EXHAUST).rem_euclid(cycle) / cycle * n as f64) as usize % n;
    let moments = [first, second].map(|j| loads.pin_moments(j));
    Instants { moments, applied: [first, second].map(|j| loads.torque.iter().map(|t| t[j]).collect()) }
}

/// Equivalent stresses at crankpin and journal of the throw with the smallest safety factor at its crankpin, eqs. (7.23) to (7.30).
fn by_source(crank: &Crank, case: Case, at: &Instants, vibratory: &[f64], factors: [f64; 4], strength: Strength) -> [Cycle; 2] {
    let twisting = [halves(case, &at.applied[0], vibratory, 1.0), halves(case, &at.applied[1], vibratory, -1.0)];
    let round = [(crank.pin_diameter, crank.pin_bore), (crank.journal_diameter, crank.journal_bore)];
    let cycle = |throw: usize, half: usize, place: usize| {
        let (diameter, bore) = round[place];
        let bending = at.moments.each_ref().map(|m| m[throw] * section::bending(diameter, bore) * factors[2 * place]);
        let torsion = twisting.each_ref().map(|t| t[throw][half] * section::torsion(diameter, bore) * factors[2 * place + 1]);
        let combine = |b: f64, t: f64| (b * b + 3.0 * t * t).sqrt();
        Cycle {
            amplitude: combine(0.5 * (bending[0] - bending[1]), 0.5 * (torsion[0] - torsion[1])),
            mean: combine(0.5 * (bending[0] + bending[1]), 0.5 * (torsion[0] + torsion[1])),
        }
    };
    let all = (0..crank.throws()).flat_map(|t| [(t, 0), (t, 1)]);
    let used = |(t, h): (usize, usize)| Criterion::Goodman.utilisation(cycle(t, h, 0), strength).0;
    let (throw, half) = all.reduce(|a, b| if used(b) > used(a) { b } else { a }).unwrap_or((0, 0));
    [cycle(throw, half, 0), cycle(throw, half, 1)]
}

/// Entries beside every printed safety factor, and beside the finite-element stresses.
///
/// # Errors
/// [`RunError`] where a design has no finite response.
pub fn entries(study: &Study, published: &Published, system: &System, strength: Option<Strength>) -> Result<Vec<Entry>, RunError> {
    let (Some(crank), Some(factors), Some(strength)) = (&study.crank, published_factors(published), strength) else {
        return Ok(Vec::new());
    };
    // the source puts both rods of a V at the middle of the pin
    let together = Crank { rod_spacing: 0.0, ..crank.clone() };
    let Some(model) = CrankModel::thesis(&study.engine, &together) else { return Ok(Vec::new()) };
    let mut list = Vec::new();
    let mut known: Vec<(String, Instants)> = Vec::new();
    for f in &published.fatigue {
        let (Some(speed), Some(case)) = (speed_of(published, &f.condition), Case::of(&f.torsion_case)) else { continue };
        if !(study.speeds_rpm[0]..=study.speeds_rpm[study.speeds_rpm.len() - 1]).contains(&speed) {
            continue;
        }
        if !known.iter().any(|k| k.0 == f.condition) {
            known.push((f.condition.clone(), instants(study, &model.at(speed))));
        }
        let Some((_, at)) = known.iter().find(|k| k.0 == f.condition) else { continue };
        let design = &study.designs[f.design];
        let shaken: Vec<f64> = torques(study, system, design, speed)?.iter().map(|e| e.half_peak_to_peak).collect();
        // a bearing between neighbouring throws carries the torque of the shaft there
        let vibratory: Vec<f64> = (0..=crank.throws()).map(|b| shaken[b.min(shaken.len() - 1)]).collect();
        let place = usize::from(f.fillet == "journal");
        let own = by_source(crank, case, at, &vibratory, factors, strength)[place];
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
            (f.design, f.condition.as_str(), f.fillet.as_str()) == (design, condition, place.name()) && Case::of(&f.torsion_case) == Some(Case::C)
        };
        published.fatigue.iter().find(same).map(|f| f.safety_factor)
    };
    let mut list = Vec::new();
    for (condition, speed) in conditions.iter().zip(&speeds) {
        for (design_index, design) in study.designs.iter().enumerate() {
            let torques = torques(study, system, design, *speed)?;
            for place in [Place::Crankpin, Place::Journal] {
                let Some((name, used)) = worst(&model, criterion, place, *speed, &torques) else { continue };
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
                        Kind::OwnStress,
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

/// The most used location at a place.
fn worst(
    model: &Margin,
    criterion: usize,
    place: Place,
    speed_rpm: f64,
    torques: &[Extremes],
) -> Option<(String, crate::crankshaft::Used)> {
    let own = model.locations.iter().enumerate().filter(|(i, s)| s.place == place && model.judges(criterion, *i));
    let used =
        own.map(|(i, s)| (s.name.clone(), model.used(criterion, i, speed_rpm, &Torque { extremes: torques[s.shaft], phasors: &[] })));
    used.reduce(|m, u| if u.1.value > m.1.value { u } else { m })
}
