//! Inputs of an engine fitted to measured or published amplitudes of single orders, by least squares.
//!
//! Residuals are absolute, in the unit of the amplitude: a large peak and a small one are read off a plot with the same error. Every
//! evaluation builds the engine anew from the changed inputs, and so does everything after the fit.

mod model;
mod search;
pub mod statistics;

pub use statistics::Statistics;

use super::{Progress, RunError};
use crate::input::{FreeInput, Input, Study};
use model::{Level, Model};
use search::BestFit;
use std::cell::RefCell;

/// Two inputs with a correlation beyond this cannot be told apart.
pub(crate) const ALIKE: f64 = 0.98;

/// How well a fitted input is known.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub enum Known {
    /// The rows determine it.
    Yes,
    /// It ends on a bound: its standard error says nothing.
    AtBound,
    /// Its standard error is as large as the input itself, or not below the standard deviation of a value that may lie anywhere between the
    /// bounds: the rows say nothing about it.
    NotIdentified,
    /// There are as many inputs as rows: any value could be exact.
    NoFreedom,
}

/// A fitted input.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Calibrated {
    /// Which, its bounds, and its value in the engine file.
    pub free: FreeInput,
    /// Fitted, in the unit of its key.
    pub value: f64,
    /// Of the fitted value, where there are more rows than inputs.
    pub standard_error: Option<f64>,
    /// How well it is known.
    pub known: Known,
}

/// A row of the fit.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct FittedRow {
    /// Index of the published amplitude.
    pub row: usize,
    /// As measured, rad.
    pub published: f64,
    /// With the engine file, rad.
    pub before: f64,
    /// Fitted, rad.
    pub after: f64,
}

/// A finished calibration.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Calibration {
    /// Fitted inputs.
    pub inputs: Vec<Calibrated>,
    /// Held inputs that were chosen by hand.
    pub by_hand: Vec<(Input, f64)>,
    /// Rows fitted.
    pub rows: Vec<FittedRow>,
    /// Errors and correlations.
    pub statistics: Statistics,
    /// How often the rows were computed.
    pub evaluations: u64,
    /// How many starts ended at the best sum of squares, and how many there were.
    pub agreeing: (usize, usize),
}

impl Calibration {
    /// Root mean square of the residuals, rad: before and after.
    pub fn rms(&self) -> (f64, f64) {
        let mean = |of: fn(&FittedRow) -> f64| {
            let sum: f64 = self.rows.iter().map(|r| (of(r) - r.published).powi(2)).sum();
            (sum / self.rows.len() as f64).sqrt()
        };
        (mean(|r| r.before), mean(|r| r.after))
    }

    /// Pairs of inputs that the rows cannot tell apart.
    pub fn alike(&self) -> Vec<(Input, Input, f64)> {
        let mut pairs = Vec::new();
        for (i, a) in self.inputs.iter().enumerate() {
            for (j, b) in self.inputs.iter().enumerate().skip(i + 1) {
                if let Some(r) = self.statistics.correlation[i][j].filter(|r| r.abs() > ALIKE) {
                    pairs.push((a.free.input, b.free.input, r));
                }
            }
        }
        pairs
    }
}

/// Fits what a study calibrates: the study with the fitted inputs, and the account of the fit. A study without `[calibrate]` comes back
/// as it is.
///
/// # Errors
/// [`RunError`] where a design has no finite response with the inputs of the engine file.
pub fn calibrate(study: &Study, progress: &dyn Progress) -> Result<(Study, Option<Calibration>), RunError> {
    let (Some(spec), Some(published)) = (&study.calibrate, &study.published) else { return Ok((study.clone(), None)) };
    let measured: Vec<f64> = spec.rows.iter().filter_map(|r| published.amplitudes[*r].amplitude).collect();
    let level = Level::of(study, spec);
    let before = Model::new(study, spec, level.as_ref()).as_in_the_file()?;
    let BestFit { best, evaluations, agreeing } = search::search((study, spec), level.as_ref(), &measured, progress)?;
    let model = RefCell::new(Model::new(study, spec, level.as_ref()));
    let statistics = statistics::statistics(&best.jacobian, &best.residuals, &search::sizes(spec, &best.point), |one, variance| {
        statistics::stretch(variance, |t| {
            let x = search::inside(spec, &best.point, one, t)?;
            let there = model.borrow_mut().amplitudes(&x).ok()?;
            Some(there.iter().zip(&measured).map(|(a, b)| (a - b).powi(2)).sum::<f64>() - best.cost())
        })
    });
    let inputs: Vec<Calibrated> = spec
        .inputs
        .iter()
        .enumerate()
        .map(|(j, free)| {
            let (value, standard_error) = (best.point[j], statistics.standard_errors[j]);
            Calibrated { free: *free, value, standard_error, known: known(free, value, standard_error) }
        })
        .collect();
    let after = best.residuals.iter().zip(&measured).map(|(r, m)| r + m);
    let rows = spec.rows.iter().zip(&measured).zip(before).zip(after);
    let rows = rows.map(|(((row, published), before), after)| FittedRow { row: *row, published: *published, before, after }).collect();
    let values: Vec<(Input, f64)> = inputs.iter().map(|c| (c.free.input, c.value)).collect();
    let calibration = Calibration { inputs, by_hand: spec.by_hand.clone(), rows, statistics, evaluations, agreeing };
    Ok((study.with_inputs(&values), Some(calibration)))
}

/// On a bound: within this share of the width of the coordinate it is searched in.
const ON_BOUND: f64 = 1e-4;

fn known(free: &FreeInput, value: f64, standard_error: Option<f64>) -> Known {
    let range = search::range(free);
    let ((low, high), at) = (range.ends(), range.coordinate(value));
    match standard_error {
        _ if at - low < ON_BOUND * (high - low) || high - at < ON_BOUND * (high - low) => Known::AtBound,
        None => Known::NoFreedom,
        Some(e) if e.is_nan() || e >= (free.upper - free.lower) / 12f64.sqrt() || e >= range.size(value) => Known::NotIdentified,
        _ => Known::Yes,
    }
}
