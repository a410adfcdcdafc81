//! Which compound, which oil, which step of a dimension: each is searched for itself, but those that cannot be best.
//!
//! What cannot be best is known from a short search without limits, and a full one where that comes close: no design of it is better than that finds, as far as searches find the best; so what is then above the best
//! that holds all limits by more than 2 % is left out. The lowest of them comes first.

use super::evaluation_plan::EvaluationPlan;
use super::families::{self, Choice};
use super::results::CompoundResult;
use super::searches::Searches;
use super::timing::Clock;
use super::{Progress, RunError};
use crate::absorber::closed_forms::EngineMode;
use crate::absorber::{Declaration, Substance};
use crate::input::{AbsorberSpec, OptimiseSpec, Study};
use crate::objective::PeakFinder;
use crate::optimise::starts::NamedPoint;
use crate::optimise::{LoadCase, Optimum, Problem, Space, search};
use crate::response::{ResponseError, Work};
use rayon::prelude::*;
use std::sync::Arc;

/// What is above the best by less than this share without limits is searched, too: a search may end at another local optimum, by 0.3 % in the tests.
const CERTAIN: f64 = 0.02;
/// What a short search finds above the best by less than this share is searched in full without limits before it is left out.
const CLOSE: f64 = 0.1;

/// One of the compounds, oils and steps that a type may have.
#[derive(Debug, Clone, Default, PartialEq)]
struct Alternative {
    substance: Option<Arc<Substance>>,
    steps: Vec<(&'static str, f64)>,
}

fn alternatives(spec: &AbsorberSpec, kind: &'static Declaration) -> Vec<Alternative> {
    let choices = spec.materials.iter().find(|m| m.0 == kind).map_or(&[][..], |m| &m.1.choices);
    let mut list: Vec<Alternative> = if choices.is_empty() {
        vec![Alternative::default()]
    } else {
        choices.iter().map(|s| Alternative { substance: Some(s.clone()), steps: Vec::new() }).collect()
    };
    for (key, values) in spec.steps.iter().filter(|s| kind.index(s.0).is_some()) {
        let with = |a: &Alternative| {
            let one = |x: &f64| Alternative { steps: a.steps.iter().copied().chain([(*key, *x)]).collect(), ..a.clone() };
            values.iter().map(one).collect::<Vec<_>>()
        };
        list = list.iter().flat_map(with).collect();
    }
    list
}

/// A family of one type with one alternative of it.
fn with(spec: &AbsorberSpec, kind: &'static Declaration, alternative: &Alternative) -> AbsorberSpec {
    let mut own = spec.clone();
    if let (Some(substance), Some(material)) = (&alternative.substance, own.materials.iter_mut().find(|m| m.0 == kind)) {
        material.1.choices = vec![substance.clone()];
    }
    for (key, values) in &mut own.steps {
        if let Some(step) = alternative.steps.iter().find(|s| s.0 == *key) {
            *values = vec![step.1];
        }
    }
    own
}

/// Whether a study names compounds, oils or steps of dimensions.
#[doc(hidden)]
pub fn are_named(spec: &OptimiseSpec) -> bool {
    spec.absorbers.iter().any(|a| !a.steps.is_empty() || a.materials.iter().any(|m| !m.1.choices.is_empty()))
}

/// How many alternatives a study has to be searched for more than one of a type; none where there is nothing to choose.
#[doc(hidden)]
pub fn asked(spec: &OptimiseSpec) -> usize {
    let [absorber] = spec.absorbers.as_slice() else { return 0 };
    absorber.types.iter().map(|t| alternatives(absorber, t).len()).filter(|n| *n > 1).sum()
}

/// Finders, load cases, modes and what is wanted of a study.
type Engine<'a> = (&'a [PeakFinder<'a>], &'a [LoadCase<'a>], &'a [Vec<EngineMode>], &'a EvaluationPlan<'a>);

/// What the searches of a study share.
struct Of<'a> {
    finders: &'a [PeakFinder<'a>],
    load_cases: &'a [LoadCase<'a>],
    modes: &'a [Vec<EngineMode>],
    wanted: &'a EvaluationPlan<'a>,
    progress: &'a dyn Progress,
}

/// The study with one compound or oil, and one step of each dimension, of every type, and what was found of the others; `None` where there is nothing to choose.
///
/// # Errors
/// [`RunError`] where none of the starts of one has a finite response.
fn chosen(study: &Study, of: &Of, work: &mut Work) -> Result<Option<(OptimiseSpec, Vec<CompoundResult>)>, RunError> {
    let Some(spec) = study.optimise.as_ref().filter(|s| asked(s) > 0) else { return Ok(None) };
    of.progress.stage("compounds and oils", asked(spec));
    let searches = Searches::new(study, (of.finders, of.load_cases), of.modes, of.wanted, of.progress);
    let (mut absorber, mut rows) = (spec.absorbers[0].clone(), Vec::new());
    // a type's own steps and compounds are chosen by its main size
    for kind in &spec.absorbers[0].types {
        let list = alternatives(&spec.absorbers[0], kind);
        if list.len() < 2 {
            continue;
        }
        let (best, found) =
            best_of(&searches, spec, (kind, &list), work).map_err(|error| RunError { what: format!("optimum_{}", kind.name), error })?;
        let own = with(&absorber, kind, &list[best]);
        absorber = AbsorberSpec { types: absorber.types.clone(), ..own };
        rows.extend(found);
    }
    Ok(Some((OptimiseSpec { absorbers: vec![absorber], ..spec.clone() }, rows)))
}

