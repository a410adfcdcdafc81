//! Web after the crankpin: a prism bent by the radial force, by the tangential one and compressed, twisted by the tangential reaction \[Bhandari 2010\] section 25.18.
//!
//! With R2 the reaction after the throw: radial bending R2r (b2 - l_c/2 - t/2) on w t²/6, tangential bending F_t (r - d_j/2) on t w²/6, compression F_r/(2 w t),
//! shear 4.5 R2t (b2 - l_c/2)/(w t²).

use super::crank::{ThrowLoads, bending};
use super::section::Swing;
use super::specification::{Bearings, Bending, Material, Sizes};
use crate::fatigue::endurance::Loading;

/// Margins of a web: against yielding by the largest principal stress, and for infinite life by von Mises amplitude and mean.
pub fn margins(
    throws: &[ThrowLoads],
    throw: usize,
    supported: (&Bearings, Bending),
    crank_radius: f64,
    sizes: &Sizes,
    material: &Material,
) -> [f64; 2] {
    let (loads, before) = (&throws[throw], supported.0.before);
    let (w, t, half) = (sizes.web_breadth, sizes.web_thickness, 0.5 * sizes.crankpin_length);
    let [radial, _] = bending(throws, throw, before + half + 0.5 * t, supported);
    let [_, twisting] = bending(throws, throw, before + half, supported);
    let arm = (crank_radius - 0.5 * sizes.journal_diameter).max(0.0);
    // the edge where all of them add up
    let normal = |((m, r), f): ((&f64, &f64), &f64)| -m * 6.0 / (w * t * t) - r * 0.5 / (w * t) + f.abs() * arm * 6.0 / (t * w * w);
    let normal: Vec<f64> = radial.iter().zip(&loads.radial).zip(&loads.tangential).map(normal).collect();
    let shear: Vec<f64> = twisting.iter().map(|m| m * 4.5 / (w * t * t)).collect();
    let principal = |(n, s): (&f64, &f64)| 0.5 * n.abs() + (0.25 * n * n + s * s).sqrt();
    let largest = normal.iter().zip(&shear).map(principal).fold(0.0, f64::max);
    let (n, s) = (Swing::of(normal), Swing::of(shear));
    let mises = |n: f64, s: f64| (n * n + 3.0 * s * s).sqrt();
    // the round section with as much material near the largest stress: 0.808 sqrt(w t)
    let limit = material.fatigue_limit(Loading::Bending, 0.808 * (w * t).sqrt());
    let goodman = mises(n.amplitude, s.amplitude) / limit + mises(n.mean, s.mean) / material.tensile;
    [material.yield_strength / largest, 1.0 / goodman]
}
