//! `method = "auto"`: the cheapest way to a peak that is right enough, by the study's own designs and random ones like them.
//!
//! A search evaluates thousands of designs by what is chosen; what is reported of a design is exact whatever was chosen. Cost is counted, not
//! measured, so that the choice is the same on every machine: work times nominal times of one kind of processor.
//!
//! Methods with a smaller model are estimated beside it and never win: once the chain is tabulated its size costs nothing, and without tables (a
//! chain that nothing damps) a few speeds cannot be trusted to show its narrow peaks, whatever the model.

use super::families;
use crate::absorber::seeds::{EngineMode, Rule};
use crate::absorber::{Kind, Mounted, Ring};
use crate::benchmark::methods::Candidate;
use crate::benchmark::speed_accuracy;
use crate::input::Study;
use crate::numerics::synthesis::Synthesiser;
use crate::objective::PeakFinder;
use crate::objective::surrogate::{Quick, Scratch};
use crate::response::{Direct, Grid, Quantity, Receptance, Response, Work};
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// A way to a peak.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// Receptance tables at every so many grid speeds, then a parabola.
    Tables(usize),
    /// A response method at a few speeds, refined by itself.
    Method(Candidate),
    /// All grid speeds, refined by direct solutions.
    Exact,
}

impl Way {
    /// In words.
    pub fn label(self) -> String {
        match self {
            Self::Tables(1) => "tables, every speed".into(),
            Self::Tables(n) => format!("tables, every {n} speeds"),
            Self::Method(c) => c.label(),
            Self::Exact => "exact".into(),
        }
    }
}

/// What was considered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Considered {
    /// The way.
    pub way: Way,
    /// Nominal seconds a design.
    pub seconds: f64,
    /// Estimate of the largest error over the probe designs, relative.
    pub error: f64,
}

/// A choice and what it was made from.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// Cheapest first.
    pub considered: Vec<Considered>,
    /// What was chosen.
    pub chosen: Considered,
    /// Nominal seconds of the exact way.
    pub exact: f64,
    /// Number of probe designs.
    pub probes: usize,
}

/// Strides of the tables that are considered.
pub const STRIDES: [usize; 5] = [16, 8, 4, 2, 1];
/// Methods that are considered.
const METHODS: [Candidate; 5] =
    [Candidate::ClosedForm, Candidate::Reduced(1), Candidate::Reduced(2), Candidate::Reduced(3), Candidate::Modal];
/// Speeds a method starts from.
const SPEEDS: usize = 27;
/// Random probe designs, and their seed.
const PROBES: usize = 256;
const SEED: u64 = 2014;
/// Random designs lie within this many e-folds of a closed form, in stiffness and damping.
const SPREAD: f64 = 2.0;
/// Tables are worth the trouble where they cost at most this share of the exact way.
const WORTH: f64 = 0.7;
/// An error is doubled where it is only known at the peak that a method itself found.
const OWN_PEAK: f64 = 2.0;

/// Nominal seconds of work, as measured by `chart` on the processor hartog was written on: for choosing, not for telling.
fn nominal(work: &Work, stations: usize) -> f64 {
    let per = [
        (work.receptance_points, 1.3e-9),
        (work.syntheses, 0.6e-6),
        (work.direct_solves, 8e-9 * stations as f64),
        (work.modal_solves, 25e-9 * stations as f64),
        (work.eigenproblems, 40e-6),
    ];
    per.iter().map(|(count, seconds)| *count as f64 * seconds).sum()
}

/// Random absorbers like those a study looks for: its types in turn, ring inertia over its range (an eighth to the whole of the largest ring where it gives one),
/// stiffness and damping up to e² times and down to 1/e² of a closed form, within the bounds. Empty where a study optimises nothing.
pub fn random_absorbers(study: &Study, modes: &[EngineMode], count: usize, seed: u64) -> Vec<Mounted> {
    let Some(spec) = &study.optimise else { return Vec::new() };
    let Some(engine) = modes.first() else { return Vec::new() };
    let mut generator = Xoshiro256PlusPlus::seed_from_u64(seed);
    let (low, high) = match &study.front {
        Some(front) => (front.inertias[0], front.inertias[front.inertias.len() - 1]),
        None => {
            let widest = families::family(&spec.absorber, Kind::Viscous, None, modes);
            let bounds = widest.variables.iter().find(|v| v.parameter == crate::optimise::Parameter::RingInertia);
            bounds.map_or((0.125 * widest.fixed[0], widest.fixed[0]), |v| (v.lower.max(0.125 * v.upper), v.upper))
        }
    };
    let kinds: Vec<Kind> = spec.absorber.kinds.iter().copied().filter(|k| *k != Kind::Locked).collect();
    if kinds.is_empty() || high <= 0.0 {
        return Vec::new();
    }
    let one = |i: usize| {
        let kind = kinds[i % kinds.len()];
        let ring = low * (high / low).powf(generator.random_range(0.0..=1.0));
        let rule = if kind == Kind::Viscous { Rule::ViscousUntuned } else { Rule::HInfinity };
        let closed = rule.absorber(ring, *engine);
        let [stiffness, damping] = [closed.stiffness(), closed.damping()].map(|v| v * generator.random_range(-SPREAD..=SPREAD).exp());
        let space = families::family(&spec.absorber, kind, Some(ring), modes);
        space.absorber(&space.point(&kind.build(ring, stiffness, damping)))
    };
    (0..count).map(one).collect()
}

