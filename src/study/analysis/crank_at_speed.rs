//! What a flexible crank is by itself: how stiff a throw is, and whether its motion at the highest speed of a study dies away.

use crate::crankshaft::flexible::{ThrowStiffness, throw_stiffness};
use crate::input::Study;
use crate::numerics::C64;
use crate::rotor::free_modes::at_speed;
use crate::units::RAD_PER_S_PER_RPM;

/// A motion grows by itself where the real part of its eigenvalue over its magnitude is larger than this.
const GROWS: f64 = 1e-3;
/// A motion slower than this share of the speed is rigid rotation, which preload of pins and journals that is left out moves a little.
const RIGID: f64 = 0.02;

/// Of the throw in the middle; `None` without a flexible crank.
#[doc(hidden)]
pub fn stiffness(study: &Study) -> Option<ThrowStiffness> {
    let (flexible, crank) = (study.flexible.as_ref()?, study.crank.as_ref()?);
    throw_stiffness(crank, &flexible.spec, crank.throws() / 2)
}

/// Highest speed of a study, rad/s.
fn highest(study: &Study) -> f64 {
    study.speeds_rpm[study.speeds_rpm.len() - 1] * RAD_PER_S_PER_RPM
}

/// Eigenvalues at the highest speed of the study in axes that turn with the crank, 1/s, rigid rotation left out; none without a flexible crank.
#[doc(hidden)]
pub fn eigenvalues(study: &Study) -> Vec<C64> {
    let found = study.flexible.as_ref().and_then(|f| at_speed(&f.assembled.shaft, f.modes()?, highest(study)));
    let mut all = found.unwrap_or_default();
    all.retain(|s| s.im > RIGID * highest(study));
    all
}

/// Those of motions that grow by themselves.
#[doc(hidden)]
pub fn growing(study: &Study) -> Vec<C64> {
    eigenvalues(study).into_iter().filter(|s| s.re > GROWS * s.norm()).collect()
}
