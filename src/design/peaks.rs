//! Peaks of a quantity over the speed range, to rounding.
//!
//! A sweep finds the local maxima on the grid; each that could win is refined between grid speeds by direct solutions. Ends of the range and
//! kinks of the torque (tabulated speeds) are candidates.

use super::measure::{Measure, Over};
use crate::absorber::Mounted;
use crate::numerics::maximise::{maximise, maximise_bracket};
use crate::numerics::synthesis::{Extremes, Synthesiser, bound, dominating};
use crate::numerics::{C64, ZERO};
use crate::response::{Direct, Grid, Method, Quantity, Response, ResponseError, System, Work};

/// Where on the range a peak lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Between the ends.
    Interior,
    /// At the lowest or highest speed.
    End,
}

/// A local maximum over speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// rad or N m.
    pub value: f64,
    /// rpm.
    pub speed_rpm: f64,
    /// Index of the order (over orders) or of the largest one in the sum (synthesis).
    pub order: usize,
    /// Share of that order: its magnitude.
    pub order_value: f64,
    /// Which of the measure's quantities.
    pub quantity: Quantity,
    /// Where in the cycle the extremes lie (synthesis only).
    pub extremes: Option<Extremes>,
    /// Where on the range.
    pub place: Place,
}

/// Peaks whose estimate lies below this share of what is asked for are not refined.
const ESTIMATE_SHARE: f64 = 0.98;
/// Share of a peak within which other pairs of extremes in the cycle are followed.
const BRANCHES: f64 = 0.03;
/// A refined peak this many times its grid value is looked at again more closely; if it grows as much again, nothing damps it (a damping
/// ratio below about 1e-8).
const STEEP: f64 = 50.0;

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
    synthesiser: Synthesiser,
}

/// A local maximum on the grid.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    /// Index of the speed.
    index: usize,
    /// Value there.
    value: f64,
    /// Estimate of the peak between grid speeds.
    estimate: f64,
    /// Whether the peak lies to the right of the grid speed.
    right: bool,
}

/// Peaks found so far.
struct Found {
    /// Share of the largest that is asked for.
    keep: f64,
    /// The largest.
    best: f64,
    peaks: Vec<Peak>,
}

