//! What a point with stresses per unit load does not exceed, without its history: its stress is a linear function of the four loads of its web, whose path over the cycle all points of the
//! web share.
//!
//! With the deviators D_l per unit load, as vectors whose length is sqrt(J2), and their products G, the deviator of loads q has the length sqrt(q' G q): what holds the path of the loads says
//! what a point bears for a few multiplications.

use super::load_paths::LoadPath;
use super::speed_table::At;
use super::{CriticalLocation, UnitLoads};
use crate::fatigue::multiaxial::bound::Within;
use crate::fatigue::multiaxial::history::deviator_of;

/// Largest principal deviatoric stress over sqrt(J2): 2/sqrt 3.
pub(super) const PRINCIPAL: f64 = 1.154_700_538_379_251_7;

/// A point, by its stresses per unit load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct UnitPoint {
    /// Its web.
    pub web: usize,
    /// Products of the deviators of two loads.
    pub products: [[f64; 4]; 4],
    /// Their lengths.
    pub lengths: [f64; 4],
    /// Hydrostatic stresses.
    pub hydrostatic: [f64; 4],
}

/// Loads of a web at a speed but for the torque.
#[derive(Debug, Clone)]
pub(super) struct BentWeb {
    path: LoadPath<3>,
    ellipsoid: [[f64; 3]; 3],
}

/// What a point bears by those.
struct Bent {
    /// Radius of a ball round its deviator, about that of the middle of the loads.
    radius: f64,
    mean_shear: f64,
    /// Its part along the deviator of the torque.
    crossed: f64,
    low: f64,
    high: f64,
    /// Length of its deviator.
    deviator: f64,
}

impl BentWeb {
    /// From moment, moment across the throw and shear force at every sample.
    pub fn of(loads: [&[f64]; 3]) -> Self {
        let path = LoadPath::of(loads);
        let ellipsoid = path.ellipsoid();
        Self { path, ellipsoid }
    }

    /// At most so far along a direction.
    fn along(&self, d: [f64; 3]) -> f64 {
        quadratic(&self.ellipsoid, &d).sqrt() + self.path.apart(d.iter().map(|d| d.abs()))
    }
}

impl UnitPoint {
    /// Of a location with stresses per unit load.
    pub fn of(location: &CriticalLocation, units: &UnitLoads) -> Self {
        let tensors = [units.moment, units.tangential, units.shear, units.torque];
        let deviators = tensors.map(|t| deviator_of(&t));
        let product = |a: usize, b: usize| (0..5).map(|d| deviators[a][d] * deviators[b][d]).sum::<f64>();
        Self {
            web: location.web(),
            products: std::array::from_fn(|a| std::array::from_fn(|b| product(a, b))),
            lengths: std::array::from_fn(|l| product(l, l).sqrt()),
            hydrostatic: tensors.map(|t| (t[0] + t[1] + t[2]) / 3.0),
        }
    }

    /// By bending alone.
    fn bent(&self, web: &BentWeb) -> Bent {
        let (a, middle) = (&web.ellipsoid, &web.path.middle);
        let g: [[f64; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| self.products[i][j]));
        let times = |x: &[[f64; 3]; 3], y: &[[f64; 3]; 3]| -> [[f64; 3]; 3] {
            std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| x[i][k] * y[k][j]).sum()))
        };
        // the largest eigenvalue of A G is at most the fourth root of the sum of the fourth powers of all
        let m = times(a, &g);
        let square = times(&m, &m);
        let fourth: f64 = (0..3).flat_map(|i| (0..3).map(move |j| (i, j))).map(|(i, j)| square[i][j] * square[j][i]).sum();
        let apart = web.path.apart(self.lengths.into_iter());
        let across = std::array::from_fn(|i| self.products[3][i]);
        let h: [f64; 3] = std::array::from_fn(|i| self.hydrostatic[i]);
        let (p, reach) = ((0..3).map(|i| h[i] * middle[i]).sum::<f64>(), web.along(h));
        // of squares of lengths
        let radius = fourth.max(0.0).sqrt().sqrt().sqrt() + apart;
        Bent {
            radius,
            mean_shear: (0..3).map(|i| m[i][i]).sum::<f64>().max(0.0).sqrt() + apart,
            crossed: web.along(across),
            low: p - reach,
            high: p + reach,
            deviator: quadratic(&g, middle).sqrt() + radius,
        }
    }

    /// At a speed between two rows of loads, under a torque of this half peak-to-peak value, and of no larger size than `largest`.
    pub(crate) fn by_ranges(&self, rows: [&[BentWeb]; 2], at: At, half_peak_to_peak: f64, largest: f64) -> Within {
        let low = self.bent(&rows[0][self.web]);
        let high = if at.fraction > 0.0 { &self.bent(&rows[1][self.web]) } else { &low };
        // what is a size or a range of a path is no larger than linear between two of them
        let interpolated = |part: fn(&Bent) -> f64| at.between(part(&low), part(high));
        let (radius, length) = (interpolated(|b| b.radius), self.lengths[3]);
        let (twisted, pressed) = (length * half_peak_to_peak, self.hydrostatic[3].abs() * largest);
        let crossed = radius * radius + 2.0 * half_peak_to_peak * interpolated(|b| b.crossed) + twisted * twisted;
        let ball = crossed.sqrt().min(radius + twisted);
        let hydrostatic = (interpolated(|b| b.low) - pressed, interpolated(|b| b.high) + pressed);
        Within {
            sqrt_j2_amplitude: ball,
            shear: ball,
            // the root of the mean square of half ranges is a norm
            mean_shear: interpolated(|b| b.mean_shear) + twisted,
            hydrostatic,
            middle: None,
            normal: hydrostatic.0.abs().max(hydrostatic.1.abs()) + PRINCIPAL * (interpolated(|b| b.deviator) + length * largest),
        }
    }
}

/// x' A x, not negative.
fn quadratic<const L: usize>(a: &[[f64; L]; L], x: &[f64; L]) -> f64 {
    let row = |i: usize| x[i] * (0..L).map(|j| a[i][j] * x[j]).sum::<f64>();
    (0..L).map(row).sum::<f64>().max(0.0)
}
