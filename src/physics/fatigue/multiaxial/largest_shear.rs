//! The plane of the largest shear of a plane state (s, t).
//!
//! On the plane of normal n = (cos a, sin a cos b, sin a sin b) the shear stress is
//!
//! u = sin 2a s/2 - cos 2a cos b t, v = cos a sin b t,
//!
//! and u² + v² <= (s/2)² + t² for every s and t. The smallest circle of no plane is therefore larger than that round the path (s/2, t), nor is the largest one smaller than half the longest chord of
//! that path, which the planes with b = 0 show in full at tan 2a = -s/(2 t) of the chord and a quarter of a turn from it. Where the circle is held by two points both are one, and the planes are known.
//! Elsewhere planes are searched: the square of the radius is the largest over weights of the corners of a smooth function of a and b \[Elzinga & Hearn 1972\], so that it has no ridges,
//! and its slope is that of the weights which hold the circle.

use super::search::LEVEL;
use crate::numerics::elementary::Elementary;
use crate::numerics::enclosing::{Ball, smallest_ball_from};
use std::f64::consts::{FRAC_PI_2, PI};

/// What the plane bears, Pa.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LargestShear {
    /// Amplitude of the shear stress.
    pub amplitude: f64,
    /// Largest normal stress.
    pub normal_max: f64,
}

/// Radii of the two circles closer than this share are one.
const ONE: f64 = 1e-12;
/// Planes of a scan over a and over b.
const SCAN: (usize, usize) = (12, 24);
/// From planes of the scan this much lower than the best, the way may lead higher.
const RISE: f64 = 0.06;
/// The first step of an ascent, rad, and the length of a slope, relative to the radius, that is none.
const FIRST: f64 = 0.05;
const FLAT: f64 = 1e-12;
const STEPS: usize = 60;
const HALVINGS: usize = 30;

/// A plane with its circle.
#[derive(Debug, Clone, Copy)]
struct At {
    x: [f64; 2],
    ball: Ball<2>,
}

/// A path with buffers for its shear on a plane.
struct Planes<'a> {
    normal: &'a [f64],
    tangential: &'a [f64],
    shear: [Vec<f64>; 2],
    known: Vec<usize>,
}

