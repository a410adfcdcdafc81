//! Peaks of a quantity over the speed range, to rounding.
//!
//! A sweep finds the local maxima on the grid, with speeds added round resonances too narrow for it; each that could win is refined by direct
//! solutions. Ends of the range and kinks of the torque (tabulated speeds) are candidates.

use super::local_maxima::{self, Candidate};
use super::measure::{Measure, Over};
use super::peak::{Peak, Place};
use super::point_metric::PointMetric;
use super::speeds::{Resonances, Speeds};
use super::surrogate::Surrogate;
use crate::absorber::Mounted;
use crate::crankshaft::Margin;
use crate::drivetrain::System;
use crate::numerics::maximise::maximise;
use crate::numerics::synthesis::{Extremes, Synthesiser, bound, dominating};
use crate::numerics::{C64, ZERO};
use crate::response::{Direct, Grid, Method, Quantity, Response, ResponseError, Work};
use std::ops::Range;

/// Share of a peak within which other pairs of extremes in the cycle are followed.
const BRANCHES: f64 = 0.03;
/// The same round a narrow resonance: phases turn by half a cycle within its width, and other extremes take over.
const NARROW_BRANCHES: f64 = 0.1;
/// A maximum closer to a neighbouring speed than this share of the distance is none.
const EDGE: f64 = 1e-3;
/// Peaks that differ by less than this share are level.
const LEVEL: f64 = 1e-9;

/// Finds peaks of one system by one method.
#[derive(Debug)]
pub struct PeakFinder<'a> {
    /// The system.
    pub system: &'a System,
    /// Speeds of the sweep.
    pub grid: &'a Grid,
    /// Method of the sweep.
    pub method: &'a Method<'a>,
    /// Solver between grid speeds.
    pub direct: Direct<'a>,
    /// Whether peaks are refined between grid speeds.
    pub refine: bool,
    resonances: Option<Resonances>,
    pub(super) synthesiser: Synthesiser,
    /// The crank, for measures of its margin.
    pub margin: Option<&'a Margin>,
    /// Tables for searches, with the quantity they are of and the largest error they may have.
    pub(super) surrogate: Option<(Surrogate, Quantity, f64)>,
}

/// Peaks found so far.
pub(super) struct Found {
    /// Share of the largest that is asked for.
    pub keep: f64,
    /// The largest.
    pub best: f64,
    pub peaks: Vec<Peak>,
}

impl Found {
    pub fn put(&mut self, peak: Peak) {
        self.best = self.best.max(peak.value);
        self.peaks.push(peak);
    }
}

impl<'a> PeakFinder<'a> {
    /// For one system, grid and method.
    pub fn new(system: &'a System, grid: &'a Grid, method: &'a Method<'a>, refine: bool) -> Self {
        Self {
            system,
            grid,
            method,
            direct: Direct::new(system, grid),
            refine,
            resonances: refine.then(|| Resonances::new(system, grid)),
            synthesiser: Synthesiser::new(&system.excitation.harmonics),
            margin: None,
            surrogate: None,
        }
    }

    /// Answers for the margin of a crank, too.
    #[must_use]
    pub fn with_margin(mut self, margin: Option<&'a Margin>) -> Self {
        self.margin = margin;
        self
    }

    /// Whether no resonance of the chain alone is too narrow for the grid.
    pub fn is_smooth(&self) -> bool {
        let speeds = self.speeds(&[]);
        speeds.added.is_empty() && speeds.poles.is_empty()
    }

