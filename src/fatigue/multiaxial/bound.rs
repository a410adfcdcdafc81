//! What no history within some ranges exceeds: so that those that cannot be the worst need not be evaluated.

use super::{Criterion, Limits, Undefined};

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

impl Criterion {
    /// At least the share of the strength (the inverse of the safety factor) that a history within these ranges uses; not negative.
    ///
    /// # Errors
    /// [`Undefined`] where the limits leave no constant.
    pub fn at_most(self, w: &Within, l: &Limits) -> Result<f64, Undefined> {
        let k = self.weight(l)?;
        let (low, high) = w.hydrostatic;
        let mean_or_max = |k: f64| (k * low).max(k * high);
        let amplitude = |k: f64| (0.5 * k * (high - low)).max(0.0);
        let stress = match self {
            Self::Matake | Self::McDiarmid => w.shear + k.abs() * w.normal,
            Self::Findley => (w.shear + k * w.normal) / (1.0 + k * k).sqrt(),
            Self::DangVanThesis | Self::DangVanPlane => w.shear + mean_or_max(k),
            Self::Sines | Self::Crossland => w.sqrt_j2_amplitude + mean_or_max(k),
            Self::DangVanMesoscopic => {
                let sum = w.sqrt_j2_amplitude + mean_or_max(k);
                w.middle.map_or(sum, |(low, high)| sum.min(w.sqrt_j2_amplitude * round(k) + (k * low).max(k * high) / 3.0))
            }
            Self::KakunoKawada => w.sqrt_j2_amplitude + amplitude(k) + mean_or_max(Self::Sines.weight(l)?),
            Self::KakunoKawadaConsistent => {
                w.sqrt_j2_amplitude + amplitude(k) + mean_or_max(3.0 * l.torsion / l.repeated_bending - 3.0 * l.torsion / l.bending)
            }
            Self::Papadopoulos => w.mean_shear + mean_or_max(k),
        };
        Ok(stress.max(0.0) / l.torsion)
    }
}

/// Largest sum of the Tresca stress of a deviator in the circle of a plane state, whose radius is 1, and of k times the hydrostatic stress, both from its centre: at an angle of cosine x the sum is
/// sqrt(1 - x²/4) + |k| x/sqrt 3.
fn round(k: f64) -> f64 {
    let a = k.abs() / 3f64.sqrt();
    if 12.0 * a * a <= 1.0 { (1.0 + 4.0 * a * a).sqrt() } else { 0.75f64.sqrt() + a }
}
