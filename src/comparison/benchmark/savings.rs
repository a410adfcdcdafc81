//! What skipping and choosing save on a study, and how often the error of a surrogate peak exceeds its estimate: over random absorbers, against exact peaks.

use super::smaller_models::{self, SmallerModel};
use super::speed_accuracy::REPEATS;
use crate::absorber::Mounted;
use crate::analysis::method_selection::{self, Choice, Strategy};
use crate::analysis::timing::median_seconds;
use crate::analysis::{RunError, families, model_check};
use crate::drivetrain::System;
use crate::engine::Excitation;
use crate::input::Study;
use crate::objective::surrogate::{Estimated, Scratch, Surrogate};
use crate::objective::{Measure, Over, PeakFinder};
use crate::response::{Direct, Grid, Method, Quantity, Receptance, Response, ResponseError, Work};
use rayon::prelude::*;
use std::time::Instant;

/// Errors of surrogate peaks against exact ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coverage {
    /// Designs that tables answer for.
    pub designs: usize,
    /// Those whose estimated error is within the tolerance of the study: the others are evaluated exactly.
    pub accepted: usize,
    /// Accepted ones whose true error is within it too.
    pub within: usize,
    /// Designs whose true error is larger than the estimate.
    pub exceeded: usize,
    /// Median of estimated over true error.
    pub ratio: f64,
}

/// Cost of one design by ways that give the same, and by tables.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cost {
    /// Seconds on one thread.
    pub seconds: f64,
    /// Work, the mean of the designs.
    pub work: Work,
}

/// What is measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Savings {
    /// What `auto` chooses here.
    pub choice: Choice,
    /// What methods with smaller models would cost and err.
    pub smaller_models: Vec<SmallerModel>,
    /// Every speed summed, every local maximum refined.
    pub full: Cost,
    /// Only what can win.
    pub skipping: Cost,
    /// Whether both found the same peaks, to the last bit.
    pub identical: bool,
    /// By the chosen tables (exactly where the estimate asks for it), with the coverage of the estimate; nothing where `auto` stays exact.
    pub surrogate: Option<(Cost, Coverage)>,
    /// Designs a second on all threads: the peak of every design, and the best of all designs where others are given up early.
    pub designs_per_second: Option<(f64, f64)>,
    /// Whether the best design is the same when others are given up early.
    pub same_best: bool,
    /// Threads of those.
    pub threads: usize,
    /// Seconds a point of the receptance kernel, squares of the magnitudes of one quantity.
    pub point: f64,
    /// A direct sweep of one design and quantity on one thread.
    pub sweep: Sweep,
}

/// A sweep that was timed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sweep {
    /// Seconds.
    pub seconds: f64,
    /// Its size.
    pub orders: usize,
    /// Its size.
    pub speeds: usize,
    /// Its size.
    pub stations: usize,
}

impl Sweep {
    /// Its size in words.
    pub fn label(&self) -> String {
        format!("{} x {} x {} (orders, speeds, stations)", self.orders, self.speeds, self.stations)
    }
}

/// Random designs, and how many of them are evaluated in full.
const DESIGNS: usize = 2000;
const IN_FULL: usize = 24;
const SEED: u64 = 1956;
/// Rounds of screening: one is over too soon to be timed.
const ROUNDS: usize = 50;
/// Speeds of the timed sweep.
const SPEEDS: usize = 200;

