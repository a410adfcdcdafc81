//! The inner loop of the receptance method: one rank-one update a point, over arrays of points.

use crate::absorber::{Absorber, Law, Mounted, Operating, SpringAndDamper};
use crate::numerics::C64;
use crate::numerics::elementary::Elementary;
use crate::numerics::piecewise::Piecewise;
use hartog_kernel::kernel;
use std::sync::OnceLock;

/// One table entry a point, in separate arrays so that the loop runs several points at a time.
#[derive(Debug, Clone, Default)]
pub(crate) struct Points {
    /// Circular frequency, rad/s.
    pub omega: Vec<f64>,
    /// Speed of the shaft, rad/s.
    pub shaft_speed: Vec<f64>,
    /// Output without absorber, y0.
    pub y0: [Vec<f64>; 2],
    /// y0 H - h u0: what the update adds to it, per dynamic stiffness (h: output per unit torque at the hub, u0: angle of the hub).
    pub g: [Vec<f64>; 2],
    /// Receptance of the hub, H.
    pub h: [Vec<f64>; 2],
    /// Whether the output is a ring's twist: then y0 holds the hub's angle.
    pub ring: bool,
    /// Their frequencies' logarithms in pieces, found once the points are all there: nothing where a law at every point costs no more.
    pub(super) pieces: OnceLock<Option<Pieces>>,
}

/// The points' frequencies in pieces.
#[derive(Debug, Clone)]
pub(super) struct Pieces {
    logarithms: Piecewise,
    /// Where a law is computed.
    nodes: Vec<Operating>,
}

/// Width of a piece of ln omega: where S is analytic within π/2, polynomials through twelve nodes err by 1e-14.
const PIECE: f64 = 0.42;
/// A law is computed at the nodes where there are this many times as many points.
const WORTH: usize = 4;

impl Points {
    /// Where each point is, from `first` on.
    pub(crate) fn operating(&self, first: usize, count: usize) -> Vec<Operating> {
        let range = first..first + count;
        self.omega[range.clone()]
            .iter()
            .zip(&self.shaft_speed[range])
            .map(|(omega, s)| Operating { omega: *omega, shaft_speed: *s })
            .collect()
    }

    /// S of a law at points from `first` on.
    fn stiffness(&self, law: &dyn Law, first: usize, out: &mut [C64]) {
        let pieces = || {
            let all = Piecewise::new(&self.omega.iter().map(|w| w.logarithm()).collect::<Vec<_>>(), PIECE);
            let logarithms = all.filter(|p| WORTH * p.nodes().len() < self.omega.len())?;
            let exponential = |x: &f64| x.exponential();
            let nodes = logarithms.nodes().iter().map(exponential).map(|omega| Operating { omega, shaft_speed: omega }).collect();
            Some(Pieces { logarithms, nodes })
        };
        let whole = first == 0 && out.len() == self.omega.len() && law.is_analytic();
        match self.pieces.get_or_init(pieces).as_ref().filter(|_| whole) {
            Some(pieces) => {
                let mut values = vec![C64::ZERO; pieces.nodes.len()];
                law.dynamic_stiffness_each(&pieces.nodes, &mut values);
                pieces.logarithms.values(&values, out);
            }
            None => law.dynamic_stiffness_each(&self.operating(first, out.len()), out),
        }
    }
}

/// S of a law as the loop needs it.
#[derive(Debug, Clone, Copy)]
enum Spring<'a> {
    Constant(SpringAndDamper),
    /// At every point.
    Each(&'a [C64]),
}

/// Inertias as the loop needs them, kg m².
#[derive(Debug, Clone, Copy)]
struct Inertias {
    ring: f64,
    hub: f64,
}

/// Numerator and denominator of y = (y0 + z g)/(1 + z H), both times the denominator of z.
#[inline(always)]
fn fraction(
    v: &Inertias,
    ring_output: bool,
    at: (f64, (f64, f64)),
    y0: (f64, f64),
    g: (f64, f64),
    h: (f64, f64),
) -> ((f64, f64), (f64, f64)) {
    let (omega, (s_re, s_im)) = at;
    let omega2 = omega * omega;
    let ring = omega2 * v.ring;
    let hub = omega2 * v.hub;
    let (d_re, d_im) = (s_re - ring, s_im);
    let (n_re, n_im) = (-ring * s_re - hub * d_re, -ring * s_im - hub * d_im);
    let (a_re, a_im) = if ring_output { (ring, 0.0) } else { (d_re, d_im) };
    let top = (y0.0 * a_re - y0.1 * a_im + n_re * g.0 - n_im * g.1, y0.0 * a_im + y0.1 * a_re + n_re * g.1 + n_im * g.0);
    let bottom = (d_re + n_re * h.0 - n_im * h.1, d_im + n_re * h.1 + n_im * h.0);
    (top, bottom)
}

