//! How a material follows temperature: the factor on its stiffness and loss, or on its relaxation time, against a reference.
//!
//! The numbers of WLF and of the silicone oil are as they are commonly quoted; neither was checked against the print.

use crate::numerics::elementary::Elementary;
use crate::units::KELVIN_AT_0_C;
use std::f64::consts::LN_10;

/// A law of temperature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TemperatureLaw {
    /// Williams, Landel and Ferry: log10 a = -C1 (T - Tr)/(C2 + T - Tr) \[Ferry 1980\]. Holds from 10 K above the glass transition, which lies C2 - 51.6 K below the reference.
    Wlf {
        /// C1.
        c1: f64,
        /// C2, K.
        c2: f64,
        /// Tr, °C.
        reference: f64,
    },
    /// Arrhenius: ln a = (E/R)(1/T - 1/Tr), temperatures in kelvin.
    Arrhenius {
        /// E, J/mol.
        activation: f64,
        /// Tr, °C.
        reference: f64,
    },
    /// Exponential: a = exp(-beta (T - Tr)), between the temperatures it was measured at.
    Exponential {
        /// beta, 1/K.
        per_k: f64,
        /// Tr, °C.
        reference: f64,
        /// °C.
        between: (f64, f64),
    },
    /// Polydimethylsiloxane oil: log10(nu/nu25) = 763.1/(273 + T) - 2.559, -25 to 250 °C (Shin-Etsu, Silicone Fluid KF-96, performance test results).
    SiliconeOil {
        /// Temperature that the absorber's values belong to, °C.
        reference: f64,
    },
}

/// Molar gas constant, J/(mol K).
const GAS_CONSTANT: f64 = 8.314_462_618;
/// Of the universal form of Williams, Landel and Ferry: C2 at the glass transition, and how far above it the form holds, K.
const C2_AT_GLASS: f64 = 51.6;
const ABOVE_GLASS: f64 = 10.0;
/// Range of the silicone oils, °C.
const OIL: (f64, f64) = (-25.0, 250.0);

impl TemperatureLaw {
    /// Temperatures at which it holds, °C.
    pub fn range(&self) -> (f64, f64) {
        match *self {
            Self::Wlf { c2, reference, .. } => (reference - c2 + C2_AT_GLASS + ABOVE_GLASS, f64::INFINITY),
            Self::Arrhenius { .. } => (-KELVIN_AT_0_C, f64::INFINITY),
            Self::Exponential { between, .. } => between,
            Self::SiliconeOil { .. } => OIL,
        }
    }

    /// Its temperature of reference, °C.
    pub fn reference(&self) -> f64 {
        match *self {
            Self::Wlf { reference, .. }
            | Self::Arrhenius { reference, .. }
            | Self::Exponential { reference, .. }
            | Self::SiliconeOil { reference } => reference,
        }
    }

    /// The factor at a temperature, °C: one at the reference.
    pub fn factor(&self, celsius: f64) -> f64 {
        self.log_factor(celsius).exponential()
    }

    /// Its natural logarithm.
    pub(crate) fn log_factor(&self, celsius: f64) -> f64 {
        match *self {
            Self::Wlf { c1, c2, reference } => -LN_10 * c1 * (celsius - reference) / (c2 + celsius - reference),
            Self::Arrhenius { activation, reference } => {
                activation / GAS_CONSTANT * (1.0 / (celsius + KELVIN_AT_0_C) - 1.0 / (reference + KELVIN_AT_0_C))
            }
            Self::Exponential { per_k, reference, .. } => -per_k * (celsius - reference),
            Self::SiliconeOil { reference } => LN_10 * (763.1 / (273.0 + celsius) - 763.1 / (273.0 + reference)),
        }
    }
}
