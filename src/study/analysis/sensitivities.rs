//! How measures of an optimum change with its parameters, and how far these may drift.

use crate::absorber::{Absorber, Mounted};
use crate::input::{LimitSpec, MeasureSpec};
use crate::objective::{Condition, Measure, holds};
use crate::optimise::{LoadCase, largest as largest_of};
use crate::response::{ResponseError, Work};
use rayon::prelude::*;

/// A measure by a parameter.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Sensitivity {
    /// Key of the measure.
    #[serde(skip)]
    pub key: &'static str,
    /// What of the system it is of.
    pub place: String,
    /// Whether it is a limit of the study.
    pub limited: bool,
    /// Index of the absorber.
    pub absorber: usize,
    /// Index of the parameter in its declaration.
    pub parameter: usize,
    /// Relative change of the measure for a relative increase of the parameter.
    pub more: f64,
    /// The same for a decrease: not its opposite where several peaks are level.
    pub less: f64,
    /// Relative increase and decrease of the parameter at which the limit breaks first; nothing where it holds up to a half.
    pub drift: (Option<f64>, Option<f64>),
}

/// Peaks that differ by less than this share are level.
const LEVEL: f64 = 1e-6;

/// Each measure, then each limit, by each parameter of a design: the steepest of the level peaks of all load cases, by their exact gradients; where it is largest in operation, or level with what it is at the reference, by differences of what is largest. `judged`: load cases in which
/// limits are to hold, in operation among them.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance.
pub(crate) fn sensitivities(
    (load_cases, judged): (&[LoadCase], &[LoadCase]),
    design: &[Mounted],
    measures: &[&MeasureSpec],
    limits: &[LimitSpec],
) -> Result<Vec<Sensitivity>, ResponseError> {
    let of: Vec<(&MeasureSpec, Option<f64>)> =
        measures.iter().map(|m| (*m, None)).chain(limits.iter().map(|l| (&l.of, Some(l.limit)))).collect();
    // the first error in this order, whichever comes first in time
    let each: Vec<Result<Vec<Sensitivity>, ResponseError>> =
        of.into_par_iter().map(|(spec, limit)| of_measure((load_cases, judged), design, spec, limit)).collect();
    Ok(each.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect())
}

/// One measure by each parameter.
fn of_measure(
    (load_cases, judged): (&[LoadCase], &[LoadCase]),
    design: &[Mounted],
    spec: &MeasureSpec,
    limit: Option<f64>,
) -> Result<Vec<Sensitivity>, ResponseError> {
    let mut level: Vec<(f64, Vec<Vec<f64>>)> = Vec::new();
    for case in load_cases {
        let mounted = case.absorbers(design)?;
        let mut work = Work::default();
        for peak in case.finder.peaks(&mounted, &spec.measure, 1.0 - LEVEL, &mut work)? {
            let gradient = |i: usize| case.finder.gradient(&mounted, i, &spec.measure, &peak, &mut Work::default());
            level.push((peak.value, (0..mounted.len()).map(gradient).collect::<Result<_, _>>()?));
        }
    }
    let largest = level.iter().map(|l| l.0).fold(0.0, f64::max);
    level.retain(|l| l.0 >= largest * (1.0 - LEVEL) && l.0 > 0.0);
    let parameters = |(absorber, m): (usize, &Mounted)| {
        let values = m.absorber.law().map_or_else(Vec::new, |law| law.values());
        values.into_iter().enumerate().map(move |(parameter, value)| (absorber, parameter, value))
    };
    let in_operation = || judged.iter().filter(|case| case.condition == Condition::InOperation);
    let own = largest_of(in_operation(), design, &spec.measure, &mut Work::default())?;
    let follows = own > 0.0 && own >= largest * (1.0 - LEVEL);
    // in operation the state of the material follows, of which a gradient knows nothing
    let by_differences = |(absorber, parameter): (usize, usize)| {
        let rise = |sign: f64| {
            let moved = moved(design, (absorber, parameter), sign * DIFFERENCE)?;
            let there = largest_of(judged.iter(), &moved, &spec.measure, &mut Work::default()).ok()?;
            Some((there / own.max(largest) - 1.0) / DIFFERENCE)
        };
        Some((rise(1.0)?, rise(-1.0)?))
    };
    let all: Vec<(usize, usize, f64)> = design.iter().enumerate().flat_map(parameters).collect();
    let by = |(absorber, parameter, value): (usize, usize, f64)| {
        let relative = |l: &(f64, Vec<Vec<f64>>)| l.1.get(absorber).and_then(|g| g.get(parameter)).map_or(0.0, |g| g * value / l.0);
        let rises: Vec<f64> = level.iter().map(relative).collect();
        let steepest = || rises.iter().fold((f64::NEG_INFINITY, f64::NEG_INFINITY), |m, r| (m.0.max(*r), m.1.max(-*r)));
        let (more, less) = if follows { by_differences((absorber, parameter))? } else { steepest() };
        if !(more.is_finite() && less.is_finite()) {
            return None;
        }
        let drift = |sign: f64| limit.and_then(|l| breaks(judged, design, (&spec.measure, l), (absorber, parameter), sign));
        // of a margin or a life it is the inverse that rises
        let sign = if spec.unit.is_inverse() { -1.0 } else { 1.0 };
        Some(Sensitivity {
            key: spec.key,
            place: spec.place.clone(),
            limited: limit.is_some(),
            absorber,
            parameter,
            more: sign * more,
            less: sign * less,
            drift: rayon::join(|| drift(1.0), || drift(-1.0)),
        })
    };
    Ok(all.into_par_iter().filter_map(by).collect())
}

/// Relative step of differences in operation: balances agree to 1e-9 and better.
const DIFFERENCE: f64 = 1e-3;

/// A design with one parameter changed by a share, as far as its range lets it; `None` where it is no ring with a law.
fn moved(design: &[Mounted], (absorber, parameter): (usize, usize), change: f64) -> Option<Vec<Mounted>> {
    let (declaration, law) = design[absorber].absorber.declaration().zip(design[absorber].absorber.law())?;
    let mut values = law.values();
    values[parameter] = declaration.parameters[parameter].range.nearest(values[parameter] * (1.0 + change));
    let mut moved = design.to_vec();
    moved[absorber].absorber = Absorber::Ring(law.rebuilt(&values));
    Some(moved)
}

/// Steps of a parameter at which a limit is looked at, growing: the largest relative change is a half.
const STEPS: [f64; 9] = [0.005, 0.01, 0.02, 0.04, 0.08, 0.15, 0.25, 0.35, 0.5];
/// Halvings between the last step that holds and the first that does not.
const HALVINGS: usize = 12;

/// Relative change of a parameter, upwards or downwards, at which a limit breaks first, as far as the steps see.
fn breaks(
    load_cases: &[LoadCase],
    design: &[Mounted],
    (measure, limit): (&Measure, f64),
    (absorber, parameter): (usize, usize),
    sign: f64,
) -> Option<f64> {
    design[absorber].absorber.law()?;
    let broken = |change: f64| {
        let Some(moved) = moved(design, (absorber, parameter), sign * change) else { return false };
        // what has no finite response holds no limit
        load_cases
            .iter()
            .filter(|case| case.differs_in(measure))
            .any(|case| case.peak_above(&moved, measure, limit, &mut Work::default()).map_or(true, |value| !holds(value / limit)))
    };
    let mut below = 0.0;
    for step in STEPS {
        if !broken(step) {
            below = step;
            continue;
        }
        let mut above = step;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (below + above);
            if broken(middle) {
                above = middle;
            } else {
                below = middle;
            }
        }
        return Some(below);
    }
    None
}
