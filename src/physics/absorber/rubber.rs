//! Ring on rubber: a spring with a constant loss factor, S = k (1 + i eta).
//!
//! Rubber loses the same share of its energy in every cycle, whatever the frequency. The law holds near one frequency: it is not causal, and methods in time
//! refuse it. Temperature changes stiffness and loss factor by the same factor, as catalogues of couplings have it (Renold RB: S_t and M30/S_t).

use super::closed_forms::EngineMode;
use super::dynamic_stiffness::{Operating, OperatingOver};
use super::law::{ClosedForm, Declaration, Law};
use super::parameter::{Follows, Parameter, RING_INERTIA, Range, STIFFNESS};
use crate::numerics::C64;
use crate::numerics::I;
use crate::numerics::taylor::Taylor;
use std::sync::Arc;

/// Ring on rubber.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rubber {
    /// kg m².
    pub ring_inertia: f64,
    /// N m/rad, not negative.
    pub stiffness: f64,
    /// Not negative.
    pub loss_factor: f64,
}

/// Share of the energy lost in a cycle over 2 pi; a search may take it from nothing to far beyond any rubber, which has 0.05 to 0.4.
const LOSS_FACTOR: Parameter = Parameter {
    key: "loss_factor",
    label: "loss factor",
    about: "Loss factor of the rubber.",
    range: Range::Within(0.0, 2.0),
    extensive: false,
    dissipative: true,
    material: false,
    follows: Follows::Factor,
    bounds: |_| (0.0, 2.0),
    typical: |_| 1.0,
};

/// Ring on rubber.
pub static RUBBER: Declaration = Declaration {
    name: "rubber",
    about: "A ring on rubber of a constant loss factor.",
    parameters: &[RING_INERTIA, Parameter { follows: Follows::Factor, ..STIFFNESS }, LOSS_FACTOR],
    build: |v| Arc::new(Rubber { ring_inertia: v[0], stiffness: v[1], loss_factor: v[2] }),
    closed_forms: &[ClosedForm { name: "hysteretic", every_mode: true, is_optimum: true, values: hysteretic }],
};

/// The exact optimum on an undamped mass: k = J w0²/(1 + mu)² and eta = sqrt(mu (3 + mu)/2), with a largest amplitude of sqrt(2 (1 + mu)/mu) static
/// deflections. h² times the denominator less the numerator of the squared amplitude has there two double roots, as \[Nishihara & Asami 2002\] ask of a
/// viscous damper.
fn hysteretic(ring_inertia: f64, engine: EngineMode) -> Vec<f64> {
    let mu = ring_inertia / engine.inertia;
    let omega = engine.omega / (1.0 + mu);
    vec![ring_inertia, ring_inertia * omega * omega, (0.5 * mu * (3.0 + mu)).sqrt()]
}

impl Law for Rubber {
    fn declaration(&self) -> &'static Declaration {
        &RUBBER
    }
    fn values(&self) -> Vec<f64> {
        vec![self.ring_inertia, self.stiffness, self.loss_factor]
    }
    fn ring_inertia(&self) -> f64 {
        self.ring_inertia
    }
    fn dynamic_stiffness(&self, _: Operating) -> C64 {
        C64::new(self.stiffness, self.stiffness * self.loss_factor)
    }
    fn over(&self, values: &[Taylor], _: &OperatingOver) -> Option<Taylor> {
        Some(values[1].times(&values[2].times_number(I).plus_number(C64::from(1.0))))
    }
    fn quotient(&self, values: &[f64], _: Operating) -> Option<[C64; 2]> {
        Some([C64::new(values[1], values[1] * values[2]), C64::from(1.0)])
    }
    fn derivatives(&self, _: Operating) -> Vec<C64> {
        vec![C64::default(), C64::new(1.0, self.loss_factor), C64::new(0.0, self.stiffness)]
    }
}
