//! The main job: evaluate the designs of a study, optimise, follow the front.

use super::audit::highest_frequency_hz;
use super::choice::{self, Choice, Strategy};
use super::evaluate::{self, Classifier, DesignResult};
use super::families::Family;
use super::results::{FrontResult, OptimumResult, Results, RowCase};
use super::systems::{appearing, systems};
use super::wanted::Wanted;
use super::timing::Timing;
use super::{Progress, RunError, cost, diagram, families, margins, sweeps};
use crate::absorber::Mounted;
use crate::absorber::closed_forms::EngineMode;
use crate::drivetrain::System;
use crate::engine::Excitation;
use crate::input::{OptimiseSpec, ResponseMethod, Study};
use crate::objective::surrogate::Surrogate;
use crate::objective::{Condition, Limit, Measure, PeakFinder};
use crate::optimise::{Problem, Row, LoadCase, Space, front, search, starts};
use crate::response::{Direct, Grid, JointReceptance, Method, Quantity, Receptance, Response, ResponseError, Work};
use rayon::prelude::*;
use std::time::Instant;

/// Random points that tables screen for a start.
const SCREENED: usize = 4096;

struct Clock {
    timing: Vec<Timing>,
    since: Instant,
}

impl Clock {
    fn lap(&mut self, stage: &str, work: Work) {
        self.timing.push(Timing { stage: stage.into(), seconds: self.since.elapsed().as_secs_f64(), work });
        self.since = Instant::now();
    }
}

/// Runs a study.
///
/// # Errors
/// [`RunError`] where a design has no finite response.
pub fn run(study: &Study, progress: &dyn Progress) -> Result<Results, RunError> {
    let mut clock = Clock { timing: Vec::new(), since: Instant::now() };
    let excitation = Excitation::new(&study.engine, study.order_limit);
    let mut systems = systems(study, excitation);
    let kinks: &[f64] = if study.refine_peaks { &systems[0].excitation.tabulated_rpm } else { &[] };
    let grid = Grid::new(&study.speeds_rpm, kinks);
    clock.lap("excitation", Work::default());
    progress.stage("response of the chain", systems.len());
    let methods: Vec<Method> = systems
        .par_iter()
        .map(|system| {
            let method = method(study, system, &grid);
            progress.step();
            method
        })
        .collect();
    let mut setup = Work::default();
    for method in &methods {
        setup += method.setup();
    }
    clock.lap("base", setup);
    let margin = margins::model(study, &systems[0].excitation.harmonics, &grid);
    if margin.is_some() {
        clock.lap("crank", Work::default());
    }
    let finder = |(system, method)| PeakFinder::new(system, &grid, method, study.refine_peaks).with_margin(margin.as_ref());
    let finders: Vec<PeakFinder> = systems.iter().zip(&methods).map(finder).collect();
    let modes = study
        .optimise
        .as_ref()
        .map_or_else(Vec::new, |o| families::engine_modes(study, o, highest_frequency_hz(study, &systems[0].excitation.orders)));
    let choice = choice(study, &modes, &finders[0]);
    let finders: Vec<PeakFinder> = finders.into_iter().map(|finder| surrogate(study, choice.as_ref(), finder)).collect();
    if choice.is_some() {
        clock.lap("choice", Work::default());
    }
    let limits: Vec<Limit> = study.limits.iter().map(|l| l.1.clone()).collect();
    let held = study.optimise.as_ref().map_or(&[Condition::Firing][..], |o| &o.conditions);
    let measures = margins::measures(study);
    let wanted = Wanted {
        twist: study.twist,
        hub: study.hub,
        objective: &study.objective.measure,
        limits: limits.iter().collect(),
        margins: &measures,
        conditions: &study.conditions,
        held,
    };

    progress.stage("designs", study.designs.len());
    let mut work = Work::default();
    let mut designs = Vec::new();
    for d in &study.designs {
        let result = evaluate::evaluate(&finders, &d.name, &d.absorbers, &wanted, &mut work);
        designs.push(result.map_err(|e| RunError { what: format!("design `{}`{}", d.name, &e.what[d.name.len()..]), ..e })?);
        progress.step();
    }
    clock.lap("designs", work);

    let load_cases: Vec<LoadCase> = held.iter().flat_map(|c| load_cases(*c, &finders)).collect();
    let job = Job { study, finders: &finders, load_cases: &load_cases, limits: &limits, modes: &modes, wanted: &wanted, progress };
    let optima = study.optimise.as_ref().map_or_else(|| Ok(Vec::new()), |o| job.optima(o))?;
    let work = optima.iter().fold(Work::default(), |mut w, o| {
        for stage in [o.optimum.stages.seeds, o.optimum.stages.search, o.optimum.stages.minimax] {
            w += stage;
        }
        w
    });
    if !optima.is_empty() {
        clock.lap("optima", work);
    }
    let fronts = study.optimise.as_ref().map_or_else(|| Ok(Vec::new()), |o| job.fronts(o, &mut clock))?;

    let own = Grid::new(&study.speeds_rpm, &[]);
    let shown: Vec<&DesignResult> = designs.iter().chain(optima.iter().filter(|o| o.main).map(|o| &o.design)).collect();
    let sweeps = shown
        .par_iter()
        .map(|d| {
            let named = (d.name.as_str(), d.conditions.as_slice());
            sweeps::sweeps(&finders, &own, named, &d.absorbers, (study.twist, study.hub), &mut Work::default())
                .map_err(|error| RunError { what: format!("design `{}`", d.name), error })
        })
        .collect::<Result<Vec<_>, _>>()?;
    let margins = shown
        .par_iter()
        .filter_map(|d| {
            let failed = |error| RunError { what: format!("design `{}`", d.name), error };
            margins::sweep(&finders[0], &own, &d.name, &d.absorbers).map_err(failed).transpose()
        })
        .collect::<Result<Vec<_>, _>>()?;
    let best = shown.iter().filter_map(|d| Some((d, d.margins.first()?))).reduce(|a, b| if b.1.margin > a.1.margin { b } else { a });
    let diagram = best.zip(margin.as_ref()).map_or(Ok(None), |((d, smallest), model)| {
        diagram::diagram(study, model, &finders[0], (&d.name, &d.absorbers), smallest)
            .map_err(|error| RunError { what: format!("design `{}`", d.name), error })
    })?;
    clock.lap("response", Work::default());
    // what one evaluation costs, apart from the stages
    if let Some(d) = shown.iter().find(|d| !d.absorbers.is_empty()) {
        let probe = cost::per_design(&finders[0], &d.absorbers, study.twist, &measures);
        clock.timing.extend(probe.map_err(|error| RunError { what: format!("design `{}`", d.name), error })?);
    }
    let forced_floor = match study.objective.measure.quantities.as_slice() {
        [q] if study.objective.is_twist => Some(Classifier::new(&systems[0], *q).floor(&finders[0], study.objective.measure.over)),
        _ => None,
    };
    let appearing = systems.get(1).map_or_else(Vec::new, |misfiring| appearing(&systems[0].excitation, &misfiring.excitation));
    let method = methods[0].name();
    drop(load_cases);
    drop(finders);
    drop(methods);
    let system = systems.swap_remove(0);
    Ok(Results {
        method,
        choice,
        designs,
        optima,
        fronts,
        forced_floor,
        sweeps,
        margin,
        margins,
        diagram,
        appearing,
        timing: clock.timing,
        system,
    })
}

