//! Plane states of one normal stress s and its shear t, as nominal bending and torsion make of a fillet: each criterion of invariants asks for a figure of the path (s, t).
//!
//! The deviator in five dimensions is (s/sqrt 3, 0, t, 0, 0): its smallest ball is a circle round the path, the Tresca stress of a difference is sqrt(s²/4 + t²), and
//! the resolved shear of a plane and direction is w0 s + w3 t: its range is a width of the path. Circles, widths and the largest of convex functions are decided by the
//! corners of the convex hull.

use super::criterion::Path;
use super::history::History;
use super::largest_shear::{LargestShear, largest_shear};
use super::papadopoulos;
use crate::numerics::enclosing::{smallest_ball, smallest_ball_from};
use crate::numerics::hull::hull;
use crate::numerics::projections::range;
use hartog_kernel::kernel;
use std::borrow::Cow;
use std::cell::OnceCell;

/// A path over the cycle, Pa. What asks for its corners only finds them first.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneState {
    samples: Points,
    /// The corners of its convex hull, counter-clockwise.
    corners: OnceCell<Points>,
    /// Found once.
    pub(super) largest_shear: OnceCell<LargestShear>,
    circle: OnceCell<Circle>,
    mean_shear: OnceCell<f64>,
}

/// Points of a path.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Points {
    /// Normal stress, xx, Pa.
    pub normal: Vec<f64>,
    /// Shear stress, xy, Pa.
    pub shear: Vec<f64>,
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
    /// Of normal and shear stress at each sample.
    pub fn of(normal: Vec<f64>, shear: Vec<f64>) -> Self {
        let (corners, largest_shear, circle, mean_shear) = Default::default();
        Self { samples: Points { normal, shear }, corners, largest_shear, circle, mean_shear }
    }

    /// The corners of its convex hull, counter-clockwise.
    pub(crate) fn corners(&self) -> &Points {
        self.corners.get_or_init(|| {
            let Points { normal, shear } = &self.samples;
            let corners = hull(normal, shear);
            let at_corners = |path: &[f64]| corners.iter().map(|j| path[*j]).collect();
            Points { normal: at_corners(normal), shear: at_corners(shear) }
        })
    }

    /// Its corners where they are known, else all samples: what is the largest of a convex function is the same of both.
    fn points(&self) -> &Points {
        self.corners.get().unwrap_or(&self.samples)
    }

    /// Whether it bears nothing at all.
    pub(crate) fn is_zero(&self) -> bool {
        self.points().normal.iter().chain(&self.points().shear).all(|s| *s == 0.0)
    }

    /// What the plane of the largest shear bears; of planes as critical that with the larger normal stress.
    pub fn largest_shear(&self) -> LargestShear {
        *self.largest_shear.get_or_init(|| largest_shear(&self.corners().normal, &self.corners().shear))
    }

    /// Amplitude of sqrt(J2) with the centre of its circle.
    pub fn circle(&self) -> Circle {
        *self.circle.get_or_init(|| {
            let root = 3f64.sqrt();
            let Points { normal, shear } = self.points();
            let deviator: Vec<f64> = normal.iter().map(|s| s / root).collect();
            let known = if shear.len() > MANY { held_by_some(&deviator, shear) } else { Vec::new() };
            let ball = smallest_ball_from([&deviator, shear], &known);
            Circle { radius: ball.radius, centre: [root * ball.centre[0], ball.centre[1]] }
        })
    }
}

impl Path for PlaneState {
    fn history(&self) -> Cow<'_, History> {
        let Points { normal, shear } = self.corners();
        Cow::Owned(History::plane_state(normal.clone(), shear.clone()))
    }

    fn largest_shear(&self) -> Option<LargestShear> {
        Some(Self::largest_shear(self))
    }

    fn sqrt_j2_amplitude(&self) -> f64 {
        self.circle().radius
    }

    fn hydrostatic(&self) -> (f64, f64) {
        let (low, high) = range(&self.points().normal);
        (low / 3.0, high / 3.0)
    }

    fn mesoscopic(&self, k: f64) -> f64 {
        let Points { normal, shear } = self.points();
        largest_sum(normal, shear, self.circle().centre, k)
    }

    fn mean_shear(&self) -> f64 {
        *self.mean_shear.get_or_init(|| self.turned_calipers())
    }
}

/// Of more points than this, the circle of some is found first.
const MANY: usize = 100;
/// Every so many.
const SOME: usize = 8;

/// Indices of the points that hold the circle of some of them.
fn held_by_some(x: &[f64], y: &[f64]) -> Vec<usize> {
    let some = |v: &[f64]| v.iter().step_by(SOME).copied().collect::<Vec<f64>>();
    smallest_ball([&some(x), &some(y)]).support().iter().map(|i| SOME * i).collect()
}

/// Points that are looked at together.
const LANES: usize = 16;

/// Largest sum of the Tresca stress about a centre and of `k` times the hydrostatic stress.
#[kernel]
fn largest_sum(normal: &[f64], shear: &[f64], [s0, t0]: [f64; 2], k: f64) -> f64 {
    let sum = |s: f64, t: f64| (0.25 * (s - s0) * (s - s0) + (t - t0) * (t - t0)).sqrt() + k * s / 3.0;
    let (s, t) = (normal.as_chunks::<LANES>(), shear.as_chunks::<LANES>());
    let mut most = [f64::NEG_INFINITY; LANES];
    for (s, t) in s.0.iter().zip(t.0) {
        for l in 0..LANES {
            let own = sum(s[l], t[l]);
            most[l] = if own > most[l] { own } else { most[l] };
        }
    }
    let rest = s.1.iter().zip(t.1).map(|(s, t)| sum(*s, *t));
    most.into_iter().chain(rest).fold(f64::NEG_INFINITY, f64::max)
}

impl PlaneState {
    /// The mean shear by the directions of the general rule: between two corners that decide a width, its square is a quadratic form in moments of those directions, so that a turn of the
    /// calipers round the hull \[Shamos 1978\] is enough.
    fn turned_calipers(&self) -> f64 {
        let Points { normal: s, shear: t } = self.corners();
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
