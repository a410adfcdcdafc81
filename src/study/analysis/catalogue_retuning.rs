//! The best absorbers of catalogues, tuned anew in what their maker can vary.

use super::catalogue::Best;
use super::search_in_operation::{is_worse_in_operation, search_in_operation};
use super::{Progress, RunError};
use crate::absorber::{Material, Mounted};
use crate::input::{CatalogueSpec, DesignSpec, LimitSpec, RETUNED, Study};
use crate::objective::{Condition, PeakFinder};
use crate::optimise::search::{self, Finish};
use crate::optimise::{LoadCase, Problem, Slot, Space, Variable};
use crate::response::ResponseError;
use rayon::prelude::*;
use std::sync::Arc;

/// Of the random starts in operation where a study has no `seed`.
const SEED: u64 = 1;
/// Where a coordinate turns from linear to logarithmic, as a share of the catalogue's value.
const SCALE: f64 = 1e-3;

/// The best of each catalogue, each followed by the same tuned anew by the study's first objective within its limits, where the catalogue says what is free.
///
/// # Errors
/// [`RunError`] where nothing damps a resonance of what is tuned.
pub(crate) fn with_retuned(
    study: &Study,
    best: Best,
    (finders, load_cases): (&[PeakFinder], &[LoadCase]),
    progress: &dyn Progress,
) -> Result<Vec<DesignSpec>, RunError> {
    let count = best.iter().filter(|(c, _)| !study.catalogues[*c].free.is_empty()).count();
    if count > 0 {
        progress.stage("catalogue, tuned anew", count);
    }
    let both = |(catalogue, design): (usize, DesignSpec)| -> Result<Vec<DesignSpec>, RunError> {
        let Some(space) = space(&study.catalogues[catalogue], &design) else { return Ok(vec![design]) };
        let found = tuned(study, space, (finders, load_cases))
            .map_err(|error| RunError { what: format!("design `{}{RETUNED}`", design.name), error })?;
        progress.step();
        let retuned = DesignSpec { name: format!("{}{RETUNED}", design.name), absorbers: found };
        Ok(vec![design, retuned])
    };
    let lists = best.into_par_iter().map(both).collect::<Result<Vec<_>, _>>()?;
    Ok(lists.into_iter().flatten().collect())
}

/// The family of an absorber: each free parameter between its value less its share and more; nothing where it has none.
fn space(catalogue: &CatalogueSpec, design: &DesignSpec) -> Option<Space> {
    let [mounted] = design.absorbers.as_slice() else { return None };
    let (law, declaration) = (mounted.absorber.law()?, mounted.absorber.declaration()?);
    let values = law.values();
    let variable = |(key, share): &(&'static str, f64)| {
        let parameter = declaration.index(key)?;
        let (x, range) = (values[parameter], declaration.parameters[parameter].range);
        let (lower, upper) = (range.nearest(x * (1.0 - share)), range.nearest(x * (1.0 + share)));
        (lower < upper).then_some(Variable { absorber: 0, parameter, lower, upper, scale: SCALE * x })
    };
    let variables: Vec<Variable> = catalogue.free.iter().filter_map(variable).collect();
    let material = Arc::new(law.material().cloned().unwrap_or_else(Material::default));
    let slot = Slot { declaration, on: mounted.on, hub_inertia: mounted.hub_inertia, values: values.clone(), material };
    (!variables.is_empty()).then(|| Space { slots: vec![slot], variables })
}

/// The best design of a family, searched from the catalogue's own and from the ends of what is free; in operation, too, where that is worse: so it is ranked.
fn tuned(study: &Study, space: Space, (finders, load_cases): (&[PeakFinder], &[LoadCase])) -> Result<Vec<Mounted>, ResponseError> {
    let own = space.point(&[space.slots[0].values.clone()]);
    let end = |of: fn(&(f64, f64)) -> f64| space.bounds().iter().map(of).collect::<Vec<f64>>();
    let starts = [("as sold", own), ("least", end(|b| b.0)), ("most", end(|b| b.1))].map(|(name, point)| (name.to_owned(), point));
    let objectives = [study.objective.measure.in_si()];
    let limits: Vec<_> = study.limits.iter().map(LimitSpec::to_limit).collect();
    let problem = Problem { load_cases, space, objectives: &objectives, weights: &[], limits: &limits, memory: None };
    let found = search::optimise(&problem, &starts, Finish::Distinct, &|| {})?;
    let mut cases = load_cases.to_vec();
    cases.push(LoadCase::new(Condition::InOperation, &finders[0]));
    let both = Problem { load_cases: &cases, space: problem.space.clone(), ..problem };
    let seed = study.optimise.as_ref().map_or(SEED, |o| o.seed);
    let found = if is_worse_in_operation(&both, &found)? { search_in_operation(&both, &found, seed, &|| {})? } else { found };
    Ok(found.design)
}