    /// Local maxima of `measure` of at least `keep` times the largest one, which comes first. An empty list where nothing is excited.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where nothing damps a resonance.
    pub fn peaks(&self, design: &[Mounted], measure: &Measure, keep: f64, work: &mut Work) -> Result<Vec<Peak>, ResponseError> {
        if measure.absorbers().any(|i| i >= design.len()) {
            // a design may have fewer absorbers than others of its study
            let own = |q: &Quantity| !matches!(q, Quantity::RingTwist(i) if *i >= design.len());
            let quantities: Vec<Quantity> = measure.quantities.iter().copied().filter(own).collect();
            let fewer = Measure { quantities, ..measure.clone() };
            return if fewer.quantities.is_empty() { Ok(Vec::new()) } else { self.peaks(design, &fewer, keep, work) };
        }
        work.evaluations += 1;
        work.eigenproblems += u64::from(self.resonances.is_some());
        let mut found = Found { keep, best: 0.0, peaks: Vec::new() };
        if let Over::Property(property) = measure.over {
            found.peaks.extend(self.property(design, measure, property));
            return Ok(found.peaks);
        }
        let speeds = self.speeds(design).with_kinks(measure.within.kinks());
        for pole in speeds.poles.iter().filter(|p| measure.within.holds(p.speed_rpm)) {
            self.check_pole(design, measure, pole, work)?;
        }
        let parts: Vec<(Range<usize>, Speeds)> =
            speeds.parts(&measure.within.ranges).into_iter().map(|part| (part.clone(), speeds.part(part))).collect();
        let orders = self.system.orders();
        match measure.over {
            Over::Synthesis | Over::Margin(_) => {
                let mut sweeps: Vec<_> = measure.quantities.iter().zip(self.sweeps(design, &measure.quantities, &speeds, work)?).collect();
                if let Over::Margin(_) = measure.over {
                    // the shafts that may be used most first: the others need fewer sums then
                    let most = |(quantity, sweep): &(&Quantity, Vec<C64>)| {
                        let metric = PointMetric::of(measure.over, **quantity, &measure.within, self.margin);
                        let sums = sweep.chunks(orders).map(bound).zip(&speeds.rpm);
                        sums.map(|(sum, speed)| metric.bound(*speed, sum)).fold(0.0, f64::max)
                    };
                    sweeps.sort_by_cached_key(|s| std::cmp::Reverse(most(s).to_bits()));
                }
                for (quantity, sweep) in sweeps {
                    let metric = PointMetric::of(measure.over, *quantity, &measure.within, self.margin);
                    for (part, speeds) in &parts {
                        let sweep = &sweep[part.start * orders..part.end * orders];
                        self.synthesised(design, (*quantity, measure.over, metric), (speeds, sweep), &mut found, work)?;
                    }
                }
            }
            Over::Orders | Over::Order(_) => {
                let only = match measure.over {
                    Over::Order(order) => self.system.excitation.orders.iter().position(|o| *o == order).map_or(0..0, |n| n..n + 1),
                    _ => 0..orders,
                };
                for quantity in &measure.quantities {
                    let sweep = self.magnitudes(design, *quantity, &speeds, work)?;
                    for (part, speeds) in &parts {
                        let sweep = &sweep[part.start * orders..part.end * orders];
                        self.single_orders(design, (*quantity, measure, only.clone()), (speeds, sweep), &mut found, work)?;
                    }
                }
            }
            Over::Power => {
                let twists = self.sweeps(design, &measure.quantities, &speeds, work)?;
                for (part, speeds) in &parts {
                    self.powers(design, measure, (speeds, part.start), &twists, &mut found, work)?;
                }
            }
            Over::Property(_) => {}
        }
        let mut peaks = found.peaks;
        peaks.retain(|p| p.value >= keep * found.best * (1.0 - LEVEL));
        peaks.sort_by(|a, b| b.value.total_cmp(&a.value));
        Ok(peaks)
    }

    /// The largest peak of `measure`; of peaks level to 1e-9, as an optimum has them, the one at the lowest speed.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where nothing damps a resonance.
    pub fn peak(&self, design: &[Mounted], measure: &Measure, work: &mut Work) -> Result<Option<Peak>, ResponseError> {
        let peaks = self.peaks(design, measure, 1.0, work)?;
        Ok(peaks.into_iter().min_by(|a, b| a.speed_rpm.total_cmp(&b.speed_rpm)))
    }

