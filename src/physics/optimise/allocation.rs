//! Tolerances that a design can bear: the widest of one ratio to those that are given, or the cheapest by the cost of each.
//!
//! The factors f on given tolerances are found in their logarithms. A tolerance whose cost is c as given costs c/f \[Chase & Greenwood 1988\]. The cheapest minimise the sum of c/f while every row, the logarithm of a limited
//! measure over its limit at a point of the box of tolerances, is at most zero: a sequence of quadratic programs with the rows linearised by differences, each step scaled back to where the largest row is zero.

use super::subproblem::{Line, solve};
use crate::numerics::elementary::Elementary;
use nalgebra::DMatrix;
use rayon::prelude::*;

/// Rows for some factors: logarithms of limited measures over their limits.
pub type RowsAt<'a> = &'a (dyn Fn(&[f64]) -> Vec<f64> + Sync);

/// Smaller factors than this are none.
const LEAST: f64 = 1e-4;
/// Difference of a logarithm of a factor for a derivative.
const DIFFERENCE: f64 = 1e-5;
/// Largest change of a logarithm of a factor in a step.
const REACH: f64 = 0.5;
const MOST_STEPS: usize = 60;
/// A row is zero within this share of the precision.
const ZERO: f64 = 1e-3;
const MOST_HALVINGS: usize = 100;
/// What is beyond or below in a row that has no finite value.
const FAR: f64 = 30.0;
const PENALTY: f64 = 1e4;

/// Factors for which the largest row is zero, or those of the most: all the same ratio to `along`, none above `most`; `None` where even the least ones are too much.
///
/// Factors and results have one element a tolerance; `precision` is that of their logarithms.
pub fn widest(rows: RowsAt, along: &[f64], most: &[f64], precision: f64) -> Option<Vec<f64>> {
    let at = |s: f64| along.iter().zip(most).map(|(f, m)| (f * s.exponential()).min(*m)).collect::<Vec<f64>>();
    let excess = |s: f64| largest(&rows(&at(s)));
    // where all are at their most
    let top = along.iter().zip(most).map(|(f, m)| (m / f).logarithm()).fold(f64::NEG_INFINITY, f64::max);
    if excess(top) <= 0.0 {
        return Some(most.to_vec());
    }
    let (mut high, mut step) = (top.min(0.0), 0.5);
    let (mut low, mut below);
    if excess(high) > 0.0 {
        loop {
            low = high - step;
            below = excess(low);
            if below <= 0.0 {
                break;
            }
            if low < LEAST.logarithm() {
                return None;
            }
            (high, step) = (low, 2.0 * step);
        }
    } else {
        (low, below) = (high, excess(high));
        while high < top {
            high = (low + step).min(top);
            let above = excess(high);
            if above > 0.0 {
                break;
            }
            (low, below, step) = (high, above, 2.0 * step);
        }
    }
    Some(at(zero((low, below), (high, excess(high)), ZERO * precision, &excess)))
}

/// Where a function changes its sign, on the side where it is not positive: by secants whose stale end is halved (Illinois), and halving where those do not help.
fn zero(mut low: (f64, f64), mut high: (f64, f64), precision: f64, f: &dyn Fn(f64) -> f64) -> f64 {
    let mut side = 0;
    for i in 0..MOST_HALVINGS {
        if low.1 >= -precision || high.0 - low.0 <= precision {
            break;
        }
        let secant = low.0 + (high.0 - low.0) * low.1 / (low.1 - high.1);
        let middle = 0.5 * (low.0 + high.0);
        let x = if i % 3 == 2 || !secant.is_finite() || secant <= low.0 || secant >= high.0 { middle } else { secant };
        let value = f(x);
        if value <= 0.0 {
            low = (x, value);
            if side < 0 {
                high.1 *= 0.5;
            }
            side = -1;
        } else {
            high = (x, value);
            if side > 0 {
                low.1 *= 0.5;
            }
            side = 1;
        }
    }
    low.0
}

fn largest(rows: &[f64]) -> f64 {
    rows.iter().copied().fold(-FAR, f64::max)
}

/// Factors with the least sum of `costs` over them for which no row is positive; `None` where even the least ones are too much. It is a local solution: the boundary may be dented.
pub fn cheapest(rows: RowsAt, costs: &[f64], most: &[f64], precision: f64) -> Option<Vec<f64>> {
    let n = costs.len();
    let sum = |f: &[f64]| costs.iter().zip(f).map(|(c, f)| c / f).sum::<f64>();
    let mut own = widest(rows, &vec![1.0; n], most, precision)?;
    let mut reach = REACH;
    // a difference has to show above what scaling back leaves
    let difference = DIFFERENCE.max(precision);
    for _ in 0..MOST_STEPS {
        let unit = sum(&own);
        let own_rows = rows(&own);
        let moved = |i: usize| {
            let mut f = own.clone();
            f[i] *= (-difference).exponential();
            rows(&f)
        };
        let differences: Vec<Vec<f64>> = (0..n).into_par_iter().map(moved).collect();
        let clamped = |x: f64| x.clamp(-FAR, FAR);
        let slope = |i: usize, row: usize| (clamped(own_rows[row]) - clamped(differences[i][row])) / difference;
        let limit = |row: usize| Line { objective: None, value: clamped(own_rows[row]), gradient: (0..n).map(|i| slope(i, row)).collect() };
        let shares: Vec<f64> = costs.iter().zip(&own).map(|(c, f)| c / f / unit).collect();
        let cost = Line { objective: Some(0), value: 1.0, gradient: shares.iter().map(|s| -s).collect() };
        let lines: Vec<Line> = std::iter::once(cost).chain((0..own_rows.len()).map(limit)).collect();
        let hessian = DMatrix::from_fn(n, n, |r, c| if r == c { shares[r] } else { 0.0 });
        let mut found = None;
        while found.is_none() && reach > precision {
            let bounds: Vec<(f64, f64)> = own
                .iter()
                .zip(most)
                .map(|(f, m)| ((-reach).max((LEAST / f).logarithm().min(0.0)), reach.min((m / f).logarithm())))
                .collect();
            let step = solve(&lines, &[1.0], &hessian, &bounds, PENALTY)?;
            let next: Vec<f64> = own.iter().zip(&step.change).map(|(f, d)| f * d.exponential()).collect();
            found = widest(rows, &next, most, precision).filter(|f| sum(f) < unit);
            if found.is_none() {
                reach *= 0.25;
            }
        }
        let Some(next) = found else { break };
        own = next;
        reach = (2.0 * reach).min(REACH);
    }
    Some(own)
}
