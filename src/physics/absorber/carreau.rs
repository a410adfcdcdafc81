//! Ring in silicone oil with a spread of relaxation times, causal Carreau: S = i omega c/(1 + (i omega tau)^a)^((1 - n)/a).
//!
//! At low frequency a Newtonian damper c; far above 1/tau the viscosity falls as omega^(n - 1). `a` = 1 and `n` = 0 is Maxwell's law. With powers of i on the principal branch the argument of S
//! lies between 0 and 90° for 0 < a <= 1 and 0 <= n < 1: the law is passive. For strains of less than one; at large ones the viscosity follows the rate of shear instead.

use super::closed_forms::{EngineMode, viscous_damping};
use super::dynamic_stiffness::{Operating, OperatingOver, by_frequency};
use super::law::{ByFactor, ClosedForm, Declaration, Law};
use super::maxwell::RELAXATION_TIME;
use super::parameter::{DAMPING, Follows, Parameter, RING_INERTIA, Range, of_material};
use crate::numerics::elementary::ComplexElementary;
use crate::numerics::taylor::Taylor;
use crate::numerics::{C64, I, ImaginaryPower, imaginary_ln, simd_elementary};
use hartog_kernel::kernel;
use std::sync::Arc;

/// Ring in silicone oil.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Carreau {
    /// kg m².
    pub ring_inertia: f64,
    /// At low frequency, N m s/rad, not negative.
    pub damping: f64,
    /// s, above zero.
    pub relaxation_time: f64,
    /// a, above 0 up to 1: how sharply the oil turns from viscous to elastic.
    pub transition: f64,
    /// n, from 0 to below 1.
    pub flow_index: f64,
}

pub(super) const TRANSITION: Parameter = of_material(
    ("transition_exponent", "a", "Width of the transition from Newtonian to shear-thinning."),
    Range::Within(0.05, 1.0),
    |_| (0.05, 1.0),
    |_| 0.8,
);

pub(super) const FLOW_INDEX: Parameter =
    of_material(("flow_index", "n", "Flow index of the shear-thinning branch."), Range::Within(0.0, 0.95), |_| (0.0, 0.95), |_| 0.3);

/// Ring in silicone oil.
pub static CARREAU: Declaration = Declaration {
    name: "carreau",
    about: "A ring in silicone oil with a spread of relaxation times.",
    parameters: &[
        RING_INERTIA,
        Parameter { follows: Follows::Factor, ..DAMPING },
        Parameter { range: Range::Positive, ..RELAXATION_TIME },
        TRANSITION,
        FLOW_INDEX,
    ],
    build: |v| Arc::new(Carreau { ring_inertia: v[0], damping: v[1], relaxation_time: v[2], transition: v[3], flow_index: v[4] }),
    closed_forms: &[ClosedForm { name: "carreau_untuned", every_mode: true, is_optimum: false, values: start }],
};

/// The best Newtonian damper, with a relaxation time of half a radian of the mode: a start, no optimum.
fn start(ring_inertia: f64, engine: EngineMode) -> Vec<f64> {
    vec![ring_inertia, viscous_damping(ring_inertia, engine), 0.5 / engine.omega, 1.0, 0.0]
}

impl Carreau {
    /// S at a frequency without a branch, for lanes; the exponent is (n - 1)/a.
    #[inline(always)]
    fn without_branches(&self, omega: f64, power: ImaginaryPower, exponent: f64) -> C64 {
        let z = 1.0 + power.branchless(omega * self.relaxation_time);
        let size = simd_elementary::exponential(0.5 * exponent * simd_elementary::logarithm(z.re * z.re + z.im * z.im));
        let (sine, cosine) = simd_elementary::sine_cosine(exponent * simd_elementary::angle(z.re, z.im));
        let newtonian = omega * self.damping * size;
        C64::new(-newtonian * sine, newtonian * cosine)
    }

