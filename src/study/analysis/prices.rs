//! What each condition, limit and bound costs: the optimum is sought again without it, all others held; and what half of the ring costs.

use super::evaluation_plan::EvaluationPlan;
use super::families;
use super::margins;
use super::results::{Change, OptimumResult, Price};
use super::searches::Searches;
use super::systems::load_cases;
use super::timing::Clock;
use super::{Progress, RunError, Silent, compounds};
use crate::absorber::closed_forms::EngineMode;
use crate::absorber::{Declaration, Mounted, Surroundings};
use crate::input::{AbsorberSpec, OptimiseSpec, ProveSpec, Size, Study};
use crate::objective::{Condition, PeakFinder};
use crate::optimise::checkpoint::remembered;
use crate::optimise::shadow_prices::OnBound;
use crate::optimise::{Effort, LoadCase};
use crate::response::{ResponseError, Work};
use rayon::prelude::*;

/// Finders and modes of a study.
type Engine<'a> = (&'a [PeakFinder<'a>], &'a [Vec<EngineMode>]);

/// Of the optimum of the main size of every type by the first objective; nothing where the study does not ask for it. `study` names all compounds and steps that it chooses from.
///
/// # Errors
/// [`RunError`] where none of the starts of one has a finite response.
pub(super) fn prices(
    study: &Study,
    engine: Engine,
    optima: &[OptimumResult],
    (progress, clock): (&dyn Progress, &mut Clock),
) -> Result<Vec<Price>, RunError> {
    let Some(spec) = study.optimise.as_ref().filter(|s| s.prices) else { return Ok(Vec::new()) };
    let main = optima.iter().filter(|o| o.main && o.objective == 0 && !o.robust && is_first_size(spec, o));
    let asked: Vec<(&OptimumResult, Change)> =
        main.flat_map(|o| changes(study, spec, o, engine.1).into_iter().map(move |c| (o, c))).collect();
    progress.stage("prices", asked.len());
    let one = |(o, change): &(&OptimumResult, Change)| {
        let name = &o.design.name;
        let own = (judged(o), o.limits_hold());
        let sought = || again(study, (o, *change), engine);
        let found = remembered(progress.memory(), &("prices", name, change, own, &o.design.absorbers), sought);
        progress.step();
        let (value, holds, compound) = found.map_err(|error| RunError { what: name.clone(), error })?;
        // what was found with all that is asked is one of the designs without some of it
        let kept = *change != Change::HalfTheRing && own.1 && !(holds && value < own.0);
        let ((changed, changed_holds), compound) = if kept { (own, None) } else { ((value, holds), compound) };
        Ok(Price { design: name.clone(), change: *change, own: own.0, changed, own_holds: own.1, changed_holds, compound })
    };
    let found = asked.par_iter().map(one).collect::<Result<Vec<_>, RunError>>()?;
    if !found.is_empty() {
        clock.lap("prices", Work::default());
    }
    Ok(found)
}

/// What an optimum comes to in all conditions that it is to hold in, and in operation where that differs; infinite where it has no such value.
fn judged(o: &OptimumResult) -> f64 {
    o.design.objective.unwrap_or(f64::INFINITY)
}

/// Whether an optimum is of the first size of each absorber, and not only shown for being the best of several.
fn is_first_size(spec: &OptimiseSpec, o: &OptimumResult) -> bool {
    spec.absorbers.iter().zip(&o.design.absorbers).all(|(a, m)| families::main_ring(a).is_none_or(|j| j == m.absorber.ring_inertia()))
}

/// What is asked of an optimum, one at a time.
fn changes(study: &Study, spec: &OptimiseSpec, o: &OptimumResult, modes: &[Vec<EngineMode>]) -> Vec<Change> {
    let has_others = |c: &Condition| spec.conditions.iter().any(|other| other != c && other.has_absorbers());
    let conditions = spec.conditions.iter().filter(|c| has_others(c)).map(|c| Change::WithoutCondition(*c));
    let limits = (0..study.limits.len()).map(Change::WithoutLimit);
    let bounds = o.on_bounds.iter().filter_map(|b| without_bound(spec, &o.design.absorbers, b, modes));
    let rings = std::iter::once(Change::HalfTheRing);
    conditions.chain(limits).chain(bounds).chain(rings).collect()
}

