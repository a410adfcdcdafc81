//! Tolerances that a design is to hold within.

use super::absorbers::DesignSpec;
use super::family::Size;
use super::optimise::{OptimiseSpec, effort};
use crate::absorber::construction::shape;
use crate::absorber::parameter::RING_INERTIA;
use crate::absorber::{Declaration, Medium};
use crate::input::error::{At, Check};
use crate::input::measure::LimitSpec;
use crate::input::schema::bounds::{
    PERCENTILE, SAMPLES, SCATTER_OF_HARDNESS, SCATTER_OF_TEMPERATURE, SCATTER_OF_VISCOSITY, TOLERANCE, YIELD_PERCENT,
};
use crate::input::schema::robust::{HARDNESS, RawAllocate, RawDistribution, RawRobust, TEMPERATURE, VISCOSITY, process_keys};
use crate::optimise::{Effort, Scatter, Tolerances};

/// Tolerances of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct RobustSpec {
    /// Shares by which parameters may be larger or smaller, by their keys.
    pub shares: Vec<(&'static str, f64)>,
    /// What the making of dampers by their dimensions scatters.
    pub process: Vec<Scatter>,
    /// Whether optima within the tolerances are sought.
    pub search: bool,
    /// Random designs.
    pub sampling: Option<Sampling>,
    /// How closely worst cases are proved, where that is asked for.
    pub prove: Option<Effort>,
    /// Whether the tolerances that designs can bear are sought.
    pub allocate: Option<AllocateSpec>,
}

/// The tolerances that designs can bear.
#[derive(Debug, Clone, PartialEq)]
pub struct AllocateSpec {
    /// The share of random designs that is to hold all limits; without it all within the tolerances are.
    pub holding: Option<(f64, Sampling)>,
    /// What each of [`RobustSpec::scatter`] costs as wide as it is given; without it all keep their ratio.
    pub costs: Option<Vec<f64>>,
}

impl RobustSpec {
    /// All that scatters.
    pub fn scatter(&self) -> Vec<Scatter> {
        self.shares.iter().map(|(key, share)| Scatter::Share(key, *share)).chain(self.process.iter().copied()).collect()
    }
}

/// Random designs within the tolerances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sampling {
    /// Per cent of the designs that are to be better than the value reported.
    pub percentile: f64,
    /// Number of designs.
    pub samples: usize,
    /// Normal, the tolerance being three standard deviations beyond which nothing is delivered; else uniform.
    pub normal: bool,
}

/// Most parameters of one design with a tolerance: the box of deviations has two to that many corners.
const MOST_TOLERANCES: usize = 6;
/// Random designs on the shorter side of a percentile: the interval by ranks then lies among them.
const BEYOND: f64 = 10.0;

