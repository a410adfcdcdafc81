//! The main job: evaluate the designs of a study, optimise, follow the front.

use super::allocation::{self, AllocationOfDesign};
use super::catalogue;
use super::catalogue_retuning::with_retuned;
use super::compounds;
use super::crank_diagram::{self, Diagram};
use super::crank_models;
use super::duty::{self, DutyOfDesign};
use super::equivalent_constants::{self, SimplestLaw};
use super::evaluate::{self, DesignResult};
use super::evaluation_plan::EvaluationPlan;
use super::heat::{self, HeatOfDesign};
use super::large_twist::{self, LargeTwistOfDesign};
use super::margins::{self, MarginSweep};
use super::model_check::highest_frequency_hz;
use super::on_joints;
use super::results::{OptimumResult, Results};
use super::robust::{self, RobustOfDesign};
use super::searches::Searches;
use super::sheets::{self, Sheet};
use super::strain::{self, StrainOfDesign};
use super::sweeps::{self, Asked, Sweeps};
use super::systems::{appearing, finders, load_cases, systems};
use super::tables_for_searches::with_tables;
use super::timing::{Clock, Timing};
use super::torsion_case::{self, CaseOfDesign};
use super::web_stress::{WebsOfDesign, web_stress};
use super::{Progress, RunError, Silent, calibrate, families, prices, timing_probe};
use crate::absorber::Mounted;
use crate::absorber::closed_forms::EngineMode;
use crate::absorber::mounted::{is_tree, station_of};
use crate::crankshaft::Margin;
use crate::drivetrain::System;
use crate::input::{DesignSpec, ResponseMethod, Study};
use crate::objective::{Measure, Over, PeakFinder};
use crate::optimise::LoadCase;
use crate::response::{Direct, Grid, JointReceptance, Method, Quantity, Receptance, Response, ResponseError, Work};
use rayon::prelude::*;

impl Study {
    /// Calibrates the inputs that the study wants fitted, then evaluates its designs and finds its optima and fronts.
    ///
    /// # Errors
    /// [`RunError`] where a design has no finite response.
    pub fn run(&self) -> Result<Results, RunError> {
        self.run_with(&Silent)
    }

    /// The same, telling of its progress.
    ///
    /// # Errors
    /// As [`Study::run`].
    #[doc(hidden)]
    pub fn run_with(&self, progress: &dyn Progress) -> Result<Results, RunError> {
        let mut clock = Clock::start();
        let (mut study, calibration) = calibrate(self, progress)?;
        if calibration.is_some() {
            clock.lap("calibration", Work::default());
        }
        let crank_difference = crank_models::choose(&mut study)?;
        if crank_difference.is_some() {
            clock.lap("choice of the crank", Work::default());
        }
        let mut results = run(&study, progress)?;
        clock.timing.append(&mut results.timing);
        Ok(Results { calibration, crank_difference, timing: clock.timing, ..results })
    }

    /// The numbers of one design on this engine, by the study's calibrated inputs; its other designs and its searches are left out.
    ///
    /// # Errors
    /// [`RunError`] where it has no finite response, and where an absorber is on no station of the chain or on its own ring.
    pub fn evaluate(&self, name: &str, absorbers: Vec<Mounted>) -> Result<DesignResult, RunError> {
        self.mounted(&absorbers).map_err(|error| RunError { what: name.to_owned(), error })?;
        let (mut study, _) = calibrate(self, &Silent)?;
        study.leave_searches_out();
        study.catalogues.clear();
        study.designs = vec![DesignSpec { name: name.to_owned(), absorbers }];
        crank_models::choose(&mut study)?;
        Ok(run(&study, &Silent)?.designs.swap_remove(0))
    }

    /// Whether each absorber hangs, directly or by the rings of others, on a station of the chain.
    fn mounted(&self, absorbers: &[Mounted]) -> Result<(), ResponseError> {
        if !is_tree(absorbers) {
            return Err(ResponseError::NotMounted { number: 1, why: "the absorbers hang on each other's rings, or on one that is none" });
        }
        match (0..absorbers.len()).find(|i| station_of(absorbers, *i) >= self.chain.len()) {
            Some(i) => Err(ResponseError::NotMounted { number: i + 1, why: "the chain has no station of that index" }),
            None => Ok(()),
        }
    }
}

