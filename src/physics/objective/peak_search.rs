//! Peaks of a quantity over the speed range, to rounding.
//!
//! A sweep finds the local maxima on the grid, with speeds added round resonances too narrow for it; each that could win is refined by direct
//! solutions. Ends of the range and kinks of the torque (tabulated speeds) are candidates.

use super::design_cache::{Shared, Sweep};
use super::duty::DutyLoad;
use super::local_maxima::{self, Candidate};
use super::measure::{Measure, Over};
use super::peak::{Peak, Place};
use super::point_metric::PointMetric;
use super::speeds::{Resonances, Speeds};
use super::surrogate::Surrogate;
use crate::absorber::Mounted;
use crate::crankshaft::Margin;
use crate::drivetrain::System;
use crate::numerics::C64;
use crate::numerics::synthesis::{Extremes, Synthesiser, bound};
use crate::response::{Direct, Grid, Hosts, Method, Quantity, ResponseError, Work, single};
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

/// Peaks that differ by less than this share are level.
pub(super) const LEVEL: f64 = 1e-9;

/// A peak is found at no more than this share below a value that is known beside it.
const CERTAIN: f64 = 1e-6;
/// Every so many speeds tell which shaft may be used most.
const EVERY: usize = 8;

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
    /// Extremes of sums of orders.
    #[doc(hidden)]
    pub synthesiser: Synthesiser,
    /// The crank, for measures of its margin.
    pub margin: Option<&'a Margin>,
    /// For means over a duty.
    pub(super) duty: &'a [DutyLoad],
    /// Tables for searches, with the largest error they may have.
    pub(super) surrogates: Vec<(Surrogate<'a>, f64)>,
    /// What stations do without absorber at the speeds of the sweep, as far as it has been asked for.
    hosts: Mutex<BTreeMap<usize, Arc<Hosts>>>,
}

/// Peaks found so far.
pub(super) struct LargestPeaks {
    /// Share of the largest that is asked for.
    pub keep: f64,
    /// The largest.
    pub best: f64,
    pub peaks: Vec<Peak>,
}

impl LargestPeaks {
    /// Nothing yet: what is asked for at least stands for the largest.
    fn new(Asked { keep, least }: Asked) -> Self {
        Self { keep, best: if least > 0.0 { least / keep } else { 0.0 }, peaks: Vec::new() }
    }

    /// Those that are asked for, the largest first.
    fn kept(mut self) -> Vec<Peak> {
        self.peaks.retain(|p| p.value >= self.keep * self.best * (1.0 - LEVEL));
        self.peaks.sort_by(|a, b| b.value.total_cmp(&a.value));
        self.peaks
    }

    /// Adds a peak that is not known yet: a branch may be met from several speeds.
    pub fn put(&mut self, peak: Peak) {
        self.best = self.best.max(peak.value);
        if !self.peaks.iter().any(|known| known.is_same(&peak)) {
            self.peaks.push(peak);
        }
    }
}

/// Which peaks of a measure are asked for.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Asked {
    /// Those of at least this share of the largest,
    pub keep: f64,
    /// and no less than this.
    pub least: f64,
}

impl Asked {
    /// The largest alone.
    pub(super) const LARGEST: Self = Self { keep: 1.0, least: 0.0 };
}

