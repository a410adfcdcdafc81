//! Fronts by NSGA-II \[Deb et al. 2002\] beside those that are followed by the minimax method: how far it stays behind at equal work and at more, and whether it finds anything that they
//! missed.

use crate::analysis::evaluation_plan::EvaluationPlan;
use crate::analysis::searches::Searches;
use crate::analysis::timing::Clock;
use crate::analysis::{RunError, Silent, families, margins, model_check};
use crate::drivetrain::System;
use crate::engine::Excitation;
use crate::input::{AbsorberSpec, FrontSpec, LimitSpec, OptimiseSpec, Size, Study};
use crate::objective::{Condition, Limit, Measure, Over, PeakFinder, Property, Shared};
use crate::optimise::{LoadCase, Problem, Space};
use crate::response::{Grid, Method, Quantity, Receptance, Work};
use heuropt::prelude::{
    CompositeVariation, Evaluation, Nsga2, Nsga2Config, Objective, ObjectiveSpace, Optimizer, PolynomialMutation, RealBounds,
    SimulatedBinaryCrossover,
};

/// A front of one family.
#[derive(Debug, Clone, PartialEq)]
pub struct Evolution {
    /// The types of its absorbers.
    pub family: String,
    /// The measures it is of.
    pub of: [String; 2],
    /// Points of the front that is followed.
    pub points: usize,
    /// Evaluations that these took.
    pub evaluations: u64,
    /// NSGA-II with as many evaluations, and with more.
    pub rounds: Vec<Round>,
}

/// One run of NSGA-II.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Round {
    /// Evaluations.
    pub evaluations: u64,
    /// Points of the front at which it has a design that is no larger in the second measure.
    pub reached: usize,
    /// By how much the first measure of the best of these is larger there: in the middle of all points.
    pub median: f64,
    /// The same at the worst point.
    pub largest: f64,
    /// Largest share by which a design of its own lies below the front: what following missed.
    pub below: f64,
}

/// Evaluations of NSGA-II, in those of the front.
const TIMES: [u64; 2] = [1, 4];
/// Size of the population; distribution index of the crossover, and how probable it is for a variable; distribution index of the mutation.
const POPULATION: usize = 100;
const CROSSOVER: (f64, f64) = (15.0, 0.5);
const MUTATION: f64 = 20.0;
const SEED: u64 = 2002;

/// Two measures of a family as the crate takes them.
struct Pair<'a> {
    problem: &'a Problem<'a>,
    second: &'a Limit,
}

/// What a design without a finite response counts.
const UNBOUNDED: f64 = 1e30;

impl heuropt::prelude::Problem for Pair<'_> {
    type Decision = Vec<f64>;

    fn objectives(&self) -> ObjectiveSpace {
        ObjectiveSpace::new(vec![Objective::minimize("first"), Objective::minimize("second")])
    }

    fn evaluate(&self, w: &Vec<f64>) -> Evaluation {
        let mut work = Work::default();
        let design = self.problem.space.design(w);
        let found = self.problem.value(w, &mut work).and_then(|(first, excess)| {
            Ok((
                first,
                excess,
                self.problem.load_cases[0].finder.value(&design, (&self.second.measure, 0.0), &Shared::default(), &mut work)?,
            ))
        });
        let (first, excess, second) = found.unwrap_or((UNBOUNDED, 0.0, UNBOUNDED));
        Evaluation::constrained(vec![first, second], excess)
    }
}