macro_rules! each_point {
    ($p:expr, $v:expr, $spring:expr, $first:expr, $out:expr, $value:expr) => {{
        // slices of one length, so that the loop has no bounds checks
        let (first, n) = ($first, $out.len());
        let (omega, out) = (&$p.omega[first..][..n], &mut $out[..n]);
        let (y_re, y_im) = (&$p.y0[0][first..][..n], &$p.y0[1][first..][..n]);
        let (g_re, g_im) = (&$p.g[0][first..][..n], &$p.g[1][first..][..n]);
        let (h_re, h_im) = (&$p.h[0][first..][..n], &$p.h[1][first..][..n]);
        match $spring {
            Spring::Constant(s) => {
                for i in 0..n {
                    let at = (omega[i], (s.stiffness, omega[i] * s.damping));
                    let (top, bottom) = fraction($v, $p.ring, at, (y_re[i], y_im[i]), (g_re[i], g_im[i]), (h_re[i], h_im[i]));
                    out[i] = $value(top, bottom);
                }
            }
            Spring::Each(s) => {
                let s = &s[..n];
                for i in 0..n {
                    let at = (omega[i], (s[i].re, s[i].im));
                    let (top, bottom) = fraction($v, $p.ring, at, (y_re[i], y_im[i]), (g_re[i], g_im[i]), (h_re[i], h_im[i]));
                    out[i] = $value(top, bottom);
                }
            }
        }
    }};
}

/// Inertias and S of an absorber at the points, given to `job`.
fn with_spring<T>(points: &Points, mounted: &Mounted, first: usize, count: usize, job: impl FnOnce(&Inertias, Spring) -> T) -> T {
    let (hub, ring) = (mounted.hub(), mounted.absorber.ring_inertia());
    let Absorber::Ring(law) = &mounted.absorber else {
        // without a ring of its own any stiffness does
        return job(&Inertias { ring: 0.0, hub: hub + ring }, Spring::Constant(SpringAndDamper { stiffness: 1.0, damping: 0.0 }));
    };
    let inertias = Inertias { ring, hub };
    match law.spring_and_damper() {
        Some(s) => job(&inertias, Spring::Constant(s)),
        None => {
            let mut each = vec![C64::ZERO; count];
            points.stiffness(law.as_ref(), first, &mut each);
            job(&inertias, Spring::Each(&each))
        }
    }
}

/// Phasors of an absorber at the points from `first` on, as many as there is room for.
pub fn phasors(points: &Points, mounted: &Mounted, first: usize, out: &mut [C64]) {
    with_spring(points, mounted, first, out.len(), |inertias, spring| phasors_with(points, inertias, spring, first, out));
}

#[kernel]
fn phasors_with(points: &Points, inertias: &Inertias, spring: Spring, first: usize, out: &mut [C64]) {
    each_point!(points, inertias, spring, first, out, |top: (f64, f64), bottom: (f64, f64)| {
        let scale = 1.0 / (bottom.0 * bottom.0 + bottom.1 * bottom.1);
        C64::new((top.0 * bottom.0 + top.1 * bottom.1) * scale, (top.1 * bottom.0 - top.0 * bottom.1) * scale)
    });
}

/// Squares of the magnitudes at every point: a root would cost as much as all the rest.
pub fn squares(points: &Points, mounted: &Mounted, out: &mut [f64]) {
    with_spring(points, mounted, 0, out.len(), |inertias, spring| squares_with(points, inertias, spring, out));
}

#[kernel]
fn squares_with(points: &Points, inertias: &Inertias, spring: Spring, out: &mut [f64]) {
    each_point!(points, inertias, spring, 0, out, |top: (f64, f64), bottom: (f64, f64)| {
        (top.0 * top.0 + top.1 * top.1) / (bottom.0 * bottom.0 + bottom.1 * bottom.1)
    });
}
