//! Cylinder pressure over the working cycle.

use super::measured::Measured;
use super::otto::Otto;
use super::wiebe::Wiebe;
use crate::engine::load::between;
use crate::engine::{Geometry, Load};

/// A model of the cylinder pressure, each tabulated at its own speeds.
#[derive(Debug, Clone, PartialEq)]
pub enum Pressure {
    /// Air-standard Otto cycle from a power or torque curve.
    Otto(Otto),
    /// Single-zone heat release after Wiebe.
    Wiebe(Wiebe),
    /// Measured traces.
    Measured(Measured),
}

impl Pressure {
    /// Speeds at which the model is tabulated, rpm, ascending.
    pub fn speeds_rpm(&self) -> &[f64] {
        match self {
            Self::Otto(m) => &m.speeds_rpm,
            Self::Wiebe(m) => &m.speeds_rpm,
            Self::Measured(m) => &m.speeds_rpm,
        }
    }

    /// Pressure over one cycle at tabulated speed `index`, Pa absolute, every `SAMPLE_DEG` from firing dead centre.
    /// `cylinders` and `strokes` turn brake power into work per cycle.
    pub fn trace(&self, index: usize, geometry: &Geometry, strokes: u32, cylinders: usize) -> Vec<f64> {
        match self {
            Self::Otto(m) => m.trace(index, geometry, strokes, cylinders),
            Self::Wiebe(m) => m.trace(index, geometry, strokes),
            Self::Measured(m) => m.trace(index, strokes),
        }
    }

    /// That of every tabulated speed.
    #[doc(hidden)]
    pub fn traces(&self, geometry: &Geometry, strokes: u32, cylinders: usize) -> Vec<Vec<f64>> {
        match self {
            Self::Otto(m) => m.traces(geometry, strokes, cylinders),
            other => (0..other.speeds_rpm().len()).map(|i| other.trace(i, geometry, strokes, cylinders)).collect(),
        }
    }

    /// Pressure of a cylinder that compresses and expands without burning, as in [`Self::trace`].
    pub fn motored(&self, index: usize, geometry: &Geometry, strokes: u32) -> Vec<f64> {
        match self {
            Self::Otto(m) => m.motored(geometry, strokes),
            Self::Wiebe(m) => m.motored(geometry, strokes),
            Self::Measured(m) => m.motored(index, strokes),
        }
    }

    /// Brake torque of the engine the model was given, N m, where it was.
    pub(crate) fn brake_torque(&self, index: usize) -> Option<f64> {
        match self {
            Self::Otto(m) => Some(m.brake_torque[index]),
            _ => None,
        }
    }

    /// The same at part load, at speeds from the lowest to the highest of `range`: brake torque or mean pressure times the share of full load, measured traces between those of the loads measured.
    /// Nothing where the traces were not measured at such a load.
    #[doc(hidden)]
    pub fn at_load(&self, load: &Load, range: (f64, f64)) -> Option<Self> {
        let scaled = |speeds: &[f64], full: &[f64]| -> (Vec<f64>, Vec<f64>) {
            let corners = load.corners(speeds, range);
            let values = corners.iter().map(|s| between(speeds, full, *s) * load.at(*s)).collect();
            (corners, values)
        };
        Some(match self {
            Self::Otto(m) => {
                let (speeds_rpm, brake_torque) = scaled(&m.speeds_rpm, &m.brake_torque);
                let scale_over_speed = speeds_rpm.iter().map(|s| between(&m.speeds_rpm, &m.scale_over_speed, *s)).collect();
                Self::Otto(Otto { speeds_rpm, brake_torque, scale_over_speed, ..m.clone() })
            }
            Self::Wiebe(m) => {
                let (speeds_rpm, indicated_mean_pressure) = scaled(&m.speeds_rpm, &m.indicated_mean_pressure);
                Self::Wiebe(Wiebe { speeds_rpm, indicated_mean_pressure, ..m.clone() })
            }
            Self::Measured(m) => Self::Measured(m.at_load(load, range)?),
        })
    }

    /// The same with the work of its brake curve, where it has one: the cycle of an Otto engine without its reconstruction factor.
    pub(crate) fn of_brake_curve(&self) -> Self {
        match self {
            Self::Otto(m) => Self::Otto(Otto { pressure_scale: 1.0, scale_over_speed: vec![1.0; m.speeds_rpm.len()], ..m.clone() }),
            other => other.clone(),
        }
    }
}
