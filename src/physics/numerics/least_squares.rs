//! Nonlinear least squares within bounds: the model of Gauss and Newton in a trust region (argmin), in coordinates that keep the bounds.
//!
//! Where residuals stay large at the minimum and curve, Gauss and Newton's matrix alone converges slowly or swings about it: the rest of the
//! curvature is learnt from the steps, by the secant update of \[Dennis, Gay & Welsch 1981\].

use crate::numerics::elementary::Elementary;
use argmin::core::{CostFunction, Error, Executor, Gradient, Hessian};
use argmin::solver::trustregion::{Steihaug, TrustRegion};
use nalgebra::{DMatrix, DVector};
use std::cell::RefCell;
use std::rc::Rc;

/// Step of the central differences, relative to the parameter or its scale: truncation and rounding both stay near 1e-8.
const STEP: f64 = 1e-4;
/// Starts keep this share of the width (of the coordinate) from the bounds, where the angles stand still.
const INSIDE: f64 = 0.02;
/// A full step that promises less than this share of the cost ends the search.
const PROMISE: f64 = 1e-10;
/// A cost this much below the first one is rounding.
const EXACT: f64 = 1e-26;
const MOST_ITERATIONS: u64 = 60;

/// Where the search ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The parameters.
    pub point: Vec<f64>,
    /// Residuals there.
    pub residuals: Vec<f64>,
    /// Their derivatives: a row a residual, a column a parameter.
    pub jacobian: DMatrix<f64>,
    /// How often the residuals were computed.
    pub evaluations: u64,
}

impl Fit {
    /// Sum of the squared residuals.
    pub fn cost(&self) -> f64 {
        self.residuals.iter().map(|r| r * r).sum()
    }
}

/// A parameter: its bounds, and the size below which it acts like zero. Between bounds decades apart its logarithm counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Smallest value.
    pub lower: f64,
    /// Largest value, above `lower`.
    pub upper: f64,
    /// Positive.
    pub scale: f64,
}

impl Range {
    /// asinh(x/scale): linear below the scale, logarithmic above.
    pub fn coordinate(&self, x: f64) -> f64 {
        (x / self.scale).area_hyperbolic_sine()
    }

    /// The parameter of a coordinate, between the bounds.
    pub fn value(&self, z: f64) -> f64 {
        (self.scale * z.hyperbolic_sine()).clamp(self.lower, self.upper)
    }

    /// Bounds of the coordinate.
    pub fn ends(&self) -> (f64, f64) {
        (self.coordinate(self.lower), self.coordinate(self.upper))
    }

    /// What a step of one in the coordinate is in the parameter.
    pub fn size(&self, x: f64) -> f64 {
        x.hypotenuse(self.scale)
    }

    /// Coordinate of an angle: z = middle + half width sin(u) stays between the ends for every u.
    fn folded(&self, u: f64) -> f64 {
        let (low, high) = self.ends();
        0.5 * (low + high) + 0.5 * (high - low) * u.sine()
    }
}

struct State<F, E> {
    residuals: F,
    ranges: Vec<Range>,
    error: Option<E>,
    evaluations: u64,
    /// One over the sum of squares at the start: argmin's tolerances are absolute.
    unit: f64,
    best: Option<(f64, Fit)>,
    /// Where derivatives were last computed, with them and the residuals.
    known: Option<(Vec<f64>, Fit)>,
    /// The part of the second derivatives that Gauss and Newton leave out, in coordinates.
    curvature: DMatrix<f64>,
}

impl<F: FnMut(&[f64]) -> Result<Vec<f64>, E>, E> State<F, E> {
    fn at(&mut self, x: &[f64]) -> Result<Vec<f64>, Error> {
        self.evaluations += 1;
        (self.residuals)(x).map_err(|e| {
            self.error = Some(e);
            Error::msg("the residuals could not be computed")
        })
    }

