//! Stress in an eye pulled by its pin: a ring as a thick curved beam (Winkler and Bach) \[Timoshenko 1956\] part I, chapter 12.
//!
//! The pin presses on half of the bore with p0 cos psi, the rod pulls at the other half alike. At the sides, a right angle from the load, the section bears
//! half of the force F and, since sections on both axes of symmetry do not turn, the moment M = F (R/2 - 4 r_n/pi²), which opens the ring there; R is the
//! radius of the section's middle, r_n = h/ln(r_o/r_i) that of its neutral line, h = r_o - r_i. The bore is stressed most:
//! F/(2 h b) + M (r_n - r_i)/(h b e r_i), with e = R - r_n and b the width.

use crate::numerics::elementary::Elementary;
use std::f64::consts::PI;

/// Smallest and largest ratio of outer to inner diameter for which the beam theory is used.
#[doc(hidden)]
pub const RATIOS: (f64, f64) = (1.02, 4.0);

/// Stress at the side of the bore over the mean stress of the section, F/((d_o - d_i) b). `ratio`: outer over inner diameter.
pub fn stress_concentration(ratio: f64) -> f64 {
    let (inner, outer) = (1.0, ratio);
    let (h, middle) = (outer - inner, 0.5 * (outer + inner));
    let neutral = h / (outer / inner).logarithm();
    let eccentricity = middle - neutral;
    let moment = 0.5 * middle - 4.0 / (PI * PI) * neutral;
    1.0 + 2.0 * moment * (neutral - inner) / (eccentricity * inner)
}

/// The least ratio, from `least` on, at which Goodman's line holds: amplitude and mean of the force, N, over bore times width times strength, for a stress
/// concentration times force over (ratio - 1); nothing where the widest eye does not hold.
pub(super) fn least_ratio(load: f64, bore: f64, width: f64, least: f64) -> Option<f64> {
    let holds = |ratio: f64| stress_concentration(ratio) * load / ((ratio - 1.0) * bore * width) <= 1.0;
    if holds(least) {
        return Some(least);
    }
    if !holds(RATIOS.1) {
        return None;
    }
    let (mut low, mut high) = (least, RATIOS.1);
    while high - low > 1e-13 * high {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if holds(middle) { high = middle } else { low = middle }
    }
    Some(high)
}
