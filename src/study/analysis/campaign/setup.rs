//! The searches of a study with nothing of what a run tells beside them.

use crate::analysis::evaluation_plan::EvaluationPlan;
use crate::analysis::run::{grid, methods, modes};
use crate::analysis::searches::Searches;
use crate::analysis::systems::{finders, load_cases, systems};
use crate::analysis::tables_for_searches::with_tables;
use crate::analysis::timing::Clock;
use crate::analysis::{RunError, Silent, calibrate, compounds, crank_models, duty, margins};
use crate::input::{MeasureSpec, Study};
use crate::objective::PeakFinder;
use crate::objective::surrogate::Surrogate;
use crate::optimise::LoadCase;
use crate::response::Method;

/// Every speed is looked at where tables tell peaks: a coarser look misses some, which no estimate of its error tells.
const STRIDE: usize = 4;

/// A finder that may tell the peaks of objectives by tables, with errors of at most a share.
fn with_tolerance<'a>(study: &Study, finder: PeakFinder<'a>, tolerance: f64) -> PeakFinder<'a> {
    let Method::Receptance(r) = finder.method else { return finder };
    let surrogate = |finder: PeakFinder<'a>, o: &MeasureSpec| {
        let surrogate = Surrogate::of(r, &o.measure, finder.margin, STRIDE);
        finder.with_surrogate(surrogate, tolerance)
    };
    study.objectives().fold(finder, surrogate)
}

/// Asks the searches of a study, with its calibrated inputs, the model of the crank that it chooses, and its compounds and steps chosen. `tolerance`: of the values of objectives, where tables may tell them.
///
/// # Errors
/// [`RunError`] where a design has no finite response, or asking fails.
pub(super) fn with_searches<T>(
    study: &Study,
    tolerance: Option<f64>,
    ask: impl FnOnce(&Searches) -> Result<T, RunError>,
) -> Result<T, RunError> {
    let (mut study, _) = calibrate(study, &Silent)?;
    crank_models::choose(&mut study)?;
    let (study, mut clock) = (&study, Clock::start());
    let systems = systems(study, study.excitation(), &Silent);
    let grid = grid(study, &systems[0]);
    let methods: Vec<Method> = methods(study, &systems, &grid, &Silent, &mut clock);
    let margin = margins::model(study, &systems[0].excitation.harmonics, &grid);
    let duty_points = duty::points(study);
    let finders = finders(study, (&systems, &methods), &grid, (margin.as_ref(), &duty_points));
    let modes = modes(study, &systems[0]);
    let (_, finders) = with_tables(study, &modes, finders, &Silent, &mut clock);
    let finders: Vec<PeakFinder> = match tolerance {
        Some(tolerance) => finders.into_iter().map(|finder| with_tolerance(study, finder, tolerance)).collect(),
        None => finders,
    };
    let measures = margins::measures(study);
    let wanted = EvaluationPlan::new(study, &measures);
    let load_cases: Vec<LoadCase> = wanted.held.iter().flat_map(|c| load_cases(*c, &finders)).collect();
    let (narrowed, _) = compounds::narrowed(study, (&finders, &load_cases, &modes, &wanted), &Silent, &mut clock)?;
    let study = narrowed.as_ref().unwrap_or(study);
    ask(&Searches::new(study, (&finders, &load_cases), &modes, &wanted, &Silent))
}
