//! From cylinder pressure to the torque of every throw, as complex amplitudes of engine orders.

pub mod cycle;
pub mod excitation;
pub mod forces;
pub mod kinematics;
pub mod layout;
pub mod order;
pub mod pressure;

pub use excitation::{Excitation, HarmonicTable};
pub use kinematics::{Kinematics, SliderCrank};
pub use layout::Layout;
pub use order::Order;
pub use pressure::Pressure;

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
    /// Fraction of the rod that rotates with the crankpin, 0 to 1; the rest moves with the piston.
    pub rod_rotating_fraction: f64,
    /// Pressure under the piston, Pa absolute.
    pub crankcase_pressure: f64,
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
        self.piston_mass + (1.0 - self.rod_rotating_fraction) * self.rod_mass
    }
}

/// What makes the torque.
#[derive(Debug, Clone, PartialEq)]
pub enum Source {
    /// Gas pressure and moving masses.
    Cylinder {
        /// Shape and masses of a cylinder unit.
        geometry: Geometry,
        /// Pressure against crank angle and speed.
        pressure: Pressure,
    },
    /// A table of torque harmonics of a whole throw; no inertia torque is added.
    Harmonics(HarmonicTable),
}

/// An engine as the torsional chain sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct Engine {
    /// Name, for titles.
    pub name: String,
    /// 2 or 4.
    pub strokes: u32,
    /// Which cylinder acts on which throw, and when it fires.
    pub layout: Layout,
    /// Pressure and masses, or torque harmonics.
    pub source: Source,
}

impl Engine {
    /// Crank angle of a working cycle, degrees: 360 (two-stroke) or 720 (four-stroke).
    pub fn cycle_deg(&self) -> f64 {
        180.0 * f64::from(self.strokes)
    }
}
