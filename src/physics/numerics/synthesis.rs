//! Half peak-to-peak of a sum of harmonics, with phase.

pub use super::extremes::Extremes;
use super::maximise::maximise;
use super::samples::Local;
pub use super::samples::Samples;
use super::sampling::Tables;
use super::{C64, ZERO, abs_sums, series};
use crate::numerics::elementary::{ComplexElementary, turn};
use std::f64::consts::TAU;

/// Of samples, several times what they err by, as a share of the sum of magnitudes.
const ROUNDING: f64 = 1e-14;
/// Other pairs of extremes that are offered, at most.
const MOST_OTHERS: usize = 4;

impl Extremes {
    pub(super) fn of(high: Local, low: Local) -> Self {
        // the minimum comes as a maximum of -f
        let (half_peak_to_peak, middle) = (0.5 * (high.value + low.value), 0.5 * (high.value - low.value));
        Self { half_peak_to_peak, middle, angle_max: high.angle, angle_min: low.angle }
    }
}

/// Finds extremes of sums over a fixed set of harmonics; holds the tables of sines and cosines.
#[derive(Debug, Clone)]
pub struct Synthesiser {
    harmonics: Vec<u32>,
    /// Whether they are 1, 2, 3 and so on.
    consecutive: bool,
    /// Their squares.
    squares: Vec<f64>,
    tables: Tables,
    /// What a slope by samples may err by, of each harmonic of magnitude one.
    doubts: Vec<f64>,
}

impl Synthesiser {
    /// For the given harmonic numbers (ascending, each at least 1).
    pub fn new(harmonics: &[u32]) -> Self {
        let tables = Tables::new(harmonics);
        let step = TAU / tables.samples() as f64;
        Self {
            harmonics: harmonics.to_vec(),
            consecutive: harmonics.iter().zip(1..).all(|(h, n)| *h == n),
            squares: harmonics.iter().map(|h| f64::from(h * h)).collect(),
            doubts: harmonics.iter().map(|&h| f64::from(h) * (f64::from(h) * step).powi(6) / 140.0 + ROUNDING / step).collect(),
            tables,
        }
    }

    /// Largest and smallest value of the sum, to rounding: sampled, then every sampled extreme that could win is polished by Newton's
    /// method on the derivative.
    pub fn extremes(&self, phasors: &[C64]) -> Extremes {
        if phasors.len() == 1 {
            return self.single(phasors[0]);
        }
        self.polished(phasors, &self.samples(phasors))
    }

    pub(super) fn polished(&self, phasors: &[C64], samples: &Samples) -> Extremes {
        let first = |sign| self.local_maxima(phasors, samples, sign, 0.0).swap_remove(0);
        Extremes::of(first(1.0), first(-1.0))
    }

    /// Extremes from samples of the sum, beside the largest and the smallest of them: to about a millionth where short waves are small.
    pub(crate) fn near_samples(&self, samples: &Samples) -> Extremes {
        Extremes::of(samples.near_top(1.0), samples.near_top(-1.0))
    }

    /// The extremes of a neighbour's phasors, one Newton step from known ones.
    pub fn near(&self, phasors: &[C64], known: &Extremes) -> Extremes {
        Extremes::of(self.step_from(phasors, known.angle_max, 1.0), self.step_from(phasors, known.angle_min, -1.0))
    }

    fn step_from(&self, phasors: &[C64], angle: f64, sign: f64) -> Local {
        let (f0, f1, f2, f3) = self.derivatives(phasors, angle);
        let change = if sign * f2 < 0.0 { (-f1 / f2).clamp(-self.step(), self.step()) } else { 0.0 };
        Local { angle: angle + change, value: sign * (f0 + change * (f1 + change * (0.5 * f2 + f3 * change / 6.0))), bend: f2 }
    }

