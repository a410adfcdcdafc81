//! What a plane state (normal stress s, its shear t) does not exceed, by a polygon round its path: for a small part of what its hull costs.
//!
//! Its sides touch the path (s/sqrt 3, t) where it reaches farthest along directions even round a turn. The circle round its corners holds the path, and along a direction between
//! those of two sides the polygon ends in the corner of both, so that the mean shear of Papadopoulos is a sum over corners.

use super::bound::Within;
use super::papadopoulos;
use crate::numerics::elementary::Elementary;
use crate::numerics::enclosing::smallest_ball_from;
use crate::numerics::projections::{extents, range};
use hartog_kernel::kernel;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Directions round half a turn: the polygon has twice as many sides, and its corners lie at most half a per cent of their distance outside the path's own circle.
const DIRECTIONS: usize = 16;
const SIDES: usize = 2 * DIRECTIONS;
/// Several times the rounding of numbers up to 1 in single precision.
const ROUNDING: f64 = 1e-6;

/// What does not depend on the path.
struct Fixed {
    /// Cosine and sine of the directions of a turn.
    turn: [[f64; 2]; SIDES],
    /// Of the rule of the mean shear, by corner of half a turn.
    moments: [[f64; 3]; DIRECTIONS],
    /// Tangent of half the angle between two of them.
    half_step: f64,
}

static FIXED: LazyLock<Fixed> = LazyLock::new(|| {
    let direction = |k: usize| {
        let (sine, cosine) = (PI * k as f64 / DIRECTIONS as f64).sine_cosine();
        [cosine, sine]
    };
    Fixed {
        turn: std::array::from_fn(direction),
        moments: papadopoulos::moments_of_parts(),
        half_step: (0.5 * PI / DIRECTIONS as f64).tangent(),
    }
});

/// A stress or load over the cycle, in single precision.
#[derive(Debug, Clone)]
pub struct Row {
    least: f64,
    most: f64,
    /// Distances from the least as shares of the range.
    shares: Vec<f32>,
}

impl Row {
    /// Of its value at every sample.
    pub fn of(values: &[f64]) -> Self {
        let (least, most) = range(values);
        let scale = if most - least > f64::MIN_POSITIVE { 1.0 / (most - least) } else { 1.0 };
        Self { least, most, shares: shares(values, least, scale) }
    }

    fn size(&self) -> f64 {
        self.least.abs().max(self.most.abs())
    }
}

/// At least what a path over the cycle bears, Pa; and the same where its shear stress is `rise` times as large. The shear stress is `per_load` times a load.
pub fn within(normal: &Row, (per_load, load): (f64, &Row), rise: f64) -> [Within; 2] {
    let root = 3f64.sqrt();
    let (across, along) = ((normal.most - normal.least) / root, per_load * (load.most - load.least));
    let spread = across.max(along.abs());
    let whole = |rise: f64| Within {
        sqrt_j2_amplitude: 0.0,
        shear: 0.0,
        mean_shear: 0.0,
        hydrostatic: (normal.least / 3.0, normal.most / 3.0),
        middle: Some((normal.least, normal.most)),
        normal: normal.size().hypotenuse(2f64.sqrt() * rise * (per_load * load.size()).abs()),
    };
    let still = [1.0, rise].map(whole);
    if spread.is_nan() || spread <= f64::MIN_POSITIVE {
        return still;
    }
    let Fixed { turn, moments, half_step } = &*FIXED;
    let directions: [[f32; 2]; DIRECTIONS] =
        std::array::from_fn(|k| [turn[k][0] * across / spread, turn[k][1] * along / spread].map(|c| c as f32));
    let most = extents(&normal.shares, &load.shares, &directions);
    let reach = |k: usize| ROUNDING + if k < DIRECTIONS { f64::from(most[k].1) } else { -f64::from(most[k - DIRECTIONS].0) };
    // a corner for each two sides that follow each other
    let [_, step] = turn[1];
    let (mut u, mut v) = ([0.0; SIDES], [0.0; SIDES]);
    for k in 0..SIDES {
        let next = (k + 1) % SIDES;
        let ([ca, sa], [cb, sb], a, b) = (turn[k], turn[next], reach(k), reach(next));
        u[k] = (a * sb - b * sa) / step;
        v[k] = (b * ca - a * cb) / step;
    }
    let square = |(k, [uu, uv, vv]): (usize, &[f64; 3])| {
        let (du, dv) = (u[k] - u[k + DIRECTIONS], v[k] - v[k + DIRECTIONS]);
        uu * du * du + 2.0 * uv * du * dv + vv * dv * dv
    };
    let mean_shear = (1.25 * moments.iter().enumerate().map(square).sum::<f64>()).sqrt();
    let bounds_at = |rise: f64, still: Within, support: &[usize]| {
        let risen = v.map(|v| rise * v);
        let ball = smallest_ball_from([&u, &risen], support);
        // the path's own circle is smaller by no more than the cosine of half the angle between two sides, so that its centre lies no farther off than the tangent; the sides of a risen path are
        // farther apart
        let off = 1.02 * rise.max(1.0) * half_step * ball.radius;
        let middle = |sign: f64| normal.least + root * spread * (ball.centre[0] + sign * off);
        let within = Within {
            sqrt_j2_amplitude: spread * ball.radius,
            shear: spread * ball.radius,
            // the root of the mean square of half ranges is a norm
            mean_shear: spread * mean_shear + papadopoulos::at_most(0.0, 0.5 * (rise - 1.0) * along.abs()),
            middle: Some((middle(-1.0).max(normal.least), middle(1.0).min(normal.most))),
            ..still
        };
        (within, ball.support().to_vec())
    };
    let (own, support) = bounds_at(1.0, still[0], &[]);
    [own, if rise == 1.0 { own } else { bounds_at(rise, still[1], &support).0 }]
}

/// Distances from the least, scaled.
#[kernel]
fn shares(numbers: &[f64], least: f64, scale: f64) -> Vec<f32> {
    numbers.iter().map(|v| ((v - least) * scale) as f32).collect()
}
