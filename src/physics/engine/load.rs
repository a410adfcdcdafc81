//! Load: what share of the full-load curve the engine runs at.

use crate::numerics::table_lookup;

/// Largest share of the full-load curve.
#[doc(hidden)]
pub const LARGEST_LOAD: f64 = 1.2;

/// Share of the full-load mean pressure over speed.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    /// rpm, ascending; empty where the share is the same at every speed.
    pub speeds_rpm: Vec<f64>,
    /// 0 to 1.2, one a speed (one in all where there is no speed); linear between speeds, constant beyond them.
    pub fraction: Vec<f64>,
}

impl Load {
    /// The same share at every speed.
    pub fn constant(fraction: f64) -> Self {
        Self { speeds_rpm: Vec::new(), fraction: vec![fraction] }
    }

    /// Share at a speed.
    pub fn at(&self, speed_rpm: f64) -> f64 {
        match self.speeds_rpm.as_slice() {
            [] | [_] => self.fraction[0],
            speeds => between(speeds, &self.fraction, speed_rpm.clamp(speeds[0], speeds[speeds.len() - 1])),
        }
    }

    /// Speeds at which a curve tabulated at `speeds` has corners once it runs at this load from the lowest to the highest speed of `range`: both tables, and where the
    /// load varies beyond the curve, whose ends are held there, those of the range.
    pub(crate) fn corners(&self, speeds: &[f64], range: (f64, f64)) -> Vec<f64> {
        let (first, last) = (speeds[0], speeds[speeds.len() - 1]);
        let (low, high) = (first.min(range.0), last.max(range.1));
        let within = |s: &&f64| **s > low && **s < high;
        let varies = self.speeds_rpm.len() > 1;
        let beyond = [low, high].into_iter().filter(|s| varies && !(first..=last).contains(s));
        let mut all: Vec<f64> = speeds.iter().chain(self.speeds_rpm.iter().filter(within)).copied().chain(beyond).collect();
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    }
}

/// Linear between tabulated values, held at their ends.
pub(crate) fn between(speeds: &[f64], values: &[f64], speed: f64) -> f64 {
    if speeds.len() == 1 {
        return values[0];
    }
    let (i, fraction) = table_lookup::held(speeds, speed);
    values[i] + (values[i + 1] - values[i]) * fraction
}