/// Measures a study; nothing where it optimises no synthesised quantity.
///
/// # Errors
/// [`RunError`] where a design has no finite peak.
pub fn measure(study: &Study) -> Result<Option<Savings>, RunError> {
    let failed = |error| RunError { what: "random absorbers".into(), error };
    let (Some(spec), Some(quantity)) = (&study.optimise, study.objective.measure.synthesised()) else { return Ok(None) };
    let excitation = Excitation::new(&study.engine, study.order_limit);
    let modes = families::engine_modes(study, spec, model_check::highest_frequency_hz(study, &excitation.orders));
    let system = System::with_modes(study.chain.clone(), study.modes.clone(), excitation);
    let grid = Grid::new(&study.speeds_rpm, &system.excitation.tabulated_rpm);
    let method = Method::Receptance(Receptance::new(&system, &grid, study.hub, &[quantity]));
    let finder = PeakFinder::new(&system, &grid, &method, true);
    let designs = method_selection::random_absorbers(study, &modes, DESIGNS, SEED);
    let (Method::Receptance(receptance), false) = (&method, designs.is_empty()) else { return Ok(None) };
    let choice = method_selection::choose(study, &study.objective.measure, &modes, &finder, receptance);
    let (full, skipping, identical) = skipping(&finder, &designs[..IN_FULL], quantity).map_err(failed)?;
    let surrogate = match choice.chosen.strategy {
        Strategy::Tables(stride) => Surrogate::new(receptance, quantity, stride),
        _ => None,
    };
    let answered = surrogate.as_ref().map(|q| coverage(q, &finder, &designs, quantity, study.tolerance)).transpose().map_err(failed)?;
    let rate = surrogate.as_ref().map(|q| rates(q, &designs));
    Ok(Some(Savings {
        full,
        skipping,
        identical,
        surrogate: answered,
        designs_per_second: rate.map(|r| (r.0, r.1)),
        same_best: rate.is_none_or(|r| r.2),
        threads: rayon::current_num_threads(),
        point: point(&method, &designs[0], quantity).map_err(failed)?,
        sweep: sweep(&system, study, &designs[0], quantity).map_err(failed)?,
        smaller_models: smaller_models::estimates(study, &finder, &method_selection::named_designs(study, &designs), quantity),
        choice,
    }))
}

/// The same peaks with and without skipping.
fn skipping(finder: &PeakFinder, designs: &[Mounted], quantity: Quantity) -> Result<(Cost, Cost, bool), ResponseError> {
    let measure = Measure::new(vec![quantity], Over::Synthesis);
    let run = |keep: f64| -> Result<(Cost, Vec<f64>), ResponseError> {
        let (start, mut work, mut values) = (Instant::now(), Work::default(), Vec::new());
        for m in designs {
            let peaks = finder.peaks(std::slice::from_ref(m), &measure, keep, &mut work)?;
            values.push(peaks.first().map_or(0.0, |p| p.value));
        }
        Ok((Cost { seconds: start.elapsed().as_secs_f64() / designs.len() as f64, work: mean(&work, designs.len()) }, values))
    };
    let (full, all) = run(0.0)?;
    let (skipping, some) = run(1.0)?;
    Ok((full, skipping, all.iter().zip(&some).all(|(a, b)| a.to_bits() == b.to_bits())))
}

fn mean(work: &Work, designs: usize) -> Work {
    let n = designs as u64;
    Work {
        evaluations: work.evaluations / n,
        direct_solves: work.direct_solves / n,
        receptance_points: work.receptance_points / n,
        syntheses: work.syntheses / n,
        eigenproblems: work.eigenproblems / n,
        ..Work::default()
    }
}

