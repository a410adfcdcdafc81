//! What least squares says about its parameters: standard errors, correlations, and which ones the data do not determine.

use nalgebra::{DMatrix, DVector};

/// Singular values below this share of the largest are zero to the accuracy of the derivatives.
const SINGULAR: f64 = 1e-6;
/// A parameter takes part in a direction the data do not determine from this share.
const PART: f64 = 1e-3;

/// Uncertainty of fitted parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Statistics {
    /// Standard error of each parameter; infinite where the data do not determine it; `None` where there are no more data than parameters.
    pub standard_errors: Vec<Option<f64>>,
    /// Correlation of each pair; `None` where one is not determined.
    pub correlation: Vec<Vec<Option<f64>>>,
    /// Standard deviation of a residual: sqrt(sum of squares/degrees of freedom).
    pub deviation: Option<f64>,
    /// Data less parameters.
    pub degrees_of_freedom: usize,
}

/// Linear theory at the minimum: covariance = s² (J'J)^-1. `jacobian`: a row a residual, a column a parameter; `widths`: what each
/// parameter can change at all, to compare parameters of different units.
pub fn statistics(jacobian: &DMatrix<f64>, residuals: &[f64], widths: &[f64]) -> Statistics {
    let (m, p) = jacobian.shape();
    let degrees_of_freedom = m.saturating_sub(p);
    let sum: f64 = residuals.iter().map(|r| r * r).sum();
    let deviation = (degrees_of_freedom > 0).then(|| (sum / degrees_of_freedom as f64).sqrt());
    let mut scaled = jacobian.clone();
    for (j, width) in widths.iter().enumerate() {
        scaled.column_mut(j).scale_mut(*width);
    }
    let decomposed = (scaled.transpose() * &scaled).symmetric_eigen();
    let largest = decomposed.eigenvalues.max().max(0.0);
    let mut covariance: DMatrix<f64> = DMatrix::zeros(p, p);
    let mut undetermined = vec![false; p];
    for (value, vector) in decomposed.eigenvalues.iter().zip(decomposed.eigenvectors.column_iter()) {
        if *value > SINGULAR * SINGULAR * largest {
            let v: DVector<f64> = vector.into_owned();
            covariance += &v * v.transpose() / *value;
        } else {
            (0..p).filter(|j| vector[*j].abs() > PART).for_each(|j| undetermined[j] = true);
        }
    }
    let error = |j: usize| match deviation {
        _ if undetermined[j] => Some(f64::INFINITY),
        Some(s) => Some(s * covariance[(j, j)].sqrt() * widths[j]),
        None => None,
    };
    let pair = |i: usize, j: usize| {
        let known = !undetermined[i] && !undetermined[j];
        known.then(|| covariance[(i, j)] / (covariance[(i, i)] * covariance[(j, j)]).sqrt())
    };
    Statistics {
        standard_errors: (0..p).map(error).collect(),
        correlation: (0..p).map(|i| (0..p).map(|j| pair(i, j)).collect()).collect(),
        deviation,
        degrees_of_freedom,
    }
}
