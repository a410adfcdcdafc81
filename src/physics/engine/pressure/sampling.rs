//! Samples of a working cycle.

use crate::units::RAD_PER_DEG;

/// Crank angle between samples of a cycle, degrees: finer changes the largest order amplitudes by less than 1e-5.
#[doc(hidden)]
pub const SAMPLE_DEG: f64 = 0.1;

/// Samples in a cycle of an engine with `strokes` strokes.
pub fn samples(strokes: u32) -> usize {
    (180.0 * f64::from(strokes) / SAMPLE_DEG).round() as usize
}

/// Crank angle of sample `j` from firing dead centre, rad.
pub fn sample_angle(j: usize) -> f64 {
    j as f64 * SAMPLE_DEG * RAD_PER_DEG
}

/// What repeats with every revolution, at the samples of a working cycle.
pub(crate) fn each_revolution<T: Clone>(strokes: u32, at_angle: impl Fn(f64) -> T) -> Vec<T> {
    let revolution: Vec<T> = (0..samples(2)).map(|j| at_angle(sample_angle(j))).collect();
    revolution.iter().cycle().take(samples(strokes)).cloned().collect()
}

/// Where a sample lies in the cycle: the angle from -180° to 180° round firing dead centre, or the gas exchange in between.
pub(crate) fn closed_part_deg(j: usize, n: usize) -> Option<f64> {
    let deg = j as f64 * SAMPLE_DEG;
    let back = deg - n as f64 * SAMPLE_DEG;
    if deg <= 180.0 {
        Some(deg)
    } else if back >= -180.0 {
        Some(back)
    } else {
        None
    }
}
