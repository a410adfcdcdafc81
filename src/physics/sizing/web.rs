//! Webs: bars from the axis to the crankpin \[Bhandari 2010\] section 25.18, with the torque that passes through the crank, which a single throw on its test bench does not have.
//!
//! With R the reaction beyond a web at the distance a from its middle: bending R_r a on w t²/6, compression R_r/(w t), shear 4.5 R_t (a + t/2)/(w t²) by its twist, and bending about the
//! direction of the crank on t w²/6: at the radius rho, T0 + R1t rho before the pin and T_after - R2t rho after it, largest at the surface of the journal or of the pin.
//! Stresses are those of the four corners of the section.

use super::crank::{Side, ThrowLoads, at_side, torsion_at_radius};
use super::section::Swing;
use super::specification::{Bearings, Bending, Material, Sizes};
use crate::fatigue::endurance::Loading;

/// Loads of a section of a web over the cycle.
pub(super) struct WebLoads {
    /// Along the web, N: tension is positive.
    along: Vec<f64>,
    /// In the plane of the throw, N m.
    bending: Vec<f64>,
    /// About the direction of the crank, N m.
    twisting_crank: Vec<f64>,
    /// About the web, N m.
    twisting_web: Vec<f64>,
}

/// Loads of both webs of a throw, at the surfaces of journal and pin. They do not depend on the breadth of the webs.
pub(super) fn loads(
    throws: &[ThrowLoads],
    throw: usize,
    supported: (&Bearings, Bending),
    crank_radius: f64,
    sizes: &Sizes,
) -> Vec<WebLoads> {
    let half = 0.5 * sizes.crankpin_length;
    let radii = [0.5 * sizes.journal_diameter, crank_radius - 0.5 * sizes.crankpin_diameter].map(|r| r.clamp(0.0, crank_radius));
    let side = |side: Side| {
        let middle = at_side(throws, throw, side, half + 0.5 * sizes.web_thickness, supported);
        let [_, twisting_web] = at_side(throws, throw, side, half, supported).bending;
        let [along, across] = middle.reaction;
        let [bending, _] = middle.bending;
        radii.map(|radius| WebLoads {
            along: along.clone(),
            bending: bending.clone(),
            twisting_crank: torsion_at_radius(&throws[throw], side, &across, radius),
            twisting_web: twisting_web.clone(),
        })
    };
    Side::BOTH.into_iter().flat_map(side).collect()
}

/// Margins of a section `breadth` wide and `thickness` thick: against yielding by the largest principal stress, and for infinite life by von Mises amplitude and mean.
pub(super) fn margins(loads: &WebLoads, (w, t): (f64, f64), material: &Material) -> [f64; 2] {
    let shear = loads.twisting_web.iter().map(|m| m * 4.5 / (w * t * t));
    let s = Swing::of(shear.clone());
    // the round section with as much material near the largest stress: 0.808 sqrt(w t)
    let limit = material.fatigue_limit(Loading::Bending, 0.808 * (w * t).sqrt());
    let mises = |n: f64, s: f64| (n * n + 3.0 * s * s).sqrt();
    let corner = |(a, b): (f64, f64)| {
        let normal = loads.along.iter().zip(&loads.bending).zip(&loads.twisting_crank);
        let normal = normal.map(|((n, m), c)| n / (w * t) + a * m * 6.0 / (w * t * t) + b * c * 6.0 / (t * w * w));
        let principal = |(n, s): (f64, f64)| 0.5 * n.abs() + (0.25 * n * n + s * s).sqrt();
        let largest = normal.clone().zip(shear.clone()).map(principal).fold(0.0, f64::max);
        let n = Swing::of(normal);
        let goodman = mises(n.amplitude, s.amplitude) / limit + mises(n.mean, s.mean) / material.tensile;
        [material.yield_strength / largest, 1.0 / goodman]
    };
    let corners = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
    corners.map(corner).into_iter().fold([f64::INFINITY; 2], |a, b| [a[0].min(b[0]), a[1].min(b[1])])
}
