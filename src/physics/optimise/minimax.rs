//! Sequential quadratic minimax: the largest of several smooth peaks, minimised in a trust region.
//!
//! Each step solves a quadratic model of all peaks that could become the largest (their exact values and gradients, and one matrix for the
//! curvature of the Lagrangian), then measures the true peaks. Without curvature the method stalls wherever fewer peaks are level than
//! there are variables: Den Hartog's problem has two level peaks and two variables, and its optimum is not a vertex of the linear model.

use super::curvature::{lagrangian, same_peak, update};
use super::problem::ROW_SHARE;
use super::subproblem::{Line, Step, solve};
use super::termination::{DECREASE, Stop, Verdict, Weight};
use super::{Problem, Row, Rows};
use crate::response::{ResponseError, Work};
use nalgebra::{DMatrix, DVector};

/// Where the iteration ended.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
pub struct Outcome {
    /// Coordinates.
    pub point: Vec<f64>,
    /// The rows there.
    pub rows: Rows,
    /// Of each row, as shares of the objective per share of the row: those of an objective sum to its weight; one per cent more of a limit brings as many per cent.
    pub multipliers: Vec<f64>,
    /// Of the lower and upper bound of each coordinate: share of the objective per unit of the coordinate.
    pub bounds: Vec<[f64; 2]>,
    /// Length of the steepest-descent step of the linear model with unit curvature, in coordinates and units of the objective: zero
    /// exactly where the first-order conditions of Karush, Kuhn and Tucker hold.
    pub kkt_residual: f64,
    /// Steps tried.
    pub iterations: usize,
    /// Why it ended.
    pub stop: Stop,
    /// The model's curvature of the Lagrangian there, in coordinates and units of the objective: what a problem nearby may begin with.
    #[serde(skip, default = "none_known")]
    pub curvature: DMatrix<f64>,
}

impl Outcome {
    /// A design that no step was made from: nothing is said of its first-order conditions.
    pub(super) fn unmoved(point: &[f64], rows: Rows) -> Self {
        let (n, multipliers) = (point.len(), vec![0.0; rows.rows.len()]);
        let bounds = vec![[0.0; 2]; n];
        let curvature = first_curvature(point);
        Self {
            point: point.to_vec(),
            rows,
            multipliers,
            bounds,
            kkt_residual: f64::INFINITY,
            iterations: 0,
            stop: Stop::NoModel,
            curvature,
        }
    }

    /// Whether it is an optimum that others may be held against.
    pub(super) fn is_certain(&self) -> bool {
        self.rows.hold() && self.kkt_residual < WELL_MET
    }

    /// Whether its first-order conditions are met.
    #[doc(hidden)]
    pub fn meets_first_order(&self) -> bool {
        self.kkt_residual < MET
    }

    /// What outcomes are compared by: a limit that fails counts before the objective.
    pub(super) fn merit(&self) -> (f64, f64) {
        (if self.rows.hold() { 0.0 } else { self.rows.excess() }, self.rows.objective())
    }
}

/// First-order conditions are met below this residual.
const MET: f64 = 1e-6;
/// First-order residual of an optimum that others are held against.
const WELL_MET: f64 = 1e-8;
const MOST_ITERATIONS: usize = 80;
const FIRST_REACH: f64 = 0.3;
const LARGEST_REACH: f64 = 2.0;
/// Relative change of a peak over that of a coordinate, at most, and the largest share that rows are asked with.
const LIFT: f64 = 2.0;
const NEAREST: f64 = 0.97;
const SMALLEST_REACH: f64 = 1e-10;
/// Of a design that misses a limit, of which nobody needs that many digits.
const SMALLEST_REACH_MISSED: f64 = 1e-6;
/// First-order residual that optima are polished to (of one absorber where it is above the second number), and most steps of that.
const CERTIFIED: f64 = 1e-9;
const CERTIFIED_ALONE: f64 = 1e-8;
const MOST_POLISHING: usize = 12;
/// An optimum is reached where no coordinate differs by more than this, nor the objective by more than these shares below and above.
const ARRIVED: (f64, [f64; 2]) = (1e-4, [1e-9, 1e-7]);