    /// Half peak-to-peak value of every grid speed of a sweep.
    pub fn synthesis(&self, sweep: &[C64]) -> Vec<f64> {
        self.extremes(sweep).iter().map(|e| e.half_peak_to_peak).collect()
    }

    /// Extremes at every grid speed of a sweep.
    pub fn extremes(&self, sweep: &[C64]) -> Vec<Extremes> {
        sweep.chunks(self.system.orders()).map(|y| self.synthesiser.extremes(y)).collect()
    }

    /// Speeds at which a design is evaluated: the grid, and more round narrow resonances where peaks are refined.
    pub fn speeds(&self, design: &[Mounted]) -> Speeds {
        match &self.resonances {
            Some(r) => r.speeds(self.system, self.grid, design),
            None => Speeds::of(self.grid),
        }
    }

    fn sweeps(
        &self,
        design: &[Mounted],
        quantities: &[Quantity],
        speeds: &Speeds,
        work: &mut Work,
    ) -> Result<Vec<Vec<C64>>, ResponseError> {
        let grid = self.method.sweep_each(design, quantities, work)?;
        if speeds.added.is_empty() {
            return Ok(grid);
        }
        let added = self.direct.at_each(design, quantities, &speeds.added_rpm(), work)?;
        Ok(grid.into_iter().zip(added).map(|(g, a)| speeds.merge(g, &a, self.system.orders())).collect())
    }

    /// Values at the speeds that matter (the others stay at minus infinity), and the largest of them and of `best`.
    fn values(&self, metric: PointMetric, speeds: &Speeds, sweep: &[C64], (keep, best): (f64, f64), work: &mut Work) -> (Vec<f64>, f64) {
        let orders = self.system.orders();
        let sums: Vec<f64> = sweep.chunks(orders).map(bound).collect();
        let bounds: Vec<f64> = sums.iter().zip(&speeds.rpm).map(|(sum, speed)| metric.bound(*speed, *sum)).collect();
        // The sum of magnitudes bounds the synthesis at that speed, and most speeds need none. Between speeds a peak may rise further; how far
        // shows in the growth towards it.
        let mut values = vec![f64::NEG_INFINITY; bounds.len()];
        let mut top = best;
        let mut know = |i: usize, values: &mut Vec<f64>, wanted: f64, rise: f64| {
            work.syntheses += 1;
            let y = &sweep[i * orders..(i + 1) * orders];
            values[i] = metric.value_above(&self.synthesiser, speeds.rpm[i], y, (rise, wanted));
        };
        let first = (0..bounds.len()).fold(0, |m, i| if bounds[i] > bounds[m] { i } else { m });
        for i in std::iter::once(first).chain(0..bounds.len()) {
            let rise = if self.refine { local_maxima::growth(&sums, i) } else { 1.0 };
            if values[i] == f64::NEG_INFINITY && bounds[i] > 0.0 && metric.bound(speeds.rpm[i], sums[i] * rise) >= keep * top {
                know(i, &mut values, keep * top, rise);
                top = top.max(values[i]);
            }
        }
        if self.refine {
            // estimates need both neighbours
            for c in local_maxima::maxima(&speeds.rpm, &values) {
                for j in [c.index.saturating_sub(1), (c.index + 1).min(values.len() - 1)] {
                    if values[j] == f64::NEG_INFINITY {
                        know(j, &mut values, 0.0, 1.0);
                    }
                }
            }
        }
        (values, top)
    }

