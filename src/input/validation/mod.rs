//! Files as checked: SI, resolved, consistent.

mod calibrate;
mod chain;
mod crank;
mod designs;
mod engine;
mod fatigue;
mod inputs;
pub(super) mod material;
mod objectives;
mod optimise;
mod published;

pub use calibrate::{CalibrateSpec, FreeInput};
pub use inputs::Input;
pub use designs::DesignSpec;
use objectives::Judged;
pub use objectives::{ObjectiveSpec, UnitOf};
pub use optimise::{AbsorberSpec, FrontSpec, OptimiseSpec, Size};

use super::error::{At, Check, InputError, Source};
use super::published::Published;
use super::schema;
use super::tables::Reach;
use crate::absorber::mounted::station_of;
use crate::crankshaft::{Crank, FatigueSpec, stations_of_throws};
use crate::drivetrain::{Chain, Modes};
use crate::engine::{Engine, Order, Source as TorqueSource};
use crate::objective::{Condition, Limit};
use crate::response::Quantity;
use std::path::Path;

/// How responses are computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ResponseMethod {
    /// The chain once, absorbers as a change of rank one.
    Receptance,
    /// The whole system at every point.
    Direct,
    /// Receptance; searches take the cheapest way that is within tolerance.
    Auto,
}

/// Largest relative error of a peak in a search, where a study says nothing.
const DEFAULT_TOLERANCE: f64 = 1e-3;

/// A study, ready to run.
#[derive(Debug, Clone)]
pub struct Study {
    /// File name without ending.
    pub name: String,
    /// Cylinders and pressure.
    pub engine: Engine,
    /// Torsional chain.
    pub chain: Chain,
    /// Its undamped modes.
    pub modes: Modes,
    /// Ascending, rpm.
    pub speeds_rpm: Vec<f64>,
    /// Highest order.
    pub order_limit: f64,
    /// How responses are computed.
    pub method: ResponseMethod,
    /// Largest relative error of a peak in a search, where the method is `auto`.
    pub tolerance: f64,
    /// Whether peaks are refined between speeds.
    pub refine_peaks: bool,
    /// Given designs.
    pub designs: Vec<DesignSpec>,
    /// Station whose amplitude is reported.
    pub hub: usize,
    /// Twist that is reported.
    pub twist: Quantity,
    /// To be small.
    pub objective: ObjectiveSpec,
    /// What more optima of the main size are to make small, each by itself.
    pub more_objectives: Vec<ObjectiveSpec>,
    /// To hold, with their words in the file.
    pub limits: Vec<(String, Limit)>,
    /// What to optimise.
    pub optimise: Option<OptimiseSpec>,
    /// Front to follow.
    pub front: Option<FrontSpec>,
    /// Conditions every design is evaluated in; firing always is.
    pub conditions: Vec<Condition>,
    /// Tables to compare with.
    pub published: Option<Published>,
    /// Inputs to fit to them.
    pub calibrate: Option<CalibrateSpec>,
    /// Dimensions of the crank, where the engine file has them.
    pub crank: Option<Crank>,
    /// How the crank's margin is judged.
    pub fatigue: Option<FatigueSpec>,
}

impl Study {
    /// An objective: the first, or one of those after it.
    pub fn objective_of(&self, index: usize) -> &ObjectiveSpec {
        index.checked_sub(1).and_then(|i| self.more_objectives.get(i)).unwrap_or(&self.objective)
    }
}

/// More points than this in a sweep would take gigabytes: a mistake in the file.
const MOST_POINTS: f64 = 5e6;

