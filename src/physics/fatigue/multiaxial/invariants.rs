//! Invariants of a history: amplitude of sqrt(J2) and hydrostatic stress.

use super::history::History;
use crate::numerics::elementary::Elementary;
use crate::numerics::enclosing::smallest_ball;

/// How the amplitude of the deviator's path is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Amplitude {
    /// Radius of the smallest ball in five dimensions.
    #[default]
    Ball,
    /// The largest radius of the smallest circles in the ten pairs of dimensions \[Minucci 2010\] section 6.1.4.2: it depends on the axes, and is too small by up to sqrt(5/2), so that it
    /// may lie below the shear amplitude of a plane.
    Pairs,
}

/// Invariants over a cycle, Pa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Invariants {
    /// Radius of the smallest ball round the path of the deviator in five dimensions.
    pub sqrt_j2_amplitude: f64,
    /// Half the range of the hydrostatic stress.
    pub hydrostatic_amplitude: f64,
    /// Middle of its range.
    pub hydrostatic_mean: f64,
    /// Centre of the ball.
    centre: [f64; 5],
}

impl Invariants {
    /// Of a history.
    pub fn of(history: &History) -> Self {
        Self::by(history, Amplitude::Ball)
    }

    /// Of a history, with the amplitude of the deviator taken in a way.
    pub fn by(history: &History, amplitude: Amplitude) -> Self {
        let path = history.deviator();
        let ball = smallest_ball(path.each_ref().map(Vec::as_slice));
        let p = history.hydrostatic();
        let (low, high) = p.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |m, v| (m.0.min(*v), m.1.max(*v)));
        Self {
            sqrt_j2_amplitude: match amplitude {
                Amplitude::Ball => ball.radius,
                Amplitude::Pairs => pairs(&path),
            },
            hydrostatic_amplitude: 0.5 * (high - low),
            hydrostatic_mean: 0.5 * (high + low),
            centre: ball.centre,
        }
    }

    /// Largest hydrostatic stress, Pa.
    #[doc(hidden)]
    pub fn hydrostatic_max(&self) -> f64 {
        self.hydrostatic_amplitude + self.hydrostatic_mean
    }

    /// Largest over the cycle of the Tresca stress of the deviator about the ball's centre and `k` times the hydrostatic stress \[Dang Van 1989\].
    pub(crate) fn mesoscopic(&self, history: &History, k: f64) -> f64 {
        let (path, p) = (history.deviator(), history.hydrostatic());
        let stress_at = |j: usize| tresca([0, 1, 2, 3, 4].map(|d| path[d][j] - self.centre[d])) + k * p[j];
        (0..history.len()).map(stress_at).fold(f64::NEG_INFINITY, f64::max)
    }
}

/// The largest radius of the smallest circles in pairs of dimensions.
fn pairs(path: &[Vec<f64>; 5]) -> f64 {
    PAIRS.map(|[a, b]| smallest_ball([&path[a], &path[b]]).radius).into_iter().fold(0.0, f64::max)
}

/// The ten pairs of dimensions.
const PAIRS: [[usize; 2]; 10] = [[0, 1], [0, 2], [1, 2], [0, 3], [1, 3], [2, 3], [0, 4], [1, 4], [2, 4], [3, 4]];

/// The path of the deviator in two of its five dimensions, and the smallest circle round it.
#[doc(hidden)]
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// The two dimensions, from 0.
    pub dimensions: [usize; 2],
    /// Over the cycle, Pa.
    pub path: [Vec<f64>; 2],
    /// Centre of the circle, Pa.
    pub centre: [f64; 2],
    /// Its radius, Pa.
    pub radius: f64,
}

/// The pair of dimensions of the deviator in which its path has the largest circle.
#[doc(hidden)]
pub fn largest_pair(history: &History) -> Pair {
    let path = history.deviator();
    let circle = |[a, b]: [usize; 2]| smallest_ball([&path[a], &path[b]]);
    let [a, b] = PAIRS.into_iter().reduce(|m, p| if circle(p).radius > circle(m).radius { p } else { m }).unwrap_or(PAIRS[0]);
    let own = circle([a, b]);
    Pair { dimensions: [a, b], path: [path[a].clone(), path[b].clone()], centre: own.centre, radius: own.radius }
}

/// sqrt(J2) over the cycle, Pa: the length of the deviator's vector of five dimensions.
#[doc(hidden)]
pub fn sqrt_j2(history: &History) -> Vec<f64> {
    let path = history.deviator();
    (0..history.len()).map(|j| path.iter().map(|d| d[j] * d[j]).sum::<f64>().sqrt()).collect()
}

/// Largest shear stress of a deviator given as a vector of five dimensions: half the difference of its largest and smallest principal stress, by the angle of
/// Lode.
pub(crate) fn tresca([s1, s2, s3, s4, s5]: [f64; 5]) -> f64 {
    let root = 3f64.sqrt();
    let xx = 2.0 * s1 / root;
    let (yy, zz) = (s2 - 0.5 * xx, -s2 - 0.5 * xx);
    let (xy, zx, yz) = (s3, s4, s5);
    let j2 = s1 * s1 + s2 * s2 + s3 * s3 + s4 * s4 + s5 * s5;
    if j2 == 0.0 {
        return 0.0;
    }
    let j3 = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx);
    let cosine = (1.5 * root * j3 / j2.power(1.5)).clamp(-1.0, 1.0);
    // principal stresses are 2 sqrt(J2/3) cos(angle + 2 pi k/3)
    let angle = cosine.arccosine() / 3.0;
    j2.sqrt() * lode(angle)
}

/// Half the difference of the extreme principal stresses over sqrt(J2): (cos a - cos(a + 2 pi/3))/sqrt 3.
fn lode(angle: f64) -> f64 {
    (angle.cosine() - (angle + 2.0 * std::f64::consts::FRAC_PI_3).cosine()) / 3f64.sqrt()
}
