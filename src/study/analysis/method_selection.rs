//! `method = "auto"`: the cheapest strategy that finds peaks within tolerance, by the study's own designs and random ones like them.
//!
//! A search evaluates thousands of designs by what is chosen; what is reported of a design is exact whatever was chosen. Cost is counted, not
//! measured, so that the choice is the same on every machine: work times nominal times of one kind of processor.

use super::families;
use crate::absorber::closed_forms::EngineMode;
use crate::absorber::{Host, Mounted, Surroundings};
use crate::input::{FrontSpec, Size, Study};
use crate::numerics::elementary::Elementary;
use crate::objective::surrogate::{Scratch, Surrogate};
use crate::objective::{Measure, Over, PeakFinder};
use crate::response::{Receptance, Response, Work};
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use rayon::prelude::*;

/// How searches find peaks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Strategy {
    /// Receptance tables at every so many grid speeds, then a parabola.
    Tables(usize),
    /// All grid speeds, refined by direct solutions.
    Exact,
}

impl Strategy {
    /// In words.
    pub fn label(self) -> String {
        match self {
            Self::Tables(1) => "tables, every speed".into(),
            Self::Tables(n) => format!("tables, every {n} speeds"),
            Self::Exact => "exact".into(),
        }
    }
}

/// A strategy that was considered.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Considered {
    /// The strategy.
    pub strategy: Strategy,
    /// Nominal seconds a design.
    pub seconds: f64,
    /// Estimate of the largest error over the probe designs, relative.
    pub error: f64,
}

/// A choice and what it was made from.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Choice {
    /// Cheapest first.
    pub considered: Vec<Considered>,
    /// What was chosen.
    pub chosen: Considered,
    /// Nominal seconds of the exact strategy.
    pub exact: f64,
    /// Number of probe designs.
    pub probes: usize,
}

/// Strides of the tables that are considered.
#[doc(hidden)]
pub const STRIDES: [usize; 5] = [16, 8, 4, 2, 1];
/// Random probe designs, and their seed.
const PROBES: usize = 256;
/// The same where the measure is the largest of several quantities.
const FEWER_PROBES: usize = 16;
const SEED: u64 = 2014;
/// Random designs lie within this many e-folds of a closed form, in every parameter but the ring inertia.
const SPREAD: f64 = 2.0;
/// Tables are worth the trouble where they cost at most this share of the exact strategy.
const WORTH: f64 = 0.7;

/// Nominal seconds of the bound of a shaft's utilisation at a speed.
const PER_BOUND: f64 = 0.2e-6;

/// Nominal seconds of work, as measured by `chart` on the processor hartog was written on: for choosing, not for telling.
pub fn nominal(work: &Work, stations: usize) -> f64 {
    let per = [
        (work.receptance_points, 1.3e-9),
        (work.syntheses, 0.6e-6),
        (work.direct_solves, 8e-9 * stations as f64),
        (work.modal_solves, 25e-9 * stations as f64),
        (work.eigenproblems, 40e-6),
    ];
    per.iter().map(|(count, seconds)| *count as f64 * seconds).sum()
}

/// Random absorbers like that a study looks for: its types in turn, ring inertia over its range (an eighth to the whole of the largest ring where it gives
/// one), every other parameter up to e² times and down to 1/e² of a closed form, within the bounds. Empty where a study does not optimise exactly one absorber.
pub fn random_absorbers(study: &Study, modes: &[Vec<EngineMode>], count: usize, seed: u64) -> Vec<Mounted> {
    let Some(spec) = &study.optimise else { return Vec::new() };
    let ([absorber], [own_modes]) = (spec.absorbers.as_slice(), modes) else { return Vec::new() };
    let Some(engine) = own_modes.first() else { return Vec::new() };
    let mut generator = Xoshiro256PlusPlus::seed_from_u64(seed);
    let (low, high) = match (&study.front, &absorber.size) {
        (Some(FrontSpec::OverInertia(inertias)), _) => (inertias[0], inertias[inertias.len() - 1]),
        (_, Size::Each(list)) => (0.125 * list[0], list[0]),
        (_, Size::Between(a, b)) => (a.max(0.125 * b), *b),
    };
    if high <= 0.0 {
        return Vec::new();
    }
    let one = |i: usize| {
        let declaration = absorber.types[i % absorber.types.len()];
        let ring = low * (high / low).power(generator.random_range(0.0..=1.0));
        let surroundings = Surroundings { modes: own_modes, ring_inertia: ring };
        let mut values = match declaration.closed_forms.iter().rfind(|f| f.every_mode) {
            Some(form) => (form.values)(ring, *engine),
            None => declaration.parameters.iter().map(|p| (p.typical)(&surroundings)).collect(),
        };
        for value in values.iter_mut().skip(1) {
            *value *= generator.random_range(-SPREAD..=SPREAD).exponential();
        }
        let choice = families::Choice { types: vec![declaration], rings: vec![Some(ring)] };
        let space = families::family(spec, &choice, modes);
        space.design(&space.point(&[values])).swap_remove(0)
    };
    (0..count).map(one).collect()
}

