//! What no history within some ranges exceeds: so that those that cannot be the worst need not be evaluated.

/// Ranges of a history, Pa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Within {
    /// At least the amplitude of sqrt(J2).
    pub sqrt_j2_amplitude: f64,
    /// At least the shear amplitude of any plane: no more than that of sqrt(J2), as circles of planes are shadows of the ball.
    pub shear: f64,
    /// At least the mean resolved shear of Papadopoulos.
    pub mean_shear: f64,
    /// No hydrostatic stress is below or above these.
    pub hydrostatic: (f64, f64),
    /// Of a plane state of one normal stress and its shear: the normal stress at the centre of the ball is not below or above these. Nothing of other states.
    pub middle: Option<(f64, f64)>,
    /// At least the size of any normal stress.
    pub normal: f64,
}

/// At least k times any hydrostatic stress.
pub(super) fn pressed(w: &Within, k: f64) -> f64 {
    let (low, high) = w.hydrostatic;
    (k * low).max(k * high)
}

/// Largest sum of the Tresca stress of a deviator in the circle of a plane state, whose radius is 1, and of k times the hydrostatic stress, both from its centre: at an angle of cosine x the sum is
/// sqrt(1 - x²/4) + |k| x/sqrt 3.
pub(super) fn round(k: f64) -> f64 {
    let a = k.abs() / 3f64.sqrt();
    if 12.0 * a * a <= 1.0 { (1.0 + 4.0 * a * a).sqrt() } else { 0.75f64.sqrt() + a }
}
