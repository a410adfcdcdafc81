//! Cylinder pressure over the working cycle.

use super::measured::Measured;
use super::otto::Otto;
use super::wiebe::Wiebe;
use crate::engine::Geometry;

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

    /// Scales the mean effective pressure of the models that have one as an input; `false` where it has none.
    #[must_use]
    pub(crate) fn scale_load(&mut self, fraction: f64) -> bool {
        match self {
            Self::Otto(m) => m.pressure_scale *= fraction,
            Self::Wiebe(m) => m.indicated_mean_pressure.iter_mut().for_each(|p| *p *= fraction),
            Self::Measured(_) => return false,
        }
        true
    }
}
