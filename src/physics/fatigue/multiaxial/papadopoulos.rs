//! Mean resolved shear over all planes and directions \[Papadopoulos et al. 1997\]: sqrt(5 <T_a²>), where T_a is half the range of the shear stress resolved in a
//! direction on a plane. For proportional stress it is the amplitude of sqrt(J2).

use super::history::{History, Weights};
use crate::numerics::elementary::Elementary;
use crate::numerics::projections::{LANES, combined, half_ranges};
use crate::numerics::quadrature::gauss_legendre;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Nodes over the height of a hemisphere, planes round it, directions on half a turn of a plane. Odd numbers: the planes and directions of even ones pair off, and say less. Within 0.1 %
/// of a rule of 65 536 on histories that no symmetry helps, within 2e-5 in bending and torsion.
const HEIGHTS: usize = 6;
const ROUND: usize = 17;
const DIRECTIONS: usize = 7;

/// Weights of the resolved shear stress in the components, with those of the mean.
static RULE: LazyLock<Vec<(Weights, f64)>> = LazyLock::new(|| {
    let mut rule = Vec::new();
    for (x, weight) in gauss_legendre(HEIGHTS) {
        let phi = (0.5 * (x + 1.0)).arccosine();
        for i in 0..ROUND {
            let plane = crate::fatigue::multiaxial::Plane { theta: 2.0 * PI * (i as f64 + 0.5) / ROUND as f64, phi };
            let [u, v] = plane.directions();
            for k in 0..DIRECTIONS {
                let (sine, cosine) = (PI * (k as f64 + 0.5) / DIRECTIONS as f64).sine_cosine();
                let m = [0, 1, 2].map(|d| cosine * u[d] + sine * v[d]);
                rule.push((crate::fatigue::multiaxial::plane::resolved(&plane.normal(), &m), 0.5 * weight / (ROUND * DIRECTIONS) as f64));
            }
        }
    }
    rule
});

/// The directions of the rule in a plane state: the resolved shear w0 s + w3 t of normal stress s and shear stress t, by growing angle of (w0, w3) from that of s, half a turn.
#[derive(Debug)]
pub(crate) struct Directions {
    along: Vec<[f64; 2]>,
    /// For each part of the half turn how many come before it.
    begin: Vec<usize>,
    /// Sums of share times w0², w0 w3, w3² of those before each, and of all.
    sums: Vec<[f64; 3]>,
}

/// Parts of the half turn, each with about one direction.
const PARTS: usize = 1024;

/// The part of the half turn in which an angle lies, by a number that grows with it; nothing of the other half.
fn turned([x, y]: [f64; 2]) -> Option<usize> {
    let size = x.abs() + y;
    (y >= 0.0 && size > 0.0).then(|| ((1.0 - x / size) * (0.5 * PARTS as f64)) as usize)
}

/// Those of the rule.
pub(crate) fn directions() -> &'static Directions {
    static DIRECTIONS: LazyLock<Directions> = LazyLock::new(|| {
        // a direction and its opposite are one
        let upper = |w: &Weights| if (w[3], w[0]) < (0.0, 0.0) { [-w[0], -w[3]] } else { [w[0], w[3]] };
        let mut list: Vec<([f64; 2], f64)> = RULE.iter().map(|(w, share)| (upper(w), *share)).collect();
        list.sort_by(|a, b| a.0[1].arctangent(a.0[0]).total_cmp(&b.0[1].arctangent(b.0[0])));
        let mut sums = vec![[0.0; 3]];
        for ([x, y], share) in &list {
            let before = sums[sums.len() - 1];
            sums.push([before[0] + share * x * x, before[1] + share * x * y, before[2] + share * y * y]);
        }
        let along: Vec<[f64; 2]> = list.into_iter().map(|l| l.0).collect();
        // those in the part before, too: rounding may lie between
        let before = |part: usize| along.iter().filter(|w| turned(**w).is_none_or(|own| own + 1 < part)).count();
        Directions { begin: (0..=PARTS).map(before).collect(), along, sums }
    });
    &DIRECTIONS
}

impl Directions {
    /// How many.
    pub fn len(&self) -> usize {
        self.along.len()
    }

    /// The first one, from `from` on, that has a positive part along `step`: a step that turns left from all before it.
    pub(crate) fn first_along(&self, step: [f64; 2], from: usize) -> usize {
        let not_along = |[x, y]: &&[f64; 2]| x * step[0] + y * step[1] <= 0.0;
        let from = from.max(turned([step[1], -step[0]]).map_or(0, |part| self.begin[part]));
        from + self.along[from..].iter().take_while(not_along).count()
    }

