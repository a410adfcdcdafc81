//! The dampers that several engines share: one minimax problem over the load cases of all of them, and which engines share one.

use crate::absorber::{Host, Material, Mounted};
use crate::analysis::families::{self, Family};
use crate::analysis::looked_over::looked_over;
use crate::analysis::searches::Searches;
use crate::analysis::{RunError, compounds};
use crate::input::{AbsorberSpec, OptimiseSpec, Study};
use crate::objective::{Condition, Limit};
use crate::optimise::assignment::{Assignment, Set, assignments, least, parties};
use crate::optimise::{Engine, LoadCase, Optimum, Problem, Proof, Verdict, proof, search, starts};
use crate::response::{ResponseError, Work};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Designs for parts of a set that its own search starts from, at most.
const KNOWN: usize = 8;
/// An optimum below this share of what the engine has without absorber is rounding.
const NOTHING: f64 = 1e-9;

/// The best damper for some engines.
#[derive(Debug)]
pub(super) struct Damper {
    pub optimum: Optimum,
    pub proof: Option<Proof>,
}

impl Damper {
    /// Its worst ratio; infinite where it breaks a limit.
    fn cost(&self) -> f64 {
        if self.optimum.outcome.rows.hold() { self.optimum.value() } else { f64::INFINITY }
    }

    /// What no damper is below, as far as that is proved.
    fn at_least(&self) -> f64 {
        match &self.proof {
            Some(proof) if proof.verdict == Verdict::Impossible => f64::INFINITY,
            Some(proof) => proof.lower_bound.unwrap_or(0.0),
            None => 0.0,
        }
    }
}

/// A family of dampers, with their materials in each study: those follow its temperatures.
struct Shared {
    family: Family,
    materials: Vec<Vec<Arc<Material>>>,
}

/// The best dampers for some of the engines.
pub(super) struct Share {
    /// Their studies.
    pub studies: Vec<usize>,
    pub damper: Result<Damper, RunError>,
}

/// Dampers of which each engine has one.
pub(super) struct Count {
    pub dampers: Vec<Arc<Share>>,
    /// The worst ratio; infinite where limits are broken.
    pub worst: f64,
    /// No assignment of so many dampers is below it; infinite where none holds the limits, zero where nothing is proved.
    pub at_least: f64,
}

/// Dampers of a family for the engines of a platform.
pub(super) struct Dampers {
    pub name: String,
    shared: Shared,
    /// Of each study, in the unit that it is minimised in.
    pub targets: Vec<f64>,
    /// For every number of dampers which engines share one.
    pub counts: Vec<Count>,
    /// Engines whose limits no damper was found to hold, each with the nearest.
    pub left_out: Vec<Share>,
}

/// The studies of a platform.
pub(super) struct Studies<'a> {
    searches: &'a [&'a Searches<'a>],
    /// The engine of each.
    engines: Vec<usize>,
    specs: Vec<&'a OptimiseSpec>,
    /// What carries each absorber in each of them.
    hosts: Vec<Vec<Host>>,
}

/// Whether two studies ask for the same absorber, but for the station that carries it, and for its temperatures and what cools it.
fn is_same_part(a: &AbsorberSpec, b: &AbsorberSpec) -> bool {
    let part = |of: &AbsorberSpec| {
        let mut part = AbsorberSpec { temperatures: a.temperatures, whole_chain: false, ..of.clone() };
        if let Host::Station(_) = part.on {
            part.on = Host::Station(0);
        }
        part.materials.iter_mut().for_each(|m| m.1.cooling = None);
        part
    };
    part(a) == part(b)
}

/// Why studies ask for no common damper, where they do not. `names`: of the studies.
pub(super) fn disagreement(studies: &[Study], names: &[String]) -> Option<String> {
    let mut specs: Vec<&OptimiseSpec> = Vec::new();
    for (study, name) in studies.iter().zip(names) {
        let Some(spec) = &study.optimise else { return Some(format!("{name}: the study has no [optimise]")) };
        if compounds::are_named(spec) {
            return Some(format!(
                "{name}: the study names compounds, oils or steps of dimensions to choose from, expected one: a [[vary]] takes one after the other"
            ));
        }
        specs.push(spec);
    }
    let first = specs.first()?;
    for (spec, name) in specs.iter().zip(names) {
        let same =
            spec.absorbers.len() == first.absorbers.len() && spec.absorbers.iter().zip(&first.absorbers).all(|(a, b)| is_same_part(a, b));
        if !same {
            return Some(format!(
                "{} and {name} ask for different dampers, expected the same [[optimise.absorber]] but for `on` and `cooling`: types, sizes in kg m² (an `inertia_ratio` is another size for each engine), bounds, materials, hub",
                names[0]
            ));
        }
        if (spec.seed, spec.random_starts, spec.prove) != (first.seed, first.random_starts, first.prove) {
            return Some(format!(
                "{} and {name} ask for different searches, expected the same `seed`, `random_starts` and `prove`",
                names[0]
            ));
        }
    }
    None
}