impl Found {
    fn put(&mut self, peak: Peak) {
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
            synthesiser: Synthesiser::new(&system.excitation.harmonics),
        }
    }

    /// Local maxima of `measure` of at least `keep` times the largest one, which comes first. An empty list where nothing is excited.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where nothing damps a resonance.
    pub fn peaks(&self, design: &[Mounted], measure: &Measure, keep: f64, work: &mut Work) -> Result<Vec<Peak>, ResponseError> {
        work.evaluations += 1;
        let mut found = Found { keep, best: 0.0, peaks: Vec::new() };
        for &quantity in &measure.quantities {
            match measure.over {
                Over::Synthesis => self.synthesised(design, quantity, &mut found, work)?,
                Over::Orders => self.single_orders(design, quantity, &mut found, work)?,
            }
        }
        let mut peaks = found.peaks;
        peaks.retain(|p| p.value >= keep * found.best);
        peaks.sort_by(|a, b| b.value.total_cmp(&a.value));
        Ok(peaks)
    }

    /// The largest peak of `measure`.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where nothing damps a resonance.
    pub fn peak(&self, design: &[Mounted], measure: &Measure, work: &mut Work) -> Result<Option<Peak>, ResponseError> {
        Ok(self.peaks(design, measure, 1.0, work)?.first().copied())
    }

    /// Half peak-to-peak value of every grid speed of a sweep.
    pub fn synthesis(&self, sweep: &[C64]) -> Vec<f64> {
        sweep.chunks(self.system.orders()).map(|y| self.synthesiser.extremes(y).half_peak_to_peak).collect()
    }

    fn synthesised(&self, design: &[Mounted], quantity: Quantity, found: &mut Found, work: &mut Work) -> Result<(), ResponseError> {
        let mut sweep = Vec::new();
        self.method.sweep(design, quantity, &mut sweep, work)?;
        let orders = self.system.orders();
        let bounds: Vec<f64> = sweep.chunks(orders).map(bound).collect();
        // The sum of magnitudes bounds the synthesis at that speed, and most speeds need none. Between speeds a peak may rise further; how far
        // shows in the growth towards it.
        let mut values = vec![f64::NEG_INFINITY; bounds.len()];
        let mut top = found.best;
        let first = (0..bounds.len()).fold(0, |m, i| if bounds[i] > bounds[m] { i } else { m });
        for i in std::iter::once(first).chain(0..bounds.len()) {
            let rise = if self.refine { growth(&bounds, i) } else { 1.0 };
            if values[i] == f64::NEG_INFINITY && bounds[i] > 0.0 && bounds[i] * rise >= found.keep * top {
                work.syntheses += 1;
                values[i] = self.synthesiser.extremes(&sweep[i * orders..(i + 1) * orders]).half_peak_to_peak;
                top = top.max(values[i]);
            }
        }
        let mut y = vec![ZERO; orders];
        let at = |speed_rpm: f64, y: &mut [C64], work: &mut Work| -> Result<Extremes, ResponseError> {
            self.direct.at(design, quantity, speed_rpm, y, work)?;
            work.syntheses += 1;
            Ok(self.synthesiser.extremes(y))
        };
        for candidate in local_maxima(&self.grid.speed_rpm, &values) {
            let value_at = |speed: f64, work: &mut Work| at(speed, &mut y, work).map(|e| e.half_peak_to_peak);
            let Some((speed_rpm, place)) = self.refined(candidate, found.keep * found.best.max(top), value_at, work)? else { continue };
            let extremes = at(speed_rpm, &mut y, work)?;
            let peak = |extremes: Extremes, speed_rpm, place, y: &[C64]| {
                let (order, order_value) = dominating(y);
                Peak { value: extremes.half_peak_to_peak, speed_rpm, order, order_value, quantity, extremes: Some(extremes), place }
            };
            found.put(peak(extremes, speed_rpm, place, &y));
            if !self.refine || place == Place::End {
                continue;
            }
            // Other pairs of extremes in the cycle may peak nearby, as high or nearly so: each is a smooth function of its own.
            let reach = (self.grid.speed_rpm[candidate.index.max(1) - 1], self.grid.speed_rpm[(candidate.index + 1).min(bounds.len() - 1)]);
            for start in self.synthesiser.alternatives(&y, (1.0 - found.keep).clamp(0.002, BRANCHES)) {
                let mut follow = |speed: f64, y: &mut [C64]| -> Result<Extremes, ResponseError> {
                    self.direct.at(design, quantity, speed, y, work)?;
                    Ok(self.synthesiser.branch(y, &start))
                };
                let (speed_rpm, _) = maximise(reach.0, reach.1, |s| follow(s, &mut y).map(|e| e.half_peak_to_peak))?;
                let extremes = follow(speed_rpm, &mut y)?;
                found.put(peak(extremes, speed_rpm, Place::Interior, &y));
            }
        }
        Ok(())
    }

    fn single_orders(&self, design: &[Mounted], quantity: Quantity, found: &mut Found, work: &mut Work) -> Result<(), ResponseError> {
        let mut sweep = Vec::new();
        self.method.magnitudes(design, quantity, &mut sweep, work)?;
        let orders = self.system.orders();
        let top = sweep.iter().copied().fold(found.best, f64::max);
        for order in 0..orders {
            let values: Vec<f64> = sweep.iter().skip(order).step_by(orders).copied().collect();
            for candidate in local_maxima(&self.grid.speed_rpm, &values) {
                let value_at = |speed: f64, work: &mut Work| self.direct.order_at(design, quantity, order, speed, work).map(|y| y.norm());
                let Some((speed_rpm, place)) = self.refined(candidate, found.keep * found.best.max(top), value_at, work)? else { continue };
                let value = self.direct.order_at(design, quantity, order, speed_rpm, work)?.norm();
                found.put(Peak { value, speed_rpm, order, order_value: value, quantity, extremes: None, place });
            }
        }
        Ok(())
    }

    /// Speed and place of the local maximum near a grid speed, or nothing where it cannot reach `wanted`.
    fn refined(
        &self,
        candidate: Candidate,
        wanted: f64,
        mut value_at: impl FnMut(f64, &mut Work) -> Result<f64, ResponseError>,
        work: &mut Work,
    ) -> Result<Option<(f64, Place)>, ResponseError> {
        let Candidate { index: i, value, estimate, right } = candidate;
        let speed = &self.grid.speed_rpm;
        let last = speed.len() - 1;
        let end = if i == 0 || i == last { Place::End } else { Place::Interior };
        if !self.refine || last == 0 {
            return Ok((value >= wanted).then_some((speed[i], end)));
        }
        if estimate.max(value) < ESTIMATE_SHARE * wanted {
            return Ok(None);
        }
        let mut best = (speed[i], value_at(speed[i], work)?, end);
        let mut keep = |(at, v): (f64, f64)| {
            if v > best.1 * (1.0 + 1e-12) {
                best = (at, v, Place::Interior);
            }
        };
        let mut f = |s: f64| value_at(s, work);
        if end == Place::Interior && !self.grid.kink[i] {
            keep(maximise_bracket((speed[i - 1], speed[i], speed[i + 1]), right, &mut f)?);
        } else {
            // an end, or a kink that may hold the maximum itself: each side is searched apart
            if i > 0 {
                keep(maximise(speed[i - 1], speed[i], &mut f)?);
            }
            if i < last {
                keep(maximise(speed[i], speed[i + 1], &mut f)?);
            }
        }
        if best.1 > STEEP * value {
            let (at, near) = (best.0, 1e-4 * (speed[(i + 1).min(last)] - speed[i.saturating_sub(1)]));
            let closer = maximise((at - near).max(speed[0]), (at + near).min(speed[last]), |s| value_at(s, work))?;
            if closer.1 > STEEP * best.1 {
                return Err(self.pole(closer.0));
            }
            if closer.1 > best.1 {
                (best.0, best.1) = closer;
            }
        }
        Ok(Some((best.0, best.2)))
    }

    /// The error for a pole at this speed: the order whose base response is largest there.
    fn pole(&self, speed_rpm: f64) -> ResponseError {
        let last = self.system.chain.len() - 1;
        let quantity = Quantity::Twist { from: 0, to: (last > 0).then_some(last) };
        let size = |n: usize| self.direct.order_at(&[], quantity, n, speed_rpm, &mut Work::default()).map_or(f64::INFINITY, |y| y.norm());
        let n = (0..self.system.orders()).fold((0, 0.0), |m, n| if size(n) > m.1 { (n, size(n)) } else { m }).0;
        ResponseError::unbounded(self.system.excitation.orders[n], speed_rpm)
    }

    /// Derivatives of a peak's value with respect to ring inertia, stiffness and damping of absorber `index`, at fixed speed and cycle
    /// angles: exact, because a peak is stationary in both (or held by an end of the range).
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance.
    pub fn gradient(&self, design: &[Mounted], index: usize, peak: &Peak, work: &mut Work) -> Result<[f64; 3], ResponseError> {
        let Some(extremes) = &peak.extremes else {
            let y = self.direct.order_at(design, peak.quantity, peak.order, peak.speed_rpm, work)?;
            let change = self.direct.sensitivity(design, index, peak.quantity, peak.order..peak.order + 1, peak.speed_rpm, work)?;
            return Ok(change[0].map(|d| (y.conj() * d).re / y.norm()));
        };
        let changes = self.direct.sensitivity(design, index, peak.quantity, 0..self.system.orders(), peak.speed_rpm, work)?;
        Ok([0, 1, 2].map(|p| {
            let change: Vec<C64> = changes.iter().map(|c| c[p]).collect();
            self.synthesiser.derivative(extremes, &change)
        }))
    }
}