/// Runs a study whose inputs are as they should be.
///
/// # Errors
/// [`RunError`] where a design has no finite response.
pub fn run(study: &Study, progress: &dyn Progress) -> Result<Results, RunError> {
    let mut clock = Clock::start();
    let mut systems = systems(study, study.excitation(), progress);
    let grid = grid(study, &systems[0]);
    clock.lap("excitation", Work::default());
    let methods = methods(study, &systems, &grid, progress, &mut clock);
    let margin = crank(study, &systems[0], &grid, progress, &mut clock);
    let duty_points = duty::points(study);
    let finders = finders(study, (&systems, &methods), &grid, (margin.as_ref(), &duty_points));
    let modes = modes(study, &systems[0]);
    let (choices, finders) = with_tables(study, &modes, finders, progress, &mut clock);
    let measures = margins::measures(study);
    let wanted = EvaluationPlan::new(study, &measures);
    let load_cases: Vec<LoadCase> = wanted.held.iter().flat_map(|c| load_cases(*c, &finders)).collect();
    let (narrowed, compounds) = compounds::narrowed(study, (&finders, &load_cases, &modes, &wanted), progress, &mut clock)?;
    let (asked, study) = (study, narrowed.as_ref().unwrap_or(study));
    let (catalogue, best) = catalogue::ranked(study, &finders, &wanted, progress)?;
    let best = with_retuned(study, best, (&finders, &load_cases), progress)?;
    let mut designs = designs(study.designs.iter().chain(&best), &finders, &wanted, progress, &mut clock)?;
    let searches = Searches::new(study, (&finders, &load_cases), &modes, &wanted, progress);
    let mut optima = study.optimise.as_ref().map_or_else(|| Ok(Vec::new()), |o| searches.optima(o, &mut clock))?;
    let prices = prices::prices(asked, (&finders, &modes), &optima, (progress, &mut clock))?;
    let bare = searches.bare();
    let fronts = study.optimise.as_ref().map_or_else(|| Ok(Vec::new()), |o| searches.fronts(o, &optima, &mut clock))?;
    let tradeoffs = study.optimise.as_ref().map_or_else(|| Ok(Vec::new()), |o| searches.tradeoffs(o, &optima, &mut clock))?;
    let shown: Vec<&DesignResult> = designs.iter().chain(optima.iter().filter(|o| o.main).map(|o| &o.design)).collect();
    let response = || over_speed(study, (&finders, &load_cases), (&shown, &optima), progress);
    let (response, probe) = rayon::join(response, || probe(study, &finders[0], &shown, &measures));
    let over = response?;
    clock.lap("response", Work::default());
    clock.timing.extend(probe?);
    let flexible = on_flexible(study, (&finders[0], &over.margins), (&designs, &optima, &shown), progress, &mut clock)?;
    large_twist::judge(designs.iter_mut().chain(optima.iter_mut().map(|o| &mut o.design)), &over.large_twist, &study.limits);
    let forced_floor = evaluate::forced_floor(study, &finders[0]);
    let (appearing, method) = (appearing(&systems), methods[0].name());
    drop(load_cases);
    drop(finders);
    drop(methods);
    Ok(Results {
        study: study.clone(),
        calibration: None,
        method,
        choices,
        compounds,
        prices,
        catalogue,
        designs,
        optima,
        fronts,
        tradeoffs,
        forced_floor,
        bare,
        sweeps: over.sweeps,
        sweeps_of_sizes: over.sweeps_of_sizes,
        margin,
        margins: over.margins,
        diagram: over.diagram,
        duty: over.duty,
        heat: over.heat,
        simplest: over.simplest,
        strain: over.strain,
        large_twist: over.large_twist,
        robust: over.robust,
        allocation: over.allocation,
        sheets: over.sheets,
        appearing,
        crank_models: flexible.crank_models,
        joints: flexible.joints,
        webs: flexible.webs,
        torsion_cases: over.torsion_cases,
        crank_difference: None,
        timing: clock.timing,
        system: systems.swap_remove(0),
    })
}

/// What only a flexible crank has.
struct OnFlexible {
    crank_models: Vec<crank_models::ByModel>,
    joints: Vec<on_joints::OnJointsOfDesign>,
    webs: Vec<WebsOfDesign>,
}

/// Designs by other models of the crank, and a few of them on bearings that are not linear and by the loads of their webs.
fn on_flexible(
    study: &Study,
    (firing, margins): (&PeakFinder, &[MarginSweep]),
    (designs, optima, shown): (&[DesignResult], &[OptimumResult], &[&DesignResult]),
    progress: &dyn Progress,
    clock: &mut Clock,
) -> Result<OnFlexible, RunError> {
    let crank_models = crank_models::by_models(study, shown, (progress, clock))?;
    let found = optima.iter().filter(|o| o.main && o.objective == 0 && !o.robust).map(|o| &o.design);
    let of_note = on_joints::of_note(designs, found);
    let joints = on_joints::on_joints(study, &of_note, (progress, clock));
    let webs = web_stress((study, firing), margins, &of_note, (progress, clock))?;
    Ok(OnFlexible { crank_models, joints, webs })
}

