//! The classification societies' limits of torsional vibration: of propulsion shafts \[IACS UR M68\], and of crankshafts \[KR Pt 5 Ch 4\].

use crate::numerics::elementary::Elementary;
use crate::units::{M_PER_MM, PA_PER_MPA};

/// A limit of nominal shear stress over the ratio of speed to rated speed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(hidden)]
pub enum ShaftRule {
    /// Of propulsion shafts.
    Propulsion {
        /// Tensile strength, Pa.
        tensile: f64,
        /// c_K of the design of the shaft: 1.0 for an integral flange, 0.6 for a tapered keyway.
        stress_factor: f64,
        /// m.
        diameter: f64,
    },
    /// Of crankshafts.
    Crank {
        /// Tensile strength, Pa.
        tensile: f64,
        /// Whether the engine is a four-stroke in line or a vee of 45 or 60 degrees.
        in_line: bool,
    },
}

/// Steps of the ratio of speeds between which a limit is taken as linear: below its curve, by less than 1e-4 of it where it is smooth.
const STEP: f64 = 0.01;
/// Points above the rated speed, closer where the limit of cranks begins to rise, as a square root.
const ABOVE: usize = 40;

impl ShaftRule {
    /// Permissible amplitude of nominal shear stress for continuous running at a ratio of speeds, Pa.
    ///
    /// Propulsion: tau_C = (sigma_B + 160)/18 c_K c_D C, in N and mm, with c_D = 0.35 + 0.93 d^-0.2, and C = 3 - 2 lambda² below 0.9 of the rated speed, 1.38 from there.
    /// Crank: 45 - 24 lambda², or 45 - 29 lambda² for others than four-strokes in line and vees of 45 or 60 degrees, above the rated speed 237 (lambda - 0.8) sqrt(lambda - 1) more
    /// than at it; times 1 + 2/3 (sigma_B/440 - 1).
    pub fn continuous(self, ratio: f64) -> f64 {
        match self {
            Self::Propulsion { tensile, stress_factor, diameter } => {
                let size = 0.35 + 0.93 * (diameter / M_PER_MM).power(-0.2);
                let speed = 3.0 - 2.0 * ratio.min(0.9).powi(2);
                (tensile / PA_PER_MPA + 160.0) / 18.0 * stress_factor * size * speed * PA_PER_MPA
            }
            Self::Crank { tensile, in_line } => {
                let slope = if in_line { 24.0 } else { 29.0 };
                let below = 45.0 - slope * ratio.min(1.0).powi(2);
                let above = 237.0 * (ratio - 0.8) * (ratio - 1.0).max(0.0).sqrt();
                (below + above) * (1.0 + 2.0 / 3.0 * (tensile / PA_PER_MPA / 440.0 - 1.0)) * PA_PER_MPA
            }
        }
    }

    /// Stress for passing through a barred range quickly over that for continuous running: 1.7/sqrt(c_K) of propulsion shafts \[IACS UR M68\]; `None` of cranks, where the rule goes by the yield strength, which is not
    /// asked for.
    pub fn transient(self) -> Option<f64> {
        match self {
            Self::Propulsion { stress_factor, .. } => Some(1.7 / stress_factor.sqrt()),
            Self::Crank { .. } => None,
        }
    }

    /// The ratio of speeds up to which there is a limit.
    pub fn top(self) -> f64 {
        match self {
            Self::Propulsion { .. } => 1.05,
            Self::Crank { .. } => 1.15,
        }
    }

    /// Ratios of speeds between which its limit is nearly linear, the last one that up to which there is a limit.
    pub fn ratios(self) -> Vec<f64> {
        let below = |last: f64| (1..=(last / STEP).round() as usize).map(|i| i as f64 * STEP);
        match self {
            Self::Propulsion { .. } => below(0.9).chain([self.top()]).collect(),
            Self::Crank { .. } => {
                let above = (1..=ABOVE).map(|i| 1.0 + (self.top() - 1.0) * (i as f64 / ABOVE as f64).powi(2));
                below(1.0).chain(above).collect()
            }
        }
    }
}

/// Ratio of speeds above which no range may be barred in normal firing.
#[doc(hidden)]
pub const HIGHEST_BARRED: f64 = 0.8;

/// The range that a critical speed bars, rpm: 16 n/(18 - lambda) to (18 - lambda) n/16 \[IACS UR M68\]; taken for cranks, too (assumption).
#[doc(hidden)]
pub fn barred(critical_rpm: f64, rated_rpm: f64) -> (f64, f64) {
    let width = (18.0 - critical_rpm / rated_rpm) / 16.0;
    (critical_rpm / width, critical_rpm * width)
}
