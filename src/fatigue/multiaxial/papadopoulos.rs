//! Mean resolved shear over all planes and directions \[Papadopoulos et al. 1997\]: sqrt(5 <T_a²>), where T_a is half the range of the shear stress resolved in a
//! direction on a plane. For proportional stress it is the amplitude of sqrt(J2).

use super::history::{History, Weights};
use crate::numerics::quadrature::gauss_legendre;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Nodes over the height of a hemisphere, planes round it, directions on half a turn of a plane: 1e-4 of the mean.
const HEIGHTS: usize = 8;
const ROUND: usize = 16;
const DIRECTIONS: usize = 8;

/// Weights of the resolved shear stress in the components, with those of the mean.
static RULE: LazyLock<Vec<(Weights, f64)>> = LazyLock::new(|| {
    let mut rule = Vec::new();
    for (x, weight) in gauss_legendre(HEIGHTS) {
        let phi = (0.5 * (x + 1.0)).acos();
        for i in 0..ROUND {
            let plane = super::Plane { theta: 2.0 * PI * (i as f64 + 0.5) / ROUND as f64, phi };
            let [u, v] = plane.directions();
            for k in 0..DIRECTIONS {
                let (sine, cosine) = (PI * (k as f64 + 0.5) / DIRECTIONS as f64).sin_cos();
                let m = [0, 1, 2].map(|d| cosine * u[d] + sine * v[d]);
                rule.push((super::plane::resolved(&plane.normal(), &m), 0.5 * weight / (ROUND * DIRECTIONS) as f64));
            }
        }
    }
    rule
});

/// sqrt(5 <T_a²>), Pa.
pub fn mean_shear(history: &History) -> f64 {
    let square = |(weights, share): &(Weights, f64)| {
        let (low, high) = history.range(weights);
        share * 0.25 * (high - low) * (high - low)
    };
    (5.0 * RULE.iter().map(square).sum::<f64>()).sqrt()
}