/// The crank's margin, where the study judges it.
fn crank(study: &Study, system: &System, grid: &Grid, progress: &dyn Progress, clock: &mut Clock) -> Option<Margin> {
    if study.fatigue.is_some() {
        progress.stage("loads of the crank", 1);
    }
    let margin = margins::model(study, &system.excitation.harmonics, grid)?;
    progress.step();
    clock.lap("crank", Work::default());
    Some(margin)
}

/// What one evaluation costs, of the first design with an absorber. Multiaxial margins, which may take a minute, are not repeated to be timed.
fn probe(study: &Study, finder: &PeakFinder, shown: &[&DesignResult], margins: &[Measure]) -> Result<Vec<Timing>, RunError> {
    let Some(d) = shown.iter().find(|d| !d.absorbers.is_empty()) else { return Ok(Vec::new()) };
    let of_extremes = |m: &&Measure| matches!(m.over, Over::Margin(c) if !finder.margin.is_some_and(|model| model.is_multiaxial(c)));
    let margins: Vec<Measure> = margins.iter().filter(of_extremes).cloned().collect();
    timing_probe::per_design(finder, &d.absorbers, study.twist, &margins).map_err(|error| of_design(d, error))
}

/// Speeds of a study, with those of its table of torque where peaks are refined.
pub(super) fn grid(study: &Study, system: &System) -> Grid {
    Grid::new(&study.speeds_rpm, if study.refine_peaks { &system.excitation.tabulated_rpm } else { &[] })
}

/// Modes that each absorber to be optimised can be tuned to.
pub(super) fn modes(study: &Study, system: &System) -> Vec<Vec<EngineMode>> {
    let highest = highest_frequency_hz(study, &system.excitation.orders);
    study.optimise.as_ref().map_or_else(Vec::new, |o| families::engine_modes(study, o, highest))
}

fn of_design(d: &DesignResult, error: ResponseError) -> RunError {
    RunError { what: format!("design `{}`", d.name), error }
}

/// The method for each system, its tables filled.
pub(super) fn methods<'a>(
    study: &Study,
    systems: &'a [System],
    grid: &'a Grid,
    progress: &dyn Progress,
    clock: &mut Clock,
) -> Vec<Method<'a>> {
    progress.stage("response of the chain", systems.len());
    let methods: Vec<Method> = systems
        .par_iter()
        .map(|system| {
            let method = method(study, system, grid);
            progress.step();
            method
        })
        .collect();
    let mut setup = Work::default();
    for method in &methods {
        setup += method.setup();
    }
    clock.lap("base", setup);
    methods
}

/// The given designs.
fn designs<'d>(
    given: impl Iterator<Item = &'d DesignSpec>,
    finders: &[PeakFinder],
    wanted: &EvaluationPlan,
    progress: &dyn Progress,
    clock: &mut Clock,
) -> Result<Vec<DesignResult>, RunError> {
    let given: Vec<&DesignSpec> = given.collect();
    progress.stage("designs", given.len());
    let evaluated: Vec<(Result<DesignResult, RunError>, Work)> = given
        .par_iter()
        .map(|d| {
            let mut work = Work::default();
            let result = evaluate::evaluate(finders, &d.name, &d.absorbers, wanted, &mut work);
            progress.step();
            (result.map_err(|e| RunError { what: format!("design `{}`{}", d.name, &e.what[d.name.len()..]), ..e }), work)
        })
        .collect();
    let mut work = Work::default();
    let mut designs = Vec::new();
    for (result, spent) in evaluated {
        work += spent;
        designs.push(result?);
    }
    clock.lap("designs", work);
    Ok(designs)
}

/// What the designs that are shown do over speed.
struct OverSpeed {
    sweeps: Vec<Sweeps>,
    sweeps_of_sizes: Vec<Sweeps>,
    margins: Vec<MarginSweep>,
    diagram: Option<Diagram>,
    torsion_cases: Vec<CaseOfDesign>,
    duty: Vec<DutyOfDesign>,
    heat: Vec<HeatOfDesign>,
    simplest: Vec<SimplestLaw>,
    strain: Vec<StrainOfDesign>,
    large_twist: Vec<LargeTwistOfDesign>,
    robust: Vec<RobustOfDesign>,
    allocation: Vec<AllocationOfDesign>,
    sheets: Vec<Sheet>,
}

