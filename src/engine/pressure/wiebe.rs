//! Single-zone cycle with heat release after Wiebe, whose area gives an indicated mean pressure.

use super::sampling::{SAMPLE_DEG, closed_part_deg, sample_angle, samples};
use crate::engine::Geometry;
use crate::numerics::elementary::Elementary;

/// Compression from boost pressure at bottom dead centre, heat release x = 1 - exp(-a y^(m + 1)) over the burn \[Heywood 1988\] eq. (9.12),
/// expansion to bottom dead centre, gas exchange at boost pressure. The wall takes no heat.
#[derive(Debug, Clone, PartialEq)]
pub struct Wiebe {
    /// Ascending, rpm.
    pub speeds_rpm: Vec<f64>,
    /// At each speed, Pa.
    pub indicated_mean_pressure: Vec<f64>,
    /// Pa absolute.
    pub boost_pressure: f64,
    /// Above 1.
    pub compression_ratio: f64,
    /// From firing dead centre, degrees.
    pub burn_start_deg: f64,
    /// Degrees.
    pub burn_duration_deg: f64,
    /// The exponent m of Wiebe's function.
    pub shape: f64,
    /// c_p/c_v, above 1.
    pub heat_capacity_ratio: f64,
}

/// Wiebe's a: 99.9 % of the heat is released at the end of the burn.
const EFFICIENCY: f64 = 6.907_755_278_982_137;

impl Wiebe {
    /// Fraction of the heat released at `deg` from firing dead centre.
    fn burnt(&self, deg: f64) -> f64 {
        let y = ((deg - self.burn_start_deg) / self.burn_duration_deg).clamp(0.0, 1.0);
        1.0 - (-EFFICIENCY * y.power(self.shape + 1.0)).exponential()
    }

    /// Without heat: compression and expansion along one line.
    pub(super) fn motored(&self, geometry: &Geometry, strokes: u32) -> Vec<f64> {
        let (heights, _) = self.heights(geometry, strokes);
        let isentrope: Vec<f64> = heights.iter().map(|h| h.power(-self.heat_capacity_ratio)).collect();
        self.compressed(geometry, &isentrope)
    }

    /// Height of the gas over its piston area at every sample, m, and dx/dtheta, m/rad.
    fn heights(&self, geometry: &Geometry, strokes: u32) -> (Vec<f64>, Vec<f64>) {
        let clearance = self.clearance(geometry);
        let motion = (0..samples(strokes)).map(|j| geometry.slider_crank.motion(sample_angle(j)));
        motion.map(|m| (clearance + m.travel, m.slope)).unzip()
    }

    /// Clearance volume over piston area, m.
    fn clearance(&self, geometry: &Geometry) -> f64 {
        2.0 * geometry.slider_crank.crank_radius / (self.compression_ratio - 1.0)
    }

    /// Boost pressure compressed and expanded where the valves are closed; `isentrope`: height^-k.
    fn compressed(&self, geometry: &Geometry, isentrope: &[f64]) -> Vec<f64> {
        let constant = (self.compression_ratio * self.clearance(geometry)).power(self.heat_capacity_ratio);
        let n = isentrope.len();
        let at = |(j, i): (usize, &f64)| self.boost_pressure * if closed_part_deg(j, n).is_some() { constant * i } else { 1.0 };
        isentrope.iter().enumerate().map(at).collect()
    }

    /// d(p V^k) = (k - 1) V^(k - 1) dQ is linear in the heat: the pressure is that of the motored cycle plus heat times a unit trace,
    /// and the heat follows from the area.
    pub(super) fn trace(&self, index: usize, geometry: &Geometry, strokes: u32) -> Vec<f64> {
        let k = self.heat_capacity_ratio;
        let (heights, slopes) = self.heights(geometry, strokes);
        let n = heights.len();
        let isentrope: Vec<f64> = heights.iter().map(|h| h.power(-k)).collect();
        let motored = self.compressed(geometry, &isentrope);
        let mut unit = vec![0.0; n];
        let mut released = 0.0;
        let half_turn = (180.0 / SAMPLE_DEG).round() as usize;
        for step in 0..2 * half_turn {
            let (j, next) = ((n - half_turn + step) % n, (n - half_turn + step + 1) % n);
            let deg = step as f64 * SAMPLE_DEG - 180.0;
            let share = self.burnt(deg + SAMPLE_DEG) - self.burnt(deg);
            if share > 0.0 {
                released += share * (0.5 * (heights[j] + heights[next])).power(k - 1.0);
            }
            if closed_part_deg(next, n).is_some() {
                unit[next] = released * isentrope[next];
            }
        }
        let work = |p: &[f64]| -> f64 { p.iter().zip(&slopes).map(|(p, slope)| p * slope).sum() };
        let wanted = self.indicated_mean_pressure[index] * 2.0 * geometry.slider_crank.crank_radius / sample_angle(1);
        let heat = (wanted - work(&motored)) / work(&unit);
        motored.iter().zip(&unit).map(|(m, u)| m + heat * u).collect()
    }
}