pub(super) fn resolve(
    check: &mut Check,
    raw: &At<RawRobust>,
    optimise: Option<&OptimiseSpec>,
    (designs, limits): (&[&DesignSpec], &[LimitSpec]),
) -> Option<RobustSpec> {
    let (place, raw) = (raw, raw.get_ref());
    let lists = types_of(optimise, designs);
    let types: Vec<&'static Declaration> = lists.iter().flatten().flatten().copied().collect();
    let mut shares = Vec::new();
    for (key, share) in raw.tolerance.iter().flat_map(|t| t.get_ref()) {
        let Some(known) = types.iter().flat_map(|t| t.parameters).map(|p| p.key).find(|known| known == key) else {
            let mut keys: Vec<&str> = types.iter().flat_map(|t| t.parameters).map(|p| p.key).collect();
            keys.sort_unstable();
            keys.dedup();
            let expected = if keys.is_empty() { "an absorber to have it".to_owned() } else { format!("one of {}", keys.join(", ")) };
            check.wrong(share, format!("found a tolerance of `{key}`, which no absorber here has, expected {expected}"));
            continue;
        };
        shares.push((known, check.within(share, &TOLERANCE)));
    }
    for empty in [&raw.tolerance, &raw.process].into_iter().flatten().filter(|t| t.get_ref().is_empty()) {
        check.wrong(empty, "found no tolerance, expected at least one parameter with its share");
    }
    if raw.tolerance.is_none() && raw.process.is_none() {
        check.wrong(place, "found [robust] without a tolerance, expected `tolerance` or `process`");
    }
    let process = process(check, raw, &types, &|key| least(key, optimise, designs));
    for (key, amount) in raw.process.iter().flat_map(|p| p.get_ref()).filter(|p| shares.iter().any(|s| s.0 == p.0)) {
        check.wrong(amount, format!("found `{key}` under `process` and `tolerance`, expected it under one of them"));
    }
    let scatters = |t: &&'static Declaration, s: &Scatter| {
        Tolerances::scattered(&[Some((t, None))], &[*s]).edges() > 0 || matches!(s, Scatter::Hardness(_) | Scatter::Temperature(_))
    };
    let of_type = |t: &&'static Declaration| {
        shares.iter().filter(|s| t.index(s.0).is_some()).count() + process.iter().filter(|s| scatters(t, s)).count()
    };
    let edges =
        |design: &Vec<Vec<&'static Declaration>>| design.iter().map(|types| types.iter().map(of_type).max().unwrap_or(0)).sum::<usize>();
    if let Some(most) = lists.iter().map(edges).max().filter(|most| *most > MOST_TOLERANCES) {
        check.wrong(
            place,
            format!(
                "found tolerances of {most} parameters of one design, expected at most {MOST_TOLERANCES}: all their corners are looked at"
            ),
        );
    }
    let sampling = raw.sampling.as_ref().map(|s| {
        let samples = check.whole(&s.samples, &SAMPLES);
        let percentile = check.within(&s.percentile, &PERCENTILE);
        let needed = (BEYOND / (0.01 * percentile.min(100.0 - percentile))).ceil() as i64;
        if (SAMPLES.low..needed).contains(s.samples.get_ref()) {
            check.wrong(
                &s.samples,
                format!("found {samples} designs for {percentile} per cent, expected at least {needed}: ten beyond the percentile, for a confidence interval with both ends"),
            );
        }
        Sampling { percentile, samples: samples as usize, normal: matches!(s.distribution, RawDistribution::Normal) }
    });
    let prove = raw.prove.as_ref().map(|prove| effort(check, (prove.get_ref().gap.as_ref(), prove.get_ref().boxes.as_ref())));
    let spec = RobustSpec { shares, process, search: raw.search.unwrap_or(true), sampling, prove, allocate: None };
    let allocate = raw.allocate.as_ref().and_then(|a| allocate(check, a, (&spec, limits)));
    (!spec.shares.is_empty() || !spec.process.is_empty()).then_some(RobustSpec { allocate, ..spec })
}

/// Key of one of the tolerances.
#[doc(hidden)]
pub fn scatter_key(s: &Scatter) -> &'static str {
    match s {
        Scatter::Share(key, _) | Scatter::Amount(key, _) => key,
        Scatter::Hardness(_) => HARDNESS,
        Scatter::Viscosity(_) => VISCOSITY,
        Scatter::Temperature(_) => TEMPERATURE,
    }
}

fn allocate(check: &mut Check, raw: &At<RawAllocate>, (spec, limits): (&RobustSpec, &[LimitSpec])) -> Option<AllocateSpec> {
    if limits.iter().all(|l| l.of.measure.is_inertia()) {
        check.wrong(
            raw,
            "found `allocate` without a limit, expected a [[constraint]] that is not on sizes and masses alone, for tolerances to hold",
        );
    }
    let keys: Vec<&str> = spec.scatter().iter().map(scatter_key).collect();
    let raw = raw.get_ref();
    let holding = raw.yield_percent.as_ref().and_then(|percent| {
        let share = 0.01 * check.within(percent, &YIELD_PERCENT);
        let Some(sampling) = spec.sampling else {
            check.wrong(percent, "found `yield_percent` without `sampling`, expected the random designs that it is a share of");
            return None;
        };
        let needed = (BEYOND / (1.0 - share)).ceil() as usize;
        if sampling.samples < needed {
            check.wrong(
                percent,
                format!(
                    "found {} random designs for {} per cent, expected at least {needed} in `sampling`: ten of them beyond",
                    sampling.samples,
                    percent.get_ref()
                ),
            );
        }
        Some((share, sampling))
    });
    let costs = raw.cost.as_ref().map(|costs| {
        for (key, cost) in costs.get_ref() {
            if !keys.contains(&key.as_str()) {
                check.wrong(cost, format!("found the cost of `{key}`, which has no tolerance here, expected one of {}", keys.join(", ")));
            }
        }
        let missing: Vec<&str> = keys.iter().copied().filter(|key| !costs.get_ref().contains_key(*key)).collect();
        if !missing.is_empty() {
            check.wrong(costs, format!("found no cost of {}, expected one for every tolerance", missing.join(", ")));
        }
        keys.iter().map(|key| costs.get_ref().get(*key).map_or(1.0, |c| check.positive(c))).collect()
    });
    Some(AllocateSpec { holding, costs })
}

