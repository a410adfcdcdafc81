//! How the heat of an absorber leaves it: to the air, and to (or from) the crank that carries it.
//!
//! The coefficients of a disc are as they are commonly quoted, not checked against the print; the mean over a disc that is laminar inside and turbulent outside is derived from them.

use crate::numerics::elementary::Elementary;

/// Temperatures round an absorber, and how well it is connected to them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cooling {
    /// °C.
    pub air: f64,
    /// °C.
    pub hub: f64,
    /// To the air.
    pub to_air: ToAir,
    /// W/K.
    pub to_hub: f64,
    /// What the material bears, °C.
    pub limit: f64,
}

/// Conductance to the air.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ToAir {
    /// W/K at every speed.
    Given(f64),
    /// Of a disc that turns in still air: both faces and the rim. Nu = h R/lambda = 0.36 Re^(1/2) with Re = Omega R²/nu; outside the radius at which Re reaches 2.4e5 turbulent, a whole disc of which has
    /// 0.015 Re^0.8 \[Cobb & Saunders 1956\]. With s, the share of the radius that is laminar, the mean is 0.36 Re^(1/2) s² + 0.015 Re^0.8 (1 - s^2.6), as the local coefficient is constant inside and rises as
    /// r^0.6 outside.
    Disc {
        /// R, m.
        radius: f64,
        /// m.
        width: f64,
    },
    /// The same of the damper's own outer diameter and width, which follow from its dimensions: as wide as it is.
    Own {
        /// R, m.
        radius: f64,
        /// m.
        width: f64,
    },
}

/// Air at 40 °C: thermal conductivity, W/(m K), and kinematic viscosity, m²/s.
const CONDUCTIVITY: f64 = 0.0271;
const VISCOSITY: f64 = 1.70e-5;
/// Reynolds number above which the flow over a disc is turbulent.
const TURBULENT: f64 = 2.4e5;

impl ToAir {
    /// W/K at a speed of the shaft, rad/s.
    pub fn conductance(self, shaft_speed: f64) -> f64 {
        match self {
            Self::Given(conductance) => conductance,
            Self::Disc { radius, width } | Self::Own { radius, width } => {
                let reynolds = shaft_speed * radius * radius / VISCOSITY;
                let laminar = (TURBULENT / reynolds).sqrt().min(1.0);
                let nusselt = 0.36 * reynolds.sqrt() * laminar * laminar + 0.015 * reynolds.power(0.8) * (1.0 - laminar.power(2.6));
                let area = 2.0 * std::f64::consts::PI * radius * (radius + width);
                nusselt * CONDUCTIVITY / radius * area
            }
        }
    }
}

impl Cooling {
    /// Temperature without heat, °C, and how much each watt adds, K/W, at a speed of the shaft, rad/s.
    pub fn at(&self, shaft_speed: f64) -> (f64, f64) {
        let to_air = self.to_air.conductance(shaft_speed);
        let sum = to_air + self.to_hub;
        ((to_air * self.air + self.to_hub * self.hub) / sum, 1.0 / sum)
    }
}