/// A condition as load cases of a design problem: one for each cylinder that may misfire.
fn load_cases<'a>(condition: Condition, finders: &'a [PeakFinder<'a>]) -> Vec<LoadCase<'a>> {
    let of = if condition == Condition::Misfire { &finders[1..] } else { &finders[..1] };
    let cylinder = |i| (condition == Condition::Misfire).then_some(i);
    of.iter().enumerate().map(|(i, finder)| LoadCase { condition, cylinder: cylinder(i), finder }).collect()
}

/// The study's method; receptances are tabulated for what is searched.
fn method<'a>(study: &Study, system: &'a System, grid: &'a Grid) -> Method<'a> {
    if study.method == ResponseMethod::Direct {
        return Method::Direct(Direct::new(system, grid));
    }
    let mut quantities: Vec<Quantity> = study.objective.measure.quantities.clone();
    quantities.extend(study.more_objectives.iter().flat_map(|o| o.measure.quantities.iter().copied()));
    quantities.extend(study.limits.iter().flat_map(|l| l.1.measure.quantities.iter().copied()));
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

/// What searches are to evaluate designs by; nothing where that is not `auto`, or where there is nothing to search or to choose.
fn choice(study: &Study, modes: &[Vec<EngineMode>], finder: &PeakFinder) -> Option<Choice> {
    match finder.method {
        Method::Receptance(r) if study.method == ResponseMethod::Auto && study.refine_peaks && study.optimise.is_some() => {
            Some(choice::choose(study, modes, finder, r))
        }
        _ => None,
    }
}

/// A finder that searches may ask for surrogate peaks, as chosen.
fn surrogate<'a>(study: &Study, choice: Option<&Choice>, finder: PeakFinder<'a>) -> PeakFinder<'a> {
    match (choice.map(|c| c.chosen.strategy), study.objective.measure.synthesised(), finder.method) {
        (Some(Strategy::Tables(stride)), Some(quantity), Method::Receptance(r)) => {
            finder.with_surrogate(Surrogate::new(r, quantity, stride), quantity, study.tolerance)
        }
        _ => finder,
    }
}

struct Job<'a> {
    study: &'a Study,
    finders: &'a [PeakFinder<'a>],
    load_cases: &'a [LoadCase<'a>],
    limits: &'a [Limit],
    modes: &'a [Vec<EngineMode>],
    wanted: &'a Wanted<'a>,
    progress: &'a dyn Progress,
}

