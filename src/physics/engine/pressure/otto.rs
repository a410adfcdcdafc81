//! Air-standard Otto cycle whose area gives a mean effective pressure.

use super::sampling::{closed_part_deg, sample_angle, samples};
use crate::engine::Geometry;
use crate::numerics::elementary::Elementary;
use std::f64::consts::PI;

/// Heat at constant volume, isentropes between the dead centres, gas exchange at inlet pressure \[Villalva 2014\] eqs. (3.1) to (3.7).
#[derive(Debug, Clone, PartialEq)]
pub struct Otto {
    /// Ascending, rpm.
    pub speeds_rpm: Vec<f64>,
    /// Brake torque of the engine at each speed, N m.
    pub brake_torque: Vec<f64>,
    /// Above 1.
    pub compression_ratio: f64,
    /// Cycle mean pressure over brake mean pressure. A reconstruction factor: the theses give 1/0.55, their amplitudes need less than 1.
    pub pressure_scale: f64,
    /// What it is multiplied by at each speed.
    pub scale_over_speed: Vec<f64>,
    /// Inlet pressure, Pa absolute.
    pub inlet_pressure: f64,
    /// c_p/c_v, above 1.
    pub heat_capacity_ratio: f64,
}

impl Otto {
    /// Brake mean effective pressure, Pa: work per cycle over displaced volume. \[Villalva 2014\] eq. (3.6) with the speed in rev/s.
    pub fn brake_mean_pressure(&self, index: usize, geometry: &Geometry, strokes: u32, cylinders: usize) -> f64 {
        self.brake_torque[index] * PI * f64::from(strokes) / (cylinders as f64 * geometry.displacement())
    }

    pub(super) fn trace(&self, index: usize, geometry: &Geometry, strokes: u32, cylinders: usize) -> Vec<f64> {
        self.isentropes(&self.powers(geometry, strokes), self.after(index, geometry, strokes, cylinders))
    }

    pub(super) fn traces(&self, geometry: &Geometry, strokes: u32, cylinders: usize) -> Vec<Vec<f64>> {
        let powers = self.powers(geometry, strokes);
        (0..self.speeds_rpm.len()).map(|i| self.isentropes(&powers, self.after(i, geometry, strokes, cylinders))).collect()
    }

    /// Without heat: expansion along the compression line.
    pub(super) fn motored(&self, geometry: &Geometry, strokes: u32) -> Vec<f64> {
        self.isentropes(&self.powers(geometry, strokes), self.inlet_pressure)
    }

    /// Pressure after expansion to bottom dead centre.
    fn after(&self, index: usize, geometry: &Geometry, strokes: u32, cylinders: usize) -> f64 {
        let (rc, k) = (self.compression_ratio, self.heat_capacity_ratio);
        let mean = self.pressure_scale * self.scale_over_speed[index] * self.brake_mean_pressure(index, geometry, strokes, cylinders);
        // The area of the cycle is clearance volume / (k - 1) (p3 - p2) (1 - rc^(1 - k)); displaced = clearance (rc - 1).
        let rise = mean * (rc - 1.0) * (k - 1.0) / (1.0 - rc.power(1.0 - k));
        self.inlet_pressure + rise * rc.power(-k)
    }

    /// Ratio of the largest volume to that of each sample to the power of k, of those in which the cylinder is closed.
    fn powers(&self, geometry: &Geometry, strokes: u32) -> Vec<f64> {
        let rc = self.compression_ratio;
        let clearance = 2.0 * geometry.slider_crank.crank_radius / (rc - 1.0);
        let n = samples(strokes);
        let power = |j: usize| {
            let ratio = rc * clearance / (clearance + geometry.slider_crank.motion(sample_angle(j)).travel);
            if closed_part_deg(j, n).is_some() { ratio.power(self.heat_capacity_ratio) } else { 1.0 }
        };
        (0..n).map(power).collect()
    }

    /// Compression from inlet pressure, expansion to `after` at bottom dead centre.
    fn isentropes(&self, powers: &[f64], after: f64) -> Vec<f64> {
        let pressure_at = |(j, power): (usize, &f64)| match closed_part_deg(j, powers.len()) {
            // heat comes and goes at dead centre, where the lever is zero: which side holds there does not matter
            Some(deg) if deg < 0.0 => self.inlet_pressure * power,
            Some(_) => after * power,
            None => self.inlet_pressure,
        };
        powers.iter().enumerate().map(pressure_at).collect()
    }
}