/// Surrogate peaks of designs against exact ones, and what a design costs.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance.
pub fn coverage(
    surrogate: &Surrogate,
    finder: &PeakFinder,
    designs: &[Mounted],
    quantity: Quantity,
    tolerance: f64,
) -> Result<(Cost, Coverage), ResponseError> {
    let taken: Vec<&Mounted> = designs.iter().filter(|m| surrogate.takes(m)).collect();
    let measure = Measure::new(vec![quantity], Over::Synthesis);
    let exact = |m: &&Mounted| finder.peak(std::slice::from_ref(*m), &measure, &mut Work::default()).map(|p| p.map_or(0.0, |p| p.value));
    let exact: Vec<f64> = taken.par_iter().map(exact).collect::<Result<_, _>>()?;
    let (mut scratch, mut work, start) = (Scratch::default(), Work::default(), Instant::now());
    let mut found: Vec<Estimated> = Vec::new();
    for m in &taken {
        let mut peak = surrogate.peak(m, &mut scratch, &mut work);
        found.push(peak);
        if peak.error > tolerance {
            peak.value = finder.peak(std::slice::from_ref(*m), &measure, &mut work)?.map_or(0.0, |p| p.value);
        }
    }
    let seconds = start.elapsed().as_secs_f64() / taken.len().max(1) as f64;
    let errors: Vec<f64> = found.iter().zip(&exact).map(|(f, e)| (f.value / e - 1.0).abs()).collect();
    let mut ratios: Vec<f64> = found.iter().zip(&errors).map(|(f, e)| f.error / e.max(f64::EPSILON)).collect();
    ratios.sort_by(f64::total_cmp);
    let pairs = || found.iter().zip(&errors);
    let coverage = Coverage {
        designs: taken.len(),
        accepted: pairs().filter(|(f, _)| f.error <= tolerance).count(),
        within: pairs().filter(|(f, e)| f.error <= tolerance && **e <= tolerance).count(),
        exceeded: pairs().filter(|(f, e)| **e > f.error).count(),
        ratio: ratios.get(ratios.len() / 2).copied().unwrap_or(f64::NAN),
    };
    Ok((Cost { seconds, work: mean(&work, taken.len().max(1)) }, coverage))
}

/// Designs a second on all threads: every peak, and the best one only; whether both have the same best.
fn rates(surrogate: &Surrogate, designs: &[Mounted]) -> (f64, f64, bool) {
    let share = designs.len().div_ceil(rayon::current_num_threads());
    let start = Instant::now();
    let lowest = |part: &[Mounted]| {
        let mut scratch = Scratch::default();
        part.iter().map(|m| surrogate.peak(m, &mut scratch, &mut Work::default()).value).fold(f64::INFINITY, f64::min)
    };
    let all = designs.par_chunks(share).map(lowest).reduce(|| f64::INFINITY, f64::min);
    let every = designs.len() as f64 / start.elapsed().as_secs_f64();
    let start = Instant::now();
    let screened = |part: &[Mounted]| {
        let (mut scratch, mut best) = (Scratch::default(), f64::INFINITY);
        for _ in 0..ROUNDS {
            best = f64::INFINITY;
            for m in part {
                if let Some(found) = surrogate.peak_below(m, best, &mut scratch, &mut Work::default()) {
                    best = best.min(found.value);
                }
            }
        }
        best
    };
    let best = designs.par_chunks(share).map(screened).reduce(|| f64::INFINITY, f64::min);
    (every, (designs.len() * ROUNDS) as f64 / start.elapsed().as_secs_f64(), all.to_bits() == best.to_bits())
}

/// Seconds a point of the squares of the magnitudes of one quantity.
fn point(method: &Method, mounted: &Mounted, quantity: Quantity) -> Result<f64, ResponseError> {
    let (mut out, mut work) = (Vec::new(), Work::default());
    let seconds = median_seconds(REPEATS, || method.squares(std::slice::from_ref(mounted), quantity, &mut out, &mut work))?;
    Ok(seconds / out.len() as f64)
}

/// Seconds of a direct sweep with a ring.
fn sweep(system: &System, study: &Study, mounted: &Mounted, quantity: Quantity) -> Result<Sweep, ResponseError> {
    let (first, last) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    let grid = Grid::new(&(0..SPEEDS).map(|i| first + (last - first) * i as f64 / (SPEEDS - 1) as f64).collect::<Vec<_>>(), &[]);
    let (direct, mut out, mut work) = (Direct::new(system, &grid), Vec::new(), Work::default());
    let seconds = median_seconds(REPEATS, || direct.sweep(std::slice::from_ref(mounted), quantity, &mut out, &mut work))?;
    Ok(Sweep { seconds, orders: system.orders(), speeds: SPEEDS, stations: system.chain.len() })
}
