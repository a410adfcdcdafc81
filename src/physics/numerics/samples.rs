//! Samples of a sum of harmonics over its period, and what they tell of its extremes.

use super::extremes::Extremes;
use super::sampling::{BLOCK, Sampled, Tables, mirrored};
use crate::numerics::C64;
use std::f64::consts::TAU;

/// A local maximum of the sum, or of its negative.
#[derive(Debug, Clone, Copy)]
pub(super) struct Local {
    pub(super) angle: f64,
    pub(super) value: f64,
    pub(super) bend: f64,
}

/// Samples of a sum over a period, the first half a step from angle zero; kept for reuse.
#[derive(Debug, Clone, Default)]
pub struct Samples {
    values: Vec<f64>,
    /// A buffer.
    ordered: Vec<C64>,
    ends: Sampled,
}

impl Samples {
    /// Takes those of another sum.
    pub(super) fn take(&mut self, tables: &Tables, phasors: &[C64]) {
        self.ends = tables.sample(phasors, &mut self.ordered, &mut self.values);
    }

    /// All of them, by angle.
    pub(super) fn values(&self) -> &[f64] {
        &self.values
    }

    /// Half their peak-to-peak: a little below that of the sum.
    pub fn half_peak_to_peak(&self) -> f64 {
        0.5 * (self.ends.high - self.ends.low)
    }

    /// Their extremes, a little inside those of the sum; at angle zero.
    pub(crate) fn extremes(&self) -> Extremes {
        Extremes { half_peak_to_peak: self.half_peak_to_peak(), middle: 0.5 * (self.ends.high + self.ends.low), ..Extremes::default() }
    }

    /// The largest of `sign` f.
    pub(super) fn end(&self, sign: f64) -> f64 {
        if sign > 0.0 { self.ends.high } else { -self.ends.low }
    }

    fn step(&self) -> f64 {
        TAU / self.values.len() as f64
    }

    /// Angle of sample `j`.
    pub(super) fn angle(&self, j: usize) -> f64 {
        (j as f64 + 0.5) * self.step()
    }

    /// Takes the indices of samples of at least `level`, of `sign` f: place by place in the blocks of the first eighth, with those that mirror it.
    pub(super) fn each_reaching(&self, sign: f64, level: f64, mut take: impl FnMut(usize)) {
        let ends = if sign > 0.0 { &self.ends.highs } else { &self.ends.lows };
        let n = self.values.len();
        for place in (0..BLOCK).filter(|place| sign * ends[*place] >= level) {
            for j in (place..n / 8).step_by(BLOCK) {
                for mirror in mirrored(j, n) {
                    if sign * self.values[mirror] >= level {
                        take(mirror);
                    }
                }
            }
        }
    }

    /// f' at sample `j` by seven samples: it errs by no more than the sixth power of a step times f^(7)/140.
    pub(super) fn slope(&self, j: usize) -> f64 {
        let [(a1, _), (a2, _), (a3, _)] = self.beside(j);
        (45.0 * a1 - 9.0 * a2 + a3) * (1.0 / 60.0) / self.step()
    }

    /// Differences and sums of the samples one, two and three steps after and before sample `j`.
    fn beside(&self, j: usize) -> [(f64, f64); 3] {
        let (f, n) = (&self.values, self.values.len());
        let sample = |k: usize| f[if k >= n { k - n } else { k }];
        [1, 2, 3].map(|d| (sample(j + d) - sample(j + n - d), sample(j + d) + sample(j + n - d)))
    }

    /// The largest of `sign` f where no maximum stands further than `reach` above its nearest sample: to about a millionth where the shortest waves are small, else to a thousandth.
    pub(super) fn near_end(&self, sign: f64, reach: f64) -> Local {
        let (f, last) = (&self.values, self.values.len() - 1);
        let lowest = self.end(sign) - reach;
        let mut best = Local { angle: 0.0, value: f64::NEG_INFINITY, bend: 0.0 };
        self.each_reaching(sign, lowest, |j| {
            let beside = [if j == 0 { last } else { j - 1 }, if j == last { 0 } else { j + 1 }];
            if beside.iter().all(|k| sign * f[*k] <= sign * f[j]) {
                let top = self.top_at(j, sign);
                best = if top.value > best.value { top } else { best };
            }
        });
        best
    }

    /// The maximum of `sign` f beside its largest sample.
    pub(super) fn near_top(&self, sign: f64) -> Local {
        let end = if sign > 0.0 { self.ends.high } else { self.ends.low };
        self.top_at(self.values.iter().position(|v| *v == end).unwrap_or(0), sign)
    }

    /// The maximum of `sign` f beside sample `j`, which is higher than those next to it: that of the polynomial through seven samples. With eight samples in the shortest wave the polynomial
    /// errs by at most a two-thousandth of the amplitude of that wave, and by less than a millionth of that of a wave three times as long.
    pub(super) fn top_at(&self, j: usize, sign: f64) -> Local {
        let [(a1, b1), (a2, b2), (a3, b3)] = self.beside(j).map(|(difference, sum)| (sign * difference, sign * sum));
        let middle = sign * self.values[j];
        // Taylor coefficients about the sample, in steps
        let c1 = (45.0 * a1 - 9.0 * a2 + a3) * (1.0 / 60.0);
        let c2 = (270.0 * b1 - 27.0 * b2 + 2.0 * b3 - 490.0 * middle) * (1.0 / 360.0);
        let c3 = (8.0 * a2 - 13.0 * a1 - a3) * (1.0 / 48.0);
        let c4 = (12.0 * b2 - 39.0 * b1 - b3 + 56.0 * middle) * (1.0 / 144.0);
        let c5 = (a3 - 4.0 * a2 + 5.0 * a1) * (1.0 / 240.0);
        let c6 = (b3 - 6.0 * b2 + 15.0 * b1 - 20.0 * middle) * (1.0 / 720.0);
        let vertex = if c2 < 0.0 { (-0.5 * c1 / c2).clamp(-1.0, 1.0) } else { 0.0 };
        let slope = |x: f64| c1 + x * (2.0 * c2 + x * (3.0 * c3 + x * (4.0 * c4 + x * (5.0 * c5 + x * 6.0 * c6))));
        let bend = |x: f64| 2.0 * c2 + x * (6.0 * c3 + x * (12.0 * c4 + x * (20.0 * c5 + x * 30.0 * c6)));
        let newton = |x: f64| if bend(x) < 0.0 { (x - slope(x) / bend(x)).clamp(-1.0, 1.0) } else { x };
        let x = newton(newton(vertex));
        let value = middle + x * (c1 + x * (c2 + x * (c3 + x * (c4 + x * (c5 + x * c6)))));
        Local { angle: self.angle(j) + x * self.step(), value, bend: 2.0 * c2 / (self.step() * self.step()) }
    }
}