/// The best of the alternatives of a type, and what was found of each.
fn best_of(
    searches: &Searches,
    spec: &OptimiseSpec,
    (kind, list): (&'static Declaration, &[Alternative]),
    work: &mut Work,
) -> Result<(usize, Vec<CompoundResult>), ResponseError> {
    let absorber = &spec.absorbers[0];
    let space = |alternative: &Alternative| {
        let own = OptimiseSpec { absorbers: vec![with(absorber, kind, alternative)], ..spec.clone() };
        let choice = Choice { types: vec![kind], rings: vec![families::main_ring(absorber)] };
        let space = families::family(&own, &choice, searches.modes);
        (searches.starts(&own, &space), space)
    };
    let spaces: Vec<(Vec<NamedPoint>, Space)> = list.par_iter().map(space).collect();
    let step = || searches.progress.step();
    let search = |i: usize, work: &mut Work| {
        let problem = searches.problem(spaces[i].1.clone(), 0);
        let silent = || {};
        let found = search::optimise(&problem, &spaces[i].0, search::Finish::Distinct, &silent)?;
        *work += found.stages.all();
        step();
        Ok::<_, ResponseError>(found)
    };
    let mut rows: Vec<CompoundResult> = list
        .iter()
        .map(|a| CompoundResult {
            kind: kind.name,
            name: a.substance.as_ref().map(|s| s.name.clone()),
            steps: a.steps.clone(),
            value: f64::INFINITY,
            holds: false,
            left_out: false,
            chosen: false,
        })
        .collect();
    let put = |row: &mut CompoundResult, found: &Optimum| (row.value, row.holds) = (found.value(), found.outcome.rows.hold());
    let is_better = |a: &CompoundResult, b: &CompoundResult| (!a.holds, a.value) < (!b.holds, b.value);
    let leaves_out = !searches.limits.is_empty() && !spec.search_all;
    let relaxed = |i: usize| Problem { limits: &[], ..searches.problem(spaces[i].1.clone(), 0) };
    // the lowest of all starts comes first: what others have to be as low as
    let bounds = |of: &[usize], low_enough: f64, work: &mut Work| {
        let found: Vec<(f64, Work)> = of.par_iter().map(|i| search::lowest_nearby(&relaxed(*i), &spaces[*i].0, low_enough)).collect();
        found.iter().for_each(|f| *work += f.1);
        let mut bounded: Vec<(usize, f64)> = of.iter().copied().zip(found.iter().map(|f| f.0)).collect();
        bounded.sort_by(|a, b| a.1.total_cmp(&b.1));
        bounded
    };
    let mut others: Vec<usize> = (0..list.len()).collect();
    if leaves_out {
        others = bounds(&others, f64::INFINITY, work).into_iter().map(|b| b.0).collect();
    }
    let mut best = others.remove(0);
    put(&mut rows[best], &search(best, work)?);
    let low_enough = if rows[best].holds { rows[best].value * (1.0 + CERTAIN) } else { 0.0 };
    let bounded = if leaves_out { bounds(&others, low_enough, work) } else { others.into_iter().map(|i| (i, 0.0)).collect() };
    for (i, mut least) in bounded {
        let above = |share: f64| rows[best].value * (1.0 + share);
        let is_hopeless = rows[best].holds && least > above(CERTAIN);
        if is_hopeless && least < above(CLOSE) {
            let found = search::optimise(&relaxed(i), &spaces[i].0, search::Finish::Distinct, &|| {})?;
            *work += found.stages.all();
            least = found.value();
        }
        if is_hopeless && least > above(CERTAIN) {
            (rows[i].value, rows[i].left_out) = (least, true);
            step();
            continue;
        }
        put(&mut rows[i], &search(i, work)?);
        if is_better(&rows[i], &rows[best]) {
            best = i;
        }
    }
    rows[best].chosen = true;
    Ok((best, rows))
}

/// The study with one of the compounds, oils and steps that it chooses from, and what was found of each; itself where it chooses from nothing.
pub(super) fn narrowed<'a>(
    study: &Study,
    (finders, load_cases, modes, wanted): Engine<'a>,
    progress: &dyn Progress,
    clock: &mut Clock,
) -> Result<(Option<Study>, Vec<CompoundResult>), RunError> {
    let of = Of { finders, load_cases, modes, wanted, progress };
    let mut work = Work::default();
    let Some((spec, rows)) = chosen(study, &of, &mut work)? else { return Ok((None, Vec::new())) };
    clock.lap("compounds", work);
    Ok((Some(Study { optimise: Some(spec), ..study.clone() }), rows))
}