    /// (i omega tau)^a.
    fn power(&self, omega: f64) -> C64 {
        ImaginaryPower::new(self.transition).of(omega * self.relaxation_time)
    }

    /// S of z = (i omega tau)^a.
    pub(super) fn stiffness_of(&self, omega: f64, z: C64) -> C64 {
        C64::new(0.0, omega * self.damping) * (1.0 + z).power((self.flow_index - 1.0) / self.transition)
    }
}

/// S at many points. The real part of 1 + (i omega tau)^a is above zero, its imaginary part not below.
#[kernel]
fn stiffness_each(law: &Carreau, power: ImaginaryPower, at: &[Operating], out: &mut [C64]) {
    let exponent = (law.flow_index - 1.0) / law.transition;
    by_frequency(at, out, |omega| law.without_branches(omega, power, exponent));
}

/// S at many multiples of frequencies.
#[kernel]
fn at_multiples(law: &Carreau, (power, multiple): (ImaginaryPower, f64), omega: &[f64], [re, im, below]: [&mut [f64]; 3]) {
    let (exponent, n) = ((law.flow_index - 1.0) / law.transition, omega.len());
    let (re, im) = (&mut re[..n], &mut im[..n]);
    for i in 0..n {
        let s = law.without_branches(omega[i] * multiple, power, exponent);
        (re[i], im[i]) = (s.re, s.im);
    }
    below[..n].fill(1.0);
}

impl Law for Carreau {
    fn declaration(&self) -> &'static Declaration {
        &CARREAU
    }
    fn values(&self) -> Vec<f64> {
        vec![self.ring_inertia, self.damping, self.relaxation_time, self.transition, self.flow_index]
    }
    fn ring_inertia(&self) -> f64 {
        self.ring_inertia
    }
    fn dynamic_stiffness(&self, at: Operating) -> C64 {
        self.stiffness_of(at.omega, self.power(at.omega))
    }
    fn dynamic_stiffness_each(&self, at: &[Operating], out: &mut [C64]) {
        stiffness_each(self, ImaginaryPower::new(self.transition), at, out);
    }
    fn followed_each<'s>(&'s self, at: &'s [Operating]) -> Option<ByFactor<'s>> {
        // temperature puts its factor on damping and relaxation time: S is that at so many times the frequency
        let (power, omega) = (ImaginaryPower::new(self.transition), at.iter().map(|at| at.omega).collect::<Vec<f64>>());
        Some(Box::new(move |factor, out| at_multiples(self, (power, simd_elementary::exponential(factor)), &omega, out)))
    }
    fn is_analytic(&self) -> bool {
        true
    }
    fn over(&self, values: &[Taylor], at: &OperatingOver) -> Option<Taylor> {
        let power = values[2].times(&at.omega).imaginary_power(&values[3])?;
        let exponent = values[4].plus_number(C64::from(-1.0)).times(&values[3].inverse()?);
        let falls = exponent.times(&power.plus_number(C64::from(1.0)).logarithm()?).exponential();
        Some(values[1].times(&at.omega).times_number(I).times(&falls))
    }
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        let (a, n) = (self.transition, self.flow_index);
        let z = self.power(at.omega);
        let falls = (1.0 + z).power((n - 1.0) / a);
        let newtonian = C64::new(0.0, at.omega);
        let s = newtonian * self.damping * falls;
        // d ln S/d ln tau = (n - 1) z/(1 + z)
        let by_log_time = s * (z / (1.0 + z)) * (n - 1.0);
        let by_transition = s
            * ((1.0 + z).logarithm() * ((1.0 - n) / (a * a))
                + (z / (1.0 + z)) * imaginary_ln(at.omega * self.relaxation_time) * ((n - 1.0) / a));
        let by_index = s * (1.0 + z).logarithm() / a;
        vec![C64::default(), newtonian * falls, by_log_time / self.relaxation_time, by_transition, by_index]
    }
}