impl Planes<'_> {
    fn at(&mut self, x: [f64; 2]) -> At {
        let ((sa, ca), (sb, cb)) = (x[0].sine_cosine(), x[1].sine_cosine());
        let (by_normal, by_shear, across) = (sa * ca, (ca * ca - sa * sa) * cb, ca * sb);
        for (i, (s, t)) in self.normal.iter().zip(self.tangential).enumerate() {
            self.shear[0][i] = by_normal * s - by_shear * t;
            self.shear[1][i] = across * t;
        }
        let ball = smallest_ball_from([&self.shear[0], &self.shear[1]], &self.known);
        self.known.clear();
        self.known.extend(ball.support());
        At { x, ball }
    }

    /// Derivatives of half the square of the radius by a and b: those with the weights of the points that hold the circle.
    fn slope(&self, at: &At) -> [f64; 2] {
        let ((sa, ca), (sb, cb)) = (at.x[0].sine_cosine(), at.x[1].sine_cosine());
        let ((s2, c2), c) = ((2.0 * sa * ca, ca * ca - sa * sa), at.ball.centre);
        let mut slope = [0.0; 2];
        for (i, weight) in at.ball.support().iter().zip(self.weights(&at.ball)) {
            let (s, t) = (self.normal[*i], self.tangential[*i]);
            let (u, v) = (0.5 * s2 * s - c2 * cb * t - c[0], ca * sb * t - c[1]);
            slope[0] += weight * (u * (c2 * s + 2.0 * s2 * cb * t) - v * sa * sb * t);
            slope[1] += weight * (u * c2 * sb * t + v * ca * cb * t);
        }
        slope
    }

    /// Weights with which the points that hold a circle have its centre.
    fn weights(&self, ball: &Ball<2>) -> [f64; 3] {
        let [u, v] = &self.shear;
        match *ball.support() {
            [_] => [1.0, 0.0, 0.0],
            [i, j, k] => {
                let area = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
                let [p, q, r] = [i, j, k].map(|i| [u[i], v[i]]);
                let all = area(p, q, r);
                [area(ball.centre, q, r) / all, area(p, ball.centre, r) / all, area(p, q, ball.centre) / all]
            }
            _ => [0.5, 0.5, 0.0],
        }
    }

    /// To the summit above a plane by the method of Broyden, Fletcher, Goldfarb and Shanno.
    fn climb(&mut self, from: [f64; 2]) -> At {
        let mut here = self.at(from);
        let mut slope = self.slope(&here);
        // the inverse of the negative curvature
        let mut inverse = [[0.0; 2]; 2];
        let mut fresh = true;
        for _ in 0..STEPS {
            let (square, length) = (here.ball.radius * here.ball.radius, slope[0].hypotenuse(slope[1]));
            if length <= FLAT * square {
                break;
            }
            if fresh {
                inverse = [[FIRST / length, 0.0], [0.0, FIRST / length]];
            }
            let step = inverse.map(|row| row[0] * slope[0] + row[1] * slope[1]);
            let mut share = 1.0;
            let mut next = None;
            for _ in 0..HALVINGS {
                let there = self.at([0, 1].map(|i| here.x[i] + share * step[i]));
                if there.ball.radius > here.ball.radius {
                    next = Some(there);
                    break;
                }
                share *= 0.25;
            }
            let Some(there) = next else {
                if fresh {
                    break;
                }
                fresh = true;
                continue;
            };
            // the circle last asked for is this one
            let other = self.slope(&there);
            let moved = [0, 1].map(|i| there.x[i] - here.x[i]);
            let fallen = [0, 1].map(|i| slope[i] - other[i]);
            let product = moved[0] * fallen[0] + moved[1] * fallen[1];
            fresh = product <= 0.0;
            if !fresh {
                let turned = inverse.map(|row| row[0] * fallen[0] + row[1] * fallen[1]);
                let scale = (1.0 + (fallen[0] * turned[0] + fallen[1] * turned[1]) / product) / product;
                for (i, row) in inverse.iter_mut().enumerate() {
                    for (j, h) in row.iter_mut().enumerate() {
                        *h += scale * moved[i] * moved[j] - (turned[i] * moved[j] + moved[i] * turned[j]) / product;
                    }
                }
            }
            (here, slope) = (there, other);
        }
        here
    }

    /// What a plane bears.
    fn bears(&self, at: &At) -> LargestShear {
        let ((sa, ca), cb) = (at.x[0].sine_cosine(), at.x[1].cosine());
        let normal = |(s, t): (&f64, &f64)| ca * ca * s + 2.0 * sa * ca * cb * t;
        let normal_max = self.normal.iter().zip(self.tangential).map(normal).fold(f64::NEG_INFINITY, f64::max);
        LargestShear { amplitude: at.ball.radius, normal_max }
    }

    /// Summits above the planes of a scan.
    fn summits(&mut self) -> Vec<At> {
        // the side of n and that of -n are one plane, and v changes but its sign with b
        let x = |i: usize, j: usize| [FRAC_PI_2 * i as f64 / SCAN.0 as f64, PI * j as f64 / SCAN.1 as f64];
        let mut radius = vec![[0.0; SCAN.1 + 1]; SCAN.0 + 1];
        for (i, row) in radius.iter_mut().enumerate() {
            for (j, r) in row.iter_mut().enumerate() {
                *r = self.at(x(i, j)).ball.radius;
            }
        }
        let top = radius.iter().flatten().copied().fold(0.0, f64::max);
        let near = |k: usize, last: usize| k.saturating_sub(1)..=(k + 1).min(last);
        let mut summits = Vec::new();
        for i in 0..=SCAN.0 {
            for j in 0..=SCAN.1 {
                let r = radius[i][j];
                let highest = near(i, SCAN.0).all(|k| near(j, SCAN.1).all(|l| radius[k][l] <= r));
                if highest && r >= top * (1.0 - RISE) {
                    summits.push(self.climb(x(i, j)));
                }
            }
        }
        summits
    }
}

/// What the plane of the largest shear bears in the states (normal, shear) of a path; of planes as critical that with the larger normal stress.
pub(super) fn largest_shear(normal: &[f64], tangential: &[f64]) -> LargestShear {
    let n = normal.len();
    if n == 0 {
        return LargestShear::default();
    }
    let mut planes = Planes { normal, tangential, shear: [vec![0.0; n], vec![0.0; n]], known: Vec::new() };
    let half: Vec<f64> = normal.iter().map(|s| 0.5 * s).collect();
    let chord = |i: usize, j: usize| [half[i] - half[j], tangential[i] - tangential[j]];
    let length = |i: usize, j: usize| chord(i, j)[0].hypotenuse(chord(i, j)[1]);
    let pairs = || (0..n).flat_map(|i| (0..i).map(move |j| (i, j)));
    let longest = pairs().map(|(i, j)| length(i, j)).fold(0.0, f64::max);
    // chords between neighbours of a longer one's ends show the same hill
    let round = |i: usize| [i, (i + 1) % n, (i + n - 1) % n];
    let summit = |(i, j): &(usize, usize)| {
        let own = length(*i, *j);
        own >= longest * (1.0 - LEVEL) && round(*i).iter().all(|k| round(*j).iter().all(|l| length(*k, *l) <= own))
    };
    let mut found = Vec::new();
    for (i, j) in pairs().filter(summit) {
        let [s, t] = chord(i, j);
        let a = 0.5 * s.arctangent(-t);
        found.extend([a, a + FRAC_PI_2].map(|a| planes.at([a, 0.0])));
    }
    if found.is_empty() {
        found.push(planes.at([0.0; 2]));
    }
    if smallest_ball_from([&half, tangential], &[]).radius > 0.5 * longest * (1.0 + ONE) {
        found.append(&mut planes.summits());
    }
    let top = found.iter().map(|at| at.ball.radius).fold(0.0, f64::max);
    let level = found.iter().filter(|at| at.ball.radius >= top * (1.0 - LEVEL)).map(|at| planes.bears(at));
    level.reduce(|m, b| if b.normal_max > m.normal_max { b } else { m }).unwrap_or_default()
}