    /// The extremes, then other pairs of a local maximum and a local minimum whose half difference comes within the share `within` of the largest, at most
    /// four, largest first: the branches that may take over when speed or design change. Pairs that are the same wave again (the sum may
    /// have a shorter period) are left out.
    pub fn pairs(&self, phasors: &[C64], within: f64) -> Vec<Extremes> {
        if phasors.len() == 1 {
            return vec![self.single(phasors[0])];
        }
        let samples = self.samples(phasors);
        // samples stand below the extremes by little
        let spread = 2.0 * (samples.half_peak_to_peak() + self.reach(phasors));
        let list = |sign| {
            let mut distinct: Vec<Local> = Vec::new();
            for l in self.local_maxima(phasors, &samples, sign, within * spread) {
                let same = |d: &Local| (d.value - l.value).abs() < 1e-9 * spread && (d.bend - l.bend).abs() < 1e-6 * d.bend.abs();
                if !distinct.iter().any(same) {
                    distinct.push(l);
                }
            }
            distinct
        };
        let (highs, lows) = (list(1.0), list(-1.0));
        let mut pairs: Vec<Extremes> = highs.iter().flat_map(|h| lows.iter().map(|l| Extremes::of(*h, *l))).collect();
        pairs.sort_by(|a, b| b.half_peak_to_peak.total_cmp(&a.half_peak_to_peak));
        let least = (1.0 - within) * pairs[0].half_peak_to_peak;
        pairs.retain(|p| p.half_peak_to_peak >= least);
        pairs.truncate(1 + MOST_OTHERS);
        pairs
    }

    /// The extremes reached from the angles of `from`: the same branch for other phasors nearby.
    pub(crate) fn branch(&self, phasors: &[C64], from: &Extremes) -> Extremes {
        let step = self.step();
        let end = |angle: f64, sign: f64| {
            let start = || Local { angle, value: sign * self.derivatives(phasors, angle).0, bend: 0.0 };
            self.newton(phasors, angle, sign, step).unwrap_or_else(start)
        };
        Extremes::of(end(from.angle_max, 1.0), end(from.angle_min, -1.0))
    }

    fn single(&self, phasor: C64) -> Extremes {
        let h = f64::from(self.harmonics[0]);
        let angle = (-phasor.angle() / h).rem_euclid(TAU);
        Extremes { half_peak_to_peak: phasor.norm(), middle: 0.0, angle_max: angle, angle_min: angle + 0.5 * TAU / h }
    }

    fn step(&self) -> f64 {
        TAU / self.tables.samples() as f64
    }

    /// How far a maximum can stand above its nearest sample: half the largest |f''| times the square of half a step.
    pub(super) fn reach(&self, phasors: &[C64]) -> f64 {
        0.125 * abs_sums::weighted(phasors, &self.squares) * self.step() * self.step()
    }

    pub(super) fn samples(&self, phasors: &[C64]) -> Samples {
        let mut samples = Samples::default();
        self.sample(phasors, &mut samples);
        samples
    }

    /// Samples the sum over a period.
    pub fn sample(&self, phasors: &[C64], samples: &mut Samples) {
        samples.take(&self.tables, phasors);
    }

    /// Local maxima of `sign` f, no further than `below` under the largest, which comes first. A maximum lies within half a step of a
    /// sample, so a sample further down than that can hide none. Maxima are told by the slope, which changes sign between two samples: on a
    /// shoulder the samples themselves may fall all the way across one.
    pub(super) fn local_maxima(&self, phasors: &[C64], samples: &Samples, sign: f64, below: f64) -> Vec<Local> {
        let (f, step) = (samples.values(), self.step());
        let top = samples.end(sign);
        let lowest = top - below - self.reach(phasors);
        // its sign is what counts: exact where seven samples leave a doubt
        let doubt = abs_sums::weighted(phasors, &self.doubts);
        let slope = |j: usize| {
            let own = samples.slope(j);
            sign * if own.abs() > doubt { own } else { self.derivatives(phasors, samples.angle(j)).1 }
        };
        let mut found: Vec<Local> = Vec::with_capacity(4);
        let mut known: Option<(usize, f64)> = None;
        let mut high: Vec<usize> = Vec::with_capacity(16);
        samples.each_reaching(sign, lowest, |j| high.push(j));
        high.sort_unstable();
        // pairs of a sample and the next, at least one of which is high enough
        let (beside, last) = (|j: usize, k: usize| (k + 1) % f.len() == j, high.last().copied());
        let before = high.iter().zip(last.into_iter().chain(high.iter().copied()));
        let pairs = before.flat_map(|(&j, k)| (!beside(j, k)).then(|| if j == 0 { f.len() - 1 } else { j - 1 }).into_iter().chain([j]));
        for j in pairs {
            let next = if j + 1 == f.len() { 0 } else { j + 1 };
            let here = known.filter(|k| k.0 == j).map_or_else(|| slope(j), |k| k.1);
            let there = slope(next);
            known = Some((next, there));
            if here > 0.0 && there <= 0.0 {
                let nearer = if here < -there { j } else { next };
                let share = (samples.top_at(nearer, sign).angle - samples.angle(j)) / step;
                let angle = samples.angle(j) + if (0.0..=1.0).contains(&share) { share } else { here / (here - there) } * step;
                let sampled = Local { angle: samples.angle(nearer), value: sign * f[nearer], bend: (there - here) / step };
                let settled = self.newton(phasors, angle, sign, step).filter(|l| l.value >= sampled.value);
                found.push(settled.unwrap_or_else(|| self.bracketed(phasors, sign, samples.angle(j), sampled)));
            }
        }
        if found.is_empty() {
            // a constant
            found.push(Local { angle: 0.0, value: top, bend: 0.0 });
        }
        found.sort_by(|a, b| b.value.total_cmp(&a.value));
        let largest = found[0].value;
        found.retain(|l| l.value >= largest - below);
        found
    }

