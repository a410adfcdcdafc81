//! Second-order conditions: curvature of the Lagrangian along the directions that first order leaves free.

use super::curvature::lagrangian;
use super::minimax::Outcome;
use super::termination::Stop;
use super::{Problem, Row};
use crate::response::Work;
use nalgebra::{DMatrix, DVector};

/// What second order says of an optimum.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct SecondOrder {
    /// Directions along which no active peak, limit or bound changes to first order.
    pub free: usize,
    /// Smallest curvature of the Lagrangian along them: share of the objective per square of a coordinate, which is nearly the logarithm of a parameter. Positive at a strict
    /// local minimum; nothing where there are no such directions: the first order decides then.
    pub curvature: Option<f64>,
}

/// Multipliers above this are active.
const ACTIVE: f64 = 1e-6;
/// Relative changes for a change of the coordinates that differ by less than this are the same: convergence leaves about 1e-6.
const STATIONARY: f64 = 1e-5;
/// Eigenvalues of a sum of squares below this share of the largest are zero.
const DEPENDENT: f64 = 1e-11;
/// Step of the differences, in coordinates.
const STEP: f64 = 1e-3;

/// Second order at an outcome \[Nocedal & Wright 2006\] theorem 12.6, by central differences of the Lagrangian's gradient; nothing where the search has not converged, where peaks appear or vanish that near, or where
/// a free parameter lies on a bound that costs nothing.
#[doc(hidden)]
pub fn second_order(problem: &Problem, outcome: &Outcome, work: &mut Work) -> Option<SecondOrder> {
    // curvature makes a minimum of a point where first order holds, and of no other
    if !matches!(outcome.stop, Stop::Converged | Stop::NothingFree) {
        return None;
    }
    let n = outcome.point.len();
    let unit = outcome.rows.objective();
    let active = outcome.rows.rows.iter().zip(&outcome.multipliers).filter(|r| *r.1 > ACTIVE).map(|r| r.0);
    // level peaks of one term stay level; a limit stays on its value
    let mut first: Vec<Option<&Row>> = vec![None; outcome.rows.weights().len()];
    let mut normals: Vec<Vec<f64>> = Vec::new();
    for row in active {
        match outcome.rows.term(row.role).map(|term| first[term].get_or_insert(row)) {
            None => normals.push(row.gradient.clone()),
            Some(of) => normals.push(row.gradient.iter().zip(&of.gradient).map(|(g, f)| (g - f) / unit).collect()),
        }
    }
    normals.retain(|v| v.iter().map(|x| x * x).sum::<f64>().sqrt() > STATIONARY);
    let held = (0..n).filter(|i| outcome.bounds[*i].iter().any(|m| *m > ACTIVE));
    normals.extend(held.map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect()));
    let free = complement(&normals, n);
    if free.is_empty() {
        return Some(SecondOrder { free: 0, curvature: None });
    }
    let bounds = problem.space.bounds();
    let mut products = DMatrix::zeros(n, free.len());
    for (k, direction) in free.iter().enumerate() {
        let mut slope = |step: f64| -> Option<DVector<f64>> {
            let moved: Vec<f64> = outcome.point.iter().zip(direction).map(|(w, d)| w + step * d).collect();
            if moved.iter().zip(&bounds).any(|(w, (low, high))| w < low || w > high) {
                return None;
            }
            lagrangian(&outcome.rows, &outcome.multipliers, &problem.rows(&moved, work).ok()?, unit)
        };
        products.set_column(k, &((slope(STEP)? - slope(-STEP)?) / (2.0 * STEP)));
    }
    let basis = DMatrix::from_fn(n, free.len(), |i, k| free[k][i]);
    let projected = basis.transpose() * products;
    let symmetric = (&projected + projected.transpose()) * 0.5;
    let curvature = symmetric.symmetric_eigenvalues().iter().copied().fold(f64::INFINITY, f64::min);
    Some(SecondOrder { free: free.len(), curvature: Some(curvature) })
}

/// Directions at right angles to some vectors of `n` components, and to each other, of length one.
fn complement(normals: &[Vec<f64>], n: usize) -> Vec<Vec<f64>> {
    if normals.is_empty() {
        return (0..n).map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect()).collect();
    }
    // eigenvectors of the sum of squares, each of them of length one, to zero
    let mut squares = DMatrix::zeros(n, n);
    for v in normals {
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length > 0.0 {
            let v = DVector::from_column_slice(v) / length;
            squares += &v * v.transpose();
        }
    }
    let eigen = squares.symmetric_eigen();
    let largest = eigen.eigenvalues.iter().copied().fold(0.0, f64::max);
    let zero = (0..n).filter(|i| eigen.eigenvalues[*i] <= DEPENDENT * largest);
    zero.map(|i| eigen.eigenvectors.column(i).iter().copied().collect()).collect()
}
