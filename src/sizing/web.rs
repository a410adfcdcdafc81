//! Web after the crankpin: a prism bent by the radial force, by the tangential one and compressed, twisted by the tangential reaction \[Bhandari 2010\] section 25.18.
//!
//! With R2 the reaction after the throw: radial bending R2r (b2 - l_c/2 - t/2) on w t²/6, tangential bending F_t (r - d_j/2) on t w²/6, compression F_r/(2 w t),
//! shear 4.5 R2t (b2 - l_c/2)/(w t²).

use super::crank::{ThrowLoads, shares};
use super::section::Swing;
use super::specification::{Bearings, Material, Sizes};
use crate::fatigue::endurance::Loading;

/// Normal and shear stress at a moment, Pa, per unit of radial and tangential force.
struct PerForce {
    normal_of_radial: f64,
    normal_of_tangential: f64,
    shear_of_tangential: f64,
}

fn per_force(bearings: &Bearings, crank_radius: f64, sizes: &Sizes) -> PerForce {
    let share = shares(bearings).1;
    let (w, t) = (sizes.web_breadth, sizes.web_thickness);
    let arm = bearings.after - 0.5 * sizes.crankpin_length;
    PerForce {
        normal_of_radial: share * (arm - 0.5 * t) * 6.0 / (w * t * t) + 0.5 / (w * t),
        normal_of_tangential: (crank_radius - 0.5 * sizes.journal_diameter).max(0.0) * 6.0 / (t * w * w),
        shear_of_tangential: 4.5 * share * arm / (w * t * t),
    }
}

/// Margins of a web: against yielding by the largest principal stress, and for infinite life by von Mises amplitude and mean.
pub fn margins(loads: &ThrowLoads, bearings: &Bearings, crank_radius: f64, sizes: &Sizes, material: &Material) -> [f64; 2] {
    let per = per_force(bearings, crank_radius, sizes);
    // the side where all of them add up
    let normal: Vec<f64> =
        loads.radial.iter().zip(&loads.tangential).map(|(r, t)| -r * per.normal_of_radial + t.abs() * per.normal_of_tangential).collect();
    let shear: Vec<f64> = loads.tangential.iter().map(|t| t * per.shear_of_tangential).collect();
    let principal = |(n, s): (&f64, &f64)| 0.5 * n.abs() + (0.25 * n * n + s * s).sqrt();
    let largest = normal.iter().zip(&shear).map(principal).fold(0.0, f64::max);
    let (n, s) = (Swing::of(normal), Swing::of(shear));
    let mises = |n: f64, s: f64| (n * n + 3.0 * s * s).sqrt();
    // the round section with as much material near the largest stress: 0.808 sqrt(w t)
    let limit = material.fatigue_limit(Loading::Bending, 0.808 * (sizes.web_breadth * sizes.web_thickness).sqrt());
    let goodman = mises(n.amplitude, s.amplitude) / limit + mises(n.mean, s.mean) / material.tensile;
    [material.yield_strength / largest, 1.0 / goodman]
}