    /// Newton's method for a maximum of `sign` f from `angle`; nothing where it does not settle within a few steps.
    fn newton(&self, phasors: &[C64], angle: f64, sign: f64, step: f64) -> Option<Local> {
        let mut psi = angle;
        for _ in 0..8 {
            let (f0, f1, f2, f3) = self.derivatives(phasors, psi);
            let change = if sign * f2 < 0.0 { (-f1 / f2).clamp(-step, step) } else { sign * f1.signum() * 0.25 * step };
            psi += change;
            if change.abs() < 1e-3 * step {
                // with what the last change adds, to third order: the value errs by its fourth power, below rounding
                return Some(Local { angle: psi, value: sign * (f0 + change * (0.5 * f1 + f3 * change * change / 6.0)), bend: f2 });
            }
        }
        None
    }

    /// A maximum of `sign` f within a step after `from`, where Newton's method does not settle: on a top that is nearly flat. Never below `known`.
    fn bracketed(&self, phasors: &[C64], sign: f64, from: f64, known: Local) -> Local {
        let value = |psi: f64| Ok::<f64, std::convert::Infallible>(sign * self.derivatives(phasors, psi).0);
        match maximise(from, from + self.step(), value) {
            Ok((angle, value)) if value > known.value => Local { angle, value, bend: known.bend },
            _ => known,
        }
    }

    /// f and its first three derivatives at psi.
    fn derivatives(&self, phasors: &[C64], psi: f64) -> (f64, f64, f64, f64) {
        if self.consecutive {
            return series::derivatives(phasors, turn(psi));
        }
        let mut sums = (0.0, 0.0, 0.0, 0.0);
        // powers by products: neighbouring harmonics are one factor apart. Two chains, odd and even, since each product waits for the last.
        let one = turn(psi);
        let step = one * one;
        let mut turns = [(C64::from(1.0), 0), (one, 1)];
        for (&h, y) in self.harmonics.iter().zip(phasors) {
            let (turn, reached) = &mut turns[(h % 2) as usize];
            while *reached < h {
                *turn *= step;
                *reached += 2;
            }
            let h = f64::from(h);
            let re = y.re * turn.re - y.im * turn.im;
            let im = y.re * turn.im + y.im * turn.re;
            sums.0 += re;
            sums.1 -= h * im;
            sums.2 -= h * h * re;
            sums.3 += h * h * h * im;
        }
        sums
    }

    /// d(half peak-to-peak) and d(middle) for each of some changes of the phasors, at fixed extreme angles (the envelope theorem: the extremes are
    /// stationary in the angle).
    pub(crate) fn derivatives_of<'c>(
        &self,
        extremes: &Extremes,
        changes: impl Iterator<Item = &'c [C64]>,
    ) -> impl Iterator<Item = (f64, f64)> {
        let turns = |psi: f64| -> Vec<C64> { self.harmonics.iter().map(|&h| turn(f64::from(h) * psi)).collect() };
        let (high, low) = (turns(extremes.angle_max), turns(extremes.angle_min));
        changes.map(move |change| {
            let sum = |turns: &[C64]| -> f64 { turns.iter().zip(change).map(|(turn, y)| (y * turn).re).sum() };
            let (high, low) = (sum(&high), sum(&low));
            (0.5 * (high - low), 0.5 * (high + low))
        })
    }
}

/// Sum of magnitudes: an upper bound of half the peak-to-peak value.
pub fn bound(phasors: &[C64]) -> f64 {
    abs_sums::sum(phasors)
}

/// The phasor of largest magnitude: its index and magnitude.
pub(crate) fn dominating(phasors: &[C64]) -> (usize, f64) {
    let largest = phasors.iter().enumerate().map(|(i, y)| (i, y.norm_sqr())).fold((0, ZERO.re), |m, v| if v.1 > m.1 { v } else { m });
    (largest.0, largest.1.sqrt())
}
