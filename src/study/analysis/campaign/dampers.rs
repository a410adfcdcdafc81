//! The dampers that several engines share: one minimax problem over the load cases of all of them, and which engines share one.

use crate::absorber::{Host, Mounted};
use crate::analysis::families::{self, Family};
use crate::analysis::looked_over::looked_over;
use crate::analysis::searches::Searches;
use crate::analysis::{RunError, compounds};
use crate::input::{AbsorberSpec, OptimiseSpec};
use crate::objective::{Condition, Limit};
use crate::optimise::assignment::{Assignment, Set, assignments};
use crate::optimise::{Engine, LoadCase, Optimum, Problem, Proof, Space, Verdict, proof, search, starts};
use crate::response::{ResponseError, Work};
use std::collections::BTreeMap;

/// Designs for parts of a set that its own search starts from, at most.
const KNOWN: usize = 8;

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

    /// What no damper is below, as a share of it; `None` where that is not proved.
    fn proved_share(&self) -> Option<f64> {
        let proof = self.proof.as_ref()?;
        match proof.verdict {
            Verdict::Impossible => Some(1.0),
            _ => proof.lower_bound.map(|b| b / self.optimum.value()),
        }
    }
}

/// Dampers of a family for the engines of a platform.
pub(super) struct Dampers {
    pub name: String,
    space: Space,
    /// Of each study, in the unit that it is minimised in.
    pub targets: Vec<f64>,
    /// For every number of dampers which engines share one.
    pub assignments: Vec<Assignment>,
    /// The best one of each set that was asked for.
    pub of_sets: BTreeMap<Set, Result<Damper, RunError>>,
}

impl Dampers {
    /// What no dampers of an assignment are below; `None` where one of the sets behind it is not proved.
    pub fn lower_bound(&self, of: &Assignment) -> Option<f64> {
        let mut shares = self.of_sets.values().map(|d| d.as_ref().ok().and_then(Damper::proved_share));
        let least = shares.try_fold(1.0, |least, share| Some(f64::min(least, share?)))?;
        Some(of.at_least * least).filter(|b| b.is_finite())
    }
}

/// The studies of a platform.
pub(super) struct Studies<'a> {
    searches: &'a [&'a Searches<'a>],
    /// The engine of each.
    engines: Vec<usize>,
    spec: &'a OptimiseSpec,
    /// What carries each absorber in each of them.
    hosts: Vec<Vec<Host>>,
}

/// Whether two studies ask for the same absorber, but for the station that carries it.
fn is_same_part(a: &AbsorberSpec, b: &AbsorberSpec) -> bool {
    let placed = |of: &AbsorberSpec| match of.on {
        Host::Station(_) => AbsorberSpec { on: Host::Station(0), whole_chain: false, ..of.clone() },
        Host::Ring(_) => AbsorberSpec { whole_chain: false, ..of.clone() },
    };
    placed(a) == placed(b)
}

impl<'a> Studies<'a> {
    /// `loads`: how many studies in a row are of one engine.
    ///
    /// # Errors
    /// In words, where they do not ask for one damper.
    pub fn new(searches: &'a [&'a Searches<'a>], loads: usize) -> Result<Self, String> {
        let specs: Option<Vec<&OptimiseSpec>> = searches.iter().map(|s| s.study.optimise.as_ref()).collect();
        let specs = specs.ok_or("a study has no [optimise]")?;
        if specs.iter().any(|spec| compounds::are_named(spec)) {
            return Err(
                "a study names compounds, oils or steps of dimensions to choose from, expected one: a [[vary]] takes one after the other"
                    .into(),
            );
        }
        let same = |other: &&OptimiseSpec| {
            other.absorbers.len() == specs[0].absorbers.len()
                && other.absorbers.iter().zip(&specs[0].absorbers).all(|(a, b)| is_same_part(a, b))
        };
        if let Some(i) = specs.iter().position(|s| !same(s)) {
            return Err(format!(
                "the studies of engines 1 and {} ask for different dampers, expected the same [[optimise.absorber]] but for `on`: types, sizes in kg m² (an `inertia_ratio` is another size for each engine), bounds, materials, hub",
                i / loads + 1
            ));
        }
        let hosts = specs.iter().map(|spec| spec.absorbers.iter().map(|a| a.on).collect()).collect();
        Ok(Self { searches, engines: (0..searches.len()).map(|i| i / loads).collect(), spec: specs[0], hosts })
    }

