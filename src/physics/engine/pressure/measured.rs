//! Measured pressure traces.

use super::sampling::{SAMPLE_DEG, samples};
use crate::engine::Load;
use crate::engine::load::between;
use crate::numerics::table_lookup;

/// Traces over a whole cycle at one or more speeds, linear in between samples.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Ascending, rpm.
    pub speeds_rpm: Vec<f64>,
    /// Ascending, degrees from firing dead centre, over one cycle (the first angle a cycle later may be repeated at the end or not).
    pub crank_deg: Vec<f64>,
    /// One trace a speed, Pa absolute, one value an angle: at full load.
    pub pressure: Vec<Vec<f64>>,
    /// Traces at other loads, ascending, of the same speeds and angles.
    pub part_load: Vec<PartLoad>,
}

/// Traces at one load.
#[derive(Debug, Clone, PartialEq)]
pub struct PartLoad {
    /// Share of full load.
    pub load: f64,
    /// As [`Measured::pressure`].
    pub pressure: Vec<Vec<f64>>,
}

impl Measured {
    /// Traces at a load, linear between the loads and speeds measured; held at the ends of the speeds, nothing outside the loads.
    pub(super) fn at_load(&self, load: &Load, range: (f64, f64)) -> Option<Self> {
        let mut loads: Vec<(f64, &Vec<Vec<f64>>)> = self.part_load.iter().map(|p| (p.load, &p.pressure)).collect();
        loads.push((1.0, &self.pressure));
        loads.sort_by(|a, b| a.0.total_cmp(&b.0));
        let shares: Vec<f64> = loads.iter().map(|l| l.0).collect();
        let speeds_rpm = load.corners(&self.speeds_rpm, range);
        let at_speed = |traces: &[Vec<f64>], speed: f64| -> Vec<f64> {
            let column = |a: usize| traces.iter().map(|t| t[a]).collect::<Vec<f64>>();
            (0..self.crank_deg.len()).map(|a| between(&self.speeds_rpm, &column(a), speed)).collect()
        };
        let trace = |speed: &f64| -> Option<Vec<f64>> {
            let share = load.at(*speed);
            if !(shares[0]..=shares[shares.len() - 1]).contains(&share) {
                return None;
            }
            let each: Vec<Vec<f64>> = loads.iter().map(|l| at_speed(l.1, *speed)).collect();
            Some((0..self.crank_deg.len()).map(|a| between(&shares, &each.iter().map(|t| t[a]).collect::<Vec<f64>>(), share)).collect())
        };
        let pressure = speeds_rpm.iter().map(trace).collect::<Option<Vec<_>>>()?;
        Some(Self { speeds_rpm, crank_deg: self.crank_deg.clone(), pressure, part_load: Vec::new() })
    }

    /// Expansion along the measured compression, mirrored at firing dead centre. What has burnt before dead centre stays in it.
    pub(super) fn motored(&self, index: usize, strokes: u32) -> Vec<f64> {
        let fired = self.trace(index, strokes);
        let n = fired.len();
        (0..n).map(|j| if (j as f64) * SAMPLE_DEG <= 180.0 { fired[(n - j) % n] } else { fired[j] }).collect()
    }

    pub(super) fn trace(&self, index: usize, strokes: u32) -> Vec<f64> {
        let cycle = 180.0 * f64::from(strokes);
        let (mut angle, mut pressure) = (self.crank_deg.clone(), self.pressure[index].clone());
        if angle[angle.len() - 1] - angle[0] < cycle - 1e-6 {
            angle.push(angle[0] + cycle);
            pressure.push(pressure[0]);
        }
        (0..samples(strokes))
            .map(|j| {
                let deg = angle[0] + (j as f64 * SAMPLE_DEG - angle[0]).rem_euclid(cycle);
                let (i, fraction) = table_lookup::interval(&angle, deg);
                pressure[i] + fraction * (pressure[i + 1] - pressure[i])
            })
            .collect()
    }
}