impl<'a> Studies<'a> {
    /// Of studies that agree; `loads`: how many of them in a row are of one engine.
    pub fn new(searches: &'a [&'a Searches<'a>], loads: usize) -> Self {
        let specs: Vec<&OptimiseSpec> = searches.iter().filter_map(|s| s.study.optimise.as_ref()).collect();
        let hosts = specs.iter().map(|spec| spec.absorbers.iter().map(|a| a.on).collect()).collect();
        Self { searches, engines: (0..searches.len()).map(|i| i / loads).collect(), specs, hosts }
    }

    /// The families of all studies; bounds that a study does not give are the widest of those that hartog would choose for each engine.
    fn families(&self) -> Vec<Shared> {
        let mut list: Vec<Shared> = Vec::new();
        for (spec, searches) in self.specs.iter().zip(self.searches) {
            for (i, family) in families::wanted(spec, searches.modes).into_iter().enumerate() {
                let materials = family.space.slots.iter().map(|s| s.material.clone()).collect();
                let Some(own) = list.get_mut(i) else {
                    list.push(Shared { family, materials: vec![materials] });
                    continue;
                };
                own.materials.push(materials);
                for (v, w) in own.family.space.variables.iter_mut().zip(&family.space.variables) {
                    (v.lower, v.upper, v.scale) = (v.lower.min(w.lower), v.upper.max(w.upper), v.scale.min(w.scale));
                }
            }
        }
        list
    }

    fn engine<'s>(&'s self, shared: &'s Shared, study: usize) -> Engine<'s> {
        Engine { index: study, hosts: &self.hosts[study], materials: &shared.materials[study] }
    }

    /// A damper in its place on the engine of a study.
    pub fn mounted(&self, family: &Dampers, study: usize, design: &[Mounted]) -> Vec<Mounted> {
        self.engine(&family.shared, study).mounted(design)
    }

    /// The load cases of a study: those that it holds optima in, and in operation where it asks for that or has limits.
    fn load_cases<'s>(&'s self, shared: &'s Shared, study: usize) -> Vec<LoadCase<'s>> {
        let (own, engine, space) = (self.searches[study], self.engine(shared, study), &shared.family.space);
        let drawn = engine.mounted(&space.design(&space.bounds().iter().map(|b| b.1).collect::<Vec<_>>()));
        let is_asked = self.specs[study].in_operation || !own.limits.is_empty();
        let operates = is_asked && !Condition::InOperation.changes_nothing(&drawn);
        let operation = operates.then(|| LoadCase::new(Condition::InOperation, &own.finders[0]));
        own.load_cases.iter().copied().chain(operation).map(|case| LoadCase { engine: Some(engine), ..case }).collect()
    }

    /// What each study minimises, in units of its target, and what it limits.
    fn asked(&self, targets: &[f64]) -> (Vec<Limit>, Vec<Limit>) {
        let of = |(i, l): (usize, &Limit)| Limit { engine: Some(i), ..l.clone() };
        let objectives = self.searches.iter().zip(targets).enumerate();
        let objectives = objectives.map(|(i, (s, target))| Limit { limit: *target, ..of((i, &s.objectives[0])) });
        let limits = self.searches.iter().enumerate().flat_map(|(i, s)| s.limits.iter().map(move |l| of((i, l))));
        (objectives.collect(), limits.collect())
    }

    /// The best damper of a family for some studies, sought from some points, too.
    fn damper(
        &self,
        (shared, (objectives, limits)): (&Shared, &(Vec<Limit>, Vec<Limit>)),
        (studies, known): (&[usize], Vec<Vec<f64>>),
        is_proved: bool,
    ) -> Result<Damper, ResponseError> {
        let (space, spec) = (&shared.family.space, self.specs[0]);
        let load_cases: Vec<LoadCase> = studies.iter().flat_map(|i| self.load_cases(shared, *i)).collect();
        let problem = Problem { load_cases: &load_cases, space: space.clone(), objectives, weights: &[], limits, memory: None };
        let of_study = |(n, i): (usize, &usize)| {
            let random = if n == 0 { spec.random_starts } else { 0 };
            starts::starts(space, self.searches[*i].modes, random, spec.seed)
        };
        let known = known.into_iter().map(|point| ("known".to_owned(), point));
        let list: Vec<_> = studies.iter().enumerate().flat_map(of_study).chain(known).collect();
        let list = starts::distinct(list, <[f64]>::to_vec);
        let mut optimum = search::optimise(&problem, &list, search::Finish::Distinct, &|| {})?;
        let excited = studies.iter().filter_map(|i| self.searches[*i].excited()).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
        looked_over(&problem, &mut optimum, (&list, excited), spec.seed)?;
        let proof = is_proved.then(|| proof::settle(&problem, &mut optimum, spec.prove.effort));
        Ok(Damper { optimum, proof })
    }

    /// The ratio of the objective of a study to its target with a damper.
    pub fn ratio(&self, family: &Dampers, study: usize, damper: &Damper) -> Option<f64> {
        let (objectives, limits) = self.asked(&family.targets);
        let load_cases = self.load_cases(&family.shared, study);
        let space = family.shared.family.space.clone();
        let problem = Problem { load_cases: &load_cases, space, objectives: &objectives, weights: &[], limits: &limits, memory: None };
        problem.exactly(&damper.optimum.outcome.point, &mut Work::default()).ok().map(|found| found.0)
    }

