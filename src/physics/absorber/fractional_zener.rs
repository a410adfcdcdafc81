//! Ring on rubber from its rubbery to its glassy end, fractional Zener: S = k (1 + r (i omega tau)^alpha)/(1 + (i omega tau)^alpha).
//!
//! k at low frequency, r k at high frequency. Thermodynamically admissible for r > 1 and 0 < alpha <= 1 \[Bagley & Torvik 1986\].

use super::closed_forms::EngineMode;
use super::dynamic_stiffness::{Operating, OperatingOver, by_frequency, powers};
use super::law::{ByFactor, ClosedForm, Declaration, Law};
use super::maxwell::RELAXATION_TIME;
use super::parameter::{Parameter, RING_INERTIA, Range, STIFFNESS, of_material};
use crate::numerics::elementary::ComplexElementary;
use crate::numerics::taylor::Taylor;
use crate::numerics::{C64, ImaginaryPower, imaginary_ln, simd_elementary};
use hartog_kernel::kernel;
use std::sync::Arc;

/// Ring on rubber of four numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FractionalZener {
    /// kg m².
    pub ring_inertia: f64,
    /// At low frequency, N m/rad, not negative.
    pub stiffness: f64,
    /// Stiffness at high over that at low frequency, above one.
    pub glass_ratio: f64,
    /// s, above zero.
    pub relaxation_time: f64,
    /// alpha, above 0 up to 1.
    pub exponent: f64,
}

/// Power of the frequency that moduli rise with.
pub(super) const EXPONENT: Parameter = of_material(
    ("fractional_exponent", "alpha", "Exponent of the fractional derivative."),
    Range::Within(0.05, 1.0),
    |_| (0.05, 1.0),
    |_| 0.5,
);

pub(super) const GLASS_RATIO: Parameter =
    of_material(("glass_ratio", "r", "Stiffness at infinite frequency over that at none."), Range::Above(1.0), |_| (1.01, 1e4), |_| 20.0);

/// Ring on rubber of four numbers.
pub static FRACTIONAL_ZENER: Declaration = Declaration {
    name: "fractional_zener",
    about: "A ring on rubber from its rubbery to its glassy end.",
    parameters: &[RING_INERTIA, STIFFNESS, GLASS_RATIO, Parameter { range: Range::Positive, ..RELAXATION_TIME }, EXPONENT],
    build: |v| Arc::new(FractionalZener { ring_inertia: v[0], stiffness: v[1], glass_ratio: v[2], relaxation_time: v[3], exponent: v[4] }),
    closed_forms: &[ClosedForm { name: "fractional_zener", every_mode: true, is_optimum: false, values: start }],
};

/// A start, no optimum: at the frequency of the best hysteretic ring the stiffness of that ring, by a springpot of exponent 0.5 a fifth as stiff as the spring, far from the glassy end.
pub(super) fn start(ring_inertia: f64, engine: EngineMode) -> Vec<f64> {
    let omega = engine.omega / (1.0 + ring_inertia / engine.inertia);
    let time = 0.04 / omega;
    let z = C64::new(0.0, omega * time).square_root();
    vec![ring_inertia, ring_inertia * omega * omega / (1.0 + z.re), 1e3, time, 0.5]
}

impl FractionalZener {
    /// S of z = (i omega tau)^alpha.
    #[inline(always)]
    pub(super) fn stiffness_of(&self, z: C64) -> C64 {
        // one division by a real number costs half of one by a complex one; the imaginary part of (1 + r z)(1 + z*) is (r - 1) Im z
        let (above, below) = (1.0 + self.glass_ratio * z, 1.0 + z);
        let scale = self.stiffness / below.norm_sqr();
        C64::new((above.re * below.re + above.im * below.im) * scale, (self.glass_ratio - 1.0) * z.im * scale)
    }
}

/// S at many points.
#[kernel]
fn at_each(law: &FractionalZener, power: ImaginaryPower, at: &[Operating], out: &mut [C64]) {
    by_frequency(at, out, |omega| law.stiffness_of(power.branchless(omega * law.relaxation_time)));
}

/// S of multiples of some (i omega tau)^alpha, by numerator and denominator.
#[kernel]
fn stiffness_each(law: &FractionalZener, share: f64, [z_re, z_im]: &[Vec<f64>; 2], [out_re, out_im, out_below]: [&mut [f64]; 3]) {
    let n = z_re.len();
    let (z_re, z_im, out_re, out_im, out_below) = (&z_re[..n], &z_im[..n], &mut out_re[..n], &mut out_im[..n], &mut out_below[..n]);
    for i in 0..n {
        let (x, y) = (share * z_re[i], share * z_im[i]);
        let (above, below) = (1.0 + law.glass_ratio * x, 1.0 + x);
        out_re[i] = (above * below + law.glass_ratio * y * y) * law.stiffness;
        out_im[i] = (law.glass_ratio - 1.0) * y * law.stiffness;
        out_below[i] = below * below + y * y;
    }
}

impl Law for FractionalZener {
    fn declaration(&self) -> &'static Declaration {
        &FRACTIONAL_ZENER
    }
    fn values(&self) -> Vec<f64> {
        vec![self.ring_inertia, self.stiffness, self.glass_ratio, self.relaxation_time, self.exponent]
    }
    fn ring_inertia(&self) -> f64 {
        self.ring_inertia
    }
    fn dynamic_stiffness(&self, at: Operating) -> C64 {
        self.stiffness_of(ImaginaryPower::new(self.exponent).of(at.omega * self.relaxation_time))
    }
    fn dynamic_stiffness_each(&self, at: &[Operating], out: &mut [C64]) {
        at_each(self, ImaginaryPower::new(self.exponent), at, out);
    }
    fn followed_each<'s>(&'s self, at: &'s [Operating]) -> Option<ByFactor<'s>> {
        // temperature puts its factor on the relaxation time
        let own = powers(at, self.relaxation_time, self.exponent);
        let own = [own.iter().map(|z| z.re).collect(), own.iter().map(|z| z.im).collect()];
        Some(Box::new(move |factor, out| stiffness_each(self, simd_elementary::exponential(self.exponent * factor), &own, out)))
    }
    fn is_analytic(&self) -> bool {
        true
    }
    fn over(&self, values: &[Taylor], at: &OperatingOver) -> Option<Taylor> {
        let power = values[3].times(&at.omega).imaginary_power(&values[4])?;
        // k (r + (1 - r)/(1 + z))
        let glassy = values[2].times_number(C64::from(-1.0)).plus_number(C64::from(1.0));
        let share = values[2].plus(&glassy.times(&power.plus_number(C64::from(1.0)).inverse()?));
        Some(values[1].times(&share))
    }
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        let x = at.omega * self.relaxation_time;
        let z = ImaginaryPower::new(self.exponent).of(x);
        let by_power = self.stiffness * (self.glass_ratio - 1.0) / ((1.0 + z) * (1.0 + z));
        vec![
            C64::default(),
            (1.0 + self.glass_ratio * z) / (1.0 + z),
            self.stiffness * z / (1.0 + z),
            by_power * self.exponent * z / self.relaxation_time,
            by_power * z * imaginary_ln(x),
        ]
    }
}
