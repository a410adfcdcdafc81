//! From the fatigue limit of a polished specimen to that of a part \[Fialho & Almeida 2019\] eqs. (37) to (44), after \[Norton 2013\] chapter 6.

use crate::numerics::elementary::Elementary;
use crate::units::{M_PER_IN, M_PER_MM, PA_PER_KPSI, PA_PER_MPA};

/// How the part is loaded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Loading {
    /// Bending, and bending with torsion as von Mises stress.
    Bending,
    /// Tension and compression.
    Axial,
}

/// Finish of the surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Surface {
    /// Ground.
    Ground,
    /// Machined or cold-drawn.
    Machined,
    /// Hot-rolled.
    HotRolled,
    /// As forged.
    Forged,
}

/// What a part differs in from a specimen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Endurance {
    /// Load.
    pub loading: Loading,
    /// Round section, m.
    pub diameter: f64,
    /// Finish.
    pub surface: Surface,
    /// °C, up to `HOTTEST`.
    pub temperature_c: f64,
    /// Per cent, one of `RELIABILITIES`.
    pub reliability_percent: f64,
}

/// Highest temperature of the formula, °C.
#[doc(hidden)]
pub const HOTTEST: f64 = 550.0;
/// Reliabilities with a factor, per cent.
#[doc(hidden)]
pub const RELIABILITIES: [f64; 8] = [50.0, 90.0, 95.0, 99.0, 99.9, 99.99, 99.999, 99.9999];
const RELIABILITY_FACTORS: [f64; 8] = [1.0, 0.897, 0.868, 0.814, 0.753, 0.702, 0.659, 0.620];

impl Endurance {
    /// Factors of load, size, surface, temperature and reliability. `tensile` in Pa. The surface factor is one at most.
    pub fn factors(&self, tensile: f64) -> [f64; 5] {
        let load = match self.loading {
            Loading::Bending => 1.0,
            Loading::Axial => 0.7,
        };
        let d = self.diameter / M_PER_MM;
        // Norton: no reduction below 8 mm, 0.6 above 250 mm
        let size = match d {
            _ if d <= 8.0 => 1.0,
            _ if d <= 250.0 => 1.189 * d.power(-0.097),
            _ => 0.6,
        };
        let (a, b) = match self.surface {
            Surface::Ground => (1.58, -0.085),
            Surface::Machined => (4.51, -0.265),
            Surface::HotRolled => (57.7, -0.718),
            Surface::Forged => (272.0, -0.995),
        };
        let surface = (a * (tensile / PA_PER_MPA).power(b)).min(1.0);
        let temperature = 1.0 - 0.0058 * (self.temperature_c - 450.0).max(0.0);
        let reliability = RELIABILITIES.iter().position(|r| *r == self.reliability_percent).map_or(1.0, |i| RELIABILITY_FACTORS[i]);
        [load, size, surface, temperature, reliability]
    }
}

/// Fatigue limit of a polished steel specimen in reversed bending, Pa: half the tensile strength, at most 700 MPa, eq. (42).
pub fn estimated_limit(tensile: f64) -> f64 {
    (0.5 * tensile).min(700.0 * PA_PER_MPA)
}

/// Neuber's constant of steels, root of inches, by tensile strength in kpsi \[Norton 2013\] table 6-6.
const NEUBER: [(f64, f64); 16] = [
    (50.0, 0.130),
    (55.0, 0.118),
    (60.0, 0.108),
    (70.0, 0.093),
    (80.0, 0.080),
    (90.0, 0.070),
    (100.0, 0.062),
    (110.0, 0.055),
    (120.0, 0.049),
    (130.0, 0.044),
    (140.0, 0.039),
    (160.0, 0.031),
    (180.0, 0.024),
    (200.0, 0.018),
    (220.0, 0.013),
    (240.0, 0.009),
];

/// Sensitivity to a notch of `radius` (m), 0 to 1: 1/(1 + sqrt(a/r)) with Neuber's constant; in torsion that of a steel 20 kpsi stronger. `tensile` in Pa;
/// steels outside the table (345 to 1655 MPa) are taken at its ends.
pub fn notch_sensitivity(radius: f64, tensile: f64, torsion: bool) -> f64 {
    let strength = tensile / PA_PER_KPSI + if torsion { 20.0 } else { 0.0 };
    let last = NEUBER[NEUBER.len() - 1];
    let constant = match NEUBER.windows(2).find(|p| strength < p[1].0) {
        Some([a, b]) => a.1 + (b.1 - a.1) * ((strength - a.0) / (b.0 - a.0)).max(0.0),
        _ => last.1,
    };
    1.0 / (1.0 + constant / (radius / M_PER_IN).sqrt())
}

/// Fatigue concentration factor of a notch with geometric factor `kt` and sensitivity `q`, eqs. (43) and (44).
pub fn fatigue_factor(kt: f64, q: f64) -> f64 {
    1.0 + q * (kt - 1.0)
}
