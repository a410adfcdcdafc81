//! Levels of the second measure along a front, and where it is looked at next.

use super::minimax::Outcome;
use crate::numerics::elementary::Elementary;

/// A jump of the front is followed up to this share of the range of the second measure.
const RESOLVED: f64 = 1e-3;
/// Points nearer in the second measure than this share of its range are one.
pub(super) const SAME: f64 = 1e-6;

/// What follows one level of the second measure.
#[derive(Debug, Clone)]
pub(super) struct Level {
    /// What the second measure may be.
    pub most: f64,
    pub outcome: Outcome,
    pub values: [f64; 2],
}

/// Leaves out levels whose optimum is that of the one before.
pub(super) fn distinct(levels: &mut Vec<Level>) {
    let same = |a: f64, b: f64| (a - b).abs() <= SAME * a.abs().max(b.abs());
    levels.dedup_by(|b, a| same(a.values[0], b.values[0]) && same(a.values[1], b.values[1]));
}

/// Up to where the optimum of a level is known to be the same.
fn reach(level: &Level) -> f64 {
    level.most.max(level.values[1])
}

/// The level half way between two.
pub(super) fn middle(left: &Level, right: &Level) -> f64 {
    0.5 * (reach(left) + right.values[1])
}

/// By how much a measure differs over all levels.
pub(super) fn range(levels: &[Level], measure: usize) -> f64 {
    let all = || levels.iter().map(|l| l.values[measure]);
    all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
}

/// Intervals that are longer than the front divided by its points, the longest first, no more than are left; ascending.
pub(super) fn gaps(levels: &[Level], count: usize) -> Vec<usize> {
    let ranges = [0, 1].map(|k| Some(range(levels, k)).filter(|r| *r > 0.0).unwrap_or(1.0));
    let length = |i: usize| {
        let along = |k: usize| (levels[i + 1].values[k] - levels[i].values[k]) / ranges[k];
        along(0).hypotenuse(along(1))
    };
    let total: f64 = (0..levels.len() - 1).map(length).sum();
    let wanted = total / (count - 1) as f64;
    let apart = |i: &usize| levels[i + 1].values[1] - reach(&levels[*i]) > RESOLVED * ranges[1];
    let mut list: Vec<usize> = (0..levels.len() - 1).filter(apart).filter(|i| length(*i) > wanted).collect();
    list.sort_by(|a, b| length(*b).total_cmp(&length(*a)).then(a.cmp(b)));
    list.truncate(count - levels.len());
    list.sort_unstable();
    list
}
