//! Fronts of two measures of a study: of every number and combination of its absorbers.

use super::RunError;
use super::families::{self, joined};
use super::results::{Beside, OptimumResult, TradeoffResult};
use super::searches::Searches;
use super::timing::{Clock, timed};
use crate::absorber::{Host, Mounted};
use crate::input::{FrontSpec, OptimiseSpec};
use crate::objective::{HELD, Limit};
use crate::optimise::tradeoff::{Follower, mark};
use crate::optimise::{Optimum, Problem, Space, Tradeoff, largest};
use crate::response::{ResponseError, Work};
use rayon::prelude::*;

impl Searches<'_> {
    /// The families of a front: the first absorber of a study, the first two, and so on, of all types.
    #[doc(hidden)]
    pub fn families_of_front(&self, spec: &OptimiseSpec) -> Vec<(String, Space, OptimiseSpec)> {
        let mut list = Vec::new();
        for count in 1..=spec.absorbers.len() {
            let fewer = OptimiseSpec { absorbers: spec.absorbers[..count].to_vec(), ..spec.clone() };
            // a ring that carries one of them may come later in the list
            if fewer.absorbers.iter().any(|a| matches!(a.on, Host::Ring(inner) if inner >= count)) {
                continue;
            }
            for types in families::types(&fewer) {
                let rings = fewer.absorbers.iter().map(families::main_ring).collect();
                let name = joined(&types);
                let space = families::family(&fewer, &families::Choice { types, rings }, self.modes);
                list.push((name, space, fewer.clone()));
            }
        }
        list
    }

    /// The optimum of a family by a measure within the limits of the study, where the study has asked for it.
    fn known<'o>(&self, spec: &OptimiseSpec, space: &Space, measure: &Limit, optima: &'o [OptimumResult]) -> Option<&'o Optimum> {
        let family = families::wanted(spec, self.modes).into_iter().find(|f| f.space == *space)?;
        let is_wanted = |o: &&OptimumResult| o.family == family.family && self.objectives.get(o.objective) == Some(measure);
        optima.iter().filter(is_wanted).find(|o| !o.robust && o.conflict.is_none()).map(|o| &o.optimum)
    }

    /// Fronts of every pair of the study's measures, beginning with optima that are known.
    ///
    /// # Errors
    /// [`RunError`] where no start of a search has a finite response.
    #[doc(hidden)]
    pub fn tradeoffs(&self, spec: &OptimiseSpec, optima: &[OptimumResult], clock: &mut Clock) -> Result<Vec<TradeoffResult>, RunError> {
        let Some(FrontSpec::Of { points, measures }) = &self.study.front else { return Ok(Vec::new()) };
        let pairs: Vec<[usize; 2]> = (0..measures.len()).flat_map(|i| (i + 1..measures.len()).map(move |j| [i, j])).collect();
        let families = self.families_of_front(spec);
        self.progress.stage("fronts", pairs.len() * families.len() * points);
        let step = || self.progress.step();
        let mut results = Vec::new();
        // fronts of all pairs and families side by side
        let follow = |of: &[usize; 2], (name, space, spec): &(String, Space, OptimiseSpec)| {
            let (first, second) = (measures[of[0]].measure.in_si(), measures[of[1]].measure.in_si());
            let failed = |error: ResponseError| RunError { what: format!("front of {name}"), error };
            let load_cases = self.load_cases_of(spec, space);
            let problem = Problem {
                load_cases: &load_cases,
                space: space.clone(),
                objectives: std::slice::from_ref(&first),
                weights: &[],
                limits: &self.limits,
                memory: self.memory(None),
            };
            let starts = |space: &Space| self.starts(spec, space);
            let least = [&first, &second].map(|measure| self.known(spec, space, measure, optima));
            Follower::new(&problem, &second, &starts).with_least(least).follow(*points, &step).map_err(failed)
        };
        // a family has no value of a measure of an absorber that it has not
        let has =
            |of: &[usize; 2], family: &&(String, Space, OptimiseSpec)| of.iter().all(|m| measures[*m].measure.is_of(family.1.slots.len()));
        let of_pair = |of: &[usize; 2]| {
            let own: Vec<_> = families.iter().filter(|family| has(of, family)).collect();
            own.into_par_iter().map(|family| timed(|| follow(of, family))).collect::<Vec<_>>()
        };
        let found: Vec<Vec<(Result<Tradeoff, RunError>, f64)>> = pairs.par_iter().map(of_pair).collect();
        for (of, found) in pairs.into_iter().zip(found) {
            let mut fronts: Vec<Tradeoff> = Vec::new();
            let own: Vec<_> = families.iter().filter(|family| has(&of, family)).collect();
            for ((name, ..), (front, seconds)) in own.iter().zip(found) {
                let mut front = front?;
                let held: Vec<bool> = front.points.par_iter().map(|p| self.excess_as_reported(&p.design) <= HELD).collect();
                let mut held = held.into_iter();
                front.points.retain(|_| held.next().unwrap_or(true));
                let mut work = front.minimax;
                work += front.searches;
                clock.beside(&format!("front_{name}"), seconds, work);
                fronts.push(front);
            }
            mark(&mut fronts);
            let failed = |error: ResponseError| RunError { what: "front".into(), error };
            let value = |m: usize, design: &[Mounted]| largest(self.load_cases.iter(), design, &measures[m].measure, &mut Work::default());
            let third = (0..measures.len()).find(|m| !of.contains(m));
            let of_front = |f: &Tradeoff| -> Result<Vec<f64>, ResponseError> {
                third.map_or_else(|| Ok(Vec::new()), |m| f.points.par_iter().map(|p| value(m, &p.design)).collect())
            };
            let third = fronts.iter().map(of_front).collect::<Result<_, _>>().map_err(failed)?;
            let beside = |d: &crate::input::DesignSpec| {
                Ok(Beside { design: d.name.clone(), values: [value(of[0], &d.absorbers)?, value(of[1], &d.absorbers)?] })
            };
            let given = self.study.designs.par_iter().map(beside).collect::<Result<_, _>>().map_err(failed)?;
            results.push(TradeoffResult { of, families: own.into_iter().map(|f| f.0.clone()).zip(fronts).collect(), third, given });
        }
        Ok(results)
    }
}