/// Responses and margins over speed of the designs that are shown, what they do over the duty, and the fatigue diagram of the one with the largest margin.
fn over_speed(
    study: &Study,
    (finders, load_cases): (&[PeakFinder], &[LoadCase]),
    (shown, optima): (&[&DesignResult], &[OptimumResult]),
    progress: &dyn Progress,
) -> Result<OverSpeed, RunError> {
    let firing = &finders[0];
    let own = Grid::new(&study.speeds_rpm, &[]);
    let swept = |d: &&DesignResult| {
        let named = (d.name.as_str(), d.conditions.as_slice());
        let swept = sweeps::sweeps(finders, &own, named, &d.absorbers, Asked::by(study), &mut Work::default());
        swept.map_err(|error| of_design(d, error))
    };
    let sweeps = || shown.par_iter().map(&swept).inspect(|_| progress.step()).collect::<Result<Vec<_>, _>>();
    let step = || progress.step();
    let margin = |d: &&DesignResult| margins::sweep(firing, &own, &d.name, &d.absorbers, &step).map_err(|e| of_design(d, e)).transpose();
    match firing.margin {
        Some(_) => progress.stage("response and margins", shown.len() * (1 + own.len())),
        None => progress.stage("response over speed", shown.len()),
    }
    let margins = || shown.par_iter().filter_map(margin).collect::<Result<Vec<_>, _>>();
    let best = shown.iter().filter_map(|d| Some((d, d.margins.first()?))).reduce(|a, b| if b.1.margin > a.1.margin { b } else { a });
    let diagram = || {
        best.zip(firing.margin).map_or(Ok(None), |((d, smallest), model)| {
            crank_diagram::diagram(study, model, firing, (&d.name, &d.absorbers), smallest).map_err(|error| of_design(d, error))
        })
    };
    let duty = || duty::duty(study, shown).map_err(|(d, error)| of_design(d, error));
    let ((sweeps, margins), (diagram, duty)) = rayon::join(|| rayon::join(sweeps, margins), || rayon::join(diagram, duty));
    let (sweeps, margins, diagram, duty) = (sweeps?, margins?, diagram?, duty?);
    let sizes: Vec<&DesignResult> = optima.iter().filter(|o| !o.main).map(|o| &o.design).collect();
    let sweeps_of_sizes = sizes.par_iter().map(&swept).collect::<Result<Vec<_>, _>>()?;
    progress.stage("temperatures", 1);
    let heat = heat::heat(study, firing, shown).map_err(|(d, error)| of_design(d, error))?;
    progress.step();
    let large_twist = large_twist::large_twist(study, firing, shown, progress).map_err(|(d, error)| of_design(d, error))?;
    let simplest = equivalent_constants::simplest(study, firing, shown).map_err(|(d, error)| of_design(d, error))?;
    let strain = strain::strain(study, firing, shown).map_err(|(d, error)| of_design(d, error))?;
    let torsion_cases = torsion_case::by_case(study, firing, shown)?;
    let robust = robust::robust(study, (firing, load_cases), shown, progress).map_err(|(d, error)| of_design(d, error))?;
    let allocation = allocation::allocations(study, load_cases, shown, progress);
    let sheets = sheets::sheets(study, (firing, load_cases), (shown, &heat), progress).map_err(|(d, error)| of_design(d, error))?;
    Ok(OverSpeed {
        sweeps,
        sweeps_of_sizes,
        margins,
        diagram,
        torsion_cases,
        duty,
        heat,
        simplest,
        strain,
        large_twist,
        robust,
        allocation,
        sheets,
    })
}

/// The study's method; receptances are tabulated for what is searched.
fn method<'a>(study: &Study, system: &'a System, grid: &'a Grid) -> Method<'a> {
    if study.method == ResponseMethod::Direct {
        return Method::Direct(Direct::new(system, grid));
    }
    let mut quantities: Vec<Quantity> = study.measures().flat_map(|m| m.measure.quantities.iter().copied()).collect();
    quantities.extend([study.twist, Quantity::Twist { from: study.hub, to: None }]);
    let mut unique: Vec<Quantity> = Vec::new();
    for q in quantities {
        if !unique.contains(&q) {
            unique.push(q);
        }
    }
    match &study.optimise {
        Some(spec) if spec.absorbers.len() > 1 => {
            let mut stations: Vec<usize> = (0..spec.absorbers.len()).map(|i| spec.station(i)).collect();
            stations.sort_unstable();
            stations.dedup();
            Method::Joint(JointReceptance::new(system, grid, &stations, &unique))
        }
        _ => Method::Receptance(Receptance::new(system, grid, study.hub, &unique)),
    }
}
