//! What least squares says about its parameters: standard errors, correlations, and which ones the data do not determine.
//!
//! Linear theory holds where the residuals are linear over the reach of the noise. Amplitudes are not: one that nearly vanishes has a kink,
//! and a minimum on it looks sharper than it is. So each direction is tried at some distance, and widened where the sum of squares rises more
//! slowly than the theory says.

use nalgebra::{DMatrix, DVector};

/// Singular values below this share of the largest are zero to the accuracy of the derivatives.
const SINGULAR: f64 = 1e-6;
/// A parameter takes part in a direction the data do not determine from this share.
const PART: f64 = 1e-3;

/// Uncertainty of fitted parameters.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
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

/// Covariance = s² (J'J)^-1 at the minimum, each of its directions times the square of the `stretch` that belongs to it. `jacobian`: a row a
/// residual, a column a parameter; `widths`: what each parameter can change at all, to compare parameters of different units. `stretch` is
/// given one standard deviation along a direction and s², see `stretch`; one where linear theory is enough.
pub fn statistics(jacobian: &DMatrix<f64>, residuals: &[f64], widths: &[f64], mut stretch: impl FnMut(&[f64], f64) -> f64) -> Statistics {
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
            let factor = deviation.map_or(1.0, |s| {
                let one: Vec<f64> = v.iter().zip(widths).map(|(v, w)| s * v * w / value.sqrt()).collect();
                stretch(&one, s * s)
            });
            covariance += &v * v.transpose() * (factor * factor / *value);
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

/// One standard deviation along the direction that the data determine least, in the unit of each parameter; nothing where there are no more
/// data than parameters or nothing is determined.
pub(crate) fn weakest(jacobian: &DMatrix<f64>, residuals: &[f64], widths: &[f64]) -> Option<Vec<f64>> {
    let mut longest: Option<(f64, Vec<f64>)> = None;
    let share = |one: &[f64]| one.iter().zip(widths).map(|(d, w)| (d / w).powi(2)).sum::<f64>();
    statistics(jacobian, residuals, widths, |one, _| {
        if longest.as_ref().is_none_or(|l| share(one) > l.0) {
            longest = Some((share(one), one.to_vec()));
        }
        1.0
    });
    longest.map(|l| l.1)
}

/// Distances along a direction at which the sum of squares is looked at, in standard deviations; three are what linear theory vouches for.
const DISTANCES: [f64; 6] = [3.0, 4.0, 6.0, 9.0, 13.0, 20.0];

/// How many times wider than linear theory a direction is: the furthest distance, either way, at which the sum of squares has risen by no
/// more than nine times s², over three. `rise(t)`: the rise at `t` standard deviations, nothing outside the bounds.
pub(crate) fn stretch(variance: f64, rise: impl Fn(f64) -> Option<f64>) -> f64 {
    let limit = 9.0 * variance;
    let reach = |sign: f64| {
        let (mut furthest, mut before) = (3.0, (0.0, 0.0));
        for t in DISTANCES {
            let Some(now) = rise(sign * t) else { break };
            if now <= limit {
                furthest = t;
            } else if before.1 <= limit {
                // where the limit lies between
                let crossing: f64 = before.0 + (t - before.0) * (limit - before.1) / (now - before.1);
                furthest = crossing.max(furthest);
            }
            before = (t, now);
        }
        furthest
    };
    (reach(1.0).max(reach(-1.0)) / 3.0).max(1.0)
}
