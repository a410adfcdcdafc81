//! Speeds of a sweep.

/// Share by which speeds may differ and be the same: rounding of corners that are products, and of speeds that are sums of steps.
pub(crate) const SAME_SPEED: f64 = 1e-9;

/// Whether two speeds differ by rounding only.
#[doc(hidden)]
pub fn is_same_speed(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME_SPEED * a.abs().max(b.abs())
}

/// Speeds of a sweep, rpm, ascending.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// The speeds.
    pub speed_rpm: Vec<f64>,
    /// Whether the torque has a kink there (a tabulated speed): maxima may sit on it.
    pub kink: Vec<bool>,
}

impl Grid {
    /// The speeds of a study and, with `kinks`, the tabulated speeds between them. One that differs from a speed of the study by rounding is that speed: of an
    /// interval as short as rounding nothing can be told.
    pub fn new(speeds_rpm: &[f64], kinks: &[f64]) -> Self {
        let (first, last) = (speeds_rpm[0], speeds_rpm[speeds_rpm.len() - 1]);
        let mut all: Vec<f64> = speeds_rpm.to_vec();
        all.extend(kinks.iter().filter(|k| **k > first && **k < last && !speeds_rpm.iter().any(|s| is_same_speed(*s, **k))));
        all.sort_by(f64::total_cmp);
        let kink = all.iter().map(|s| kinks.iter().any(|k| is_same_speed(*s, *k))).collect();
        Self { speed_rpm: all, kink }
    }

    /// Number of speeds.
    pub fn len(&self) -> usize {
        self.speed_rpm.len()
    }

    /// Never true for a checked study.
    pub fn is_empty(&self) -> bool {
        self.speed_rpm.is_empty()
    }
}
