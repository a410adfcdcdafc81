//! Plane states of one normal stress s and its shear t, as nominal bending and torsion make of a fillet: each criterion of invariants asks for a figure of the path (s, t).
//!
//! The deviator in five dimensions is (s/sqrt 3, 0, t, 0, 0): its smallest ball is a circle round the path, the Tresca stress of a difference is sqrt(s²/4 + t²), and
//! the resolved shear of a plane and direction is w0 s + w3 t: its range is a width of the path. Circles, widths and the largest of convex functions are decided by the
//! corners of the convex hull.

use super::bound::Within;
use super::criterion::Path;
use super::largest_shear::{LargestShear, largest_shear};
use super::papadopoulos;
use crate::numerics::enclosing::smallest_ball;
use crate::numerics::hull::hull;
use std::cell::OnceCell;

/// The corners of the convex hull of a path, counter-clockwise, Pa.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PlaneState {
    /// Normal stress, xx.
    pub normal: Vec<f64>,
    /// Shear stress, xy.
    pub shear: Vec<f64>,
    /// Found once.
    pub(super) largest_shear: OnceCell<LargestShear>,
    circle: OnceCell<Circle>,
    mean_shear: OnceCell<f64>,
}

/// The smallest circle round the deviator's path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Circle {
    /// Amplitude of sqrt(J2), Pa.
    pub radius: f64,
    /// Its centre: normal and shear stress, Pa.
    pub centre: [f64; 2],
}

impl PlaneState {
    /// Of a path over the cycle: normal and shear stress at each sample.
    pub fn of(normal: &[f64], shear: &[f64]) -> Self {
        let corners = hull(normal, shear);
        let at = |path: &[f64]| corners.iter().map(|j| path[*j]).collect();
        Self { normal: at(normal), shear: at(shear), ..Self::default() }
    }

    /// What this path exceeds nowhere: of what nothing has asked for yet, nothing is said.
    pub(crate) fn within(&self) -> Within {
        let size = |(s, t): (&f64, &f64)| (s * s + 2.0 * t * t).sqrt();
        Within {
            sqrt_j2_amplitude: self.circle.get().map_or(f64::INFINITY, |c| c.radius),
            mean_shear: self.mean_shear.get().copied().unwrap_or(f64::INFINITY),
            hydrostatic: Path::hydrostatic(self),
            normal: self.normal.iter().zip(&self.shear).map(size).fold(0.0, f64::max),
        }
    }

    /// Whether it bears nothing at all.
    pub(crate) fn is_zero(&self) -> bool {
        self.normal.iter().chain(&self.shear).all(|s| *s == 0.0)
    }

    /// What the plane of the largest shear bears; of planes as critical that with the larger normal stress.
    pub fn largest_shear(&self) -> LargestShear {
        *self.largest_shear.get_or_init(|| largest_shear(&self.normal, &self.shear))
    }

    /// Amplitude of sqrt(J2) with the centre of its circle.
    pub fn circle(&self) -> Circle {
        *self.circle.get_or_init(|| {
            let root = 3f64.sqrt();
            let deviator: Vec<f64> = self.normal.iter().map(|s| s / root).collect();
            let ball = smallest_ball([&deviator, &self.shear]);
            Circle { radius: ball.radius, centre: [root * ball.centre[0], ball.centre[1]] }
        })
    }
}

impl Path for PlaneState {
    fn largest_shear(&self) -> Option<LargestShear> {
        Some(Self::largest_shear(self))
    }

    fn sqrt_j2_amplitude(&self) -> f64 {
        self.circle().radius
    }

    fn hydrostatic(&self) -> (f64, f64) {
        let (low, high) = self.normal.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |m, s| (m.0.min(*s), m.1.max(*s)));
        (low / 3.0, high / 3.0)
    }

    fn mesoscopic(&self, k: f64) -> f64 {
        let [s0, t0] = self.circle().centre;
        let at = |(s, t): (&f64, &f64)| (0.25 * (s - s0) * (s - s0) + (t - t0) * (t - t0)).sqrt() + k * s / 3.0;
        self.normal.iter().zip(&self.shear).map(at).fold(f64::NEG_INFINITY, f64::max)
    }

    fn mean_shear(&self) -> f64 {
        *self.mean_shear.get_or_init(|| self.turned_calipers())
    }
}

impl PlaneState {
    /// The mean shear by the directions of the general rule: between two corners that decide a width, its square is a quadratic form in moments of those directions, so that a turn of the
    /// calipers round the hull \[Shamos 1978\] is enough.
    fn turned_calipers(&self) -> f64 {
        let (s, t) = (&self.normal, &self.shear);
        let n = s.len();
        if n < 2 {
            return 0.0;
        }
        let directions = papadopoulos::directions();
        // corners that bound the path along a direction and against it, beginning with that of the normal stress
        let farther = |sign: f64| move |m: usize, i: usize| if (sign * s[i], sign * t[i]) > (sign * s[m], sign * t[m]) { i } else { m };
        let (first, last) = ((0..n).fold(0, farther(1.0)), (0..n).fold(0, farther(-1.0)));
        let (mut i, mut j, mut from, mut sum) = (first, last, 0, 0.0);
        // the first directions along which the next corner lies farther out; half a turn takes each corner once round
        let leave_i = |i: usize, from: usize| {
            let next = if i + 1 == n { 0 } else { i + 1 };
            if i == last { directions.len() } else { directions.first_along([s[next] - s[i], t[next] - t[i]], from) }
        };
        let leave_j = |j: usize, from: usize| {
            let next = if j + 1 == n { 0 } else { j + 1 };
            if j == first { directions.len() } else { directions.first_along([s[j] - s[next], t[j] - t[next]], from) }
        };
        let (mut until_i, mut until_j) = (leave_i(i, 0), leave_j(j, 0));
        while from < directions.len() {
            let until = until_i.min(until_j);
            let [ss, st, tt] = directions.moments(from, until);
            let (ds, dt) = (s[i] - s[j], t[i] - t[j]);
            sum += 0.25 * (ss * ds * ds + 2.0 * st * ds * dt + tt * dt * dt);
            from = until;
            if until_i == until && i != last {
                i = if i + 1 == n { 0 } else { i + 1 };
                until_i = leave_i(i, from);
            }
            if until_j == until && j != first {
                j = if j + 1 == n { 0 } else { j + 1 };
                until_j = leave_j(j, from);
            }
        }
        (5.0 * sum).sqrt()
    }
}
