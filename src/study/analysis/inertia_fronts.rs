//! Fronts over ring inertia, and in which load cases fronts are held to limits.

use super::RunError;
use super::evaluate;
use super::families;
use super::results::{FrontResult, OptimumResult};
use super::searches::Searches;
use super::timing::{Clock, timed};
use crate::absorber::{Declaration, Mounted};
use crate::input::{FrontSpec, OptimiseSpec};
use crate::objective::{Condition, HELD};
use crate::optimise::front::KnownOptimum;
use crate::optimise::{LoadCase, Problem, Space, front, proof};
use crate::response::Work;
use rayon::prelude::*;

impl<'a> Searches<'a> {
    /// Optima by the first objective of families that differ from this one in the ring they hold.
    fn known_along<'o>(&self, spec: &OptimiseSpec, space: &Space, optima: &'o [OptimumResult]) -> Vec<KnownOptimum<'o>> {
        let families = families::wanted(spec, self.modes);
        let asked = |o: &&OptimumResult| o.objective == 0 && !o.robust && o.conflict.is_none();
        let along = |o: &'o OptimumResult| {
            let family = families.iter().find(|f| f.family == o.family)?;
            family.space.is_but_for_ring(space).then(|| KnownOptimum { space: family.space.clone(), outcome: &o.optimum.outcome })
        };
        optima.iter().filter(asked).filter_map(along).collect()
    }

    /// Load cases of a study, and the absorbers of a family in operation where optima of the study are judged there.
    pub(super) fn load_cases_of(&self, spec: &OptimiseSpec, space: &Space) -> Vec<LoadCase<'a>> {
        let middle: Vec<f64> = space.bounds().iter().map(|b| 0.5 * (b.0 + b.1)).collect();
        let judged = (spec.in_operation || !self.limits.is_empty()) && !Condition::InOperation.changes_nothing(&space.design(&middle));
        let operation = LoadCase::new(Condition::InOperation, &self.finders[0]);
        self.load_cases.iter().cloned().chain(judged.then_some(operation)).collect()
    }

    /// How far a design, as it is reported, is beyond the limit that it is furthest beyond, over that; zero without limits, infinite where it has no finite response.
    pub(super) fn excess_as_reported(&self, design: &[Mounted]) -> f64 {
        if self.limits.is_empty() {
            return 0.0;
        }
        let found = evaluate::evaluate(self.finders, "front", design, self.wanted, &mut Work::default());
        found.map_or(f64::INFINITY, |d| d.limits.iter().fold(0.0, |m: f64, ratio| m.max(ratio - 1.0)))
    }

    /// The fronts, with the time of each, beginning with optima that are known.
    ///
    /// # Errors
    /// [`RunError`] where none of the starts at an inertia has a finite response.
    pub fn fronts(&self, spec: &OptimiseSpec, optima: &[OptimumResult], clock: &mut Clock) -> Result<Vec<FrontResult>, RunError> {
        let Some(FrontSpec::OverInertia(inertias)) = &self.study.front else { return Ok(Vec::new()) };
        let all = families::types(spec);
        self.progress.stage("fronts", 2 * inertias.len() * all.len());
        let step = || self.progress.step();
        // a front is of one absorber: validation sees to it
        let follow = |types: Vec<&'static Declaration>| {
            let declaration = types[0];
            let space = families::family(spec, &families::Choice { types, rings: vec![Some(inertias[0])] }, self.modes);
            let failed = |error| RunError { what: format!("front of {} absorbers", declaration.name), error };
            let known = self.known_along(spec, &space, optima);
            let load_cases = self.load_cases_of(spec, &space);
            let problem = Problem { load_cases: &load_cases, ..self.problem(space, 0) };
            let (front, mut seconds) = timed(|| front::follow(&problem, (inertias, &known), &|s| self.starts(spec, s), &step));
            let mut front = front.map_err(failed)?;
            let prove = spec.prove;
            if prove.all && prove.effort.boxes > 0 {
                seconds += timed(|| proof::settle_front(&problem, &mut front, prove.effort)).1;
            }
            front.points.par_iter_mut().for_each(|p| {
                let excess = self.excess_as_reported(&p.design);
                if excess > p.excess.max(HELD) {
                    (p.excess, p.dominated) = (excess, true);
                }
            });
            let others = front.points.par_iter().map(|p| self.others(&p.design)).collect::<Result<Vec<_>, _>>().map_err(failed)?;
            Ok((FrontResult { declaration, front, others }, seconds))
        };
        let found: Vec<Result<(FrontResult, f64), RunError>> = all.into_par_iter().map(follow).collect();
        let mut results = Vec::new();
        for front in found {
            let (result, seconds) = front?;
            clock.beside(&format!("front_{}", result.declaration.name), seconds, result.front.work);
            results.push(result);
        }
        Ok(results)
    }
}
