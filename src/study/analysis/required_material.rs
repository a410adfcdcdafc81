//! What an absorber would have to be made of: the modulus or viscosity that its law asks of the shape that is sheared.

use crate::absorber::construction::shape;
use crate::absorber::parameter::{DAMPING, STIFFNESS};
use crate::absorber::{Absorber, Medium, Operating};
use crate::drivetrain::natural;
use crate::objective::Condition;
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

/// A ring on its held hub: what a maker measures.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(hidden)]
pub struct OnHeldHub {
    /// Own frequency, Hz.
    pub frequency_hz: f64,
    /// Real part of the dynamic stiffness there, N m/rad.
    pub stiffness: f64,
    /// Imaginary over real part there.
    pub loss_factor: f64,
}

/// Key of the viscosity of an oil by its name.
const VISCOSITY: &str = "viscosity_pa_s";

/// Where damping is the whole of it the ring has no frequency that matters, and that of pendulums goes with the speed of the shaft.
fn has_no_frequency(absorber: &Absorber) -> bool {
    let of_shape = absorber.declaration().and_then(shape).map(|s| match s.medium {
        Medium::Oil | Medium::Field => true,
        Medium::Rubber | Medium::Leaves | Medium::Coils => false,
    });
    of_shape.unwrap_or_else(|| absorber.value(STIFFNESS.key).is_none_or(|k| k == 0.0))
}

/// The ring of an absorber at its own frequency; nothing where it has none.
pub(super) fn at_own_frequency(absorber: &Absorber) -> Option<OnHeldHub> {
    let law = absorber.law().filter(|_| !has_no_frequency(absorber))?;
    let omega = natural::own(law.as_ref())?;
    let s = law.dynamic_stiffness(Operating { omega, shaft_speed: omega });
    Some(OnHeldHub { frequency_hz: omega * HZ_PER_RAD_PER_S, stiffness: s.re, loss_factor: s.im / s.re })
}

/// The same in the reference of its material, and in the state of each of these conditions that has one; nothing where its material has no states.
#[doc(hidden)]
pub fn over_states(absorber: &Absorber, conditions: impl Iterator<Item = Condition>) -> Vec<(Condition, OnHeldHub)> {
    let states = conditions.filter_map(|c| Some((c, absorber.in_state(c.material()?)?)));
    let mut list: Vec<(Condition, OnHeldHub)> = states.filter_map(|(c, own)| Some((c, at_own_frequency(&own)?))).collect();
    if let Some(own) = at_own_frequency(absorber).filter(|_| !list.is_empty()) {
        list.insert(0, (Condition::Firing, own));
    }
    list
}

/// Nothing where no geometry is given, or where nothing is sheared.
#[doc(hidden)]
pub fn made_of(absorber: &Absorber, ring_twist: f64) -> Option<MadeOf> {
    let law = absorber.law().filter(|law| shape(law.declaration()).is_none_or(|s| s.medium.is_sheared()))?;
    let factor = law.parts().map(|p| p.factor).or_else(|| Some(law.material()?.geometry?.factor()))?;
    Some(MadeOf {
        factor,
        rubber: at_own_frequency(absorber).map(|own| (own.frequency_hz, own.stiffness / factor, own.loss_factor)),
        viscosity: absorber
            .value(DAMPING.key)
            .filter(|_| has_no_frequency(absorber))
            .map(|c| c / factor)
            .or_else(|| absorber.value(VISCOSITY)),
        strain: law.strain_per_twist()? * ring_twist,
    })
}
