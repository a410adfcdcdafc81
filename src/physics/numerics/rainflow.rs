//! Cycles of a periodic function by rainflow counting \[ASTM E1049, repeating histories\].

use super::C64;
use super::synthesis::Synthesiser;
use std::f64::consts::TAU;

impl Synthesiser {
    /// Values of the sum at its turning points over a period, in the order of their angles.
    pub(crate) fn turning_points(&self, phasors: &[C64]) -> Vec<f64> {
        let samples = self.samples(phasors);
        let extremes =
            |sign: f64| self.local_maxima(phasors, &samples, sign, f64::INFINITY).into_iter().map(move |l| (l.angle, sign * l.value));
        let mut points: Vec<(f64, f64)> = extremes(1.0).chain(extremes(-1.0)).collect();
        points.sort_by(|a, b| a.0.rem_euclid(TAU).total_cmp(&b.0.rem_euclid(TAU)));
        points.into_iter().map(|p| p.1).collect()
    }
}

/// Amplitudes (half the range) of all cycles of a history that repeats itself, from its turning points; the largest is that of the whole range.
pub fn amplitudes(turning_points: &[f64]) -> Vec<f64> {
    let Some(top) = (0..turning_points.len()).reduce(|m, i| if turning_points[i] > turning_points[m] { i } else { m }) else {
        return Vec::new();
    };
    let mut open: Vec<f64> = Vec::new();
    let mut list = Vec::new();
    // from the largest value round to itself every cycle closes
    let round = turning_points.iter().cycle().skip(top).take(turning_points.len() + 1);
    for point in round {
        open.push(*point);
        while let [.., a, b, c] = open[..] {
            if (c - b).abs() < (b - a).abs() {
                break;
            }
            list.push(0.5 * (b - a).abs());
            open.truncate(open.len() - 3);
            open.push(c);
        }
    }
    list
}