/// Fronts of a study whose optima are to hold where everything works; none of others.
///
/// # Errors
/// [`RunError`] where no start of a search has a finite response.
pub fn measure(study: &Study) -> Result<Vec<Evolution>, RunError> {
    let (Some(spec), Some(front)) = (&study.optimise, &study.front) else { return Ok(Vec::new()) };
    if spec.conditions != [Condition::Firing] || spec.absorbers.len() > 1 {
        return Ok(Vec::new());
    }
    let excitation = Excitation::new(&study.engine, study.order_limit);
    let modes = families::engine_modes(study, spec, model_check::highest_frequency_hz(study, &excitation.orders));
    let system = System::with_modes(study.chain.clone(), study.modes.clone(), excitation);
    let grid = Grid::new(&study.speeds_rpm, if study.refine_peaks { &system.excitation.tabulated_rpm } else { &[] });
    let mut quantities: Vec<Quantity> = study.measures().flat_map(|m| m.measure.quantities.iter().copied()).collect();
    quantities.dedup();
    let method = Method::Receptance(Receptance::new(&system, &grid, study.hub, &quantities));
    let margin = margins::model(study, &system.excitation.harmonics, &grid);
    let duty = crate::analysis::duty_points(study);
    let finder = PeakFinder::new(&system, &grid, &method, study.refine_peaks).with_margin(margin.as_ref()).with_duty(&duty);
    let finders = [finder];
    let load_cases = [LoadCase::new(Condition::Firing, &finders[0])];
    let wanted = EvaluationPlan::new(study, &[]);
    let searches = Searches::new(study, (&finders, &load_cases), &modes, &wanted, &Silent);
    let limits: Vec<Limit> = study.limits.iter().map(LimitSpec::to_limit).collect();
    let beside = |space: Space, first: &Measure, second: &Measure, exact: Exact| {
        let (first, second) = ([first.in_si()], second.in_si());
        let problem = Problem { load_cases: &load_cases, space, objectives: &first, weights: &[], limits: &limits, memory: None };
        exact.beside(&Pair { problem: &problem, second: &second })
    };
    let mut clock = Clock::start();
    match front {
        FrontSpec::OverInertia(inertias) => {
            let free = between(spec, (inertias[0], inertias[inertias.len() - 1]));
            let inertia = Measure::new(vec![Quantity::RingTwist(0)], Over::Property(Property::RingInertia));
            let one = |f: crate::analysis::FrontResult| {
                let space = families::family(&free, &families::Choice { types: vec![f.declaration], rings: vec![None] }, &modes);
                let points = f.front.points.iter().filter(|p| !p.dominated).map(|p| [p.value, p.design[0].absorber.ring_inertia()]);
                let of = [study.objective.word.clone(), "ring_inertia".into()];
                let exact =
                    Exact { family: f.declaration.name.into(), of, points: points.collect(), evaluations: f.front.work.evaluations };
                beside(space, &study.objective.measure, &inertia, exact)
            };
            Ok(searches.fronts(spec, &[], &mut clock)?.into_iter().map(one).collect())
        }
        FrontSpec::Of { measures, .. } => {
            let families = searches.families_of_front(spec);
            let mut list = Vec::new();
            for tradeoff in searches.tradeoffs(spec, &[], &mut clock)? {
                let [first, second] = tradeoff.of.map(|m| &measures[m]);
                for ((family, front), (_, space, _)) in tradeoff.families.iter().zip(&families) {
                    let exact = Exact {
                        family: family.clone(),
                        of: [first.word.clone(), second.word.clone()],
                        points: front.points.iter().filter(|p| !p.dominated).map(|p| p.values).collect(),
                        evaluations: front.minimax.evaluations + front.searches.evaluations,
                    };
                    list.push(beside(space.clone(), &first.measure, &second.measure, exact));
                }
            }
            Ok(list)
        }
    }
}

/// The study's absorber with a ring between two sizes.
fn between(spec: &OptimiseSpec, (low, high): (f64, f64)) -> OptimiseSpec {
    let free = |a: &AbsorberSpec| AbsorberSpec { size: Size::Between(low, high), ..a.clone() };
    OptimiseSpec { absorbers: spec.absorbers.iter().map(free).collect(), ..spec.clone() }
}

/// A front as it was followed.
struct Exact {
    family: String,
    of: [String; 2],
    /// By ascending second measure.
    points: Vec<[f64; 2]>,
    evaluations: u64,
}

impl Exact {
    fn beside(self, pair: &Pair) -> Evolution {
        let round = |times: &u64| {
            let generations = (times * self.evaluations) as usize / POPULATION;
            let config = Nsga2Config { population_size: POPULATION, generations: generations.saturating_sub(1), seed: SEED };
            let bounds = pair.problem.space.bounds();
            let variation = CompositeVariation {
                crossover: SimulatedBinaryCrossover::new(bounds.clone(), CROSSOVER.0, CROSSOVER.1),
                mutation: PolynomialMutation::new(bounds.clone(), MUTATION, 1.0 / bounds.len() as f64),
            };
            let found = Nsga2::new(config, RealBounds::new(bounds), variation).run(pair);
            let held = found.pareto_front.iter().filter(|c| c.evaluation.constraint_violation <= 0.0);
            let own: Vec<[f64; 2]> = held.map(|c| [c.evaluation.objectives[0], c.evaluation.objectives[1]]).collect();
            self.against(&own, found.evaluations as u64)
        };
        let rounds = TIMES.iter().map(round).collect();
        Evolution { rounds, family: self.family, of: self.of, points: self.points.len(), evaluations: self.evaluations }
    }

    /// Where NSGA-II ended against the front.
    fn against(&self, own: &[[f64; 2]], evaluations: u64) -> Round {
        let behind = |p: &[f64; 2]| {
            let no_larger = own.iter().filter(|o| o[1] <= p[1] * (1.0 + ROUNDING)).map(|o| o[0]);
            no_larger.reduce(f64::min).map(|best| best / p[0] - 1.0)
        };
        let mut gaps: Vec<f64> = self.points.iter().filter_map(behind).collect();
        gaps.sort_by(f64::total_cmp);
        // the front falls: at what lies between two of its points it is no lower than at the next one
        let below = |o: &[f64; 2]| self.points.iter().find(|p| p[1] >= o[1]).map_or(0.0, |p| p[0] / o[0] - 1.0);
        Round {
            evaluations,
            reached: gaps.len(),
            median: gaps.get(gaps.len() / 2).copied().unwrap_or(f64::NAN),
            largest: gaps.last().copied().unwrap_or(f64::NAN),
            below: own.iter().map(below).fold(0.0, f64::max),
        }
    }
}

/// Values of one design by two ways may differ by this share.
const ROUNDING: f64 = 1e-9;