/// Rows in units of the largest objective.
pub(super) fn lines(rows: &Rows, unit: f64) -> Vec<Line> {
    let line = |r: &Row| {
        let scale = if r.role.is_limit() { 1.0 } else { 1.0 / unit };
        Line { objective: rows.term(r.role), value: r.value * scale, gradient: r.gradient.iter().map(|g| g * scale).collect() }
    };
    rows.rows.iter().map(line).collect()
}

fn merit(rows: &Rows, unit: f64, penalty: f64) -> f64 {
    rows.objective() / unit + penalty * rows.excess()
}

/// How far each coordinate may move: the trust region within the bounds.
fn reach(point: &[f64], bounds: &[(f64, f64)], radius: f64) -> Vec<(f64, f64)> {
    point.iter().zip(bounds).map(|(w, (low, high))| ((low - w).max(-radius).min(0.0), (high - w).min(radius).max(0.0))).collect()
}

/// A coordinate closer to a bound than an interior-point method resolves is on it: stiffness and damping become exactly zero.
fn snapped(w: f64, (low, high): (f64, f64)) -> f64 {
    const NEAR: f64 = 1e-6;
    if w - low < NEAR {
        low
    } else if high - w < NEAR {
        high
    } else {
        w
    }
}

/// First-order conditions at a point: the step of the model with unit curvature and no trust region, and its multipliers.
struct FirstOrder {
    residual: f64,
    multipliers: Vec<f64>,
    bounds: Vec<[f64; 2]>,
}

fn first_order(rows: &Rows, point: &[f64], bounds: &[(f64, f64)], penalty: f64) -> FirstOrder {
    let n = point.len();
    let unknown = || FirstOrder { residual: f64::INFINITY, multipliers: vec![0.0; rows.rows.len()], bounds: vec![[0.0; 2]; n] };
    if n == 0 {
        return FirstOrder { residual: 0.0, ..unknown() };
    }
    let step = solve(&lines(rows, rows.objective()), rows.weights(), &DMatrix::identity(n, n), &reach(point, bounds, 1.0), penalty);
    step.map_or_else(unknown, |s| FirstOrder {
        residual: DVector::from_column_slice(&s.change).norm(),
        multipliers: s.multipliers,
        bounds: s.bounds,
    })
}

/// The curvature of an outcome that was read: it is told apart.
fn none_known() -> DMatrix<f64> {
    DMatrix::zeros(0, 0)
}

/// Minimises from `start`.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance at the start.
pub fn minimise(problem: &Problem, start: &[f64], work: &mut Work) -> Result<Outcome, ResponseError> {
    minimise_with(problem, start, first_curvature(start), work)
}

/// Curvature to begin with where none is known.
fn first_curvature(start: &[f64]) -> DMatrix<f64> {
    DMatrix::identity(start.len(), start.len()) * 0.1
}

/// The same, beginning with a curvature: that of a problem nearby.
///
/// # Errors
/// As [`minimise`].
pub(crate) fn minimise_with(problem: &Problem, start: &[f64], curvature: DMatrix<f64>, work: &mut Work) -> Result<Outcome, ResponseError> {
    minimise_knowing(problem, start, (curvature, None), work)
}

/// The same from a start that may lead to a `known` optimum: once it is there, that is the outcome.
///
/// # Errors
/// As [`minimise`].
pub(super) fn minimise_towards(problem: &Problem, start: &[f64], known: &Outcome, work: &mut Work) -> Result<Outcome, ResponseError> {
    minimise_knowing(problem, start, (first_curvature(start), Some(known).filter(|k| k.is_certain())), work)
}

fn minimise_knowing(
    problem: &Problem,
    start: &[f64],
    (curvature, known): (DMatrix<f64>, Option<&Outcome>),
    work: &mut Work,
) -> Result<Outcome, ResponseError> {
    let n = start.len();
    let parts = |outcome: &Outcome| (outcome.clone(), outcome.curvature.as_slice().to_vec());
    let joined = |(outcome, curvature): (Outcome, Vec<f64>)| Outcome { curvature: DMatrix::from_vec(n, n, curvature), ..outcome };
    let own = ("minimax", start.to_vec(), curvature.as_slice().to_vec(), known.map(|k| &k.point));
    let run = |work: &mut Work| from(problem, start, (curvature, known), work).map(|outcome| parts(&outcome));
    let found = problem.remembered(&own, work, run).map(joined)?;
    problem.tell(&found.point, &found.rows);
    Ok(found)
}

