//! Two absorbers, or one with more than two free parameters: what is known of a box although an order may have a pole in it.

use super::asked::Case;
use super::at_speed::{Pair, PairOver};
use super::boxes::{Bounds, Search, halves};
use super::form::Form;
use crate::numerics::C64;
use crate::numerics::elementary::turn;
use crate::objective::measure::Over;
use crate::response::Quantity;
use crate::response::enclosed::{Corners, Enclosed};
use crate::response::pair::{Coefficients, pair};
use std::f64::consts::FRAC_PI_4;

/// Amplitudes that are below this share of what they must not reach in the middle of a box are not looked at over all of it.
const MAY_EXCLUDE: f64 = 0.5;
/// Amplitudes of which linear functions are combined.
const COMBINED: usize = 12;
/// Speeds at which sums of orders are looked at.
const FOREMOST: usize = 8;
/// Speeds at which cuts are tried.
const TRIED: usize = 4;
/// What a factor of e in width counts among cuts, against what they raise the bound by.
const WIDTH: f64 = 0.03;

/// An amplitude of one order that must not reach a size.
#[derive(Debug, Clone, Copy)]
pub(super) struct Amplitude {
    /// Index of the speed.
    pub speed: u32,
    order: usize,
    quantity: usize,
    most: f64,
    pub is_objective: bool,
    /// Its share of the size in the middle of the box.
    pub middle: f64,
    /// It is nowhere below this share of it.
    pub least: f64,
}

/// What was seen of a box at some speeds.
#[derive(Debug, Default)]
pub(super) struct Seen {
    /// Amplitudes that may exclude it, the largest in the middle first.
    pub amplitudes: Vec<Amplitude>,
    /// Speeds at which sums of orders are to be looked at.
    pub foremost: Vec<u32>,
}

impl Case<'_> {
    /// Whether nothing but amplitudes of single orders of the chain is asked for.
    pub(super) fn asks_amplitudes_alone(&self) -> bool {
        let is_one = self.finder.system.orders() <= 1;
        self.parts.iter().all(|p| {
            let is_amplitude = matches!(p.measure.over, Over::Orders | Over::Order(_)) || is_one && p.measure.over == Over::Synthesis;
            is_amplitude && !p.quantities.iter().any(|q| matches!(self.quantities[*q], Quantity::RingTwist(_)))
        })
    }

    /// Half ranges of sums that are asked for, in units of what they must not reach: `of` is given the quantity and its phasors in the middle of the box. `None` where something else is asked for.
    fn half_ranges(&self, over: &PairOver, of: impl Fn(usize, &[C64]) -> f64) -> Option<f64> {
        let mut most = f64::NEG_INFINITY;
        for part in self.parts.iter().filter(|p| p.measure.within.holds(over.at.speed_rpm)) {
            if part.measure.over != Over::Synthesis {
                return None;
            }
            let factor = part.measure.within.weight(over.at.speed_rpm) / part.most;
            for quantity in part.quantities.iter().copied() {
                let middle = |order: usize| Some(over.quotient(order, quantity)?.middle(over.loads(order)));
                let phasors: Option<Vec<C64>> = (0..over.loads.len()).map(middle).collect();
                // in the very middle there may be a pole
                if let Some(phasors) = phasors.filter(|all| all.iter().all(|y| y.is_finite())) {
                    most = f64::max(most, factor * of(quantity, &phasors));
                }
            }
        }
        Some(most)
    }

    /// The largest of them in the middle.
    fn middle(&self, over: &PairOver) -> Option<f64> {
        self.half_ranges(over, |_, phasors| self.finder.synthesiser.extremes(phasors).half_peak_to_peak)
    }

    /// The largest of them, at least, each order by itself.
    fn sums(&self, over: &PairOver) -> f64 {
        let least = |quantity: usize, phasors: &[C64]| {
            let extremes = self.finder.synthesiser.extremes(phasors);
            let harmonics = self.finder.system.excitation.harmonics.iter().map(|h| f64::from(*h));
            let by = harmonics.map(|h| (turn(h * extremes.angle_max) - turn(h * extremes.angle_min)) * 0.5);
            let least = |(order, by)| over.quotient(order, quantity).map_or(f64::NEG_INFINITY, |q| q.least_along(over.loads(order), by));
            by.enumerate().map(least).sum()
        };
        self.half_ranges(over, least).unwrap_or(f64::NEG_INFINITY)
    }

    /// Amplitudes of single orders at a speed over a box, those that may exclude it: half the range of a sum is at least pi/4 of each, as the mean of |cos| is 2/pi. Ends at the first that excludes it.
    fn amplitudes(&self, speed: u32, over: &PairOver, found: &mut Vec<Amplitude>) -> bool {
        let (at, mut scratch) = (over.at, Coefficients::default());
        let orders = &self.finder.system.excitation.orders;
        for part in self.parts.iter().filter(|p| p.measure.within.holds(at.speed_rpm)) {
            for (order, own) in orders.iter().enumerate() {
                let counts = match part.measure.over {
                    Over::Synthesis if orders.len() > 1 => FRAC_PI_4,
                    Over::Synthesis | Over::Orders => 1.0,
                    Over::Order(asked) if asked == *own => 1.0,
                    _ => continue,
                };
                let most = part.most / (part.measure.within.weight(at.speed_rpm) * counts);
                for quantity in part.quantities.iter().copied() {
                    let Some(quotient) = over.quotient(order, quantity) else { continue };
                    let middle = quotient.middle(over.loads(order)).norm() / most;
                    if middle < MAY_EXCLUDE {
                        continue;
                    }
                    let least = quotient.least(over.loads(order), &mut scratch) / most;
                    found.push(Amplitude { speed, order, quantity, most, is_objective: !part.role.is_limit(), middle, least });
                    if least >= 1.0 {
                        return true;
                    }
                }
            }
        }
        false
    }
}

