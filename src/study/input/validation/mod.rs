//! Files as checked: SI, resolved, consistent.

mod absorbers;
mod calibrate;
mod catalogue;
mod chain;
mod checked_study;
mod crank;
mod damping;
mod derived_chain;
mod engine;
mod family;
mod fatigue;
mod flexible;
mod flexible_model;
mod imported;
mod inputs;
mod load;
pub(super) mod material;
mod material_laws;
mod material_states;
mod measures;
mod named;
mod optimise;
mod parts;
mod placeholders;
mod published;
mod ranges;
mod robust;
mod rooms;
mod rows;
pub(super) mod sizing;
mod substances;
mod systems;
mod tree;

pub use absorbers::DesignSpec;
use absorbers::Reaches;
pub use calibrate::{CalibrateSpec, FreeInput};
pub use catalogue::CatalogueSpec;
pub use catalogue::RETUNED;
use checked_study::DEFAULT_TOLERANCE;
pub use checked_study::{CrankModel, Reciprocating, ResponseMethod, Study};
pub use family::{AbsorberSpec, Size};
pub use flexible_model::FlexibleModel;
pub use inputs::Input;
pub use load::DutyPoint;
use material_states::{Known, Temperatures};
use measures::{Context, Judged};
pub use parts::PartsError;
use ranges::MOST_POINTS;
pub use sizing::{SizedAbsorber, SizedChain, SizingStudy};

use named::folder_of;
pub(super) use named::table;
pub use optimise::{FrontSpec, OptimiseSpec, ProveSpec};
pub use placeholders::Placeholder;
pub use robust::{AllocateSpec, RobustSpec, Sampling, scatter_key};

use super::error::{At, Check, InputError, Source};
use super::measure::MeasureSpec;
use super::published::Published;
use super::schema::bounds::{ORDER_LIMIT, RELATIVE_ERROR};
use super::schema::engine::RawEngine;
use super::schema::fatigue::RawCrankPressure;
use super::schema::study::RawStudy;
use super::tables::Reach;
use crate::absorber::mounted::station_of;
use crate::crankshaft::{Crank, FatigueSpec};
use crate::drivetrain::{Chain, Modes};
use crate::engine::{Engine, Excitation, Order, Source as TorqueSource};
use crate::objective::Condition;
use crate::objective::condition::Burning;
use crate::response::Quantity;
use crate::units::HZ_PER_RPM;
use std::path::Path;

/// The files of a study as they are read.
pub(super) struct Files<'a> {
    pub path: &'a Path,
    pub source: &'a Source,
    pub study: &'a RawStudy,
    pub engine_path: &'a Path,
    pub engine_source: &'a Source,
    pub engine: &'a RawEngine,
}

impl Files<'_> {
    /// What paths in the engine file are relative to.
    fn folder(&self) -> &Path {
        folder_of(self.engine_path)
    }
}

/// What of an engine and of a study's ranges everything else is checked against.
struct Base {
    engine: Engine,
    chain: Chain,
    crank: Option<Crank>,
    reciprocating: Reciprocating,
    speeds_rpm: Vec<f64>,
    order_limit: f64,
    known_rpm: Option<(f64, f64)>,
}

impl Base {
    /// Orders that the torque has, ascending.
    fn orders(&self) -> Vec<Order> {
        match &self.engine.source {
            TorqueSource::Cylinder { .. } => Order::up_to(self.order_limit, self.engine.strokes),
            TorqueSource::Harmonics(_) => Excitation::new(&self.engine, self.order_limit).orders,
        }
    }

    /// What absorbers are resolved against.
    fn reaches<'a>(&'a self, study: &'a Path, modes: &'a Modes, Known { temperatures, substances }: Known<'a>) -> Reaches<'a> {
        let orders = self.orders();
        let hz = |order: Option<&Order>, speed: f64| order.map_or(0.0, |o| o.value() * speed * HZ_PER_RPM);
        let frequencies_hz = (hz(orders.first(), self.speeds_rpm[0]), hz(orders.last(), self.speeds_rpm[self.speeds_rpm.len() - 1]));
        Reaches { chain: &self.chain, modes, temperatures, substances, folder: folder_of(study), frequencies_hz }
    }
}

