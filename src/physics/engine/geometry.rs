//! Dimensions and masses of a cylinder unit.

use super::kinematics::SliderCrank;
/// How the mass of a rod is spread.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RodModel {
    /// One mass on each eye.
    TwoMasses {
        /// Fraction that rotates with the crankpin, 0 to 1; the rest moves with the piston.
        rotating_fraction: f64,
    },
    /// A rigid body.
    Body {
        /// Distance of the centre of mass from the centre of the big end, m.
        centre_from_big_end: f64,
        /// About the centre of mass, kg m².
        inertia: f64,
    },
}

/// Geometry and moving masses of one cylinder unit; all cylinders are alike.
#[derive(Debug, Clone, PartialEq)]
pub struct Geometry {
    /// m.
    pub bore: f64,
    /// Crank, rod and the kinematic law.
    pub slider_crank: SliderCrank,
    /// Piston, rings and pin, kg.
    pub piston_mass: f64,
    /// kg.
    pub rod_mass: f64,
    /// How its mass is spread.
    pub rod: RodModel,
    /// Pressure under the piston, Pa absolute.
    pub crankcase_pressure: f64,
    /// Coulomb friction between piston and liner: friction over normal force.
    pub liner_friction: f64,
}

impl Geometry {
    /// Piston area, m².
    pub fn piston_area(&self) -> f64 {
        0.25 * std::f64::consts::PI * self.bore * self.bore
    }

    /// Volume displaced in a stroke, m³ \[Villalva 2014\] eq. (3.4).
    pub fn displacement(&self) -> f64 {
        2.0 * self.slider_crank.crank_radius * self.piston_area()
    }

    /// Mass that moves with the piston, kg \[Villalva 2014\] p. 46.
    pub fn oscillating_mass(&self) -> f64 {
        self.piston_mass + (1.0 - self.rod_rotating_fraction()) * self.rod_mass
    }

    /// What of a rod and its piston turns with the pin, kg: the rotating part of the rod, and half the oscillating mass, the constant part of its inertia.
    #[doc(hidden)]
    pub fn mass_on_pin(&self) -> f64 {
        self.rod_rotating_fraction() * self.rod_mass + 0.5 * self.oscillating_mass()
    }

    /// Fraction of the rod that rotates with the crankpin: two masses in its eyes with the same centre.
    pub fn rod_rotating_fraction(&self) -> f64 {
        match self.rod {
            RodModel::TwoMasses { rotating_fraction } => rotating_fraction,
            RodModel::Body { centre_from_big_end, .. } => 1.0 - centre_from_big_end / self.slider_crank.rod_length,
        }
    }

    /// Distance of the rod's centre of mass from the centre of the big end, m.
    pub fn rod_centre(&self) -> f64 {
        (1.0 - self.rod_rotating_fraction()) * self.slider_crank.rod_length
    }

    /// Inertia about its centre of mass of a rod that is two masses in its eyes: m a b, kg m².
    pub fn two_mass_inertia(&self) -> f64 {
        let a = self.rod_centre();
        self.rod_mass * a * (self.slider_crank.rod_length - a)
    }

    /// Inertia of the rod beyond that, kg m²; zero for two masses.
    pub fn excess_inertia(&self) -> f64 {
        match self.rod {
            RodModel::TwoMasses { .. } => 0.0,
            RodModel::Body { inertia, .. } => inertia - self.two_mass_inertia(),
        }
    }
}
