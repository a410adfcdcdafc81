//! Ring on filled rubber, fractional Kelvin: S = k (1 + (i omega tau)^alpha), a spring beside a springpot.
//!
//! Over two or three decades the storage and loss moduli of filled rubber rise as omega^alpha. With (i)^alpha on the principal branch S is passive and causal for 0 < alpha <= 1; alpha = 1 is a spring
//! beside a dashpot. The stiffness grows without bound at high frequency: `fractional_zener` ends it.

use super::dynamic_stiffness::{Operating, OperatingOver, by_frequency, powers};
use super::fractional_zener::{EXPONENT, start};
use super::law::{ByFactor, ClosedForm, Declaration, Law};
use super::maxwell::RELAXATION_TIME;
use super::parameter::{Parameter, RING_INERTIA, Range, STIFFNESS};
use crate::numerics::taylor::Taylor;
use crate::numerics::{C64, ImaginaryPower, imaginary_ln, simd_elementary};
use hartog_kernel::kernel;
use std::sync::Arc;

/// Ring on a spring beside a springpot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FractionalKelvin {
    /// kg m².
    pub ring_inertia: f64,
    /// At low frequency, N m/rad, not negative.
    pub stiffness: f64,
    /// s, above zero.
    pub relaxation_time: f64,
    /// alpha, above 0 up to 1.
    pub exponent: f64,
}

/// Ring on a spring beside a springpot.
pub static FRACTIONAL_KELVIN: Declaration = Declaration {
    name: "fractional_kelvin",
    about: "A ring on filled rubber: a spring beside a fractional element.",
    parameters: &[RING_INERTIA, STIFFNESS, Parameter { range: Range::Positive, ..RELAXATION_TIME }, EXPONENT],
    build: |v| Arc::new(FractionalKelvin { ring_inertia: v[0], stiffness: v[1], relaxation_time: v[2], exponent: v[3] }),
    closed_forms: &[ClosedForm {
        name: "fractional_kelvin",
        every_mode: true,
        is_optimum: false,
        values: |ring, engine| {
            let zener = start(ring, engine);
            vec![zener[0], zener[1], zener[3], zener[4]]
        },
    }],
};

/// S at many points.
#[kernel]
fn at_each(law: &FractionalKelvin, power: ImaginaryPower, at: &[Operating], out: &mut [C64]) {
    by_frequency(at, out, |omega| law.stiffness * (1.0 + power.branchless(omega * law.relaxation_time)));
}

impl Law for FractionalKelvin {
    fn declaration(&self) -> &'static Declaration {
        &FRACTIONAL_KELVIN
    }
    fn values(&self) -> Vec<f64> {
        vec![self.ring_inertia, self.stiffness, self.relaxation_time, self.exponent]
    }
    fn ring_inertia(&self) -> f64 {
        self.ring_inertia
    }
    fn dynamic_stiffness(&self, at: Operating) -> C64 {
        self.stiffness * (1.0 + ImaginaryPower::new(self.exponent).of(at.omega * self.relaxation_time))
    }
    fn dynamic_stiffness_each(&self, at: &[Operating], out: &mut [C64]) {
        at_each(self, ImaginaryPower::new(self.exponent), at, out);
    }
    fn followed_each<'s>(&'s self, at: &'s [Operating]) -> Option<ByFactor<'s>> {
        // temperature puts its factor on the relaxation time
        let own = powers(at, self.relaxation_time, self.exponent);
        Some(Box::new(move |factor, [re, im, below]| {
            let share = self.stiffness * simd_elementary::exponential(self.exponent * factor);
            own.iter().zip(re).zip(im).for_each(|((z, re), im)| (*re, *im) = (self.stiffness + share * z.re, share * z.im));
            below.fill(1.0);
        }))
    }
    fn is_analytic(&self) -> bool {
        true
    }
    fn over(&self, values: &[Taylor], at: &OperatingOver) -> Option<Taylor> {
        let power = values[2].times(&at.omega).imaginary_power(&values[3])?;
        Some(values[1].times(&power.plus_number(C64::from(1.0))))
    }
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        let x = at.omega * self.relaxation_time;
        let z = ImaginaryPower::new(self.exponent).of(x);
        vec![C64::default(), 1.0 + z, self.stiffness * self.exponent * z / self.relaxation_time, self.stiffness * z * imaginary_ln(x)]
    }
}