    fn synthesised(
        &self,
        design: &[Mounted],
        (quantity, over, metric): (Quantity, Over, PointMetric),
        (speeds, sweep): (&Speeds, &[C64]),
        found: &mut Found,
        work: &mut Work,
    ) -> Result<(), ResponseError> {
        let orders = self.system.orders();
        let (values, top) = self.values(metric, speeds, sweep, (found.keep, found.best), work);
        let mut y = vec![ZERO; orders];
        let at = |speed_rpm: f64, y: &mut [C64], work: &mut Work| -> Result<Extremes, ResponseError> {
            self.direct.at(design, quantity, speed_rpm, y, work)?;
            work.syntheses += 1;
            Ok(self.synthesiser.extremes(y))
        };
        for candidate in local_maxima::maxima(&speeds.rpm, &values) {
            let value_at = |speed: f64, work: &mut Work| at(speed, &mut y, work).map(|e| metric.value(speed, &e, &y));
            let Some((mut speed_rpm, place)) =
                self.refined((design, quantity), candidate, speeds, found.keep * found.best.max(top), value_at, work)?
            else {
                continue;
            };
            let mut extremes = at(speed_rpm, &mut y, work)?;
            let reach = (speeds.rpm[candidate.index.saturating_sub(2)], speeds.rpm[(candidate.index + 2).min(values.len() - 1)]);
            let followed = self.refine && !metric.asks_for_all();
            if followed && place == Place::Interior && speed_rpm == speeds.rpm[candidate.index] && !speeds.kink[candidate.index] {
                // nothing higher was met on either side: among several tops the search may have ended on a lower one. The branch itself has one
                let (up, value) = self.top_of_branch((design, quantity, metric), &extremes, reach, work)?;
                speed_rpm = if value > metric.value(speed_rpm, &extremes, &y) { up } else { speed_rpm };
                extremes = at(speed_rpm, &mut y, work)?;
            }
            let peak = |extremes: Extremes, speed_rpm, place, y: &[C64]| {
                let (order, order_value) = dominating(y);
                let (value, weight) = (metric.value(speed_rpm, &extremes, y), metric.weight(speed_rpm));
                Peak { value, weight, over, speed_rpm, order, order_value, quantity, extremes: Some(extremes), place }
            };
            found.put(peak(extremes, speed_rpm, place, &y));
            if !followed {
                continue;
            }
            // Other pairs of extremes in the cycle may peak nearby, as high or nearly so: each is a smooth function of its own.
            let share = if speeds.is_narrow(candidate.index) { NARROW_BRANCHES } else { (1.0 - found.keep).clamp(0.002, BRANCHES) };
            for start in self.synthesiser.alternatives(&y, share) {
                let top = self.top_of_branch((design, quantity, metric), &start, reach, work)?;
                // a branch may be held by the same end of the range
                let held = place == Place::End && {
                    let extremes = self.on_branch((design, quantity), &start, speed_rpm, &mut y, work)?;
                    metric.value(speed_rpm, &extremes, &y) >= top.1
                };
                let (at, place) = if held { (speed_rpm, Place::End) } else { (top.0, Place::Interior) };
                let margin = EDGE * (reach.1 - reach.0);
                if !held && !(reach.0 + margin..=reach.1 - margin).contains(&at) {
                    // it rises beyond the neighbours, and is no maximum here
                    continue;
                }
                let extremes = self.on_branch((design, quantity), &start, at, &mut y, work)?;
                // a smaller range round a higher mean may use more than the whole cycle does: it is no row of its own
                if metric.value(at, &extremes, &y) <= metric.value(at, &self.synthesiser.extremes(&y), &y) * (1.0 + LEVEL) {
                    found.put(peak(extremes, at, place, &y));
                }
            }
        }
        Ok(())
    }

    /// The extremes of the branch of `from` at a speed, and the phasors there.
    fn on_branch(
        &self,
        (design, quantity): (&[Mounted], Quantity),
        from: &Extremes,
        speed_rpm: f64,
        y: &mut [C64],
        work: &mut Work,
    ) -> Result<Extremes, ResponseError> {
        self.direct.at(design, quantity, speed_rpm, y, work)?;
        Ok(self.synthesiser.branch(y, from))
    }

