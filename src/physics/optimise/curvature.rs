//! Curvature of the Lagrangian, as steps tell it: gradients of the same peaks at two points.

use super::{Row, Rows};
use crate::objective::Peak;
use nalgebra::{DMatrix, DVector};

/// How far apart two peaks are: in speed (relative) and, for a synthesis, in the angles of the cycle.
fn distance(a: &Peak, b: &Peak) -> f64 {
    let apart = |x: f64, y: f64| {
        let d = (x - y).rem_euclid(std::f64::consts::TAU);
        d.min(std::f64::consts::TAU - d)
    };
    let angles = match (&a.extremes, &b.extremes) {
        (Some(a), Some(b)) => apart(a.angle_max, b.angle_max) + apart(a.angle_min, b.angle_min),
        _ => 0.0,
    };
    let speeds = if a.speed_rpm == b.speed_rpm { 0.0 } else { (a.speed_rpm / b.speed_rpm - 1.0).abs() };
    speeds + 0.1 * angles
}

/// The row at a new point that belongs to the same peak: the nearest, within a tenth.
pub(super) fn same_peak<'r>(row: &Row, rows: &'r Rows) -> Option<&'r Row> {
    rows.rows
        .iter()
        .filter(|r| r.load_case == row.load_case && r.role == row.role && r.peak.quantity == row.peak.quantity)
        .filter(|r| r.peak.extremes.is_some() || r.peak.order == row.peak.order)
        .map(|r| (distance(&r.peak, &row.peak), r))
        .filter(|(d, _)| *d < 0.1)
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, r)| r)
}

/// Gradient of the Lagrangian at `rows` with the multipliers found at `old`, or nothing where a peak has gone.
pub(super) fn lagrangian(old: &Rows, multipliers: &[f64], rows: &Rows, unit: f64) -> Option<DVector<f64>> {
    let mut sum = DVector::zeros(old.rows.first().map_or(0, |r| r.gradient.len()));
    for (row, multiplier) in old.rows.iter().zip(multipliers) {
        if *multiplier > 1e-6 {
            let scale = if row.role.is_limit() { 1.0 } else { 1.0 / unit };
            sum += DVector::from_column_slice(&same_peak(row, rows)?.gradient) * (multiplier * scale);
        }
    }
    Some(sum)
}

/// Damped update after Powell: keeps the matrix positive definite. \[Nocedal & Wright 2006\] procedure 18.2.
pub(super) fn update(hessian: &mut DMatrix<f64>, step: &DVector<f64>, change: &DVector<f64>) {
    let bs = &*hessian * step;
    let sbs = step.dot(&bs);
    if sbs <= 0.0 || step.norm() < 1e-12 {
        return;
    }
    let sy = step.dot(change);
    let theta = if sy >= 0.2 * sbs { 1.0 } else { 0.8 * sbs / (sbs - sy) };
    let r = change * theta + &bs * (1.0 - theta);
    *hessian += &r * r.transpose() / step.dot(&r) - &bs * bs.transpose() / sbs;
}