fn base(files: &Files, check: &mut Check, in_engine: &mut Check) -> Option<Base> {
    let engine = engine::resolve(in_engine, files.engine, files.folder());
    let crank = match (&files.engine.crank, &engine) {
        (Some(raw), Some(engine)) => crank::resolve(in_engine, raw, engine),
        _ => None,
    };
    let chain = chain::resolve(in_engine, files.engine, engine.as_ref(), crank.as_ref());
    let study = files.study;
    let speeds_rpm = ranges::speeds(check, study);
    let order_limit = study.order_limit.as_ref().map_or(12.0, |o| check.within(o, &ORDER_LIMIT));
    // a mistake must not make what follows build a list of all orders up to it
    let order_limit = if order_limit <= ORDER_LIMIT.high { order_limit } else { ORDER_LIMIT.high };
    if speeds_rpm.len() as f64 * order_limit * 2.0 > MOST_POINTS {
        let found = speeds_rpm.len();
        check.wrong(
            &study.speed_rpm,
            format!("found {found} speeds with orders up to {order_limit}, expected at most {MOST_POINTS} points"),
        );
    }
    // what follows needs a chain and an engine that make sense
    let (Some(mut engine), Some(chain), true) = (engine, chain, in_engine.mistakes.is_empty()) else { return None };
    let known_rpm = ranges::known_speeds(check, study, &engine, &speeds_rpm);
    load::apply(check, study, &mut engine, &speeds_rpm);
    ranges::check_orders(check, study, &engine, order_limit);
    Some(Base { engine, chain, crank, reciprocating: chain::reciprocating(files.engine), speeds_rpm, order_limit, known_rpm })
}

/// All mistakes, those of the engine file first.
fn mistakes(in_engine: Check, check: Check) -> InputError {
    let mut mistakes = InputError::sorted(in_engine.mistakes).mistakes;
    mistakes.extend(InputError::sorted(check.mistakes).mistakes);
    InputError { mistakes }
}

pub(super) fn resolve(files: &Files) -> Result<Study, InputError> {
    let mut in_engine = Check::new(files.engine_source);
    let mut check = Check::new(files.source);
    check.meshed = tree::meshed(&files.engine.station);
    let mut placeholders = placeholders::resolve(&mut in_engine, &files.engine.placeholder);
    placeholders.extend(placeholders::resolve(&mut check, &files.study.placeholder));
    let Some(base) = base(files, &mut check, &mut in_engine) else { return Err(mistakes(in_engine, check)) };
    asks_for_something(&mut check, files.study);
    let study = rest(files, &mut check, &mut in_engine, base);
    match study {
        Some(study) if check.mistakes.is_empty() && in_engine.mistakes.is_empty() => Ok(Study { placeholders, ..study }),
        _ => Err(mistakes(in_engine, check)),
    }
}

/// How the crank's margin is judged.
fn judge(files: &Files, check: &mut Check, in_engine: &mut Check, base: &Base) -> Option<FatigueSpec> {
    let raw = files.study.fatigue.as_ref()?;
    ranges::check_throws(check, raw, &base.chain);
    let spec = fatigue::resolve(check, raw, base.crank.as_ref(), folder_of(files.path))?;
    if let Some(raw) = &files.engine.crank {
        crank::check_counterweights(in_engine, raw, &base.engine);
    }
    if let (Some(raw), Some(crank), true) = (&files.engine.crank, &base.crank, fatigue::needs_formulas(&spec)) {
        crank::check_ranges(in_engine, raw.get_ref(), crank);
    }
    Some(spec)
}

/// Published tables, and the inputs to be fitted to them where there is no mistake so far.
fn comparison(
    files: &Files,
    check: &mut Check,
    base: &Base,
    (modes, designs, fatigue): (&Modes, &[DesignSpec], Option<&FatigueSpec>),
) -> (Option<Published>, Option<CalibrateSpec>) {
    let names: Vec<String> = designs.iter().map(|d| d.name.clone()).collect();
    let orders = match &base.engine.source {
        TorqueSource::Cylinder { .. } => Order::up_to(base.order_limit, base.engine.strokes),
        TorqueSource::Harmonics(table) => table.harmonics.iter().map(|h| h.0).filter(|o| o.value() <= base.order_limit).collect(),
    };
    let speeds = &base.speeds_rpm;
    let reach = Reach { designs: &names, speeds_rpm: (speeds[0], speeds[speeds.len() - 1]), orders: &orders };
    let limits = fatigue.and_then(|f| f.limits.as_ref());
    let published = files.study.published.as_ref();
    let published = published.map(|p| published::resolve(check, p.get_ref(), folder_of(files.path), &reach, limits));
    let read = check.mistakes.is_empty();
    let calibrate = files.study.calibrate.as_ref().filter(|_| read);
    let calibrate = calibrate.and_then(|c| calibrate::resolve(check, c, published.as_ref(), designs, &base.engine, (&base.chain, modes)));
    (published, calibrate)
}