/// A bound of the study on a parameter, beyond which hartog would look without it.
fn without_bound(spec: &OptimiseSpec, design: &[Mounted], on: &OnBound, modes: &[Vec<EngineMode>]) -> Option<Change> {
    let absorber = &spec.absorbers[on.absorber];
    let kind = design[on.absorber].absorber.declaration()?;
    let parameter = kind.parameters.get(on.parameter).filter(|_| on.parameter > 0)?;
    let of_material = absorber.materials.iter().filter(|m| m.0 == kind).flat_map(|m| &m.1.properties);
    of_material.chain(&absorber.bounds).find(|b| b.0 == parameter.key)?;
    let surroundings = Surroundings { modes: &modes[on.absorber], ring_inertia: largest_ring(absorber) };
    let (low, high) = (parameter.bounds)(&surroundings);
    let (instead, is_farther) = if on.upper { (high, high > on.bound) } else { (low, low < on.bound) };
    is_farther.then_some(Change::WithoutBound { absorber: on.absorber, key: parameter.key, bound: on.bound, instead })
}

fn largest_ring(spec: &AbsorberSpec) -> f64 {
    match &spec.size {
        Size::Between(_, high) => *high,
        Size::Each(list) => list[0],
    }
}

/// The study after a change, of the types of an optimum alone.
fn changed(study: &Study, spec: &OptimiseSpec, design: &[Mounted], change: Change) -> Study {
    let mut own = study.clone();
    // limits are judged in operation: without the last of them the search still looks there
    let in_operation = spec.in_operation || !study.limits.is_empty();
    let prove = ProveSpec { effort: Effort { boxes: 0, ..spec.prove.effort }, all: false, file: false };
    let mut spec = OptimiseSpec { prices: false, in_operation, prove, ..spec.clone() };
    for (absorber, kind) in spec.absorbers.iter_mut().zip(kinds(design)) {
        absorber.types = vec![kind];
        if let Size::Each(list) = &mut absorber.size {
            list.truncate(1);
        }
    }
    match change {
        Change::WithoutCondition(c) => spec.conditions.retain(|own| *own != c),
        Change::WithoutLimit(i) => drop(own.limits.remove(i)),
        Change::WithoutBound { absorber, key, bound, instead } => {
            let own = &mut spec.absorbers[absorber];
            let of_material = own.materials.iter_mut().flat_map(|m| &mut m.1.properties);
            for (_, (low, high)) in of_material.chain(&mut own.bounds).filter(|b| b.0 == key) {
                *(if *high == bound { high } else { low }) = instead;
            }
        }
        Change::HalfTheRing => {
            for absorber in &mut spec.absorbers {
                match &mut absorber.size {
                    Size::Between(low, high) => (*low, *high) = (low.min(0.5 * *high), 0.5 * *high),
                    Size::Each(list) => list.iter_mut().for_each(|j| *j *= 0.5),
                }
            }
        }
    }
    own.optimise = Some(spec);
    (own.robust, own.front, own.combined) = (None, None, None);
    own.more_objectives.clear();
    own
}

/// Types of the absorbers of an optimum, all of which have one.
fn kinds(design: &[Mounted]) -> impl Iterator<Item = &'static Declaration> {
    design.iter().filter_map(|m| m.absorber.declaration())
}

/// The optimum after a change: its value, whether it holds the limits that are left, and its compound or oil where several are named.
fn again(
    study: &Study,
    (o, change): (&OptimumResult, Change),
    (finders, modes): Engine,
) -> Result<(f64, bool, Option<String>), ResponseError> {
    let nothing = (f64::INFINITY, false, None);
    let Some(spec) = &study.optimise else { return Ok(nothing) };
    let other = changed(study, spec, &o.design.absorbers, change);
    let measures = margins::measures(&other);
    let plan = EvaluationPlan::new(&other, &measures);
    let cases: Vec<LoadCase> = plan.held.iter().flat_map(|c| load_cases(*c, finders)).collect();
    let (narrowed, rows) =
        compounds::narrowed(&other, (finders, &cases, modes, &plan), &Silent, &mut Clock::start()).map_err(|e| e.error)?;
    let other = narrowed.as_ref().unwrap_or(&other);
    let searches = Searches::new(other, (finders, &cases), modes, &plan, &Silent);
    let Some(spec) = &other.optimise else { return Ok(nothing) };
    let Some(found) = searches.optimum_from(spec, &o.design.absorbers).map_err(|e| e.error)? else { return Ok(nothing) };
    let compound = rows.iter().find(|r| r.chosen).and_then(|r| r.name.clone());
    Ok((judged(&found), found.limits_hold(), compound))
}
