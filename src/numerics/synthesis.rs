//! Half peak-to-peak of a sum of harmonics, with phase.

pub use super::extremes::Extremes;
pub(crate) use super::extremes::{Most, Precision};
use super::maximise::maximise;
use super::sampling::{BLOCK, sample};
use super::{C64, ZERO, magnitudes};
use crate::numerics::elementary::{ComplexElementary, Elementary, turn};
use std::f64::consts::TAU;

/// A local maximum of the sum, or of its negative.
#[derive(Debug, Clone, Copy)]
pub(super) struct Local {
    pub(super) angle: f64,
    pub(super) value: f64,
    pub(super) bend: f64,
}

/// Other pairs of extremes that are offered, at most.
const MOST_OTHERS: usize = 4;

/// Samples of a sum over a period, kept for reuse.
#[derive(Debug, Clone, Default)]
pub struct Samples {
    values: Vec<f64>,
    sorted: Vec<C64>,
    /// Smallest and largest of them.
    low: f64,
    high: f64,
}

impl Samples {
    /// Half their peak-to-peak: a little below that of the sum.
    pub fn half_peak_to_peak(&self) -> f64 {
        0.5 * (self.high - self.low)
    }

    /// Their extremes, a little inside those of the sum; at angle zero.
    pub(crate) fn extremes(&self) -> Extremes {
        Extremes { half_peak_to_peak: self.half_peak_to_peak(), middle: 0.5 * (self.high + self.low), ..Extremes::default() }
    }
}

impl Extremes {
    fn of(high: Local, low: Local) -> Self {
        // the minimum comes as a maximum of -f
        let (half_peak_to_peak, middle) = (0.5 * (high.value + low.value), 0.5 * (high.value - low.value));
        Self { half_peak_to_peak, middle, angle_max: high.angle, angle_min: low.angle }
    }
}

/// Finds extremes of sums over a fixed set of harmonics; holds the tables of sines and cosines.
#[derive(Debug, Clone)]
pub struct Synthesiser {
    harmonics: Vec<u32>,
    /// Their squares.
    squares: Vec<f64>,
    /// Indices of the harmonics, even ones first, and how many those are.
    sorted: Vec<usize>,
    evens: usize,
    /// Samples in a quarter of a period, the first half a step from angle zero: a whole number of blocks.
    quarter: usize,
    /// cos(h psi) and sin(h psi) at every sample of the first quarter: block by block of samples, harmonic by harmonic.
    cosine: Vec<f64>,
    sine: Vec<f64>,
}

