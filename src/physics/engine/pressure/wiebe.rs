//! Single-zone cycle with heat release after Wiebe, whose area gives an indicated mean pressure.

use super::sampling::{SAMPLE_DEG, closed_part_deg, each_revolution, sample_angle};
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

/// The gas in the cylinder at an angle.
#[derive(Clone, Copy)]
struct Gas {
    /// Volume over piston area, m.
    height: f64,
    /// dx/dtheta, m/rad.
    slope: f64,
    /// height^-k.
    isentrope: f64,
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
        let gas = self.gas(geometry, strokes);
        self.compressed(geometry, &gas)
    }

    /// The gas at every sample.
    fn gas(&self, geometry: &Geometry, strokes: u32) -> Vec<Gas> {
        let clearance = self.clearance(geometry);
        each_revolution(strokes, |theta| {
            let motion = geometry.slider_crank.motion(theta);
            let height = clearance + motion.travel;
            Gas { height, slope: motion.slope, isentrope: height.power(-self.heat_capacity_ratio) }
        })
    }

    /// Clearance volume over piston area, m.
    fn clearance(&self, geometry: &Geometry) -> f64 {
        2.0 * geometry.slider_crank.crank_radius / (self.compression_ratio - 1.0)
    }

    /// Boost pressure compressed and expanded where the valves are closed.
    fn compressed(&self, geometry: &Geometry, gas: &[Gas]) -> Vec<f64> {
        let constant = (self.compression_ratio * self.clearance(geometry)).power(self.heat_capacity_ratio);
        let n = gas.len();
        let pressure_at =
            |(j, g): (usize, &Gas)| self.boost_pressure * if closed_part_deg(j, n).is_some() { constant * g.isentrope } else { 1.0 };
        gas.iter().enumerate().map(pressure_at).collect()
    }

    /// d(p V^k) = (k - 1) V^(k - 1) dQ is linear in the heat: the pressure is that of the motored cycle plus heat times a unit trace,
    /// and the heat follows from the area.
    pub(super) fn trace(&self, index: usize, geometry: &Geometry, strokes: u32) -> Vec<f64> {
        let k = self.heat_capacity_ratio;
        let gas = self.gas(geometry, strokes);
        let n = gas.len();
        let motored = self.compressed(geometry, &gas);
        let mut unit = vec![0.0; n];
        let (mut released, mut burnt) = (0.0, self.burnt(-180.0));
        let half_turn = (180.0 / SAMPLE_DEG).round() as usize;
        for step in 0..2 * half_turn {
            let (j, next) = ((n - half_turn + step) % n, (n - half_turn + step + 1) % n);
            let deg = step as f64 * SAMPLE_DEG - 180.0;
            let before = std::mem::replace(&mut burnt, self.burnt(deg + SAMPLE_DEG));
            if burnt > before {
                released += (burnt - before) * (0.5 * (gas[j].height + gas[next].height)).power(k - 1.0);
            }
            if closed_part_deg(next, n).is_some() {
                unit[next] = released * gas[next].isentrope;
            }
        }
        let work = |p: &[f64]| -> f64 { p.iter().zip(&gas).map(|(p, g)| p * g.slope).sum() };
        let wanted = self.indicated_mean_pressure[index] * 2.0 * geometry.slider_crank.crank_radius / sample_angle(1);
        let heat = (wanted - work(&motored)) / work(&unit);
        motored.iter().zip(&unit).map(|(m, u)| m + heat * u).collect()
    }
}