impl Job<'_> {
    fn problem(&self, space: Space, objective: usize) -> Problem<'_> {
        Problem { load_cases: self.load_cases, space, objective: &self.study.objective_of(objective).measure, limits: self.limits }
    }

    /// Closed forms, random points, and the best of many random points where tables can tell it in no time.
    fn starts(&self, spec: &OptimiseSpec, space: &Space) -> Vec<(String, Vec<f64>)> {
        let mut list = starts::starts(space, self.modes, spec.random_starts, spec.seed);
        if spec.random_starts > 0 {
            let points = starts::random_points(space, &list[0].1, SCREENED, spec.seed);
            if let Some(best) = self.finders[0].best_of(points.iter().map(|w| space.design(w)), &self.study.objective.measure) {
                list.push((format!("best of {SCREENED}"), points[best].clone()));
            }
        }
        list
    }

    fn optima(&self, spec: &OptimiseSpec) -> Result<Vec<OptimumResult>, RunError> {
        let mut families: Vec<(Family, usize)> = families::wanted(spec, self.modes).into_iter().map(|family| (family, 0)).collect();
        // the main size of each type once more for every other objective
        for (i, objective) in self.study.more_objectives.iter().enumerate() {
            let main: Vec<Family> = families.iter().filter(|f| f.0.is_main && f.1 == 0).map(|f| f.0.clone()).collect();
            families.extend(main.into_iter().map(|f| (Family { name: format!("{}_by_{}", f.name, objective.word), ..f }, i + 1)));
        }
        let count = families.iter().map(|f| self.starts(spec, &f.0.space).len()).sum();
        self.progress.stage("optima", count);
        let step = || self.progress.step();
        families
            .into_par_iter()
            .map(|(Family { name, space, is_main: main }, objective)| {
                let failed = |error: ResponseError| RunError { what: name.clone(), error };
                let problem = self.problem(space, objective);
                let starts = self.starts(spec, &problem.space);
                let optimum = search::optimise(&problem, &starts, &step).map_err(failed)?;
                let mounted = optimum.design.as_slice();
                let design = evaluate::evaluate(self.finders, &name, mounted, self.wanted, &mut Work::default());
                let classifier = Classifier::new(self.finders[0].system, self.study.twist);
                let nature = |r: &Row| {
                    let load_case = &self.load_cases[r.load_case];
                    classifier.nature(load_case.finder, &load_case.condition.absorbers(mounted), &r.peak)
                };
                let natures = optimum.outcome.rows.rows.iter().map(nature).collect::<Result<_, _>>().map_err(failed)?;
                let load_case = |r: &Row| {
                    let load_case = &self.load_cases[r.load_case];
                    RowCase { condition: load_case.condition, cylinder: load_case.cylinder }
                };
                let load_cases = optimum.outcome.rows.rows.iter().map(load_case).collect();
                Ok(OptimumResult { design: design?, optimum, natures, load_cases, main, objective })
            })
            .collect()
    }

    /// The study's other objectives for a design, at their worst in the load cases.
    fn others(&self, design: &[Mounted]) -> Result<Vec<f64>, ResponseError> {
        let value = |measure: &Measure| {
            let peak = |s: &LoadCase| s.finder.peak(&s.condition.absorbers(design), measure, &mut Work::default());
            self.load_cases.iter().try_fold(0.0, |worst, s| Ok(f64::max(worst, peak(s)?.map_or(0.0, |p| p.value))))
        };
        self.study.more_objectives.iter().map(|o| value(&o.measure)).collect()
    }

    fn fronts(&self, spec: &OptimiseSpec, clock: &mut Clock) -> Result<Vec<FrontResult>, RunError> {
        let Some(wanted) = &self.study.front else { return Ok(Vec::new()) };
        let mut results = Vec::new();
        for types in families::types(spec) {
            // a front is of one absorber: validation sees to it
            let declaration = types[0];
            self.progress.stage(&format!("front, {}", declaration.name), 2 * wanted.inertias.len());
            let space = families::family(spec, &families::Choice { types, rings: vec![Some(wanted.inertias[0])] }, self.modes);
            let problem = self.problem(space, 0);
            let step = || self.progress.step();
            let front = front::follow(&problem, &wanted.inertias, |s| self.starts(spec, s), &step)
                .map_err(|error| RunError { what: format!("front of {} absorbers", declaration.name), error })?;
            clock.lap(&format!("front_{}", declaration.name), front.work);
            let others = front.points.par_iter().map(|p| self.others(&p.design));
            let others = others
                .collect::<Result<Vec<_>, _>>()
                .map_err(|error| RunError { what: format!("front of {} absorbers", declaration.name), error })?;
            results.push(FrontResult { declaration, front, others });
        }
        Ok(results)
    }
}