    /// Speed and value of the maximum of a branch between two speeds.
    fn top_of_branch(
        &self,
        (design, quantity, metric): (&[Mounted], Quantity, PointMetric),
        from: &Extremes,
        (low, high): (f64, f64),
        work: &mut Work,
    ) -> Result<(f64, f64), ResponseError> {
        let mut y = vec![ZERO; self.system.orders()];
        let mut value = |speed: f64| self.on_branch((design, quantity), from, speed, &mut y, work).map(|e| metric.value(speed, &e, &y));
        if low < high { maximise(low, high, value) } else { Ok((low, value(low)?)) }
    }

    /// Magnitudes of a quantity at all speeds and orders (speed by speed).
    fn magnitudes(&self, design: &[Mounted], quantity: Quantity, speeds: &Speeds, work: &mut Work) -> Result<Vec<f64>, ResponseError> {
        let mut grid = Vec::new();
        self.method.squares(design, quantity, &mut grid, work)?;
        grid.iter_mut().for_each(|v| *v = v.sqrt());
        let added = self.direct.at_each(design, &[quantity], &speeds.added_rpm(), work)?.swap_remove(0);
        let added: Vec<f64> = added.iter().map(|y| y.norm()).collect();
        Ok(speeds.merge(grid, &added, self.system.orders()))
    }

    fn single_orders(
        &self,
        design: &[Mounted],
        (quantity, measure, only): (Quantity, &Measure, Range<usize>),
        (speeds, sweep): (&Speeds, &[f64]),
        found: &mut Found,
        work: &mut Work,
    ) -> Result<(), ResponseError> {
        let orders = self.system.orders();
        let weights: Vec<f64> = speeds.rpm.iter().map(|s| measure.within.weight(*s)).collect();
        let of = |order: usize| sweep.iter().skip(order).step_by(orders).zip(&weights).map(|(v, w)| v * w);
        let top = only.clone().flat_map(of).fold(found.best, f64::max);
        for order in only {
            let values: Vec<f64> = of(order).collect();
            let order_at = |speed: f64, work: &mut Work| self.direct.order_at(design, quantity, order, speed, work).map(|y| y.norm());
            for candidate in local_maxima::maxima(&speeds.rpm, &values) {
                let value_at = |speed: f64, work: &mut Work| order_at(speed, work).map(|y| y * measure.within.weight(speed));
                let wanted = found.keep * found.best.max(top);
                let Some((speed_rpm, place)) = self.refined((design, quantity), candidate, speeds, wanted, value_at, work)? else {
                    continue;
                };
                let (order_value, weight) = (order_at(speed_rpm, work)?, measure.within.weight(speed_rpm));
                let value = order_value * weight;
                found.put(Peak { value, weight, over: measure.over, speed_rpm, order, order_value, quantity, extremes: None, place });
            }
        }
        Ok(())
    }

    /// Speed and place of the local maximum near a candidate, or nothing where it cannot reach `wanted`.
    pub(super) fn refined(
        &self,
        (design, quantity): (&[Mounted], Quantity),
        candidate: Candidate,
        speeds: &Speeds,
        wanted: f64,
        value_at: impl FnMut(f64, &mut Work) -> Result<f64, ResponseError>,
        work: &mut Work,
    ) -> Result<Option<(f64, Place)>, ResponseError> {
        let last = speeds.rpm.len() - 1;
        if !self.refine || last == 0 {
            let end = if candidate.index == 0 || candidate.index == last { Place::End } else { Place::Interior };
            return Ok((candidate.value >= wanted).then_some((speeds.rpm[candidate.index], end)));
        }
        match local_maxima::refine(candidate, speeds, wanted, value_at, work)? {
            Some(r) if r.unbounded => Err(self.pole(design, quantity, r.speed_rpm)),
            found => Ok(found.map(|r| (r.speed_rpm, r.place))),
        }
    }
}