/// Designs that strategies are tried on first: those of the study with one absorber on the station that is optimised, else three random ones.
#[doc(hidden)]
pub fn named_designs(study: &Study, random: &[Mounted]) -> Vec<Mounted> {
    let given = study.designs.iter().filter(|d| d.absorbers.len() == 1).map(|d| &d.absorbers[0]);
    let named: Vec<Mounted> = given.filter(|m| m.on == Host::Station(study.hub)).cloned().collect();
    if named.is_empty() { random.iter().take(3).cloned().collect() } else { named }
}

/// Chooses the strategy of searches by one of the objectives of a study. `receptance`: its tables.
pub fn choose(study: &Study, measure: &Measure, modes: &[Vec<EngineMode>], finder: &PeakFinder, receptance: &Receptance) -> Choice {
    let stations = finder.system.chain.len();
    let random = random_absorbers(study, modes, if measure.quantities.len() == 1 { PROBES } else { FEWER_PROBES }, SEED);
    let mut named = named_designs(study, &random);
    let mut considered = Vec::new();
    // the exact strategy, on the designs that have names; one without a finite peak is reported where it is evaluated
    let mut work = Work::default();
    named.retain(|m| finder.peak(std::slice::from_ref(m), measure, &mut work).is_ok());
    // bounds of the crank's utilisation at every speed are no work that is counted
    let bounds = if let Over::Margin(_) = measure.over { measure.quantities.len() * finder.grid.len() } else { 0 };
    let exact = nominal(&work, stations) / named.len().max(1) as f64 + PER_BOUND * bounds as f64;
    considered.push(Considered { strategy: Strategy::Exact, seconds: exact, error: 0.0 });
    if finder.is_smooth() {
        let all: Vec<Mounted> = named.iter().chain(&random).cloned().collect();
        let surrogate = |stride: usize| Surrogate::of(receptance, measure, finder.margin, stride);
        let strides: Vec<usize> = STRIDES.into_iter().filter(|s| *s == 1 || 2 * s < receptance.grid().len()).collect();
        considered.extend(tables(&surrogate, &strides, &all, study.tolerance, exact, stations));
    }
    considered.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let is_good = |c: &&Considered| c.error <= study.tolerance && c.strategy != Strategy::Exact && c.seconds < WORTH * exact;
    let chosen = considered.iter().find(is_good).copied();
    let chosen = chosen.unwrap_or(Considered { strategy: Strategy::Exact, seconds: exact, error: 0.0 });
    Choice { considered, chosen, exact, probes: named.len() + random.len() }
}

/// Tables at several strides: their own estimate, and the difference to the tables at every speed, which shows peaks that were missed. A design whose own
/// estimate is too large is evaluated exactly, and paid for so.
fn tables<'s>(
    surrogate: &(dyn Fn(usize) -> Option<Surrogate<'s>> + Sync),
    strides: &[usize],
    probes: &[Mounted],
    tolerance: f64,
    exact: f64,
    stations: usize,
) -> Vec<Considered> {
    let peaks = |stride: usize| -> Option<Vec<(f64, f64, f64)>> {
        let surrogate = surrogate(stride)?;
        let one = |scratch: &mut Scratch, m: &Mounted| {
            let mut work = Work::default();
            let found = surrogate.peak(m, scratch, &mut work);
            (found.value, found.error, nominal(&work, stations))
        };
        Some(probes.par_iter().filter(|m| surrogate.takes(m)).map_init(Scratch::default, one).collect())
    };
    let Some(all) = peaks(1).filter(|all| !all.is_empty()) else { return Vec::new() };
    let considered = |stride: &usize| {
        let found = peaks(*stride)?;
        let (mut error, mut seconds) = (0.0, 0.0);
        for (own, full) in found.iter().zip(&all) {
            seconds += own.2;
            if own.1 > tolerance {
                seconds += exact;
                continue;
            }
            error = f64::max(error, own.1 + (own.0 / full.0 - 1.0).abs());
        }
        Some(Considered { strategy: Strategy::Tables(*stride), seconds: seconds / found.len() as f64, error })
    };
    strides.par_iter().filter_map(considered).collect()
}