/// What cannot be lifted to the top within a reach is left out: a relative change is hardly larger than the step.
fn share(reach: f64) -> f64 {
    (1.0 - LIFT * reach).clamp(ROW_SHARE, NEAREST)
}

/// A point with what its next step depends on.
struct At<'p> {
    problem: &'p Problem<'p>,
    bounds: &'p [(f64, f64)],
    point: &'p [f64],
    rows: &'p Rows,
    unit: f64,
    penalty: f64,
    radius: f64,
}

impl At<'_> {
    fn step(&self, model: &[Line], hessian: &DMatrix<f64>) -> Option<Step> {
        solve(model, self.rows.weights(), hessian, &reach(self.point, self.bounds, self.radius), self.penalty)
    }

    /// Where a step leads, or its second-order correction where that is better, and the decrease as a share of what was promised.
    fn tried(
        &self,
        (model, hessian): (&[Line], &DMatrix<f64>),
        step: &Step,
        promised: f64,
        work: &mut Work,
    ) -> (Vec<f64>, Result<Rows, ResponseError>, f64) {
        let length = step.change.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
        let here = merit(self.rows, self.unit, self.penalty);
        let mut to = |change: &[f64]| {
            let moved = self.point.iter().zip(change).zip(self.bounds);
            let point: Vec<f64> = moved.map(|((w, d), b)| snapped(w + d, *b)).collect();
            let there = self.problem.rows_near(&point, share(2.0 * length), work);
            let decrease = there.as_ref().map_or(f64::NEG_INFINITY, |r| here - merit(r, self.unit, self.penalty));
            (point, there, decrease / promised)
        };
        let first = to(&step.change);
        if first.2 < 0.25
            && let Ok(trial) = &first.1
            && let Some(corrected) = corrected(self.rows, trial, model, step, self.unit)
            && let Some(second) = self.step(&corrected, hessian)
        {
            // the same model through the values measured at the trial point
            let second = to(&second.change);
            return if second.2 > first.2 { second } else { first };
        }
        first
    }
}

/// Whether a point is that of an optimum but for what the next steps would add, and as good.
fn is_at(known: &Outcome, point: &[f64], rows: &Rows) -> bool {
    let near = point.iter().zip(&known.point).all(|(a, b)| (a - b).abs() < ARRIVED.0);
    let ([below, above], ratio) = (ARRIVED.1, rows.objective() / known.rows.objective());
    near && rows.hold() && (1.0 - below..=1.0 + above).contains(&ratio)
}

fn from(
    problem: &Problem,
    start: &[f64],
    (curvature, known): (DMatrix<f64>, Option<&Outcome>),
    work: &mut Work,
) -> Result<Outcome, ResponseError> {
    let bounds = problem.space.bounds();
    let n = start.len();
    let mut point = start.to_vec();
    let mut hessian = curvature;
    let mut radius = FIRST_REACH;
    let mut rows = problem.rows_near(&point, share(radius), work)?;
    let mut iterations = 0;
    let mut weight = Weight::first();
    let stop = loop {
        let unit = rows.objective();
        if n == 0 || unit == 0.0 {
            break Stop::NothingFree;
        }
        if iterations == MOST_ITERATIONS {
            break Stop::Iterations;
        }
        if radius < if rows.hold() { SMALLEST_REACH } else { SMALLEST_REACH_MISSED } {
            break Stop::SmallSteps;
        }
        iterations += 1;
        let at = At { problem, bounds: &bounds, point: &point, rows: &rows, unit, penalty: weight.now, radius };
        let model = lines(&rows, unit);
        let Some(step) = at.step(&model, &hessian) else { break Stop::NoModel };
        let here = merit(&rows, unit, weight.now);
        let promised = here - step.model;
        match weight.verdict(&rows, here, promised) {
            Verdict::Try => {}
            Verdict::Heavier => {
                radius = FIRST_REACH;
                continue;
            }
            Verdict::Stop(stop) => break stop,
        }
        let (to, there, ratio) = at.tried((&model, &hessian), &step, promised, work);
        let change = DVector::from_iterator(n, to.iter().zip(&point).map(|(a, b)| a - b));
        let length = change.amax();
        if let Ok(there) = &there
            && let (Some(new), Some(old)) =
                (lagrangian(&rows, &step.multipliers, there, unit), lagrangian(&rows, &step.multipliers, &rows, unit))
        {
            update(&mut hessian, &change, &(new - old));
        }
        if ratio < 0.25 {
            radius = 0.4 * length.min(radius);
        } else if ratio > 0.75 && length > 0.9 * radius {
            radius = (2.0 * radius).min(LARGEST_REACH);
        }
        if ratio > 0.01
            && let Ok(there) = there
        {
            point = to;
            rows = there;
            if let Some(known) = known.filter(|k| is_at(k, &point, &rows)) {
                return Ok(known.clone());
            }
        }
    };
    let penalty = weight.now;
    let FirstOrder { residual, multipliers, bounds } = first_order(&rows, &point, &bounds, penalty);
    let found = Outcome { point, rows, multipliers, bounds, kkt_residual: residual, iterations, stop, curvature: hessian };
    // a design that misses a limit is no optimum
    let wanted = found.rows.hold() && (problem.space.slots.len() > 1 || residual > CERTIFIED_ALONE);
    // a neighbour is handed the curvature of the search: steps of polishing are as small as rounding
    let curvature = found.curvature.clone();
    Ok(if wanted { Outcome { curvature, ..polished(problem, found, penalty, work) } } else { found })
}

