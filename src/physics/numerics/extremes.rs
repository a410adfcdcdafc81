//! The extremes of a sum of harmonics over its period.

/// The extremes of f(psi) = sum of Re(Y_n e^{i h_n psi}) over a period.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize, serde::Deserialize)]
pub struct Extremes {
    /// (max f - min f) / 2.
    pub half_peak_to_peak: f64,
    /// (max f + min f) / 2.
    pub middle: f64,
    /// Angle psi of the maximum, rad.
    pub angle_max: f64,
    /// Angle psi of the minimum, rad.
    pub angle_min: f64,
}

/// Bounds of the extremes of a sum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Most {
    pub half_peak_to_peak: f64,
    /// Size of the middle.
    pub middle: f64,
}

impl Most {
    /// Of extremes.
    pub fn of(extremes: &Extremes) -> Self {
        Self { half_peak_to_peak: extremes.half_peak_to_peak, middle: extremes.middle.abs() }
    }
}

/// How right extremes are to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Precision {
    /// As right as numbers are.
    Rounding,
    /// To about a millionth where short waves are small, else to a thousandth: for values that only say where to look more closely.
    Millionth,
}