    fn point(&self, u: &[f64]) -> Vec<f64> {
        u.iter().zip(&self.ranges).map(|(u, r)| r.value(r.folded(*u))).collect()
    }

    fn cost(&mut self, u: &[f64]) -> Result<f64, Error> {
        let x = self.point(u);
        let cost = 0.5 * self.at(&x)?.iter().map(|r| r * r).sum::<f64>();
        if cost.is_finite() { Ok(cost * self.unit) } else { Err(Error::msg("the residuals are not finite")) }
    }

    /// Residuals and derivatives at the coordinates `u`.
    fn derivatives(&mut self, u: &[f64]) -> Result<Fit, Error> {
        if let Some((at, fit)) = &self.known
            && at == u
        {
            return Ok(fit.clone());
        }
        let point = self.point(u);
        let residuals = self.at(&point)?;
        let mut jacobian = DMatrix::zeros(residuals.len(), point.len());
        for j in 0..point.len() {
            let range = self.ranges[j];
            let step = STEP * range.size(point[j]);
            let (mut up, mut down) = (point.clone(), point.clone());
            (up[j], down[j]) = ((point[j] + step).min(range.upper), (point[j] - step).max(range.lower));
            let width = up[j] - down[j];
            let (above, below) = (self.at(&up)?, self.at(&down)?);
            jacobian.set_column(j, &((DVector::from_vec(above) - DVector::from_vec(below)) / width));
        }
        let fit = Fit { point, residuals, jacobian, evaluations: self.evaluations };
        if self.best.as_ref().is_none_or(|b| fit.cost() < b.0) {
            self.best = Some((fit.cost(), fit.clone()));
        }
        // no decomposition of a matrix that is not finite ends
        if !fit.cost().is_finite() || fit.jacobian.iter().any(|d| !d.is_finite()) {
            return Err(Error::msg("the residuals or their derivatives are not finite"));
        }
        if let Some((from, before)) = self.known.take() {
            self.learn((&from, &before), (u, &fit));
        }
        self.known = Some((u.to_vec(), fit.clone()));
        Ok(fit)
    }

    /// Secant update of the curvature from one point to the next.
    fn learn(&mut self, (from, before): (&[f64], &Fit), (to, after): (&[f64], &Fit)) {
        let (old, new) = (self.in_coordinates(from, before), self.in_coordinates(to, after));
        let residuals = DVector::from_column_slice(&after.residuals);
        let step = DVector::from_column_slice(to) - DVector::from_column_slice(from);
        let gradients = new.transpose() * &residuals - old.transpose() * DVector::from_column_slice(&before.residuals);
        let wanted = (new - old).transpose() * &residuals;
        let along = gradients.dot(&step);
        if along <= 0.0 {
            return;
        }
        // what was learnt far away is scaled down where it is too large for this step
        let known = step.dot(&(&self.curvature * &step)).abs();
        if known > 0.0 {
            self.curvature *= (step.dot(&wanted).abs() / known).min(1.0);
        }
        let missing = wanted - &self.curvature * &step;
        let both = &missing * gradients.transpose() + &gradients * missing.transpose();
        self.curvature += both / along - &gradients * gradients.transpose() * (missing.dot(&step) / (along * along));
    }

    /// Derivatives with respect to the coordinates.
    fn in_coordinates(&self, u: &[f64], fit: &Fit) -> DMatrix<f64> {
        let mut jacobian = fit.jacobian.clone();
        for (j, (u, range)) in u.iter().zip(&self.ranges).enumerate() {
            let (low, high) = range.ends();
            jacobian.column_mut(j).scale_mut(0.5 * (high - low) * u.cosine() * range.size(fit.point[j]));
        }
        jacobian
    }
}

struct Problem<F, E>(Rc<RefCell<State<F, E>>>);

impl<F: FnMut(&[f64]) -> Result<Vec<f64>, E>, E> CostFunction for Problem<F, E> {
    type Param = Vec<f64>;
    type Output = f64;
    fn cost(&self, u: &Vec<f64>) -> Result<f64, Error> {
        self.0.borrow_mut().cost(u)
    }
}