/// The twist that is reported: that of the first objective or limit of a twist, else the one from the hub through the chain.
fn reported_twist<'m>(mut asked: impl Iterator<Item = &'m MeasureSpec>, chain: &Chain, hub: usize) -> Quantity {
    let twist = |m: &MeasureSpec| match m.measure.quantities.as_slice() {
        [twist @ Quantity::Twist { to: Some(_), .. }] => Some(*twist),
        [twist @ Quantity::Twist { to: None, .. }] if chain.len() == 1 || m.is_twist => Some(*twist),
        _ => None,
    };
    asked.find_map(twist).unwrap_or_else(|| measures::default_twist(chain, hub))
}

/// Whether the crank's margin is that of the brake curve.
fn loads_crank_by_brake_curve(study: &RawStudy) -> bool {
    study.fatigue.as_ref().is_some_and(|f| f.get_ref().pressure == RawCrankPressure::BrakeCurve)
}

/// Largest relative error of a peak in a search.
fn tolerance(check: &mut Check, study: &RawStudy) -> f64 {
    let allowed = |t| check.within(t, &RELATIVE_ERROR);
    study.response.tolerance.as_ref().map_or(DEFAULT_TOLERANCE, allowed)
}

/// A study has something to evaluate or to search for, and no second objective without a search.
fn asks_for_something(check: &mut Check, study: &RawStudy) {
    if let (Some(second), None) = (study.objective.get(1), &study.optimise) {
        check.wrong(second, "found a second [[objective]] without [optimise], expected what is to be optimised by it");
    }
    if study.design.is_empty() && study.catalogue.is_empty() && study.optimise.is_none() {
        check.wrong(&study.engine, "found neither a design nor a catalogue nor [optimise], expected at least one of them in a study");
    }
}

/// The station that carries the first absorber that is searched for, or else that of the first design that has one.
fn hub<'d>(mut designs: impl Iterator<Item = &'d DesignSpec>, optimise: Option<&OptimiseSpec>) -> usize {
    let given = || designs.find(|d| !d.absorbers.is_empty()).map_or(0, |d| station_of(&d.absorbers, 0));
    optimise.map_or_else(given, |o| o.station(0))
}

/// Conditions of the study, and those of its search.
fn conditions(check: &mut Check, study: &RawStudy, engine: &Engine, optimise: Option<&OptimiseSpec>) -> Vec<Condition> {
    let mut all = study.conditions.as_ref().map_or_else(Vec::new, |c| optimise::conditions(check, c, engine));
    for condition in optimise.into_iter().flat_map(|o| &o.conditions) {
        if !all.contains(condition) {
            all.push(*condition);
        }
    }
    all
}

/// Given designs, catalogues, and what is optimised.
fn absorbers_of(
    files: &Files,
    check: &mut Check,
    base: &Base,
    (modes, temperatures): (&Modes, Temperatures),
) -> (Vec<DesignSpec>, Vec<CatalogueSpec>, Option<OptimiseSpec>) {
    let (study, folder) = (files.study, folder_of(files.path));
    let known = Known { temperatures, substances: &substances::substances(check, &study.compounds, folder) };
    let designs = absorbers::resolve(check, study, base.reaches(files.path, modes, known));
    let catalogues = catalogue::resolve(check, study, (&base.chain, folder), &designs, known);
    let optimise = optimise::resolve(check, study, &base.engine, (&base.chain, modes), known);
    (designs, catalogues, optimise)
}