    /// The families of all studies; bounds that a study does not give are the widest of those that hartog would choose for each engine.
    fn families(&self) -> Vec<Family> {
        let mut all = self.searches.iter().map(|s| families::wanted(self.spec, s.modes));
        let mut list = all.next().unwrap_or_default();
        for other in all {
            for (own, other) in list.iter_mut().zip(other) {
                for (v, w) in own.space.variables.iter_mut().zip(&other.space.variables) {
                    (v.lower, v.upper, v.scale) = (v.lower.min(w.lower), v.upper.max(w.upper), v.scale.min(w.scale));
                }
            }
        }
        list
    }

    /// The studies of a set of engines.
    pub fn of(&self, set: Set) -> impl Iterator<Item = usize> {
        (0..self.engines.len()).filter(move |i| set >> self.engines[*i] & 1 == 1)
    }

    /// A design in its place on the engine of a study.
    pub fn mounted(&self, study: usize, design: &[Mounted]) -> Vec<Mounted> {
        design.iter().zip(&self.hosts[study]).map(|(m, host)| Mounted { on: *host, ..m.clone() }).collect()
    }

    /// The load cases of a study: those that it holds optima in, and in operation where it asks for that or has limits.
    fn load_cases(&self, study: usize, design: &[Mounted]) -> Vec<LoadCase<'_>> {
        let own = self.searches[study];
        let is_asked = own.study.optimise.as_ref().is_some_and(|o| o.in_operation) || !own.limits.is_empty();
        let operates = is_asked && !Condition::InOperation.changes_nothing(design);
        let operation = operates.then(|| LoadCase::new(Condition::InOperation, &own.finders[0]));
        let engine = Some(Engine { index: study, hosts: &self.hosts[study] });
        own.load_cases.iter().copied().chain(operation).map(|case| LoadCase { engine, ..case }).collect()
    }

    /// What each study minimises, in units of its target, and what it limits.
    fn asked(&self, targets: &[f64]) -> (Vec<Limit>, Vec<Limit>) {
        let of = |(i, l): (usize, &Limit)| Limit { engine: Some(i), ..l.clone() };
        let objectives =
            self.searches.iter().zip(targets).enumerate().map(|(i, (s, target))| Limit { limit: *target, ..of((i, &s.objectives[0])) });
        let limits = self.searches.iter().enumerate().flat_map(|(i, s)| s.limits.iter().map(move |l| of((i, l))));
        (objectives.collect(), limits.collect())
    }

    /// The best damper of a family for some studies, sought from some points, too.
    fn damper(
        &self,
        (family, (objectives, limits)): (&Family, &(Vec<Limit>, Vec<Limit>)),
        (studies, known): (&[usize], Vec<Vec<f64>>),
        is_proved: bool,
    ) -> Result<Damper, ResponseError> {
        let space = &family.space;
        let drawn = space.design(&space.bounds().iter().map(|b| b.1).collect::<Vec<_>>());
        let load_cases: Vec<LoadCase> = studies.iter().flat_map(|i| self.load_cases(*i, &drawn)).collect();
        let problem = Problem { load_cases: &load_cases, space: space.clone(), objectives, weights: &[], limits, memory: None };
        let of_study = |(n, i): (usize, &usize)| {
            let random = if n == 0 { self.spec.random_starts } else { 0 };
            starts::starts(space, self.searches[*i].modes, random, self.spec.seed)
        };
        let known = known.into_iter().map(|point| ("known".to_owned(), point));
        let list: Vec<_> = studies.iter().enumerate().flat_map(of_study).chain(known).collect();
        let list = starts::distinct(list, <[f64]>::to_vec);
        let mut optimum = search::optimise(&problem, &list, search::Finish::Distinct, &|| {})?;
        let excited = studies.iter().filter_map(|i| self.searches[*i].excited()).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
        looked_over(&problem, &mut optimum, (&list, excited), self.spec.seed)?;
        let proof = is_proved.then(|| proof::settle(&problem, &mut optimum, self.spec.prove.effort));
        Ok(Damper { optimum, proof })
    }

    /// The ratio of the objective of a study to its target with a damper.
    pub fn ratio(&self, family: &Dampers, study: usize, damper: &Damper) -> Option<f64> {
        let (objectives, limits) = self.asked(&family.targets);
        let load_cases = self.load_cases(study, &damper.optimum.design);
        let space = family.space.clone();
        let problem = Problem { load_cases: &load_cases, space, objectives: &objectives, weights: &[], limits: &limits, memory: None };
        problem.exactly(&damper.optimum.outcome.point, &mut Work::default()).ok().map(|found| found.0)
    }

    /// Dampers of every family. `targets`: of each study, where they are given; `sets`: of engines whose damper is sought, at most, besides those that a first assignment takes.
    ///
    /// # Errors
    /// [`RunError`] where the damper of a single study has no finite response, or its objective is zero, so that nothing is a ratio to it.
    pub fn dampers(&self, targets: Option<&[f64]>, sets: usize) -> Result<Vec<Dampers>, RunError> {
        self.families().iter().map(|family| self.of_family(family, targets, sets)).collect()
    }

    fn of_family(&self, family: &Family, targets: Option<&[f64]>, sets: usize) -> Result<Dampers, RunError> {
        let count = self.engines.iter().max().map_or(0, |last| last + 1);
        let own_optimum = |i: usize| -> Result<(f64, Vec<f64>), RunError> {
            let failed = |error| RunError { what: family.name.clone(), error };
            let asked = self.asked(&vec![1.0; self.searches.len()]);
            let optimum = self.damper((family, &asked), (&[i], Vec::new()), false).map_err(failed)?.optimum;
            Ok((optimum.value(), optimum.outcome.point))
        };
        let (targets, points): (Vec<f64>, Vec<Vec<f64>>) = match targets {
            Some(targets) => (targets.to_vec(), Vec::new()),
            None => (0..self.searches.len()).map(own_optimum).collect::<Result<Vec<_>, _>>()?.into_iter().unzip(),
        };
        let asked = self.asked(&targets);
        let mut of_sets: BTreeMap<Set, Result<Damper, RunError>> = BTreeMap::new();
        let mut cost = |set: Set| {
            let studies: Vec<usize> = self.of(set).collect();
            let mut parts: Vec<(&Set, &Damper)> =
                of_sets.iter().filter(|(part, _)| *part & !set == 0).filter_map(|(s, d)| Some((s, d.as_ref().ok()?))).collect();
            parts.sort_by_key(|(part, _)| std::cmp::Reverse(part.count_ones()));
            let known = parts.iter().take(KNOWN).map(|(_, d)| d.optimum.outcome.point.clone());
            let known = known.chain(studies.iter().filter_map(|i| points.get(*i).cloned())).collect();
            let found = self.damper((family, &asked), (&studies, known), family.is_proved);
            let cost = found.as_ref().map_or(f64::INFINITY, Damper::cost);
            of_sets.insert(set, found.map_err(|error| RunError { what: family.name.clone(), error }));
            cost
        };
        let assignments = assignments(count, sets, &mut cost);
        Ok(Dampers { name: family.name.clone(), space: family.space.clone(), targets, assignments, of_sets })
    }
}
