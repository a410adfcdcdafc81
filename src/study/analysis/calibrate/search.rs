//! Searches from several starts: the sum of squares has several minima where amplitudes bend.

use super::model::{Level, Model};
use super::statistics;
use crate::analysis::{Progress, RunError};
use crate::input::{CalibrateSpec, FreeInput, Study};
use crate::numerics::least_squares::{Fit, Range, fit};
use rayon::prelude::*;

/// First starts between the bounds, besides the values of the engine file: alike in all inputs.
const FIRST: [f64; 2] = [0.5, 0.25];
/// Further starts from the best of them, in standard deviations along the direction that the rows determine least: other minima lie there.
const FURTHER: [f64; 4] = [-12.0, -5.0, 5.0, 12.0];
/// Sums of squares within this share are the same.
const SAME: f64 = 1e-6;

/// The best fit.
pub struct BestFit {
    pub best: Fit,
    /// How often the rows were computed in all searches.
    pub evaluations: u64,
    /// How many searches ended there, of how many.
    pub agreeing: (usize, usize),
}

/// An input as least squares sees it: where its size is small against its bounds, it is searched by its logarithm.
pub fn range(f: &FreeInput) -> Range {
    Range { lower: f.lower, upper: f.upper, scale: f.scale }
}

/// What each input may change by at a point, to compare inputs of different units.
pub(crate) fn sizes(spec: &CalibrateSpec, point: &[f64]) -> Vec<f64> {
    spec.inputs.iter().zip(point).map(|(f, x)| range(f).size(*x)).collect()
}

/// The point `t` times `one` away, where it lies between the bounds.
pub fn inside(spec: &CalibrateSpec, point: &[f64], one: &[f64], t: f64) -> Option<Vec<f64>> {
    let x: Vec<f64> = point.iter().zip(one).map(|(x, d)| x + t * d).collect();
    spec.inputs.iter().zip(&x).all(|(f, x)| (f.lower..=f.upper).contains(x)).then_some(x)
}

/// The point `t` times `one` away, or most of the way to the bound that is met before.
fn towards(spec: &CalibrateSpec, point: &[f64], one: &[f64], t: f64) -> Vec<f64> {
    const MOST: f64 = 0.9;
    let to_bound = spec.inputs.iter().zip(point).zip(one).map(|((f, x), d)| {
        let room = if t * d > 0.0 { f.upper - x } else { x - f.lower };
        if *d == 0.0 { f64::INFINITY } else { MOST * room / d.abs() }
    });
    let reach = to_bound.fold(t.abs(), f64::min) * t.signum();
    point.iter().zip(one).map(|(x, d)| x + reach * d).collect()
}

/// Searches from the engine file and between the bounds, then along the valley of the best.
pub fn search(
    (study, spec): (&Study, &CalibrateSpec),
    level: Option<&Level>,
    measured: &[f64],
    progress: &dyn Progress,
) -> Result<BestFit, RunError> {
    let ranges: Vec<Range> = spec.inputs.iter().map(range).collect();
    let all = |starts: Vec<Vec<f64>>| -> Result<Vec<Fit>, RunError> {
        let one = |start: &Vec<f64>| {
            let mut model = Model::new(study, spec, level);
            let residuals = |x: &[f64]| Ok(model.amplitudes(x)?.iter().zip(measured).map(|(a, b)| a - b).collect());
            let found = fit(residuals, &ranges, start);
            progress.step();
            found
        };
        starts.par_iter().map(one).collect()
    };
    progress.stage("calibration", 1 + FIRST.len() + FURTHER.len());
    let mut starts: Vec<Vec<f64>> = vec![spec.inputs.iter().map(|f| f.start.clamp(f.lower, f.upper)).collect()];
    let between = |share: f64| {
        let value_at = |r: &Range| r.value(r.ends().0 + share * (r.ends().1 - r.ends().0));
        ranges.iter().map(value_at).collect::<Vec<f64>>()
    };
    starts.extend(FIRST.map(between));
    let mut fits = all(starts)?;
    let first = &fits[lowest(&fits)];
    if let Some(one) = statistics::weakest(&first.jacobian, &first.residuals, &sizes(spec, &first.point)) {
        let mut further: Vec<Vec<f64>> = FURTHER.iter().map(|t| towards(spec, &first.point, &one, *t)).collect();
        further.dedup();
        fits.extend(all(further)?);
    }
    let best = fits[lowest(&fits)].clone();
    let agreeing = fits.iter().filter(|f| f.cost() <= best.cost() * (1.0 + SAME)).count();
    Ok(BestFit { evaluations: fits.iter().map(|f| f.evaluations).sum(), agreeing: (agreeing, fits.len()), best })
}

/// Index of the lowest sum of squares; the first of those that are the same, so that rounding between starts changes nothing.
fn lowest(fits: &[Fit]) -> usize {
    (1..fits.len()).fold(0, |m, i| if fits[i].cost() < fits[m].cost() * (1.0 - SAME) { i } else { m })
}
