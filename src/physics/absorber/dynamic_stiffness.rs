//! Where a law is asked for its dynamic stiffness, and that of a spring and a damper.

use crate::numerics::taylor::Taylor;
use crate::numerics::{C64, ImaginaryPower};
use hartog_kernel::kernel;

/// Where a law is asked for its stiffness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Operating {
    /// Circular frequency of the motion, rad/s.
    pub omega: f64,
    /// Speed of the shaft, rad/s.
    pub shaft_speed: f64,
}

/// The same where they are anything that models hold, complex numbers with them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OperatingOver {
    /// Circular frequency of the motion, rad/s.
    pub omega: Taylor,
    /// Speed of the shaft, rad/s.
    pub shaft_speed: Taylor,
}

impl From<Operating> for OperatingOver {
    fn from(at: Operating) -> Self {
        let [omega, shaft_speed] = [at.omega, at.shaft_speed].map(|x| Taylor::constant(C64::from(x)));
        Self { omega, shaft_speed }
    }
}

/// Points that are computed together, and of which a loop takes so many at a time.
const TOGETHER: usize = 32;
const LANES: usize = 8;

/// S at many points by a function of the frequency that has no branch: a loop over numbers that follow each other, in whole groups, becomes vector instructions.
#[inline(always)]
pub(super) fn by_frequency(at: &[Operating], out: &mut [C64], of: impl Fn(f64) -> C64) {
    for (at, out) in at.chunks(TOGETHER).zip(out.chunks_mut(TOGETHER)) {
        let (mut omega, mut re, mut im) = ([1.0; TOGETHER], [0.0; TOGETHER], [0.0; TOGETHER]);
        omega.iter_mut().zip(at).for_each(|(omega, at)| *omega = at.omega);
        let whole = at.len().next_multiple_of(LANES);
        for ((omega, re), im) in omega[..whole].iter().zip(&mut re[..whole]).zip(&mut im[..whole]) {
            let s = of(*omega);
            (*re, *im) = (s.re, s.im);
        }
        out.iter_mut().zip(re.into_iter().zip(im)).for_each(|(out, (re, im))| *out = C64::new(re, im));
    }
}

/// (i omega tau)^alpha at many points, for tau > 0.
#[kernel]
pub(super) fn powers(at: &[Operating], tau: f64, alpha: f64) -> Vec<C64> {
    let (power, mut out) = (ImaginaryPower::new(alpha), vec![C64::default(); at.len()]);
    by_frequency(at, &mut out, |omega| power.branchless(omega * tau));
    out
}

/// A spring and a viscous damper side by side: S = k + i omega c.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringAndDamper {
    /// N m/rad.
    pub stiffness: f64,
    /// N m s/rad.
    pub damping: f64,
}

impl SpringAndDamper {
    /// S = k + i omega c, N m/rad.
    pub fn dynamic_stiffness(self, omega: f64) -> C64 {
        C64::new(self.stiffness, omega * self.damping)
    }
}