impl<F: FnMut(&[f64]) -> Result<Vec<f64>, E>, E> Gradient for Problem<F, E> {
    type Param = Vec<f64>;
    type Gradient = Vec<f64>;
    fn gradient(&self, u: &Vec<f64>) -> Result<Vec<f64>, Error> {
        let mut state = self.0.borrow_mut();
        let fit = state.derivatives(u)?;
        let jacobian = state.in_coordinates(u, &fit);
        let residuals = DVector::from_column_slice(&fit.residuals);
        let gradient = jacobian.transpose() * &residuals;
        let cost = 0.5 * fit.cost();
        // argmin's trust region goes on for ever: an error is its only way to end
        let step = jacobian.svd(true, true).solve(&residuals, 1e-12).map_err(Error::msg)?;
        if 0.5 * gradient.dot(&step) <= PROMISE * cost || cost * state.unit <= EXACT {
            return Err(Error::msg("converged"));
        }
        Ok((gradient * state.unit).as_slice().to_vec())
    }
}

impl<F: FnMut(&[f64]) -> Result<Vec<f64>, E>, E> Hessian for Problem<F, E> {
    type Param = Vec<f64>;
    type Hessian = Vec<Vec<f64>>;
    fn hessian(&self, u: &Vec<f64>) -> Result<Vec<Vec<f64>>, Error> {
        let mut state = self.0.borrow_mut();
        let fit = state.derivatives(u)?;
        let jacobian = state.in_coordinates(u, &fit);
        let h = (jacobian.transpose() * &jacobian + &state.curvature) * state.unit;
        Ok(h.row_iter().map(|r| r.iter().copied().collect()).collect())
    }
}

/// Minimises half the sum of the squared `residuals` over parameters in their `ranges`, from one start. Derivatives by central
/// differences.
///
/// # Errors
/// The error of `residuals` where they cannot be computed at the start; one met on the way ends the search at the best point so far.
pub fn fit<F, E>(residuals: F, ranges: &[Range], start: &[f64]) -> Result<Fit, E>
where
    F: FnMut(&[f64]) -> Result<Vec<f64>, E>,
{
    let angle = |(x, range): (&f64, &Range)| {
        let (low, high) = range.ends();
        (2.0 * (range.coordinate(*x) - low) / (high - low) - 1.0).clamp(INSIDE - 1.0, 1.0 - INSIDE).arcsine()
    };
    let first: Vec<f64> = start.iter().zip(ranges).map(angle).collect();
    let state = State {
        residuals,
        ranges: ranges.to_vec(),
        error: None,
        evaluations: 0,
        unit: 1.0,
        best: None,
        known: None,
        curvature: DMatrix::zeros(ranges.len(), ranges.len()),
    };
    let shared = Rc::new(RefCell::new(state));
    let begun = shared.borrow_mut().derivatives(&first);
    match begun {
        Ok(fit) => shared.borrow_mut().unit = 1.0 / fit.cost().max(f64::MIN_POSITIVE),
        Err(_) => {
            if let Some(error) = shared.borrow_mut().error.take() {
                return Err(error);
            }
        }
    }
    let region = TrustRegion::new(Steihaug::<Vec<f64>, f64>::new().with_max_iters(2 * ranges.len() as u64)).with_radius(0.5);
    if let Ok(region) = region.and_then(|r| r.with_max_radius(1.5)) {
        let run = Executor::new(Problem(shared.clone()), region).configure(|s| s.param(first.clone()).max_iters(MOST_ITERATIONS));
        let _stopped = run.timer(false).run();
    }
    let mut state = shared.borrow_mut();
    let evaluations = state.evaluations;
    match state.best.take() {
        Some((_, fit)) => Ok(Fit { evaluations, ..fit }),
        None => unreachable!("the start was evaluated"),
    }
}