pub(super) fn resolve(
    path: &Path,
    source: &Source,
    study: &schema::study::RawStudy,
    engine_path: &Path,
    engine_source: &Source,
    raw_engine: &schema::engine::RawEngine,
) -> Result<Study, InputError> {
    let mut in_engine = Check::new(engine_source);
    let engine = engine::resolve(&mut in_engine, raw_engine, engine_path.parent().unwrap_or_else(|| Path::new("")));
    let chain = chain::resolve(&mut in_engine, raw_engine, engine.as_ref().map_or(0, |e| e.layout.throws()));
    let crank = match (&raw_engine.crank, &engine) {
        (Some(raw), Some(engine)) => crank::resolve(&mut in_engine, raw, engine),
        _ => None,
    };
    let mut check = Check::new(source);
    let speeds_rpm = speeds(&mut check, study);
    let order_limit = study.order_limit.as_ref().map_or(12.0, |o| check.within(o, 0.5..=200.0, "an order from 0.5 to 200"));
    if speeds_rpm.len() as f64 * order_limit * 2.0 > MOST_POINTS {
        let found = speeds_rpm.len();
        check.wrong(
            &study.speed_rpm,
            format!("found {found} speeds with orders up to {order_limit}, expected at most {MOST_POINTS} points"),
        );
    }
    // what follows needs a chain and an engine that make sense
    let (Some(mut engine), Some(chain), true) = (engine, chain, in_engine.mistakes.is_empty()) else {
        let mut mistakes = InputError::sorted(in_engine.mistakes).mistakes;
        mistakes.extend(InputError::sorted(check.mistakes).mistakes);
        return Err(InputError { mistakes });
    };
    check_load(&mut check, study, &mut engine);
    check_orders(&mut check, study, &engine, order_limit);
    check_range(&mut check, study, &engine, &speeds_rpm);
    let modes = Modes::new(&chain);
    let designs = designs::resolve(&mut check, study, &chain, &modes);
    let optimise = study.optimise.as_ref().and_then(|o| optimise::resolve(&mut check, o, &engine, &chain, &modes));
    let hub = match (&optimise, designs.iter().find(|d| !d.absorbers.is_empty())) {
        (Some(o), _) => o.station(0),
        (None, Some(d)) => station_of(&d.absorbers, 0),
        (None, None) => 0,
    };
    let folder = path.parent().unwrap_or_else(|| Path::new(""));
    let fatigue = study.fatigue.as_ref().and_then(|f| {
        check_throws(&mut check, f, &chain);
        let spec = fatigue::resolve(&mut check, f, crank.as_ref(), folder)?;
        if let (Some(raw), Some(crank), true) = (&raw_engine.crank, &crank, fatigue::needs_formulas(&spec)) {
            crank::check_ranges(&mut in_engine, raw.get_ref(), crank);
        }
        Some(spec)
    });
    let judged = match (&study.fatigue, &fatigue) {
        (None, _) => Judged::Not,
        (Some(_), None) => Judged::Wrongly,
        (Some(_), Some(spec)) => Judged::By(spec),
    };
    let mut more_objectives = objectives::objectives(&mut check, study, &chain, hub, judged);
    let objective = more_objectives.remove(0);
    if let (Some(second), None) = (study.objective.get(1), &optimise) {
        check.wrong(second, "found a second [[objective]] without [optimise], expected what is to be optimised by it");
    }
    let limits = objectives::limits(&mut check, study, &chain, judged);
    let tolerance = study
        .response
        .tolerance
        .as_ref()
        .map_or(DEFAULT_TOLERANCE, |t| check.within(t, 1e-9..=0.1, "a relative error from 1e-9 to 0.1 (0.001 is 0.1 %)"));
    let front = optimise::front(&mut check, study, optimise.as_ref(), &chain, &modes);
    let mut conditions = study.conditions.as_ref().map_or_else(Vec::new, |c| optimise::conditions(&mut check, c, &engine));
    conditions.extend(optimise.iter().flat_map(|o| &o.conditions).filter(|c| !conditions.contains(c)).copied().collect::<Vec<_>>());
    let names: Vec<String> = designs.iter().map(|d| d.name.clone()).collect();
    let orders = match &engine.source {
        TorqueSource::Cylinder { .. } => Order::up_to(order_limit, engine.strokes),
        TorqueSource::Harmonics(table) => table.harmonics.iter().map(|h| h.0).filter(|o| o.value() <= order_limit).collect(),
    };
    let reach = Reach { designs: &names, speeds_rpm: (speeds_rpm[0], speeds_rpm[speeds_rpm.len() - 1]), orders: &orders };
    let limits_of_fatigue = fatigue.as_ref().and_then(|f| f.limits.as_ref());
    let published = study.published.as_ref().map(|p| published::resolve(&mut check, p.get_ref(), folder, &reach, limits_of_fatigue));
    let read = check.mistakes.is_empty();
    let calibrate = study
        .calibrate
        .as_ref()
        .filter(|_| read)
        .and_then(|c| calibrate::resolve(&mut check, c, published.as_ref(), &designs, &engine, (&chain, &modes)));
    if study.design.is_empty() && study.optimise.is_none() {
        check.wrong(&study.engine, "found neither a design nor [optimise], expected at least one of them in a study");
    }
    if !check.mistakes.is_empty() || !in_engine.mistakes.is_empty() {
        let mut mistakes = InputError::sorted(in_engine.mistakes).mistakes;
        mistakes.extend(InputError::sorted(check.mistakes).mistakes);
        return Err(InputError { mistakes });
    }
    let last = chain.len() - 1;
    let twist = match objective.measure.quantities.as_slice() {
        [twist @ Quantity::Twist { to: Some(_), .. }] => *twist,
        [twist @ Quantity::Twist { to: None, .. }] if last == 0 || objective.is_twist => *twist,
        _ => objectives::default_twist(&chain, hub),
    };
    Ok(Study {
        name: path.file_stem().map_or_else(|| "study".into(), |s| s.to_string_lossy().into_owned()),
        engine,
        chain,
        modes,
        speeds_rpm,
        order_limit,
        method: match study.response.method {
            schema::study::RawMethod::Receptance => ResponseMethod::Receptance,
            schema::study::RawMethod::Direct => ResponseMethod::Direct,
            schema::study::RawMethod::Auto => ResponseMethod::Auto,
        },
        tolerance,
        refine_peaks: study.response.refine_peaks.unwrap_or(true),
        designs,
        hub,
        twist,
        objective,
        more_objectives,
        limits,
        optimise,
        front,
        conditions,
        published,
        calibrate,
        crank,
        fatigue,
    })
}