impl Synthesiser {
    /// For the given harmonic numbers (ascending, each at least 1).
    pub fn new(harmonics: &[u32]) -> Self {
        let (mut sorted, odd): (Vec<usize>, Vec<usize>) = (0..harmonics.len()).partition(|i| harmonics[*i].is_multiple_of(2));
        let evens = sorted.len();
        sorted.extend(odd);
        // eight samples in the shortest wave; a quarter of the period is enough, the others mirror it
        let quarter = (2 * harmonics.iter().max().map_or(1, |&h| h as usize)).next_multiple_of(BLOCK);
        let table = |f: fn(f64) -> f64| {
            // angles by whole numbers of half steps
            let at = |h: u32, j: usize| f(TAU * (((2 * j + 1) * h as usize) % (8 * quarter)) as f64 / (8 * quarter) as f64);
            let block = |b: usize| sorted.iter().flat_map(move |&i| (b * BLOCK..(b + 1) * BLOCK).map(move |j| at(harmonics[i], j)));
            (0..quarter / BLOCK).flat_map(block).collect()
        };
        let (cosine, sine) = (table(f64::cosine), table(f64::sine));
        Self {
            harmonics: harmonics.to_vec(),
            squares: harmonics.iter().map(|h| f64::from(h * h)).collect(),
            sorted,
            evens,
            quarter,
            cosine,
            sine,
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

    fn polished(&self, phasors: &[C64], samples: &Samples) -> Extremes {
        let first = |sign| self.local_maxima(phasors, samples, sign, 0.0).swap_remove(0);
        Extremes::of(first(1.0), first(-1.0))
    }

    /// Extremes to about a millionth from samples of the sum: one Newton step from the largest and the smallest of them.
    pub(crate) fn near_samples(&self, phasors: &[C64], samples: &Samples) -> Extremes {
        let end = |wanted: f64, sign: f64| {
            let angle = self.angle(samples.values.iter().position(|v| *v == wanted).unwrap_or(0));
            self.step_from(phasors, angle, sign)
        };
        Extremes::of(end(samples.high, 1.0), end(samples.low, -1.0))
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

    /// The extremes where they may matter, to rounding or to about a millionth: nothing where `can_matter` says no to bounds of them, which come with them.
    pub(crate) fn extremes_if(&self, phasors: &[C64], precision: Precision, can_matter: impl Fn(Most) -> bool) -> (Option<Extremes>, Most) {
        if phasors.len() == 1 {
            let own = self.single(phasors[0]);
            return (Some(own), Most::of(&own));
        }
        let samples = self.samples(phasors);
        let reach = self.reach(phasors);
        let sampled = samples.extremes();
        let most = Most { half_peak_to_peak: sampled.half_peak_to_peak + reach, middle: sampled.middle.abs() + reach };
        let extremes = can_matter(most).then(|| self.by(phasors, &samples, reach, precision));
        (extremes, most)
    }

    fn by(&self, phasors: &[C64], samples: &Samples, reach: f64, precision: Precision) -> Extremes {
        match precision {
            Precision::Rounding => self.polished(phasors, samples),
            Precision::Millionth => Extremes::of(self.near_end(phasors, samples, 1.0, reach), self.near_end(phasors, samples, -1.0, reach)),
        }
    }

    /// The largest of `sign` f by one Newton step from every sampled maximum that may stand for it.
    fn near_end(&self, phasors: &[C64], samples: &Samples, sign: f64, reach: f64) -> Local {
        let f = &samples.values;
        let last = f.len() - 1;
        let lowest = if sign > 0.0 { samples.high } else { -samples.low } - reach;
        let mut best = Local { angle: 0.0, value: f64::NEG_INFINITY, bend: 0.0 };
        for (b, own) in f.as_chunks::<BLOCK>().0.iter().enumerate().filter(|(_, own)| reaches(own, sign, lowest)) {
            for (j, v) in (b * BLOCK..).zip(own) {
                let beside = [if j == 0 { last } else { j - 1 }, if j == last { 0 } else { j + 1 }];
                if sign * v >= lowest && beside.iter().all(|k| sign * f[*k] <= sign * v) {
                    let stepped = self.step_from(phasors, self.angle(j), sign);
                    best = if stepped.value > best.value { stepped } else { best };
                }
            }
        }
        best
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
            let start = Local { angle, value: sign * self.derivatives(phasors, angle).0, bend: 0.0 };
            self.newton(phasors, angle, sign, step).unwrap_or(start)
        };
        Extremes::of(end(from.angle_max, 1.0), end(from.angle_min, -1.0))
    }

    fn single(&self, phasor: C64) -> Extremes {
        let h = f64::from(self.harmonics[0]);
        let angle = (-phasor.angle() / h).rem_euclid(TAU);
        Extremes { half_peak_to_peak: phasor.norm(), middle: 0.0, angle_max: angle, angle_min: angle + 0.5 * TAU / h }
    }

    /// Angle of sample `j`.
    fn angle(&self, j: usize) -> f64 {
        (j as f64 + 0.5) * self.step()
    }

    fn step(&self) -> f64 {
        TAU / (4 * self.quarter) as f64
    }

    /// How far a maximum can stand above its nearest sample: half the largest |f''| times the square of half a step.
    fn reach(&self, phasors: &[C64]) -> f64 {
        0.125 * magnitudes::weighted(phasors, &self.squares) * self.step() * self.step()
    }

    /// f' at sample `j`, from the tables.
    fn slope(&self, phasors: &[C64], j: usize) -> f64 {
        let q = self.quarter;
        // column of the first quarter, and signs there of odd cosines, even sines and odd sines
        let (column, odd_cosine, even_sine, odd_sine) = match j / q {
            0 => (j, 1.0, 1.0, 1.0),
            1 => (2 * q - 1 - j, -1.0, -1.0, 1.0),
            2 => (j - 2 * q, -1.0, 1.0, -1.0),
            _ => (4 * q - 1 - j, 1.0, -1.0, -1.0),
        };
        let first = (column / BLOCK) * self.harmonics.len() * BLOCK + column % BLOCK;
        let sum = |places: std::ops::Range<usize>, cosine: f64, sine: f64| -> f64 {
            let term = |place: usize| {
                let (i, at) = (self.sorted[place], first + place * BLOCK);
                f64::from(self.harmonics[i]) * (sine * phasors[i].re * self.sine[at] + cosine * phasors[i].im * self.cosine[at])
            };
            places.map(term).sum()
        };
        -(sum(0..self.evens, 1.0, even_sine) + sum(self.evens..self.sorted.len(), odd_cosine, odd_sine))
    }

    pub(super) fn samples(&self, phasors: &[C64]) -> Samples {
        let mut samples = Samples::default();
        self.sample(phasors, &mut samples);
        samples
    }

    /// Samples the sum over a period.
    pub fn sample(&self, phasors: &[C64], samples: &mut Samples) {
        samples.sorted.clear();
        samples.sorted.extend(self.sorted.iter().map(|i| phasors[*i]));
        samples.values.resize(4 * self.quarter, 0.0);
        (samples.low, samples.high) = sample(&samples.sorted, self.evens, &self.cosine, &self.sine, &mut samples.values);
    }

    /// Local maxima of `sign` f, no further than `below` under the largest, which comes first. A maximum lies within half a step of a
    /// sample, so a sample further down than that can hide none. Maxima are told by the slope, which changes sign between two samples: on a
    /// shoulder the samples themselves may fall all the way across one.
    pub(super) fn local_maxima(&self, phasors: &[C64], samples: &Samples, sign: f64, below: f64) -> Vec<Local> {
        let (n, step) = (samples.values.len(), self.step());
        let top = if sign > 0.0 { samples.high } else { -samples.low };
        let f = &samples.values;
        let lowest = top - below - self.reach(phasors);
        let slope = |j: usize| sign * self.slope(phasors, j);
        let after = |j: usize| if j + 1 == n { 0 } else { j + 1 };
        let mut found: Vec<Local> = Vec::with_capacity(4);
        let mut known: Option<(usize, f64)> = None;
        let blocks = f.as_chunks::<BLOCK>().0.iter().enumerate();
        let high = blocks.filter(|(b, own)| reaches(own, sign, lowest) || sign * f[after((b + 1) * BLOCK - 1)] >= lowest);
        for j in high.flat_map(|(b, _)| b * BLOCK..(b + 1) * BLOCK) {
            let next = after(j);
            if sign * f[j] < lowest && sign * f[next] < lowest {
                continue;
            }
            let here = known.filter(|k| k.0 == j).map_or_else(|| slope(j), |k| k.1);
            let there = slope(next);
            known = Some((next, there));
            if here > 0.0 && there <= 0.0 {
                let angle = self.angle(j) + here / (here - there) * step;
                let nearer = if here < -there { j } else { next };
                let sampled = Local { angle: self.angle(nearer), value: sign * f[nearer], bend: (there - here) / step };
                let settled = self.newton(phasors, angle, sign, step).filter(|l| l.value >= sampled.value);
                found.push(settled.unwrap_or_else(|| self.bracketed(phasors, sign, self.angle(j), sampled)));
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

/// Whether a sample of a block, times `sign`, is not below a level.
fn reaches(block: &[f64; BLOCK], sign: f64, level: f64) -> bool {
    block.iter().fold(false, |any, v| any | (sign * v >= level))
}

/// Sum of magnitudes: an upper bound of half the peak-to-peak value.
pub fn bound(phasors: &[C64]) -> f64 {
    magnitudes::sum(phasors)
}

/// The phasor of largest magnitude: its index and magnitude.
pub(crate) fn dominating(phasors: &[C64]) -> (usize, f64) {
    let largest = phasors.iter().enumerate().map(|(i, y)| (i, y.norm_sqr())).fold((0, ZERO.re), |m, v| if v.1 > m.1 { v } else { m });
    (largest.0, largest.1.sqrt())
}