    /// Dampers of every family. `targets`: of each study, where they are given; `sets`: of engines whose damper is sought, at most, besides those of a first assignment.
    ///
    /// # Errors
    /// [`NoDampers`] where the damper of a single study has no finite response, or its objective is nothing, so that there is no ratio to it.
    pub fn dampers(&self, targets: Option<&[f64]>, sets: usize) -> Result<Vec<Dampers>, NoDampers> {
        self.families().into_iter().map(|shared| self.of_family(shared, targets, sets)).collect()
    }

    /// Value and place of the best damper for a study alone, in its own unit.
    fn alone(&self, shared: &Shared, study: usize) -> Result<(f64, Vec<f64>), NoDampers> {
        let failed = |error| NoDampers::Unbounded(RunError { what: shared.family.name.clone(), error });
        let asked = self.asked(&vec![1.0; self.searches.len()]);
        let optimum = self.damper((shared, &asked), (&[study], Vec::new()), false).map_err(failed)?.optimum;
        let bare = self.searches[study].bare().first().copied().flatten().unwrap_or(0.0);
        if optimum.value() <= NOTHING * bare { Err(NoDampers::Nothing(study)) } else { Ok((optimum.value(), optimum.outcome.point)) }
    }

    fn of_family(&self, shared: Shared, targets: Option<&[f64]>, sets: usize) -> Result<Dampers, NoDampers> {
        let (targets, points): (Vec<f64>, Vec<Vec<f64>>) = match targets {
            Some(targets) => (targets.to_vec(), Vec::new()),
            None => (0..self.searches.len()).map(|i| self.alone(&shared, i)).collect::<Result<Vec<_>, _>>()?.into_iter().unzip(),
        };
        let asked = self.asked(&targets);
        let best = |studies: Vec<usize>, known: Vec<Vec<f64>>| {
            let known = known.into_iter().chain(studies.iter().filter_map(|i| points.get(*i).cloned())).collect();
            let damper = self.damper((&shared, &asked), (&studies, known), shared.family.is_proved);
            Share { damper: damper.map_err(|error| RunError { what: shared.family.name.clone(), error }), studies }
        };
        let of_engine = |e: usize| (0..self.engines.len()).filter(|i| self.engines[*i] == e).collect::<Vec<_>>();
        let count = self.engines.last().map_or(0, |last| last + 1);
        let cost_of = |share: &Share| share.damper.as_ref().map_or(f64::INFINITY, Damper::cost);
        // what nothing serves alone is served together with nothing
        let (served, left_out): (Vec<Share>, Vec<Share>) =
            (0..count).map(|e| best(of_engine(e), Vec::new())).partition(|share| cost_of(share).is_finite());
        let mut of_sets: BTreeMap<Set, Arc<Share>> = served.into_iter().enumerate().map(|(i, share)| (1 << i, Arc::new(share))).collect();
        let alone: Vec<Vec<usize>> = of_sets.values().map(|share| share.studies.clone()).collect();
        let mut cost = |set: Set| {
            if let Some(known) = of_sets.get(&set) {
                return cost_of(known);
            }
            let studies: Vec<usize> = parties(set).flat_map(|e| alone[e].clone()).collect();
            let parts = of_sets.iter().filter(|(part, _)| *part & !set == 0);
            let mut parts: Vec<(&Set, &Damper)> = parts.filter_map(|(part, share)| Some((part, share.damper.as_ref().ok()?))).collect();
            parts.sort_by_key(|(part, _)| std::cmp::Reverse(part.count_ones()));
            let known = parts.iter().take(KNOWN).map(|(_, d)| d.optimum.outcome.point.clone()).collect();
            let share = best(studies, known);
            let cost = cost_of(&share);
            of_sets.insert(set, Arc::new(share));
            cost
        };
        let found = assignments(alone.len(), sets, &mut cost);
        let known = of_sets.iter().map(|(set, share)| (*set, share.damper.as_ref().map_or(0.0, Damper::at_least))).collect();
        let of_count = |(i, own): (usize, Assignment)| {
            let dampers: Vec<Arc<Share>> = own.sets.iter().map(|set| of_sets[set].clone()).collect();
            // that of an assignment may be of a part whose search has erred
            let worst = dampers.iter().map(|share| cost_of(share)).fold(0.0, f64::max);
            Count { dampers, worst, at_least: least(alone.len(), i + 1, &known).min(worst) }
        };
        let counts = found.into_iter().enumerate().map(of_count).collect();
        Ok(Dampers { name: shared.family.name.clone(), targets, counts, left_out, shared })
    }
}

/// Why there are no dampers.
#[derive(Debug)]
pub(super) enum NoDampers {
    /// The damper of a single study has no finite response.
    Unbounded(RunError),
    /// The objective of this study is nothing.
    Nothing(usize),
}
