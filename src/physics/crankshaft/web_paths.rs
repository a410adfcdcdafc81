//! What points with stresses per unit load do not exceed under a torque that is known over the whole cycle: by the corners of the path of all loads of their web, which they share.

use super::load_paths::{LANES, LoadPath};
use super::unit_load_bounds::{PRINCIPAL, UnitPoint};
use super::unit_loads::UnitLoads;
use crate::fatigue::multiaxial::bound::Within;
use crate::fatigue::multiaxial::history::deviator_of;
use crate::fatigue::multiaxial::invariants::tresca;
use crate::fatigue::multiaxial::{Criterion, LoadShares, Shear};
use hartog_kernel::kernel;
use std::cell::OnceCell;

/// Steps of the centre of a ball towards the point farthest from it, of this share over their number \[Badoiu & Clarkson 2003\]: its radius is then within two per cent of the smallest one.
const STEPS: usize = 8;
const STEP: f64 = 0.2;
/// Pairs of the four loads.
const PAIRS: [(usize, usize); 10] = [(0, 0), (1, 1), (2, 2), (3, 3), (0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];

const UNBOUNDED: Within = Within {
    sqrt_j2_amplitude: f64::INFINITY,
    shear: f64::INFINITY,
    mean_shear: f64::INFINITY,
    hydrostatic: (f64::NEG_INFINITY, f64::INFINITY),
    middle: None,
    normal: f64::INFINITY,
};

/// The path of the four loads of a web over the cycle.
#[derive(Debug)]
pub(super) struct WebPath {
    path: LoadPath<4>,
    /// Products of two loads at every corner, those of different ones twice.
    products: [Vec<f64>; PAIRS.len()],
    ellipsoid: OnceCell<[[f64; 4]; 4]>,
    shares: OnceCell<LoadShares>,
    /// The same where the torque is larger, if that is asked for.
    risen: Option<Box<Self>>,
}

/// A ball round the deviators of a point at the corners.
struct Ball {
    /// Loads of its centre, less their middles.
    centre: [f64; 4],
    /// Of its radius.
    square: f64,
}

impl Ball {
    fn radius(&self) -> f64 {
        self.square.max(0.0).sqrt()
    }
}

impl WebPath {
    fn new(path: LoadPath<4>, risen: Option<Box<Self>>) -> Self {
        let product = |(a, b): (usize, usize)| {
            let times = if a == b { 1.0 } else { 2.0 };
            path.corners[a].iter().zip(&path.corners[b]).map(|(x, y)| times * x * y).collect()
        };
        let products = PAIRS.map(product);
        Self { path, products, ellipsoid: OnceCell::new(), shares: OnceCell::new(), risen }
    }

    /// Of moment, moment across the throw, shear force and torque at every sample, and where the torque is up to `rise` times as far from its mean.
    pub fn of(loads: [&[f64]; 4], rise: f64, mean_torque: f64) -> Self {
        let path = LoadPath::of(loads);
        let risen = (rise > 1.0).then(|| Box::new(Self::new(path.risen(rise, mean_torque), None)));
        Self::new(path, risen)
    }

    /// Where the torque is larger; itself where that was not asked for.
    pub fn risen(&self) -> &Self {
        self.risen.as_deref().unwrap_or(self)
    }

    /// What a point does not exceed, as far as a criterion asks for it: nothing else has a bound.
    pub fn within(&self, criterion: Criterion, point: &UnitPoint) -> Within {
        let apart = self.path.apart(point.lengths.into_iter());
        let mut within = UNBOUNDED;
        if criterion.shear() == Shear::Mean {
            within.mean_shear = self.mean_shear(point) + apart;
        } else {
            within.sqrt_j2_amplitude = self.ball(point).radius() + apart;
            within.shear = within.sqrt_j2_amplitude;
        }
        self.pressed(criterion, point, within)
    }

    /// The same more closely, at a higher cost; nothing where bounds say no more.
    pub(crate) fn closely(&self, criterion: Criterion, point: &UnitPoint, units: &UnitLoads) -> Option<Within> {
        let apart = self.path.apart(point.lengths.into_iter());
        let tensors = [units.moment, units.tangential, units.shear, units.torque];
        let mut within = UNBOUNDED;
        if criterion.shear() == Shear::Mean {
            let shares = self.shares.get_or_init(|| LoadShares::of(self.corners()));
            within.mean_shear = shares.mean_shear(&tensors.each_ref().map(deviator_of)) + apart;
        } else if criterion.shear() == Shear::Planes {
            within.shear = self.tresca(&tensors, point, &self.ball(point)) + apart;
        } else {
            return None;
        }
        Some(self.pressed(criterion, point, within))
    }

    fn len(&self) -> usize {
        self.path.corners[0].len()
    }

    fn corners(&self) -> [&[f64]; 4] {
        self.path.corners.each_ref().map(Vec::as_slice)
    }

    /// With hydrostatic stresses, and normal ones where a criterion asks for them.
    fn pressed(&self, criterion: Criterion, point: &UnitPoint, within: Within) -> Within {
        let (h, path) = (&point.hydrostatic, &self.path);
        let middle: f64 = (0..4).map(|l| h[l] * path.middle[l]).sum();
        let off = path.apart(h.iter().map(|h| h.abs()));
        let (low, high) = ends(self.corners(), h);
        let normal = if criterion.asks_for_normal_stress() {
            // the deviator of no load is that of the middles away from the corners
            let (slope, square) = from(point, &path.middle.map(|m| -m));
            let most = largest_normal(self.corners(), (h, middle), &self.squares(point), (slope, square));
            most + off + PRINCIPAL * path.apart(point.lengths.into_iter())
        } else {
            f64::INFINITY
        };
        Within { hydrostatic: (middle + low - off, middle + high + off), normal, ..within }
    }

    /// Squares of the lengths of the deviators of a point at the corners, less that of the middles.
    fn squares(&self, point: &UnitPoint) -> Vec<f64> {
        let mut squares = vec![0.0; self.len()];
        combine(self.products.each_ref().map(Vec::as_slice), &PAIRS.map(|(a, b)| point.products[a][b]), &mut squares);
        squares
    }

    fn ball(&self, point: &UnitPoint) -> Ball {
        let (corners, squares) = (self.corners(), self.squares(point));
        let corner_at = |k: usize| corners.map(|row| row[k]);
        let farthest_from = |centre: &[f64; 4]| {
            let (slope, square) = from(point, centre);
            let (k, value) = farthest(corners, &squares, slope);
            (k, value + square)
        };
        let mut best = Ball { centre: [0.0; 4], square: f64::INFINITY };
        // the middle of a long chord is a good centre to begin with
        let (first, square) = farthest_from(&best.centre);
        best.square = square;
        let (second, _) = farthest_from(&corner_at(first));
        let mut centre: [f64; 4] = std::array::from_fn(|l| 0.5 * (corners[l][first] + corners[l][second]));
        for step in 0..STEPS {
            let (far, square) = farthest_from(&centre);
            if square < best.square {
                best = Ball { centre, square };
            }
            let share = STEP / (step as f64 + 1.5);
            centre = std::array::from_fn(|l| centre[l] + share * (corners[l][far] - centre[l]));
        }
        best
    }

    /// Mean resolved shear by an ellipsoid round the path: half the range along w is at most the root of w' D A D' w, whose mean over planes and
    /// directions is a fifth of the trace of A G.
    fn mean_shear(&self, point: &UnitPoint) -> f64 {
        let a = self.ellipsoid.get_or_init(|| self.path.ellipsoid());
        let trace: f64 = (0..4).map(|i| (0..4).map(|j| a[i][j] * point.products[i][j]).sum::<f64>()).sum();
        trace.max(0.0).sqrt()
    }

    /// Largest Tresca stress at the corners about the centre of a ball: no plane has a larger shear amplitude.
    fn tresca(&self, tensors: &[[f64; 6]; 4], point: &UnitPoint, ball: &Ball) -> f64 {
        let deviators = tensors.each_ref().map(deviator_of);
        let (slope, square) = from(point, &ball.centre);
        let corners = self.corners();
        let mut most = 0.0;
        for (k, own) in self.squares(point).into_iter().enumerate() {
            let length2 = own + square - 2.0 * (0..4).map(|l| slope[l] * corners[l][k]).sum::<f64>();
            // it is at most the length of the deviator
            if length2 > most * most {
                let part = |d: usize| (0..4).map(|l| deviators[l][d] * (corners[l][k] - ball.centre[l])).sum::<f64>();
                most = f64::max(most, tresca([0, 1, 2, 3, 4].map(part)));
            }
        }
        most
    }
}

/// G c and c' G c of loads c.
fn from(point: &UnitPoint, c: &[f64; 4]) -> ([f64; 4], f64) {
    let slope: [f64; 4] = std::array::from_fn(|i| (0..4).map(|j| point.products[i][j] * c[j]).sum());
    (slope, (0..4).map(|i| slope[i] * c[i]).sum())
}

/// Sums of rows, each with its weight.
#[kernel]
fn combine(rows: [&[f64]; PAIRS.len()], weights: &[f64; PAIRS.len()], out: &mut [f64]) {
    let n = out.len();
    for (row, weight) in rows.iter().zip(weights) {
        for (sum, x) in out.iter_mut().zip(&row[..n]) {
            *sum += weight * x;
        }
    }
}

/// The corner with the largest square less twice slope . loads, and that.
#[kernel]
fn farthest(corners: [&[f64]; 4], squares: &[f64], slope: [f64; 4]) -> (usize, f64) {
    let [a, b, c, d] = corners.map(|row| row.as_chunks::<LANES>().0);
    let squares = squares.as_chunks::<LANES>().0;
    let s = slope.map(|s| -2.0 * s);
    let (mut most, mut block) = ([f64::NEG_INFINITY; LANES], [0usize; LANES]);
    for (i, own) in squares.iter().enumerate() {
        for l in 0..LANES {
            let value = own[l] + s[0] * a[i][l] + s[1] * b[i][l] + s[2] * c[i][l] + s[3] * d[i][l];
            let larger = value > most[l];
            most[l] = if larger { value } else { most[l] };
            block[l] = if larger { i } else { block[l] };
        }
    }
    let lane = (0..LANES).fold(0, |m, l| if most[l] > most[m] { l } else { m });
    (block[lane] * LANES + lane, most[lane])
}

/// Smallest and largest value of weights . loads.
#[kernel]
fn ends(corners: [&[f64]; 4], weights: &[f64; 4]) -> (f64, f64) {
    let [a, b, c, d] = corners.map(|row| row.as_chunks::<LANES>().0);
    let w = weights;
    // the same operation for both ends: compilers mix up lanes of different ones
    let (mut low, mut high) = ([f64::NEG_INFINITY; LANES], [f64::NEG_INFINITY; LANES]);
    for i in 0..a.len() {
        for l in 0..LANES {
            let value = w[0] * a[i][l] + w[1] * b[i][l] + w[2] * c[i][l] + w[3] * d[i][l];
            low[l] = if -value > low[l] { -value } else { low[l] };
            high[l] = if value > high[l] { value } else { high[l] };
        }
    }
    let largest = |lanes: [f64; LANES]| lanes.into_iter().fold(f64::NEG_INFINITY, f64::max);
    (-largest(low), largest(high))
}

/// Largest size of the hydrostatic stress (by weights, and that of the middles) with the largest principal deviatoric one, which lengths of the deviators bound.
fn largest_normal(corners: [&[f64]; 4], (h, middle): (&[f64; 4], f64), squares: &[f64], (slope, square): ([f64; 4], f64)) -> f64 {
    let normal_at = |k: usize| {
        let q = corners.map(|row| row[k]);
        let along = |w: &[f64; 4]| (0..4).map(|l| w[l] * q[l]).sum::<f64>();
        (middle + along(h)).abs() + PRINCIPAL * (squares[k] + square - 2.0 * along(&slope)).max(0.0).sqrt()
    };
    (0..squares.len()).map(normal_at).fold(0.0, f64::max)
}