/// Everything of a study but its engine and ranges.
fn rest(files: &Files, check: &mut Check, in_engine: &mut Check, base: Base) -> Option<Study> {
    let study = files.study;
    let modes = Modes::new(&base.chain);
    let temperatures = material_states::of_conditions(check, study);
    let (designs, catalogues, optimise) = absorbers_of(files, check, &base, (&modes, temperatures));
    let given: Vec<&DesignSpec> = designs.iter().chain(catalogues.iter().flat_map(|c| &c.designs)).collect();
    let hub = hub(given.iter().copied(), optimise.as_ref());
    let fatigue = judge(files, check, in_engine, &base);
    let of = Context {
        chain: &base.chain,
        fatigue: Judged::new(study.fatigue.is_some(), fatigue.as_ref()),
        hub,
        speeds: (base.speeds_rpm[0], base.speeds_rpm[base.speeds_rpm.len() - 1]),
        order_limit: base.order_limit,
        strokes: base.engine.strokes,
        absorbers: Context::absorbers(given.iter().map(|d| d.absorbers.len()), optimise.as_ref()),
        cooled: &Context::cooled(&given, optimise.as_ref()),
        balanced: &Context::balanced(&given, optimise.as_ref()),
        lives: &Context::lives(&given, optimise.as_ref()),
        media: &Context::media(&given, optimise.as_ref()),
        unread: given.is_empty() && !study.catalogue.is_empty(),
        has_duty: !study.duty.is_empty(),
        unequal: material_states::conditions(study).any(|c| c.get_ref().0.burning() != Burning::Alike),
    };
    let mut more_objectives = measures::objectives(check, study, of);
    let objective = more_objectives.remove(0);
    let limits = measures::limits(check, study, of);
    let known: Vec<MeasureSpec> = std::iter::once(&objective).chain(&more_objectives).cloned().collect();
    let by_word = |check: &mut Check, words: &At<Vec<At<String>>>| measures::of_front(check, words, (&known, &limits), of);
    let combined = measures::combined(check, study, (&known, &limits), of);
    let robust = study.robust.as_ref().and_then(|r| robust::resolve(check, r, optimise.as_ref(), (&given, &limits)));
    let front = optimise::front(check, study, optimise.as_ref(), (&base.chain, &modes), &by_word);
    let conditions = conditions(check, study, &base.engine, optimise.as_ref());
    let parts = (base.crank.as_ref(), &base.engine, &base.chain);
    let (flexible, model) = flexible::of_study((check, in_engine), (study, files.engine, files.folder()), parts, &base.speeds_rpm, &given);
    let (published, calibrate) = comparison(files, check, &base, (&modes, &designs, fatigue.as_ref()));
    let checked = Study {
        name: files.path.file_stem().map_or_else(|| "study".into(), |s| s.to_string_lossy().into_owned()),
        flexible,
        crank_model: model,
        scatter: optimise::scatter(check, study, &base.engine, &conditions),
        crank_engine: loads_crank_by_brake_curve(study).then(|| base.engine.of_brake_curve()),
        duty: load::duty(check, study, &base.engine, &base.speeds_rpm),
        reciprocating: base.reciprocating,
        engine: base.engine,
        twist: reported_twist(known.iter().chain(limits.iter().map(|l| &l.of)), &base.chain, hub),
        chain: base.chain,
        modes,
        speeds_rpm: base.speeds_rpm,
        known_rpm: base.known_rpm,
        order_limit: base.order_limit,
        method: study.response.method.into(),
        tolerance: tolerance(check, study),
        refine_peaks: study.response.refine_peaks.unwrap_or(true),
        every_station: study.response.every_station,
        torque_in_conditions: false,
        designs,
        catalogues,
        hub,
        objective,
        more_objectives,
        combined,
        limits,
        optimise,
        held_without_search: Vec::new(),
        robust,
        front,
        conditions,
        temperatures,
        published,
        calibrate,
        crank: base.crank,
        fatigue,
        remarks: Vec::new(),
        set: Vec::new(),
        placeholders: Vec::new(),
    };
    rows::check(check, study, &checked);
    Some(checked.judged_in_its_conditions())
}

impl Study {
    /// With the conditions that given designs are to hold limits in where nothing is searched: all of the study in which their absorbers work.
    fn judged_in_its_conditions(mut self) -> Self {
        let works = |c: &&Condition| !matches!(c, Condition::Firing | Condition::AbsorberLocked | Condition::AbsorberLost);
        let more = self.conditions.iter().filter(works).filter(|_| !self.limits.is_empty()).copied();
        self.held_without_search = std::iter::once(Condition::Firing).chain(more).collect();
        self
    }
}
