//! How measures of an optimum change with its parameters, and how far these may drift.

use crate::absorber::Mounted;
use crate::input::{LimitSpec, MeasureSpec, UnitOf};
use crate::optimise::LoadCase;
use crate::response::{ResponseError, Work};

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
    /// Relative increase and decrease of the parameter, to first order, at which the limit breaks; nothing where it does not.
    pub drift: (Option<f64>, Option<f64>),
}

/// Peaks that differ by less than this share are level.
const LEVEL: f64 = 1e-6;

/// Each measure, then each limit, by each parameter of a design: the steepest of the level peaks of all load cases, by their exact gradients.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance.
pub(crate) fn sensitivities(
    load_cases: &[LoadCase],
    design: &[Mounted],
    measures: &[&MeasureSpec],
    limits: &[LimitSpec],
) -> Result<Vec<Sensitivity>, ResponseError> {
    let mut list = Vec::new();
    let of = measures.iter().map(|m| (*m, None)).chain(limits.iter().map(|l| (&l.of, Some(l.limit))));
    for (spec, limit) in of {
        let mut level: Vec<(f64, Vec<Vec<f64>>)> = Vec::new();
        for case in load_cases {
            let mounted = case.condition.absorbers(design);
            let mut work = Work::default();
            for peak in case.finder.peaks(&mounted, &spec.measure, 1.0 - LEVEL, &mut work)? {
                let gradient = |i: usize| case.finder.gradient(&mounted, i, &spec.measure, &peak, &mut Work::default());
                level.push((peak.value, (0..mounted.len()).map(gradient).collect::<Result<_, _>>()?));
            }
        }
        let largest = level.iter().map(|l| l.0).fold(0.0, f64::max);
        level.retain(|l| l.0 >= largest * (1.0 - LEVEL) && l.0 > 0.0);
        for (absorber, mounted) in design.iter().enumerate() {
            let Some(law) = mounted.absorber.law() else { continue };
            for (parameter, value) in law.values().iter().enumerate() {
                let relative = |l: &(f64, Vec<Vec<f64>>)| l.1.get(absorber).and_then(|g| g.get(parameter)).map_or(0.0, |g| g * value / l.0);
                let rises: Vec<f64> = level.iter().map(relative).collect();
                let (more, less) = rises.iter().fold((f64::NEG_INFINITY, f64::NEG_INFINITY), |m, r| (m.0.max(*r), m.1.max(-*r)));
                if !(more.is_finite() && less.is_finite()) {
                    continue;
                }
                let room = limit.map(|l| (l / largest - 1.0).max(0.0));
                let drift = |rise: f64| room.filter(|_| rise > 0.0).map(|room| room / rise);
                // of a margin it is the inverse that rises
                let sign = if spec.unit == UnitOf::Margin { -1.0 } else { 1.0 };
                list.push(Sensitivity {
                    key: spec.key,
                    place: spec.place.clone(),
                    limited: limit.is_some(),
                    absorber,
                    parameter,
                    more: sign * more,
                    less: sign * less,
                    drift: (drift(more), drift(less).filter(|d| *d < 1.0)),
                });
            }
        }
    }
    Ok(list)
}