/// Of level peaks the one at the lowest speed.
pub(super) fn lowest(peaks: Vec<Peak>) -> Option<Peak> {
    peaks.into_iter().min_by(|a, b| a.speed_rpm.total_cmp(&b.speed_rpm))
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
            duty: &[],
            surrogates: Vec::new(),
            hosts: Mutex::default(),
        }
    }

    /// What the station of a design of one absorber does without it at the speeds of the sweep.
    pub(super) fn hosts(&self, design: &[Mounted]) -> Option<Arc<Hosts>> {
        let (station, _) = single(design)?;
        let known = || self.hosts.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = known().get(&station) {
            return Some(found.clone());
        }
        // not while it is locked: who waits for it may be who computes it
        let found = Arc::new(Hosts::on_station(&self.direct, station));
        known().insert(station, found.clone());
        Some(found)
    }

    /// Answers for the margin of a crank, too.
    #[must_use]
    pub fn with_margin(mut self, margin: Option<&'a Margin>) -> Self {
        self.margin = margin;
        self
    }

    /// Answers for means over a duty, too.
    #[must_use]
    pub fn with_duty(mut self, duty: &'a [DutyLoad]) -> Self {
        self.duty = duty;
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
        self.peaks_knowing(design, measure, Asked { keep, least: 0.0 }, &Shared::default(), work)
    }

    /// The same with what measures of one design share.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where nothing damps a resonance.
    pub(crate) fn peaks_knowing(
        &self,
        design: &[Mounted],
        measure: &Measure,
        asked: Asked,
        shared: &Shared,
        work: &mut Work,
    ) -> Result<Vec<Peak>, ResponseError> {
        if measure.absorbers().any(|i| i >= design.len()) {
            // a design may have fewer absorbers than others of its study
            let exists = |q: &Quantity| !matches!(q, Quantity::RingTwist(i) if *i >= design.len());
            let quantities: Vec<Quantity> = measure.quantities.iter().copied().filter(exists).collect();
            let fewer = Measure { quantities, ..measure.clone() };
            return if fewer.quantities.is_empty() { Ok(Vec::new()) } else { self.peaks_knowing(design, &fewer, asked, shared, work) };
        }
        work.evaluations += 1;
        work.eigenproblems += u64::from(self.resonances.is_some());
        let mut found = LargestPeaks::new(asked);
        match measure.over {
            Over::Property(property) => return Ok(self.property(design, measure, property).into_iter().collect()),
            Over::Mean | Over::MeanPower => return Ok(self.mean(design, measure, work)?.into_iter().collect()),
            Over::Damage => return Ok(self.damage(design, measure, work)?.into_iter().collect()),
            Over::Strain | Over::SpringStress => return self.strains(design, measure, asked, shared, work),
            Over::AtDuty(point) => return self.at_duty(design, measure, (point, asked.keep), work),
            _ => {}
        }
        let speeds = self.speeds_for(design, measure, shared);
        for pole in speeds.poles.iter().filter(|p| measure.within.holds(p.speed_rpm)) {
            self.check_pole(design, measure, pole, work)?;
        }
        let parts: Vec<(Range<usize>, Speeds)> =
            speeds.parts(&measure.within.ranges).into_iter().map(|part| (part.clone(), speeds.part(part))).collect();
        let (orders, mut hint) = (self.system.orders(), 0.0);
        match measure.over {
            Over::Synthesis | Over::Margin(_) => {
                hint = self.sums(design, measure, (&speeds, &parts), shared, &mut found, work)?;
            }
            Over::Orders | Over::Order(_) => {
                let only = self.orders_of(measure.over);
                for quantity in &measure.quantities {
                    let sweep = self.magnitudes(design, *quantity, &speeds, work)?;
                    for (part, speeds) in &parts {
                        let sweep = &sweep[part.start * orders..part.end * orders];
                        self.single_orders(design, (*quantity, measure, only.clone()), (speeds, sweep), &mut found, work)?;
                    }
                }
            }
            Over::Statistic(statistic) => {
                let swept = self.swept(design, measure, &speeds, shared, work)?;
                for (quantity, sweep) in measure.quantities.iter().zip(&swept) {
                    for (part, speeds) in &parts {
                        let sweep = &sweep[part.start * orders..part.end * orders];
                        self.statistics(design, (*quantity, measure, statistic), (speeds, sweep), &mut found, work)?;
                    }
                }
            }
            Over::Power => {
                let twists = self.swept(design, measure, &speeds, shared, work)?;
                let mut search_part =
                    |part: &(Range<usize>, Speeds)| self.powers(design, measure, (&part.1, part.0.start), &twists, &mut found, work);
                parts.iter().try_for_each(&mut search_part)?;
            }
            Over::Temperature => parts.iter().try_for_each(|(_, speeds)| self.temperatures(design, measure, speeds, &mut found, work))?,
            Over::Mean | Over::AtDuty(_) | Over::MeanPower | Over::Damage | Over::Strain | Over::SpringStress | Over::Property(_) => {}
        }
        let peaks = found.kept();
        if peaks.is_empty() && hint > LargestPeaks::new(asked).best {
            // sweep and direct solution differ by more than they should: without the hint nothing is lost
            shared.worst.borrow_mut().clear();
            return self.peaks_knowing(design, measure, asked, shared, work);
        }
        if let (Over::Margin(_), Some(peak)) = (measure.over, peaks.first()) {
            shared.worst.borrow_mut().push((peak.quantity, peak.speed_rpm));
        }
        Ok(peaks)
    }

    /// Local maxima of sums of orders, some quantities after the others; returns the share of its strength that the crank uses beside known peaks, zero of other measures.
    fn sums(
        &self,
        design: &[Mounted],
        measure: &Measure,
        (speeds, parts): (&Speeds, &[(Range<usize>, Speeds)]),
        shared: &Shared,
        found: &mut LargestPeaks,
        work: &mut Work,
    ) -> Result<f64, ResponseError> {
        let (orders, mut hint) = (self.system.orders(), 0.0);
        let turns = self.turns(measure, speeds);
        for measure in &turns {
            // what is swept in turns is not held for other measures
            let held = if turns.len() == 1 { shared } else { &Shared::default() };
            let swept = self.swept(design, measure, speeds, held, work)?;
            let mut sweeps: Vec<(&Quantity, &Sweep)> = measure.quantities.iter().zip(swept.iter()).collect();
            if let Over::Margin(_) = measure.over {
                self.worst_first(measure, speeds, &mut sweeps, shared);
                hint = self.used_at_known_peaks(measure, (speeds, &sweeps), shared, work);
                found.best = found.best.max(hint);
            }
            for (quantity, sweep) in sweeps {
                let metric = PointMetric::of(measure.over, *quantity, &measure.within, self.margin, Some(&shared.known));
                for (part, speeds) in parts {
                    let sweep = &sweep[part.start * orders..part.end * orders];
                    self.synthesised(design, (*quantity, measure.over, metric), (speeds, sweep), found, work)?;
                }
            }
        }
        Ok(hint)
    }

    /// Indices of the orders that a measure of single orders asks for.
    fn orders_of(&self, over: Over) -> Range<usize> {
        match over {
            Over::Order(order) => self.system.excitation.orders.iter().position(|o| *o == order).map_or(0..0, |n| n..n + 1),
            _ => 0..self.system.orders(),
        }
    }

    /// The shafts that may be used most, as some speeds tell, come first: the others need fewer sums then.
    fn worst_first(&self, measure: &Measure, speeds: &Speeds, sweeps: &mut [(&Quantity, &Sweep)], shared: &Shared) {
        let most = |(quantity, sweep): &(&Quantity, &Sweep)| {
            let metric = PointMetric::of(measure.over, **quantity, &measure.within, self.margin, Some(&shared.known));
            let sums = sweep.chunks(self.system.orders()).zip(&speeds.rpm).step_by(EVERY).map(|(y, speed)| (bound(y), speed));
            sums.map(|(sum, speed)| metric.bound(*speed, sum)).fold(0.0, f64::max)
        };
        sweeps.sort_by_cached_key(|s| std::cmp::Reverse(most(s).to_bits()));
    }

    /// Share of its strength that the crank uses by this criterion beside the peaks of criteria that were asked before, less a millionth: speeds that use less need not be looked at.
    fn used_at_known_peaks(
        &self,
        measure: &Measure,
        (speeds, sweeps): (&Speeds, &[(&Quantity, &Sweep)]),
        shared: &Shared,
        work: &mut Work,
    ) -> f64 {
        let (orders, last) = (self.system.orders(), speeds.rpm.len() - 1);
        let mut used = |(quantity, speed_rpm): &(Quantity, f64)| -> Option<f64> {
            let sweep = sweeps.iter().find(|s| s.0 == quantity)?.1;
            let i = speeds.rpm.partition_point(|s| s < speed_rpm).min(last);
            let (speed, y) = (speeds.rpm[i], &sweep[i * orders..(i + 1) * orders]);
            work.syntheses += 1;
            let metric = PointMetric::of(measure.over, *quantity, &measure.within, self.margin, Some(&shared.known));
            measure.within.holds(speed).then(|| metric.value(speed, &self.synthesiser.extremes(y), y))
        };
        shared.worst.borrow().iter().filter_map(&mut used).fold(0.0, f64::max) * (1.0 - CERTAIN)
    }

    /// The largest peak of `measure`; of peaks level to 1e-9, as an optimum has them, the one at the lowest speed.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where nothing damps a resonance.
    pub fn peak(&self, design: &[Mounted], measure: &Measure, work: &mut Work) -> Result<Option<Peak>, ResponseError> {
        Ok(lowest(self.peaks(design, measure, 1.0, work)?))
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
