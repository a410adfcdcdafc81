//! The engine: its cylinders or its table of torque harmonics.

use super::geometry::Geometry;
use super::harmonic_table::HarmonicTable;
use super::layout::Layout;
use super::pressure::Pressure;

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
    /// The same with the work of its brake curve, where its pressure follows one.
    #[doc(hidden)]
    pub fn of_brake_curve(&self) -> Self {
        match &self.source {
            Source::Cylinder { geometry, pressure } => {
                Self { source: Source::Cylinder { geometry: geometry.clone(), pressure: pressure.of_brake_curve() }, ..self.clone() }
            }
            Source::Harmonics(_) => self.clone(),
        }
    }

    /// Mean inertia of the reciprocating masses of a cylinder, kg m²: half of m r² (the part that varies with twice the crank angle is as large)
    /// \[Ker Wilson 1956\]. Nothing where the torque of a whole throw comes from a table.
    pub fn reciprocating_inertia(&self) -> Option<f64> {
        let geometry = match &self.source {
            Source::Cylinder { geometry, .. } => geometry,
            Source::Harmonics(table) => table.masses.as_ref()?,
        };
        Some(0.5 * geometry.oscillating_mass() * geometry.slider_crank.crank_radius.powi(2))
    }

    /// Crank angle of a working cycle, degrees: 360 (two-stroke) or 720 (four-stroke).
    #[doc(hidden)]
    pub fn cycle_deg(&self) -> f64 {
        180.0 * f64::from(self.strokes)
    }
}
