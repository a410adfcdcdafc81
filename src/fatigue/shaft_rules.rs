//! The classification societies' limit of torsional vibration in propulsion shafts \[IACS UR M68\].

use crate::units::{M_PER_MM, PA_PER_MPA};

/// Ratios of speed to rated speed from which the limit is constant, and up to which there is one.
pub(crate) const RATIOS: (f64, f64) = (0.9, 1.05);

/// Permissible amplitude of nominal shear stress for continuous running, Pa: tau_C = (sigma_B + 160)/18 c_K c_D C, in N and mm, with c_D = 0.35 + 0.93 d^-0.2, and C = 3 - 2 lambda² below 0.9 of
/// the rated speed, 1.38 from there to 1.05 of it. `stress_factor`: c_K of the design of the shaft (1.0 for an integral flange, 0.6 for a tapered keyway).
pub(crate) fn continuous(tensile: f64, stress_factor: f64, diameter: f64, speed_ratio: f64) -> f64 {
    let size = 0.35 + 0.93 * (diameter / M_PER_MM).powf(-0.2);
    let speed = 3.0 - 2.0 * speed_ratio.min(RATIOS.0).powi(2);
    (tensile / PA_PER_MPA + 160.0) / 18.0 * stress_factor * size * speed * PA_PER_MPA
}