/// The least that a dimension may be, of given designs and of bounds and steps; infinite where nothing has it.
fn least(key: &str, optimise: Option<&OptimiseSpec>, designs: &[&DesignSpec]) -> f64 {
    let given = designs.iter().flat_map(|d| &d.absorbers).filter_map(|m| m.absorber.value(key));
    let searched = optimise.into_iter().flat_map(|o| &o.absorbers).flat_map(|a| {
        let bounds = a.bounds.iter().filter(|b| b.0 == key).map(|b| b.1.0);
        let sizes = match &a.size {
            Size::Each(list) => list.iter().copied().fold(f64::INFINITY, f64::min),
            Size::Between(least, _) => *least,
        };
        let ring = (key == RING_INERTIA.key).then_some(sizes);
        bounds.chain(ring).chain(a.steps.iter().filter(|s| s.0 == key).flat_map(|s| s.1.iter().copied()))
    });
    given.chain(searched).fold(f64::INFINITY, f64::min)
}

/// What a process scatters; `least`: of a dimension by its key.
fn process(check: &mut Check, raw: &RawRobust, types: &[&'static Declaration], least: &dyn Fn(&str) -> f64) -> Vec<Scatter> {
    let mut list = Vec::new();
    for (key, amount) in raw.process.iter().flat_map(|p| p.get_ref()) {
        let known = process_keys().into_iter().find(|known| known == key);
        let has = |medium: Medium| types.iter().any(|t| shape(t).is_some_and(|s| s.medium == medium));
        let is_had = match key.as_str() {
            HARDNESS => has(Medium::Rubber),
            VISCOSITY => has(Medium::Oil),
            TEMPERATURE => has(Medium::Rubber) || has(Medium::Oil),
            _ => types.iter().any(|t| shape(t).zip(t.index(key)).is_some_and(|(s, i)| s.is_dimension(i))),
        };
        let Some(known) = known.filter(|_| is_had) else {
            let expected = process_keys().join(", ");
            check.wrong(
                amount,
                format!("found the scatter of `{key}`, which no absorber here has, expected that of a type by its dimensions: {expected}"),
            );
            continue;
        };
        list.push(match known {
            HARDNESS => Scatter::Hardness(check.within(amount, &SCATTER_OF_HARDNESS)),
            VISCOSITY => Scatter::Viscosity(0.01 * check.within(amount, &SCATTER_OF_VISCOSITY)),
            TEMPERATURE => Scatter::Temperature(check.within(amount, &SCATTER_OF_TEMPERATURE)),
            key => {
                let (own, least) = (check.positive(amount), least(key));
                if own >= least {
                    check.wrong(
                        amount,
                        format!("found a scatter of {own} of `{key}`, expected less than {least}, the least that it is drawn with"),
                    );
                }
                Scatter::Amount(key, own)
            }
        });
    }
    list
}

/// Types that each absorber may have, of every given design and of what is optimised.
fn types_of(optimise: Option<&OptimiseSpec>, designs: &[&DesignSpec]) -> Vec<Vec<Vec<&'static Declaration>>> {
    let given = |d: &&DesignSpec| d.absorbers.iter().map(|m| m.absorber.declaration().into_iter().collect()).collect();
    designs.iter().map(given).chain(optimise.map(|o| o.absorbers.iter().map(|a| a.types.clone()).collect())).collect()
}
