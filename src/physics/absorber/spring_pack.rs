//! Ring on steel springs in oil, by the figures of makers of leaf-spring dampers: static stiffness k, and at a reference frequency the damping factor kappa = Im S/k and the dynamic ratio
//! Re S/k = 1 + q.
//!
//! Oil squeezed through gaps acts in series with the compliance of chambers and leaves: S = k + k_h i omega c/(k_h + i omega c), a static spring beside Maxwell's law. At x = omega/omega_ref = 1 the two figures
//! give k_h = k (kappa² + q²)/q and omega_ref c/k_h = q/kappa, so that S = k (1 + (kappa² + q²) i x/(kappa + i x q)). The ratio must be above one: q = 0 would be a dashpot, which `tuned` is.

use super::closed_forms::{EngineMode, h_infinity_ring};
use super::dynamic_stiffness::{Operating, OperatingOver};
use super::law::{ClosedForm, Declaration, Law};
use super::parameter::{Follows, Parameter, RING_INERTIA, Range, STIFFNESS, of_material};
use crate::numerics::C64;
use crate::numerics::taylor::Taylor;
use crate::units::HZ_PER_RAD_PER_S;
use std::sync::Arc;

/// Ring on steel springs in oil.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringPack {
    /// kg m².
    pub ring_inertia: f64,
    /// Static, N m/rad, not negative.
    pub stiffness: f64,
    /// kappa at the reference frequency, not negative.
    pub damping_factor: f64,
    /// 1 + q at the reference frequency, above one.
    pub dynamic_ratio: f64,
    /// Hz, above zero.
    pub reference_frequency: f64,
}

pub(super) const DAMPING_FACTOR: Parameter = Parameter {
    dissipative: true,
    ..of_material(
        ("damping_factor", "kappa", "Damping factor of the maker at the reference frequency."),
        Range::NotNegative,
        |_| (0.0, 10.0),
        |_| 0.5,
    )
};

pub(super) const DYNAMIC_RATIO: Parameter = of_material(
    ("dynamic_ratio", "ratio", "Dynamic over static stiffness at the reference frequency."),
    Range::Above(1.0),
    |_| (1.001, 100.0),
    |_| 1.5,
);

/// Where the oil is thicker, the figures are reached at a lower frequency.
pub(super) const REFERENCE_FREQUENCY: Parameter = Parameter {
    follows: Follows::Inverse,
    ..of_material(
        ("reference_frequency_hz", "at/Hz", "Frequency that the figures of the maker are given at."),
        Range::Positive,
        |s| (0.01 * s.typical() * HZ_PER_RAD_PER_S, 100.0 * s.typical() * HZ_PER_RAD_PER_S),
        |s| s.typical() * HZ_PER_RAD_PER_S,
    )
};

/// Ring on steel springs in oil.
pub static SPRING_PACK: Declaration = Declaration {
    name: "spring_pack",
    about: "A ring on steel springs in oil, by figures of makers.",
    parameters: &[RING_INERTIA, STIFFNESS, DAMPING_FACTOR, DYNAMIC_RATIO, REFERENCE_FREQUENCY],
    build: |v| {
        Arc::new(SpringPack { ring_inertia: v[0], stiffness: v[1], damping_factor: v[2], dynamic_ratio: v[3], reference_frequency: v[4] })
    },
    closed_forms: &[ClosedForm { name: "spring_pack", every_mode: true, is_optimum: false, values: start }],
};

/// Spring and loss of the best spring and damper at their own frequency, half as stiff again there as at rest: a start, no optimum.
fn start(ring_inertia: f64, engine: EngineMode) -> Vec<f64> {
    let best = h_infinity_ring(ring_inertia, engine);
    let own = (best.stiffness / ring_inertia).sqrt();
    let stiffness = best.stiffness / 1.5;
    vec![ring_inertia, stiffness, best.damping * own / stiffness, 1.5, own * HZ_PER_RAD_PER_S]
}

impl SpringPack {
    /// i x, kappa² + q², and kappa + i x q.
    fn parts(&self, omega: f64) -> (C64, f64, C64) {
        let x = omega * HZ_PER_RAD_PER_S / self.reference_frequency;
        let q = self.dynamic_ratio - 1.0;
        (C64::new(0.0, x), self.damping_factor * self.damping_factor + q * q, C64::new(self.damping_factor, x * q))
    }
}

impl Law for SpringPack {
    fn declaration(&self) -> &'static Declaration {
        &SPRING_PACK
    }
    fn values(&self) -> Vec<f64> {
        vec![self.ring_inertia, self.stiffness, self.damping_factor, self.dynamic_ratio, self.reference_frequency]
    }
    fn ring_inertia(&self) -> f64 {
        self.ring_inertia
    }
    fn dynamic_stiffness(&self, at: Operating) -> C64 {
        let (ix, sum, denominator) = self.parts(at.omega);
        self.stiffness * (1.0 + sum * ix / denominator)
    }
    fn is_analytic(&self) -> bool {
        true
    }
    fn over(&self, values: &[Taylor], at: &OperatingOver) -> Option<Taylor> {
        let [_, stiffness, kappa, ratio, reference] = values else { return None };
        let ix = reference.inverse()?.times(&at.omega).times_number(C64::new(0.0, HZ_PER_RAD_PER_S));
        let q = ratio.plus_number(C64::from(-1.0));
        let (sum, below) = (kappa.times(kappa).plus(&q.times(&q)), kappa.plus(&ix.times(&q)));
        Some(stiffness.times(&sum.times(&ix).times(&below.inverse()?).plus_number(C64::from(1.0))))
    }
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        let (kappa, q) = (self.damping_factor, self.dynamic_ratio - 1.0);
        let (ix, sum, denominator) = self.parts(at.omega);
        let part = ix / denominator;
        let by_kappa = self.stiffness * part * (2.0 * kappa - sum / denominator);
        let by_ratio = self.stiffness * part * (2.0 * q - sum * ix / denominator);
        // x falls as the reference frequency rises
        let by_frequency = -self.stiffness * sum * kappa * ix / (denominator * denominator) / self.reference_frequency;
        vec![C64::default(), 1.0 + sum * part, by_kappa, by_ratio, by_frequency]
    }
}