/// Chooses the way for a study. `receptance`: its tables.
pub fn choose(study: &Study, modes: &[EngineMode], finder: &PeakFinder, receptance: &Receptance) -> Choice {
    let stations = finder.system.chain.len();
    let given: Vec<Mounted> = study.designs.iter().filter(|d| d.absorbers.len() == 1).map(|d| d.absorbers[0]).collect();
    let random = random_absorbers(study, modes, PROBES, SEED);
    let mut named: Vec<Mounted> = given.iter().filter(|m| m.station == study.hub).copied().collect();
    if named.is_empty() {
        named = random.iter().take(3).copied().collect();
    }
    let mut considered = Vec::new();
    // the exact way, on the designs that have names; one without a finite peak is reported where it is evaluated
    let measure = &study.objective.measure;
    let mut work = Work::default();
    named.retain(|m| finder.peak(std::slice::from_ref(m), measure, &mut work).is_ok());
    let exact = nominal(&work, stations) / named.len().max(1) as f64;
    considered.push(Considered { way: Way::Exact, seconds: exact, error: 0.0 });
    if let Some(quantity) = measure.synthesised() {
        let all: Vec<Mounted> = named.iter().chain(&random).copied().collect();
        if finder.is_smooth() {
            considered.extend(tables(receptance, quantity, &all, study.tolerance, exact, stations));
        }
        considered.extend(methods(study, finder, &named, quantity));
    }
    considered.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let right = |c: &&Considered| c.error <= study.tolerance && matches!(c.way, Way::Tables(_)) && c.seconds < WORTH * exact;
    let chosen = considered.iter().find(right).copied().unwrap_or(Considered { way: Way::Exact, seconds: exact, error: 0.0 });
    Choice { considered, chosen, exact, probes: named.len() + random.len() }
}

/// Tables at several strides: their own estimate, and the difference to the tables at every speed, which shows peaks that were missed. A design whose own
/// estimate is too large is evaluated exactly, and paid for so.
fn tables(receptance: &Receptance, quantity: Quantity, probes: &[Mounted], tolerance: f64, exact: f64, stations: usize) -> Vec<Considered> {
    let peaks = |stride: usize| -> Option<Vec<(f64, f64, f64)>> {
        let quick = Quick::new(receptance, quantity, stride)?;
        let mut scratch = Scratch::default();
        let one = |m: &Mounted| {
            let mut work = Work::default();
            let found = quick.peak(m, &mut scratch, &mut work);
            (found.value, found.error, nominal(&work, stations))
        };
        Some(probes.iter().filter(|m| quick.takes(m)).map(one).collect())
    };
    let Some(all) = peaks(1).filter(|all| !all.is_empty()) else { return Vec::new() };
    let at = |stride: usize| {
        let found = peaks(stride)?;
        let (mut error, mut seconds) = (0.0, 0.0);
        for (own, full) in found.iter().zip(&all) {
            seconds += own.2;
            if own.1 > tolerance {
                seconds += exact;
                continue;
            }
            error = f64::max(error, own.1 + (own.0 / full.0 - 1.0).abs());
        }
        Some(Considered { way: Way::Tables(stride), seconds: seconds / found.len() as f64, error })
    };
    let speeds = receptance.grid().len();
    STRIDES.iter().filter(|s| **s == 1 || 2 * **s < speeds).filter_map(|s| at(*s)).collect()
}

/// Methods with a model of their own: their peak against a direct solution at the same speed.
fn methods(study: &Study, finder: &PeakFinder, probes: &[Mounted], quantity: Quantity) -> Vec<Considered> {
    let (first, last) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    let speeds: Vec<f64> = (0..SPEEDS).map(|i| first + (last - first) * i as f64 / (SPEEDS - 1) as f64).collect();
    let grid = Grid::new(&speeds, &[]);
    let direct = Direct::new(finder.system, &grid);
    let synthesiser = Synthesiser::new(&finder.system.excitation.harmonics);
    let estimate = |candidate: Candidate| -> Option<Considered> {
        let method = candidate.build(finder.system, &grid, probes.get(..1)?, quantity)?;
        let (mut error, mut work) = (0.0, Work::default());
        for m in probes {
            let design = std::slice::from_ref(m);
            let (speed, value) = speed_accuracy::peak(method.as_ref(), &synthesiser, design, quantity, true, &mut work).ok()?;
            let mut y = vec![crate::numerics::ZERO; finder.system.orders()];
            direct.at(design, quantity, speed, &mut y, &mut work).ok()?;
            let exact = synthesiser.extremes(&y).half_peak_to_peak;
            error = f64::max(error, OWN_PEAK * (value / exact - 1.0).abs());
        }
        let seconds = nominal(&work, finder.system.chain.len()) / probes.len() as f64;
        Some(Considered { way: Way::Method(candidate), seconds, error })
    };
    METHODS.iter().filter_map(|c| estimate(*c)).collect()
}
