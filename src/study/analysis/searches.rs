//! The searches of a study: optima and fronts.

use super::evaluate::{self, Classifier, DesignResult};
use super::evaluation_plan::EvaluationPlan;
use super::families::{self, Family};
use super::looked_over::{LookedOver, in_operation, looked_over};
use super::results::{OptimumResult, RowCase};
use super::sensitivities::sensitivities;
use super::timing::{Clock, timed};
use super::{Progress, RunError};
use crate::absorber::closed_forms::EngineMode;
use crate::absorber::{Deviation, Mounted};
use crate::input::{DesignSpec, FrontSpec, LimitSpec, OptimiseSpec, ProveSpec, Study};
use crate::objective::{Condition, Limit, Measure, Over, PeakFinder};
use crate::optimise;
use crate::optimise::minimax;
use crate::optimise::search::Recorder;
use crate::optimise::starts::NamedPoint;
use crate::optimise::{
    Effort, Exclusions, Interchange, LoadCase, Optimum, Problem, Proof, Reason, Remembers, Row, Slot, Space, Tolerances, Verdict, largest,
    proof, robust, search, second_order, shadow_prices, starts,
};
use crate::response::{ResponseError, Work};
use rayon::prelude::*;
use std::sync::atomic::{AtomicU64, Ordering};

/// Second order means something where first order holds this well.
const FIRST_ORDER: f64 = 1e-4;
/// Random points that tables screen for a start.
const SCREENED: usize = 4096;

/// An optimum that is sought.
struct Sought {
    family: Family,
    /// Index of the objective.
    objective: usize,
    /// Tolerances within which the worst counts.
    within: Option<Tolerances>,
}

/// What all searches of a study share.
#[doc(hidden)]
pub struct Searches<'a> {
    pub(super) study: &'a Study,
    pub(super) finders: &'a [PeakFinder<'a>],
    pub(super) load_cases: &'a [LoadCase<'a>],
    /// Each by itself, in SI units.
    pub(super) objectives: Vec<Limit>,
    /// Of each, where it is the mean of a twist over the duty: its terms with their shares; else none.
    duty: Vec<(Vec<Limit>, Vec<f64>)>,
    /// Those that are combined, in units of their targets.
    combined: Vec<Limit>,
    pub(super) limits: Vec<Limit>,
    pub(super) modes: &'a [Vec<EngineMode>],
    pub(super) wanted: &'a EvaluationPlan<'a>,
    pub(super) progress: &'a dyn Progress,
    /// Time that proofs have taken, one after the other, ns.
    proofs: AtomicU64,
}

/// A mean over the duty as the sum of its points: a largest value has kinks where other angles of the cycle take over, which each point has for itself.
fn terms(study: &Study, measure: &Measure) -> (Vec<Limit>, Vec<f64>) {
    if measure.over != Over::Mean || measure.quantities.len() != 1 {
        return (Vec::new(), Vec::new());
    }
    let term = |i: usize| Measure { over: Over::AtDuty(i), ..measure.clone() }.in_si();
    ((0..study.duty.len()).map(term).collect(), study.duty.iter().map(|p| p.share).collect())
}

