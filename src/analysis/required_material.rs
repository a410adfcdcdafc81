//! What an absorber would have to be made of: the modulus or viscosity that its law asks of the shape that is sheared.

use crate::absorber::parameter::DAMPING;
use crate::absorber::{Absorber, Operating};
use crate::drivetrain::natural;
use crate::units::HZ_PER_RAD_PER_S;

/// Of an absorber whose geometry is given.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct MadeOf {
    /// Factor B of the shape, m³.
    pub factor: f64,
    /// Of a ring with a frequency of its own: that, Hz, shear modulus there, Pa, and loss factor.
    pub rubber: Option<(f64, f64, f64)>,
    /// Viscosity at low frequency that the damper asks for, Pa s.
    pub viscosity: Option<f64>,
    /// Largest shear strain, at the largest synthesised twist of the ring.
    pub strain: f64,
}

/// Nothing where no geometry is given.
pub(crate) fn made_of(absorber: &Absorber, ring_twist: f64) -> Option<MadeOf> {
    let law = absorber.law()?;
    let geometry = law.material()?.geometry?;
    let factor = geometry.factor();
    let at_own = |omega: f64| {
        let s = law.dynamic_stiffness(Operating { omega, shaft_speed: omega });
        (omega * HZ_PER_RAD_PER_S, s.re / factor, s.im / s.re)
    };
    // where damping is the whole of it the ring has no frequency that matters
    let is_oil = absorber.value(crate::absorber::parameter::STIFFNESS.key).is_none_or(|k| k == 0.0);
    Some(MadeOf {
        factor,
        rubber: natural::own(law.as_ref()).filter(|_| !is_oil).map(at_own),
        viscosity: absorber.value(DAMPING.key).filter(|_| is_oil).map(|c| c / factor),
        strain: geometry.strain_per_twist() * ring_twist,
    })
}