/// A table named in a file: a missing one is a mistake at its name, a mistake in it has its own place.
fn table<T>(check: &mut Check, name: &At<String>, folder: &Path, read: impl Fn(&Path) -> Result<T, InputError>) -> Option<T> {
    let path = folder.join(name.get_ref());
    if !path.is_file() {
        let help = format!("looked for {}; paths are relative to the file they stand in", path.display());
        check.wrong_with_help(name, if path.exists() { "found no file there, expected a table" } else { "file not found" }, help);
        return None;
    }
    read(&path).map_err(|mut e| check.mistakes.append(&mut e.mistakes)).ok()
}

fn speeds(check: &mut Check, study: &schema::study::RawStudy) -> Vec<f64> {
    let raw = study.speed_rpm.get_ref();
    let before = check.mistakes.len();
    let (from, to, step) = (check.positive(&raw.from), check.positive(&raw.to), check.positive(&raw.step));
    if to < from {
        check.wrong(&raw.to, format!("found an empty speed range, {from} to {to} rpm, expected `to` of at least `from`"));
    }
    let steps = ((to - from) / step + 1e-9).floor();
    if steps.is_finite() && steps > MOST_POINTS {
        check.wrong(&raw.step, format!("found a step of {step} rpm, which makes {steps} speeds, expected at most {MOST_POINTS}"));
    }
    if check.mistakes.len() > before {
        return vec![from];
    }
    let mut speeds: Vec<f64> = (0..=steps as usize).map(|i| from + i as f64 * step).collect();
    let last = speeds[speeds.len() - 1];
    // the highest speed belongs to the range even where the step does not meet it
    if to - last > 1e-6 * step {
        speeds.push(to);
    }
    speeds
}

/// A margin needs the torque beside every throw.
fn check_throws(check: &mut Check, fatigue: &At<schema::fatigue::RawFatigue>, chain: &Chain) {
    let throws = chain.stations.iter().map(|s| s.throws.len()).sum();
    let found = if chain.len() == 1 || chain.stations.iter().any(|s| s.throws.len() > 1) {
        "found [fatigue] for a chain with several throws on a station or without shafts, expected a station for each throw"
    } else if stations_of_throws(chain, throws).is_none() {
        "found [fatigue] for a chain whose throws do not follow each other, expected them in the order of their numbers"
    } else {
        return;
    };
    check.wrong(fatigue, found);
}

fn check_load(check: &mut Check, study: &schema::study::RawStudy, engine: &mut Engine) {
    let Some(load) = &study.load_fraction else { return };
    let fraction = check.within(load, 0.0..=1.5, "a fraction of the full mean pressure, 0 to 1.5");
    let scaled = match &mut engine.source {
        TorqueSource::Cylinder { pressure, .. } => pressure.scale_load(fraction),
        TorqueSource::Harmonics(_) => false,
    };
    if !scaled {
        check.wrong(load, "found `load_fraction` with measured traces or harmonics, expected it with `otto` or `wiebe` only");
    }
}

fn check_orders(check: &mut Check, study: &schema::study::RawStudy, engine: &Engine, limit: f64) {
    let some = match &engine.source {
        TorqueSource::Cylinder { .. } => !Order::up_to(limit, engine.strokes).is_empty(),
        TorqueSource::Harmonics(table) => table.harmonics.iter().any(|(o, c)| o.value() <= limit && c.norm() > 0.0),
    };
    if !some {
        let message = format!("found no order of the torque up to {limit}, expected at least one that is not zero");
        match &study.order_limit {
            Some(o) => check.wrong(o, message),
            None => check.wrong(&study.engine, message),
        }
    }
}

fn check_range(check: &mut Check, study: &schema::study::RawStudy, engine: &Engine, speeds: &[f64]) {
    let TorqueSource::Cylinder { pressure, .. } = &engine.source else { return };
    let table = pressure.speeds_rpm();
    let (first, last) = (speeds[0], speeds[speeds.len() - 1]);
    if table.len() > 1 && (first < table[0] - 1e-9 || last > table[table.len() - 1] + 1e-9) {
        check.wrong(
            &study.speed_rpm,
            format!(
                "found {first} to {last} rpm, expected a range within the pressure table of the engine, {} to {} rpm",
                table[0],
                table[table.len() - 1]
            ),
        );
    }
}

/// Index of a station named in the study; a mistake where there is none.
fn station(check: &mut Check, chain: &Chain, name: &At<String>) -> Option<usize> {
    let found = chain.find(name.get_ref());
    if found.is_none() {
        let names: Vec<&str> = chain.stations.iter().take(24).map(|s| s.name.as_str()).collect();
        check.wrong_with_help(
            name,
            format!("found station `{}`, expected one of the engine's stations", name.get_ref()),
            format!("the stations are {}", names.join(", ")),
        );
    }
    found
}
