//! Stress on a material plane: the path of its shear stress with the smallest circle round it, and its normal stress.

use super::history::{History, Weights};
use crate::numerics::elementary::Elementary;
use crate::numerics::enclosing::{Ball, smallest_ball_from};
use hartog_kernel::kernel;

/// A plane by its normal, (sin phi cos theta, sin phi sin theta, cos phi); n and -n are one plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// From x towards y, rad.
    pub theta: f64,
    /// From z, rad.
    pub phi: f64,
}

impl Plane {
    /// The plane of a normal of any length.
    pub fn of([x, y, z]: [f64; 3]) -> Self {
        // the half of the sphere with z above zero stands for both
        let sign = if z < 0.0 || (z == 0.0 && (y < 0.0 || (y == 0.0 && x < 0.0))) { -1.0 } else { 1.0 };
        let (x, y, z) = (sign * x, sign * y, sign * z);
        Self { theta: y.arctangent(x), phi: x.hypotenuse(y).arctangent(z) }
    }

    /// Its normal.
    pub fn normal(&self) -> [f64; 3] {
        let ((st, ct), (sp, cp)) = (self.theta.sine_cosine(), self.phi.sine_cosine());
        [sp * ct, sp * st, cp]
    }

    /// Two directions on it, at right angles: of growing phi, of growing theta.
    pub(crate) fn directions(&self) -> [[f64; 3]; 2] {
        let ((st, ct), (sp, cp)) = (self.theta.sine_cosine(), self.phi.sine_cosine());
        [[cp * ct, cp * st, -sp], [-st, ct, 0.0]]
    }

    /// The plane a little further: angles along its two directions.
    #[must_use]
    pub fn moved(&self, a: f64, b: f64) -> Self {
        let (n, [u, v]) = (self.normal(), self.directions());
        Self::of([0, 1, 2].map(|d| n[d] + a.tangent() * u[d] + b.tangent() * v[d]))
    }
}

/// Weights of the stress resolved along `m` on the plane of normal `n`: m . sigma n.
pub fn resolved(n: &[f64; 3], m: &[f64; 3]) -> Weights {
    [m[0] * n[0], m[1] * n[1], m[2] * n[2], m[0] * n[1] + m[1] * n[0], m[1] * n[2] + m[2] * n[1], m[2] * n[0] + m[0] * n[2]]
}

/// How the amplitude of a shear path is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Amplitude {
    /// Radius of the smallest circle round it.
    #[default]
    Circle,
    /// Half its longest chord, which is also its longest projection: too small by up to 2/sqrt 3 where the path is round, and its middle is not unique
    /// \[Minucci 2010\] p. 30.
    Chord,
}

/// Buffers of one thread.
#[derive(Debug, Clone, Default)]
pub struct Scratch {
    shear: [Vec<f64>; 2],
    /// The last circle: those of neighbouring planes are held by the same samples.
    last: Option<Ball<2>>,
}

/// What a plane bears over the cycle, Pa.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneStress {
    /// Amplitude of the shear stress.
    pub shear_amplitude: f64,
    /// Largest normal stress.
    pub normal_max: f64,
    /// Largest over the cycle of the distance to the circle's centre and the weighted hydrostatic stress.
    pub dang_van: f64,
}

impl Scratch {
    /// Shear path on a plane, with its circle.
    pub fn circle(&mut self, history: &History, plane: &Plane) -> Ball<2> {
        let n = plane.normal();
        for (direction, out) in plane.directions().iter().zip(&mut self.shear) {
            history.project(&resolved(&n, direction), out);
        }
        let last = self.last.filter(|b| b.support().iter().all(|i| *i < history.len()));
        let known = last.as_ref().map_or(&[][..], |b| b.support());
        let circle = smallest_ball_from([&self.shear[0], &self.shear[1]], known);
        self.last = Some(circle);
        circle
    }

    /// Shear path of the last plane asked for.
    pub fn path(&self) -> [&[f64]; 2] {
        [&self.shear[0], &self.shear[1]]
    }

    /// Circle of the last plane asked for.
    pub fn last(&self) -> Option<Ball<2>> {
        self.last
    }

    /// Everything on a plane. `dang_van`: weight of the hydrostatic stress, and that stress at every sample.
    pub fn plane_stress(&mut self, history: &History, plane: &Plane, amplitude: Amplitude, dang_van: Option<(f64, &[f64])>) -> PlaneStress {
        let n = plane.normal();
        let circle = self.circle(history, plane);
        let (_, normal_max) = history.range(&resolved(&n, &n));
        let dang_van = dang_van.map_or(0.0, |(k, p)| mesoscopic(&self.shear[0], &self.shear[1], circle.centre, k, p));
        let shear_amplitude = match amplitude {
            Amplitude::Circle => circle.radius,
            Amplitude::Chord => self.half_chord(),
        };
        PlaneStress { shear_amplitude, normal_max, dang_van }
    }

    fn half_chord(&mut self) -> f64 {
        let [u, v] = &self.shear;
        let from = |i: usize| (0..i).map(|j| (u[i] - u[j]).hypotenuse(v[i] - v[j])).fold(0.0, f64::max);
        0.5 * (0..u.len()).map(from).fold(0.0, f64::max)
    }
}

/// Largest distance to the centre with `k` times the hydrostatic stress at the same time.
#[kernel]
fn mesoscopic(u: &[f64], v: &[f64], centre: [f64; 2], k: f64, p: &[f64]) -> f64 {
    const LANES: usize = 16;
    let value = |u: f64, v: f64, p: f64| {
        let (x, y) = (u - centre[0], v - centre[1]);
        (x * x + y * y).sqrt() + k * p
    };
    let mut most = [f64::NEG_INFINITY; LANES];
    let (us, vs, ps) = (u.as_chunks::<LANES>(), v.as_chunks::<LANES>(), p.as_chunks::<LANES>());
    for ((u, v), p) in us.0.iter().zip(vs.0).zip(ps.0) {
        for l in 0..LANES {
            let at = value(u[l], v[l], p[l]);
            most[l] = if at > most[l] { at } else { most[l] };
        }
    }
    let rest = us.1.iter().zip(vs.1).zip(ps.1).map(|((u, v), p)| value(*u, *v, *p));
    most.into_iter().chain(rest).fold(f64::NEG_INFINITY, f64::max)
}