impl<'a> Searches<'a> {
    /// Of a study.
    pub fn new(
        study: &'a Study,
        (finders, load_cases): (&'a [PeakFinder<'a>], &'a [LoadCase<'a>]),
        modes: &'a [Vec<EngineMode>],
        wanted: &'a EvaluationPlan<'a>,
        progress: &'a dyn Progress,
    ) -> Self {
        let objectives = study.objectives().map(|o| o.measure.in_si()).collect();
        let limits = study.limits.iter().map(LimitSpec::to_limit).collect();
        let combined = study.combined.iter().flat_map(|c| c.parts.iter().map(LimitSpec::to_limit)).collect();
        let duty = study.objectives().map(|o| terms(study, &o.measure)).collect();
        Self { study, finders, load_cases, objectives, duty, combined, limits, modes, wanted, progress, proofs: AtomicU64::new(0) }
    }

    /// What remembers searches, and of what they are.
    pub(super) fn memory<'s>(&'s self, search: Option<optimise::Sought<'s>>) -> Option<Remembers<'s>> {
        self.progress.memory().map(|memory| Remembers { memory, search })
    }

    pub(super) fn problem(&self, space: Space, objective: usize) -> Problem<'_> {
        let (objectives, weights) = match (self.objectives.get(objective), &self.study.combined) {
            (Some(_), _) if !self.duty[objective].0.is_empty() => (self.duty[objective].0.as_slice(), self.duty[objective].1.as_slice()),
            (None, Some(combined)) => (self.combined.as_slice(), combined.weights.as_slice()),
            _ => (std::slice::from_ref(&self.objectives[objective]), &[][..]),
        };
        Problem { load_cases: self.load_cases, space, objectives, weights, limits: &self.limits, memory: self.memory(None) }
    }

    /// Absorbers of a family whose places make no difference to anything that is asked for.
    fn interchange(&self, space: &Space) -> Interchange {
        let of_front = match &self.study.front {
            Some(FrontSpec::Of { measures, .. }) => measures.as_slice(),
            _ => &[],
        };
        let measures = self.objectives.iter().chain(&self.combined).chain(self.duty.iter().flat_map(|d| &d.0)).map(|l| &l.measure);
        Interchange::of(space, measures.chain(of_front.iter().map(|m| &m.measure)), &self.limits)
    }

    /// Closed forms, random points, and the best of many random points where tables can tell it in no time.
    pub(super) fn starts(&self, spec: &OptimiseSpec, space: &Space) -> Vec<(String, Vec<f64>)> {
        let interchange = self.interchange(space);
        let list = starts::starts(space, self.modes, spec.random_starts, spec.seed);
        let mut list = starts::distinct(list, |point| interchange.ordered(space, point));
        if spec.random_starts > 0 {
            let points = starts::random_points(space, &list[0].1, SCREENED, spec.seed);
            if let Some(best) = self.finders[0].best_of(points.iter().map(|w| space.design(w)), &self.study.objective.measure) {
                list.push((format!("best of {SCREENED}"), points[best].clone()));
            }
        }
        list
    }

    /// The given designs that are of a family, moved into its bounds.
    fn given(&self, space: &Space) -> Vec<(String, Vec<f64>)> {
        let named_point = |d: &DesignSpec| -> Option<(String, Vec<f64>)> {
            let alike = |(m, slot): (&Mounted, &Slot)| m.on == slot.on && m.absorber.declaration() == Some(slot.declaration);
            let fits = d.absorbers.len() == space.slots.len() && d.absorbers.iter().zip(&space.slots).all(alike);
            fits.then(|| (d.name.clone(), space.point_of(&d.absorbers)))
        };
        self.study.designs.iter().filter_map(named_point).collect()
    }

    /// Lowest and highest frequency that the torque excites over the range, rad/s.
    pub(super) fn excited(&self) -> Option<(f64, f64)> {
        let orders = &self.finders[0].system.excitation.orders;
        let speeds = &self.study.speeds_rpm;
        Some((orders.first()?.omega(speeds[0]), orders.last()?.omega(speeds[speeds.len() - 1])))
    }

    /// All optima that the study asks for.
    ///
    /// # Errors
    /// [`RunError`] where none of the starts of one has a finite response.
    pub fn optima(&self, spec: &OptimiseSpec, clock: &mut Clock) -> Result<Vec<OptimumResult>, RunError> {
        let with_starts = |sought: Sought| (self.starts(spec, &sought.family.space), sought);
        let sought = self.sought(spec);
        self.progress.stage("screens of random designs", sought.len());
        let families: Vec<_> = sought.into_par_iter().map(with_starts).inspect(|_| self.progress.step()).collect();
        // a step a start, and one a proof
        let steps = |(starts, sought): &(Vec<NamedPoint>, Sought)| starts.len() + usize::from(sought.family.is_proved);
        self.progress.stage("optima", families.iter().map(steps).sum());
        let step = || self.progress.step();
        let one = |(starts, sought)| self.optimum(spec, sought, starts, &step);
        let mut found = families.into_par_iter().map(one).collect::<Result<Vec<OptimumResult>, RunError>>()?;
        show_best_size(&mut found);
        let mut work = Work::default();
        for stages in found.iter().map(|o| o.optimum.stages) {
            work += stages.all();
        }
        if !found.is_empty() {
            clock.lap("optima", work);
            clock.beside("proofs", 1e-9 * self.proofs.load(Ordering::Relaxed) as f64, Work::default());
        }
        Ok(found)
    }

    /// That of the main size of the first types, sought from a design, too.
    pub(super) fn optimum_from(&self, spec: &OptimiseSpec, design: &[Mounted]) -> Result<Option<OptimumResult>, RunError> {
        let Some(sought) = self.sought(spec).into_iter().next() else { return Ok(None) };
        let space = &sought.family.space;
        let starts = self.starts(spec, space).into_iter().chain([("known".to_owned(), space.point_of(design))]).collect();
        self.optimum(spec, sought, starts, &|| {}).map(Some)
    }

    /// One of them.
    fn optimum(&self, spec: &OptimiseSpec, sought: Sought, starts: Vec<NamedPoint>, step: Recorder) -> Result<OptimumResult, RunError> {
        let Sought { family: Family { name, family, space, is_main: main, is_proved }, objective, within } = sought;
        let failed = |error: ResponseError| RunError { what: name.clone(), error };
        let problem =
            Problem { memory: self.memory(Some(optimise::Sought { design: &name, objective })), ..self.problem(space, objective) };
        let found = match &within {
            Some(tolerances) => robust::optimise(&problem, tolerances, &starts, spec.seed, step),
            None => search::optimise(&problem, &starts, search::Finish::All, step).map(|optimum| (Vec::new(), optimum)),
        };
        let (mut deviations, mut optimum) = found.map_err(failed)?;
        let all: Vec<_> = starts.into_iter().chain(self.given(&problem.space)).collect();
        let mut looked = {
            let scenarios = robust::scenarios(self.load_cases, &deviations);
            let reference = Problem { load_cases: &scenarios, space: problem.space.clone(), ..problem };
            looked_over(&reference, &mut optimum, (&all, self.excited()), spec.seed).map_err(failed)?
        };
        if let Some(tolerances) = within.as_ref().filter(|_| looked.led_elsewhere()) {
            // a design from elsewhere has its own worst deviation
            (deviations, optimum) = robust::settled((&problem, &[]), tolerances, (deviations, optimum), spec.seed).map_err(failed)?;
        }
        let operation = LoadCase::new(Condition::InOperation, &self.finders[0]);
        let is_asked = spec.in_operation || !self.limits.is_empty();
        let held_against = (within.as_ref(), &mut deviations);
        let counts = is_asked
            && self
                .is_of_operation((&problem, operation), held_against, (&mut optimum, &mut looked), (&all, spec.seed, step))
                .map_err(failed)?;
        let at_reference = robust::scenarios(self.load_cases, &deviations);
        let scenarios: Vec<LoadCase> = at_reference.iter().copied().chain(counts.then_some(operation)).collect();
        let LookedOver { scan, survey, nearby, conflict } = looked;
        let problem = Problem { load_cases: &scenarios, ..problem };
        let (mut proof, exclusions) = self.proof((spec, is_proved), &problem, (&mut optimum, within.is_some()), step);
        let conflict = conflict.filter(|_| !optimum.outcome.rows.hold());
        let design =
            self.as_reported(&problem, (&mut optimum, conflict.is_none() && within.is_none()), (spec.prove.effort, proof.as_mut()), &name)?;
        // of the nearest design nothing is an optimum but its violation
        let is_optimum = conflict.is_none() && optimum.outcome.kkt_residual < FIRST_ORDER;
        let conditions = || second_order::second_order(&problem, &optimum.outcome, &mut Work::default());
        let second_order = is_optimum.then(conditions).flatten();
        let mounted = optimum.design.as_slice();
        let classifier = Classifier::new(self.finders[0].system, self.study.twist);
        let nature = |r: &Row| {
            let load_case = &scenarios[r.load_case];
            classifier.nature(load_case.finder, &load_case.absorbers(mounted)?, &r.peak)
        };
        let natures = optimum.outcome.rows.rows.iter().map(nature).collect::<Result<_, _>>().map_err(failed)?;
        // those of the materials' reference: in operation the state of the material follows, too
        let sensitivities =
            sensitivities((&at_reference, &scenarios), mounted, &self.study.measures_of(objective), &self.study.limits).map_err(failed)?;
        let load_case = |r: &Row| {
            let load_case = &scenarios[r.load_case];
            RowCase { condition: load_case.condition, cylinder: load_case.cylinder, deviation: load_case.deviation.cloned() }
        };
        let load_cases = optimum.outcome.rows.rows.iter().map(load_case).collect();
        let firing = LoadCase::new(Condition::Firing, &self.finders[0]);
        let reference = self.comes_to(objective, &[firing], mounted).ok();
        let (prices, on_bounds) = shadow_prices::prices(&problem.space, &optimum.outcome, self.limits.len());
        Ok(OptimumResult {
            design,
            optimum,
            natures,
            load_cases,
            main,
            family,
            objective,
            prices,
            scan,
            survey,
            nearby,
            proof,
            exclusions,
            second_order,
            sensitivities,
            on_bounds,
            conflict,
            robust: within.is_some(),
            reference,
        })
    }

    /// That no design is better than an optimum, and the same for others to check; what a proof finds that is better takes its place.
    fn proof(
        &self,
        (spec, is_asked): (&OptimiseSpec, bool),
        problem: &Problem,
        (optimum, tolerant): (&mut Optimum, bool),
        step: Recorder,
    ) -> (Option<Proof>, Option<Exclusions>) {
        if !is_asked {
            return (None, None);
        }
        let ProveSpec { effort, file, .. } = spec.prove;
        let (found, seconds) = timed(|| {
            let proof = if tolerant { Proof::none(Reason::Tolerances) } else { proof::settle(problem, optimum, effort) };
            let is_told = file && matches!(proof.verdict, Verdict::Proved | Verdict::Impossible);
            let exclusions = is_told.then(|| proof::exclusions(problem, &optimum.outcome, effort, &mut optimum.stages.search)).flatten();
            (Some(proof), exclusions)
        });
        step();
        self.proofs.fetch_add((1e9 * seconds) as u64, Ordering::Relaxed);
        found
    }

    /// Limits are judged in operation, too: whether an optimum differs there, which then is sought anew. A design that is as good there is the best of both; within tolerances it is as drawn there.
    fn is_of_operation(
        &self,
        (problem, operation): (&Problem, LoadCase),
        (within, deviations): (Option<&Tolerances>, &mut Vec<Deviation>),
        (optimum, looked): (&mut Optimum, &mut LookedOver),
        (starts, seed, step): (&[NamedPoint], u64, Recorder),
    ) -> Result<bool, ResponseError> {
        let scenarios: Vec<LoadCase> = robust::scenarios(self.load_cases, deviations).into_iter().chain([operation]).collect();
        let both = Problem { load_cases: &scenarios, space: problem.space.clone(), ..*problem };
        let counts = in_operation(&both, (optimum, looked), starts, seed, step)?;
        if let Some(tolerances) = within.filter(|_| counts && looked.conflict.is_none()) {
            // it has its own worst deviation
            (*deviations, *optimum) = robust::settled((problem, &[operation]), tolerances, (deviations.clone(), optimum.clone()), seed)?;
        }
        Ok(counts)
    }

    /// The numbers of an optimum. A limit may jump between two speeds that a search looks at, as a temperature does where a balance of heat is lost: where the design then breaks one, the best of the other local optima
    /// that holds them takes its place.
    fn as_reported(
        &self,
        problem: &Problem,
        (optimum, others): (&mut Optimum, bool),
        (effort, mut proof): (Effort, Option<&mut Proof>),
        name: &str,
    ) -> Result<DesignResult, RunError> {
        let evaluated = |design: &[Mounted]| evaluate::evaluate(self.finders, name, design, self.wanted, &mut Work::default());
        let own = evaluated(&optimum.design)?;
        if own.within_limits() || !others {
            return Ok(own);
        }
        for (i, other) in optimum.others.iter().enumerate() {
            let from = problem.space.point_of(&other.design);
            let Ok(outcome) = minimax::minimise(problem, &from, &mut Work::default()) else { continue };
            let design = problem.space.design(&outcome.point);
            let Some(found) = evaluated(&design).ok().filter(|d| d.within_limits() && outcome.rows.hold()) else { continue };
            optimum.others.drain(..=i);
            (optimum.design, optimum.outcome) = (design, outcome);
            if let Some(proof) = &mut proof {
                // what no design is below holds of its family, what it is itself at no speed above does not
                proof.upper_bound = proof::upper_bound(problem, &optimum.outcome, effort, &mut optimum.stages.search);
            }
            return Ok(found);
        }
        Ok(own)
    }

    /// Family and objective of the optimum of a name; none of those within tolerances.
    pub(super) fn named(&self, spec: &OptimiseSpec, name: &str) -> Option<(Space, usize)> {
        let found = self.sought(spec).into_iter().find(|s| s.family.name == name && s.within.is_none())?;
        Some((found.family.space, found.objective))
    }

    /// What is sought: every family by the first objective; the main size of each type once more by every other objective, and within tolerances.
    fn sought(&self, spec: &OptimiseSpec) -> Vec<Sought> {
        let mut families: Vec<Sought> =
            families::wanted(spec, self.modes).into_iter().map(|family| Sought { family, objective: 0, within: None }).collect();
        let others = self.study.more_objectives.iter().map(|o| format!("by_{}", o.word));
        let main: Vec<Family> = families.iter().filter(|f| f.family.is_main).map(|f| f.family.clone()).collect();
        let again =
            |suffix: &str| -> Vec<Family> { main.iter().map(|f| Family { name: format!("{}_{suffix}", f.name), ..f.clone() }).collect() };
        for (i, suffix) in others.chain(self.study.combined.iter().map(|_| "combined".to_owned())).enumerate() {
            families.extend(again(&suffix).into_iter().map(|family| Sought { family, objective: i + 1, within: None }));
        }
        if let Some(robust) = self.study.robust.as_ref().filter(|r| r.search) {
            let tolerances = |f: &Family| {
                let types: Vec<_> = f.space.slots.iter().map(|s| Some((s.declaration, s.material.substance.as_deref()))).collect();
                Tolerances::scattered(&types, &robust.scatter())
            };
            let within = again("robust").into_iter().map(|family| (tolerances(&family), family)).filter(|f| f.0.edges() > 0);
            families.extend(within.map(|(t, family)| Sought { family, objective: 0, within: Some(t) }));
        }
        families
    }

    /// An objective of a design at its worst in some load cases, as searches minimise it.
    fn comes_to(&self, objective: usize, load_cases: &[LoadCase], design: &[Mounted]) -> Result<f64, ResponseError> {
        let worst = |l: &Limit| Ok(largest(load_cases.iter(), design, &l.measure, &mut Work::default())? / l.limit);
        let Some(own) = self.objectives.get(objective) else {
            let parts = self.combined.iter().map(worst).collect::<Result<Vec<f64>, ResponseError>>()?;
            let weights = self.study.combined.as_ref().map_or(&[][..], |c| &c.weights);
            let sum = || parts.iter().zip(weights).map(|(p, w)| p * w).sum();
            return Ok(if weights.is_empty() { parts.iter().copied().fold(0.0, f64::max) } else { sum() });
        };
        worst(own)
    }

    /// Each objective of the engine without absorber; `None` where it is one of absorbers, or has no finite response.
    pub(crate) fn bare(&self) -> Vec<Option<f64>> {
        let combined = self.study.combined.iter().map(|_| self.combined.as_slice());
        let each = self.objectives.iter().map(std::slice::from_ref).chain(combined).enumerate();
        let of_engine = |parts: &[Limit]| parts.iter().all(|l| l.measure.absorbers().next().is_none());
        each.map(|(i, parts)| if of_engine(parts) { self.comes_to(i, self.load_cases, &[]).ok() } else { None }).collect()
    }

    /// The study's other objectives for a design, at their worst in the load cases.
    pub(super) fn others(&self, design: &[Mounted]) -> Result<Vec<f64>, ResponseError> {
        let value = |measure: &Measure| largest(self.load_cases.iter(), design, measure, &mut Work::default());
        self.study.more_objectives.iter().map(|o| value(&o.measure)).collect()
    }
}

/// Shows the best size of those that a study lists, too, where it is not the first: what answers its question has curves, margins and conditions.
fn show_best_size(optima: &mut [OptimumResult]) {
    let asked = optima.iter_mut().filter(|o| o.objective == 0 && !o.robust);
    let order = |o: &OptimumResult| (!o.design.within_limits(), o.design.objective.unwrap_or(f64::INFINITY));
    let lower = |a: &OptimumResult, b: &OptimumResult| {
        let (a, b) = (order(a), order(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    };
    if let Some(best) = asked.min_by(|a, b| lower(a, b)) {
        best.main = true;
    }
}
