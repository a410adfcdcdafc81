//! What no history within some ranges exceeds: so that those that cannot be the worst need not be evaluated.

use super::{Criterion, Limits, Undefined};

/// Ranges of a history, Pa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Within {
    /// At least the amplitude of sqrt(J2). Shear amplitudes of planes are no larger: their circles are shadows of the ball.
    pub sqrt_j2_amplitude: f64,
    /// At least the mean resolved shear of Papadopoulos.
    pub mean_shear: f64,
    /// No hydrostatic stress is below or above these.
    pub hydrostatic: (f64, f64),
    /// At least the size of any normal stress.
    pub normal: f64,
}

impl Within {
    /// What is within both.
    #[must_use]
    pub(crate) fn and(self, other: &Self) -> Self {
        Self {
            sqrt_j2_amplitude: self.sqrt_j2_amplitude.min(other.sqrt_j2_amplitude),
            mean_shear: self.mean_shear.min(other.mean_shear),
            hydrostatic: (self.hydrostatic.0.max(other.hydrostatic.0), self.hydrostatic.1.min(other.hydrostatic.1)),
            normal: self.normal.min(other.normal),
        }
    }
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
            Self::Matake | Self::McDiarmid => w.sqrt_j2_amplitude + k.abs() * w.normal,
            Self::Findley => (w.sqrt_j2_amplitude + k * w.normal) / (1.0 + k * k).sqrt(),
            Self::DangVanThesis | Self::DangVanPlane | Self::DangVanMesoscopic | Self::Sines | Self::Crossland => {
                w.sqrt_j2_amplitude + mean_or_max(k)
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