impl Search<'_> {
    fn over<'s>(&'s self, speed: u32, pairs: &'s [Pair]) -> Option<PairOver<'s>> {
        let at = &self.speeds[speed as usize];
        PairOver::of(at, &pairs[at.case])
    }

    /// Whether absorbers are looked at as quotients, and whether nothing but amplitudes of single orders of the chain is asked for; of one absorber linear functions say more unless that is so.
    pub(super) fn of_pairs(&self) -> (bool, bool) {
        let values = self.values(&self.problem.space.bounds());
        let is_known = |(i, case): (usize, &Case)| {
            let both = case.enclosed(&values).ok().and_then(|absorbers| pair(&absorbers));
            self.speeds.iter().find(|s| s.case == i).is_some_and(|at| PairOver::of(at, &both).is_some())
        };
        let known: Vec<bool> = self.cases.iter().enumerate().map(is_known).collect();
        let alone = known.iter().zip(&self.cases).all(|(is_known, case)| *is_known && case.asks_amplitudes_alone());
        (alone || self.problem.space.slots.len() > 1 && known.contains(&true), alone)
    }

    /// The absorbers of each case.
    pub(super) fn pairs(&self, absorbers: &[Vec<Enclosed>]) -> Vec<Pair> {
        absorbers.iter().map(|a| if self.is_pair { pair(a) } else { None }).collect()
    }

    /// What absorbers have at some speeds over a box; the speed of an amplitude or a sum that excludes it.
    pub(super) fn seen(&self, pairs: &[Pair], speeds: &[u32]) -> Result<Seen, u32> {
        let mut seen = Seen { foremost: speeds.to_vec(), ..Seen::default() };
        // by what is known of sums over the box, and by what they are in the middle
        let mut sums: Vec<(f64, f64, u32)> = Vec::new();
        for s in speeds.iter().copied() {
            let Some(over) = self.over(s, pairs) else { continue };
            let case = &self.cases[over.at.case];
            if case.amplitudes(s, &over, &mut seen.amplitudes) {
                return Err(s);
            }
            if let Some(middle) = case.middle(&over).filter(|_| !self.amplitudes_alone) {
                let least = if middle < MAY_EXCLUDE { f64::NEG_INFINITY } else { case.sums(&over) };
                if least >= 1.0 {
                    return Err(s);
                }
                sums.push((least, middle, s));
            }
        }
        seen.amplitudes.sort_by(|a, b| b.middle.total_cmp(&a.middle).then(a.speed.cmp(&b.speed)));
        if self.amplitudes_alone {
            seen.foremost.clear();
        } else if sums.len() == speeds.len() {
            sums.sort_by(|a, b| b.0.total_cmp(&a.0).then(b.1.total_cmp(&a.1)).then(a.2.cmp(&b.2)));
            seen.foremost = sums.into_iter().map(|m| m.2).take(FOREMOST).collect();
        }
        Ok(seen)
    }

    /// Linear functions that are at least one only where an amplitude reaches its size: of those that are largest in the middle.
    pub(super) fn linear(&self, pairs: &[Pair], amplitudes: &[Amplitude]) -> Vec<Form> {
        let mut scratch = Coefficients::default();
        let mut of = |a: &Amplitude| {
            let over = self.over(a.speed, pairs)?;
            let loads = over.loads(a.order);
            over.quotient(a.order, a.quantity)?.least(loads, &mut scratch);
            let (value, slopes) = scratch.linear(loads, over.pair.each_ref().map(Corners::variables), a.most);
            value.is_finite().then_some(Form { value, slopes, middle: a.middle, is_objective: a.is_objective, ..Form::default() })
        };
        amplitudes.iter().take(COMBINED).filter_map(&mut of).collect()
    }

    /// The coordinate along which a cut raises most what is known at some speeds, wide ones before narrow ones.
    pub(super) fn best_cut(&self, bounds: &Bounds, speeds: &[u32]) -> usize {
        let reached = |half: Bounds| {
            let values = self.values(&half);
            let Ok(absorbers) = self.cases.iter().map(|c| c.enclosed(&values)).collect::<Result<Vec<_>, _>>() else { return 0.0 };
            let pairs = self.pairs(&absorbers);
            let mut best = f64::NEG_INFINITY;
            for s in speeds.iter().take(TRIED) {
                let Some(over) = self.over(*s, &pairs) else { continue };
                let case = &self.cases[over.at.case];
                let mut amplitudes = Vec::new();
                case.amplitudes(*s, &over, &mut amplitudes);
                best = amplitudes.iter().map(|a| a.least).fold(best, f64::max);
                if !self.amplitudes_alone {
                    best = best.max(case.sums(&over));
                }
            }
            best.clamp(0.0, 1.0)
        };
        let score = |along: usize| {
            let [low, high] = halves(bounds, along).map(reached);
            0.5 * (low + high) + WIDTH * (bounds[along].1 - bounds[along].0)
        };
        let scored = (0..bounds.len()).map(|along| (along, score(along)));
        scored.reduce(|most, next| if next.1 > most.1 { next } else { most }).map_or(0, |found| found.0)
    }
}