    /// Moments of those in a range.
    pub fn moments(&self, from: usize, until: usize) -> [f64; 3] {
        [0, 1, 2].map(|m| self.sums[until][m] - self.sums[from][m])
    }
}

/// Of the directions along which s/sqrt 3 has part u and t part v: sums of share times u², u v, v² in each of some even parts of half a turn, from that of s.
pub(super) fn moments_of_parts<const PARTS: usize>() -> [[f64; 3]; PARTS] {
    let mut sums = [[0.0; 3]; PARTS];
    for (w, share) in RULE.iter() {
        let (u, v) = (3f64.sqrt() * w[0], w[3]);
        let angle = v.arctangent(u).rem_euclid(PI);
        let part = ((angle / PI * PARTS as f64) as usize).min(PARTS - 1);
        [u * u, u * v, v * v].iter().zip(&mut sums[part]).for_each(|(product, sum)| *sum += share * product);
    }
    sums
}

/// Of a plane state whose xx stays within an amplitude s and whose xy stays within t, whatever their phase: at least sqrt(5 <T_a²>), Pa.
pub fn at_most(s: f64, t: f64) -> f64 {
    static CROSSED: LazyLock<f64> = LazyLock::new(|| RULE.iter().map(|(w, share)| 10.0 * share * (w[0] * w[3]).abs()).sum());
    (s * s * (1.0 / 3.0) + t * t + *CROSSED * s * t).sqrt()
}

/// sqrt(5 <T_a²>), Pa.
pub fn mean_shear(history: &History) -> f64 {
    let square = |(weights, share): &(Weights, f64)| {
        let (low, high) = history.range(weights);
        share * 0.25 * (high - low) * (high - low)
    };
    (5.0 * RULE.iter().map(square).sum::<f64>()).sqrt()
}

/// Four loads over the cycle in single precision, as shares of their largest sizes.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LoadShares {
    largest: [f64; 4],
    shares: Vec<[f32; 4]>,
}

/// More than the rounding of all that is in single precision, of the sum of the largest sizes of sqrt(J2) that each load makes by itself.
const ROUNDING: f64 = 3e-6;

impl LoadShares {
    /// Of each load at every sample.
    pub fn of(loads: [&[f64]; 4]) -> Self {
        let largest = loads.map(|row| row.iter().fold(0.0, |m: f64, v| m.max(v.abs())));
        let scale = largest.map(|size| if size > 0.0 { 1.0 / size } else { 0.0 });
        let share = |j: usize| std::array::from_fn(|l| (loads[l][j] * scale[l]) as f32);
        Self { largest, shares: (0..loads[0].len()).map(share).collect() }
    }

    /// At least sqrt(5 <T_a²>) of the rule, Pa, and hardly more, where each load makes these deviators (`deviator_of`) per unit.
    pub fn mean_shear(&self, deviators: &[[f64; 5]; 4]) -> f64 {
        static ROWS: LazyLock<[Vec<f32>; 5]> = LazyLock::new(|| {
            // of the stresses of a deviator, whose parts are those of `deviator_of`; filled up to whole lanes
            let row = |of: fn(&Weights) -> f64| {
                let mut row: Vec<f32> = RULE.iter().map(|(w, _)| of(w) as f32).collect();
                row.resize(row.len().next_multiple_of(LANES), 0.0);
                row
            };
            [row(|w| (2.0 * w[0] - w[1] - w[2]) / 3f64.sqrt()), row(|w| w[1] - w[2]), row(|w| w[3]), row(|w| w[5]), row(|w| w[4])]
        });
        let mut directions: [Vec<f32>; 4] = Default::default();
        for ((direction, deviator), largest) in directions.iter_mut().zip(deviators).zip(self.largest) {
            combined(&ROWS, &deviator.map(|d| (d * largest) as f32), direction);
        }
        let mut half = Vec::new();
        half_ranges(&self.shares, &directions, &mut half);
        let square: f64 = half.iter().zip(RULE.iter()).map(|(h, (_, share))| share * f64::from(*h) * f64::from(*h)).sum();
        let length = |d: &[f64; 5]| d.iter().map(|d| d * d).sum::<f64>().sqrt();
        let sizes: f64 = deviators.iter().zip(self.largest).map(|(d, largest)| length(d) * largest).sum();
        (5.0 * square).sqrt() + ROUNDING * sizes
    }
}