/// Local maxima of grid values, largest first, each with an estimate of the true peak: the vertex of the parabola through 1/v² at three
/// speeds, exact for a single resonance.
fn local_maxima(speed: &[f64], values: &[f64]) -> Vec<Candidate> {
    let last = values.len() - 1;
    let mut found: Vec<Candidate> = (0..=last)
        .filter(|&i| values[i] > 0.0 && (i == 0 || values[i] > values[i - 1]) && (i == last || values[i] >= values[i + 1]))
        .map(|i| {
            let inside = i > 0 && i < last && values[i - 1] > 0.0 && values[i + 1] > 0.0;
            let estimate = if inside { vertex(&speed[i - 1..=i + 1], &values[i - 1..=i + 1]) } else { values[i] };
            let right = i < last && (i == 0 || values[i + 1] >= values[i - 1]);
            Candidate { index: i, value: values[i], estimate, right }
        })
        .collect();
    found.sort_by(|a, b| b.value.total_cmp(&a.value));
    found
}

/// How far a peak may rise above a grid value: the square of its growth from its lower neighbour, and never less than a well-resolved peak
/// can hide.
fn growth(values: &[f64], i: usize) -> f64 {
    let lower = [i.checked_sub(1), Some(i + 1)].into_iter().flatten().filter_map(|j| values.get(j)).fold(values[i], |m, v| m.min(*v));
    (values[i] / lower).powi(2).max(1.03)
}

fn vertex(x: &[f64], v: &[f64]) -> f64 {
    let q: Vec<f64> = v.iter().map(|v| 1.0 / (v * v)).collect();
    let (h0, h1) = (x[1] - x[0], x[2] - x[1]);
    let (s0, s1) = ((q[1] - q[0]) / h0, (q[2] - q[1]) / h1);
    let curvature = (s1 - s0) / (h0 + h1);
    if curvature.is_nan() || curvature <= 0.0 {
        return v[1];
    }
    let slope = s0 + curvature * h0;
    let lowest = q[1] - 0.25 * slope * slope / curvature;
    if lowest > 0.0 { 1.0 / lowest.sqrt() } else { f64::INFINITY }
}