/// Further steps of the same model where decreases are already lost in rounding, kept while they lower the first-order residual and raise nothing: valleys of
/// several absorbers, and of some laws, are so flat that a decrease of 1e-12 still leaves their parameters uncertain in the seventh digit. A step that lowers nothing tells the model of the curvature.
fn polished(problem: &Problem, mut best: Outcome, penalty: f64, work: &mut Work) -> Outcome {
    let bounds = problem.space.bounds();
    for _ in 0..MOST_POLISHING {
        let unit = best.rows.objective();
        let done = best.kkt_residual < CERTIFIED || unit == 0.0;
        let model = (!done)
            .then(|| {
                solve(&lines(&best.rows, unit), best.rows.weights(), &best.curvature, &reach(&best.point, &bounds, FIRST_REACH), penalty)
            })
            .flatten();
        let Some(step) = model else { break };
        let moved = best.point.iter().zip(&step.change).zip(&bounds);
        let point: Vec<f64> = moved.map(|((w, d), b)| snapped(w + d, *b)).collect();
        let Ok(rows) = problem.rows(&point, work) else { break };
        let FirstOrder { residual, multipliers, bounds } = first_order(&rows, &point, &bounds, penalty);
        let rise = merit(&rows, unit, penalty) - merit(&best.rows, unit, penalty);
        let mut curvature = best.curvature.clone();
        if let (Some(new), Some(old)) =
            (lagrangian(&best.rows, &step.multipliers, &rows, unit), lagrangian(&best.rows, &step.multipliers, &best.rows, unit))
        {
            let change = DVector::from_iterator(point.len(), point.iter().zip(&best.point).map(|(a, b)| a - b));
            update(&mut curvature, &change, &(new - old));
        }
        if residual >= best.kkt_residual || rise > DECREASE {
            // the step has told of a curvature that the model did not know
            best.curvature = curvature;
            continue;
        }
        best = Outcome { point, rows, multipliers, bounds, kkt_residual: residual, iterations: best.iterations + 1, curvature, ..best };
    }
    best
}

/// Lines whose constants make the model exact at the trial point; `None` where an important peak has gone.
fn corrected(rows: &Rows, trial: &Rows, model: &[Line], step: &Step, unit: f64) -> Option<Vec<Line>> {
    rows.rows
        .iter()
        .zip(model)
        .zip(&step.multipliers)
        .map(|((row, line), multiplier)| {
            let Some(measured) = same_peak(row, trial) else { return if *multiplier > 1e-6 { None } else { Some(line.clone()) } };
            let scale = if row.role.is_limit() { 1.0 } else { 1.0 / unit };
            let along: f64 = line.gradient.iter().zip(&step.change).map(|(g, d)| g * d).sum();
            Some(Line { value: measured.value * scale - along, ..line.clone() })
        })
        .collect()
}
