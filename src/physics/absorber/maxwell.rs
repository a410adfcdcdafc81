//! Ring in oil that is elastic, too, by one relaxation time: S = i omega c/(1 + i omega tau), a damper in series with a spring of c/tau (Maxwell).
//!
//! Silicone oil yields at low frequency and springs back at high frequency; with the right relaxation time a ring without a spring does as much as one that is tuned.

use super::closed_forms::EngineMode;
use super::dynamic_stiffness::{Operating, OperatingOver};
use super::law::{ClosedForm, Declaration, Law};
use super::parameter::{DAMPING, Follows, Parameter, RING_INERTIA, Range, of_material};
use crate::numerics::taylor::Taylor;
use crate::numerics::{C64, I};
use std::sync::Arc;

/// Ring in an oil of one relaxation time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Maxwell {
    /// kg m².
    pub ring_inertia: f64,
    /// At low frequency, N m s/rad, not negative.
    pub damping: f64,
    /// s, not negative.
    pub relaxation_time: f64,
}

/// Relaxation time of a material, s.
pub(super) const RELAXATION_TIME: Parameter = Parameter {
    follows: Follows::Factor,
    ..of_material(
        ("relaxation_time_s", "tau/s", "Relaxation time."),
        Range::NotNegative,
        |s| (0.0, 1e3 / s.typical()),
        |s| 1.0 / s.typical(),
    )
};

/// Ring in an oil of one relaxation time.
pub static MAXWELL: Declaration = Declaration {
    name: "maxwell",
    about: "A ring in oil of one relaxation time.",
    parameters: &[RING_INERTIA, Parameter { follows: Follows::Factor, ..DAMPING }, RELAXATION_TIME],
    build: |v| Arc::new(Maxwell { ring_inertia: v[0], damping: v[1], relaxation_time: v[2] }),
    closed_forms: &[ClosedForm { name: "maxwell_untuned", every_mode: true, is_optimum: true, values: best }],
};

/// The exact optimum on an undamped mass. With u = sqrt(4 + 3 mu) and D = 3 u² + 4 u + 4: K = c/tau = 24 J w0²/D and c = J w0 sqrt(96/((u - 2)(3 u + 2) D)); the largest amplitude,
/// D/((u + 2) sqrt(3 (u - 2)(3 u + 2))) static deflections, is that of the best spring and damper of \[Nishihara & Asami 2002\]. Derived as theirs: h² times the denominator less the
/// numerator of the squared amplitude has two double roots.
fn best(ring_inertia: f64, engine: EngineMode) -> Vec<f64> {
    let mu = ring_inertia / engine.inertia;
    let u = (4.0 + 3.0 * mu).sqrt();
    // u - 2 without cancellation for small mu
    let excess = 3.0 * mu / (u + 2.0);
    let d = 3.0 * u * u + 4.0 * u + 4.0;
    let stiffness = 24.0 / d * ring_inertia * engine.omega * engine.omega;
    let damping = (96.0 / (excess * (3.0 * u + 2.0) * d)).sqrt() * ring_inertia * engine.omega;
    vec![ring_inertia, damping, damping / stiffness]
}

impl Law for Maxwell {
    fn declaration(&self) -> &'static Declaration {
        &MAXWELL
    }
    fn values(&self) -> Vec<f64> {
        vec![self.ring_inertia, self.damping, self.relaxation_time]
    }
    fn ring_inertia(&self) -> f64 {
        self.ring_inertia
    }
    fn dynamic_stiffness(&self, at: Operating) -> C64 {
        C64::new(0.0, at.omega * self.damping) / C64::new(1.0, at.omega * self.relaxation_time)
    }
    fn is_analytic(&self) -> bool {
        true
    }
    fn over(&self, values: &[Taylor], at: &OperatingOver) -> Option<Taylor> {
        let below = values[2].times(&at.omega).times_number(I).plus_number(C64::from(1.0));
        Some(values[1].times(&at.omega).times_number(I).times(&below.inverse()?))
    }
    fn quotient(&self, values: &[f64], at: Operating) -> Option<[C64; 2]> {
        Some([C64::new(0.0, at.omega * values[1]), C64::new(1.0, at.omega * values[2])])
    }
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        let denominator = C64::new(1.0, at.omega * self.relaxation_time);
        let by_time = at.omega * at.omega * self.damping / (denominator * denominator);
        vec![C64::default(), C64::new(0.0, at.omega) / denominator, by_time]
    }
}
