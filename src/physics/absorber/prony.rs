//! Ring on rubber or oil of several relaxation times, a Prony series (generalised Maxwell): S = k + sum over branches of k_j i omega tau_j/(1 + i omega tau_j).
//!
//! k at low frequency, k + sum k_j at high frequency; with k = 0 an oil of viscous damping sum k_j tau_j. Every k_j and tau_j above zero makes the law passive. Temperature that changes rates by a factor
//! multiplies every tau_j by it. Given only: a list of branches is what finite elements and shaker tests are fitted with, not what is ordered.

use super::dynamic_stiffness::{Operating, OperatingOver};
use super::law::{Declaration, Law};
use super::parameter::{Follows, Parameter, RING_INERTIA, Range};
use crate::numerics::C64;
use crate::numerics::taylor::Taylor;
use std::sync::Arc;

/// A spring in series with a damper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branch {
    /// N m/rad, above zero.
    pub stiffness: f64,
    /// s, above zero.
    pub relaxation_time: f64,
}

/// Ring on a Prony series.
#[derive(Debug, Clone, PartialEq)]
pub struct Prony {
    /// kg m².
    pub ring_inertia: f64,
    /// At low frequency, N m/rad, not negative.
    pub stiffness: f64,
    /// The branches.
    pub branches: Arc<[Branch]>,
    /// On all stiffnesses, above zero: one as they were given.
    pub stiffness_scale: f64,
    /// On all relaxation times, above zero: one as they were given.
    pub time_scale: f64,
}

const fn scale(key: &'static str, label: &'static str, about: &'static str) -> Parameter {
    Parameter {
        key,
        label,
        about,
        range: Range::Positive,
        extensive: false,
        dissipative: false,
        material: true,
        follows: Follows::Nothing,
        bounds: |_| (1.0, 1.0),
        typical: |_| 1.0,
    }
}

const STIFFNESS_SCALE: Parameter = Parameter { extensive: true, ..scale("stiffness_scale", "scale", "Factor on all stiffnesses.") };
const TIME_SCALE: Parameter =
    Parameter { follows: Follows::Factor, ..scale("time_scale", "time scale", "Factor on all relaxation times.") };

/// Ring on a Prony series. A study gives its branches; without any it is a spring of its scale, which no study can ask for.
pub(crate) static PRONY: Declaration = Declaration {
    name: "prony",
    about: "A ring on a Prony series.",
    parameters: &[RING_INERTIA, STIFFNESS_SCALE, TIME_SCALE],
    build: |v| Arc::new(Prony { ring_inertia: v[0], stiffness: 1.0, branches: Arc::new([]), stiffness_scale: v[1], time_scale: v[2] }),
    closed_forms: &[],
};

impl Law for Prony {
    fn declaration(&self) -> &'static Declaration {
        &PRONY
    }
    fn values(&self) -> Vec<f64> {
        vec![self.ring_inertia, self.stiffness_scale, self.time_scale]
    }
    fn ring_inertia(&self) -> f64 {
        self.ring_inertia
    }
    fn dynamic_stiffness(&self, at: Operating) -> C64 {
        let branch_stiffness = |b: &Branch| {
            let x = at.omega * b.relaxation_time * self.time_scale;
            C64::new(x * x, x) * (b.stiffness / (1.0 + x * x))
        };
        self.stiffness_scale * (self.stiffness + self.branches.iter().map(branch_stiffness).sum::<C64>())
    }
    fn is_analytic(&self) -> bool {
        true
    }
    fn over(&self, values: &[Taylor], at: &OperatingOver) -> Option<Taylor> {
        // x²/(1 + x²) + i x/(1 + x²) = 1 - 1/(1 + i x)
        let mut sum = Taylor::constant(C64::from(self.stiffness));
        let by_omega = values[2].times(&at.omega);
        for b in self.branches.iter() {
            let below = by_omega.times_number(C64::new(0.0, b.relaxation_time)).plus_number(C64::from(1.0));
            let share = below.inverse()?.times_number(C64::from(-1.0)).plus_number(C64::from(1.0));
            sum = sum.plus(&share.times_number(C64::from(b.stiffness)));
        }
        Some(values[1].times(&sum))
    }
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        let by_time = |b: &Branch| {
            let z = C64::new(0.0, at.omega * b.relaxation_time);
            let denominator = 1.0 + z * self.time_scale;
            b.stiffness * z / (denominator * denominator)
        };
        let own = self.dynamic_stiffness(at);
        vec![C64::default(), own / self.stiffness_scale, self.stiffness_scale * self.branches.iter().map(by_time).sum::<C64>()]
    }
    fn rebuilt(&self, values: &[f64]) -> Arc<dyn Law> {
        Arc::new(Self { ring_inertia: values[0], stiffness_scale: values[1], time_scale: values[2], ..self.clone() })
    }
}
