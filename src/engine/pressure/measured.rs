//! Measured pressure traces.

use super::sampling::{SAMPLE_DEG, samples};
use crate::numerics::nearest;

/// Traces over a whole cycle at one or more speeds, linear in between samples.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Ascending, rpm.
    pub speeds_rpm: Vec<f64>,
    /// Ascending, degrees from firing dead centre, over one cycle (the first angle a cycle later may be repeated at the end or not).
    pub crank_deg: Vec<f64>,
    /// One trace a speed, Pa absolute, one value an angle.
    pub pressure: Vec<Vec<f64>>,
}

impl Measured {
    /// Expansion along the measured compression, mirrored at firing dead centre. What has burnt before dead centre stays in it.
    pub(super) fn motored(&self, index: usize, strokes: u32) -> Vec<f64> {
        let fired = self.trace(index, strokes);
        let n = fired.len();
        (0..n).map(|j| if (j as f64) * SAMPLE_DEG <= 180.0 { fired[(n - j) % n] } else { fired[j] }).collect()
    }

    pub(super) fn trace(&self, index: usize, strokes: u32) -> Vec<f64> {
        let cycle = 180.0 * f64::from(strokes);
        let (mut angle, mut pressure) = (self.crank_deg.clone(), self.pressure[index].clone());
        if angle[angle.len() - 1] - angle[0] < cycle - 1e-6 {
            angle.push(angle[0] + cycle);
            pressure.push(pressure[0]);
        }
        (0..samples(strokes))
            .map(|j| {
                let deg = angle[0] + (j as f64 * SAMPLE_DEG - angle[0]).rem_euclid(cycle);
                let (i, fraction) = nearest::interval(&angle, deg);
                pressure[i] + fraction * (pressure[i + 1] - pressure[i])
            })
            .collect()
    }
}
