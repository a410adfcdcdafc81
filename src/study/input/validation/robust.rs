//! Tolerances that a design is to hold within.

use super::absorbers::DesignSpec;
use super::optimise::OptimiseSpec;
use crate::absorber::construction::shape;
use crate::absorber::{Declaration, Sheared};
use crate::input::error::{At, Check};
use crate::input::schema::robust::{HARDNESS, RawDistribution, RawRobust, VISCOSITY, process_keys};
use crate::optimise::{Scatter, Tolerances};

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
const MOST_SAMPLES: i64 = 1_000_000;
/// Random designs on the shorter side of a percentile: the interval by ranks then lies among them.
const BEYOND: f64 = 10.0;

pub(super) fn resolve(
    check: &mut Check,
    raw: &At<RawRobust>,
    optimise: Option<&OptimiseSpec>,
    designs: &[&DesignSpec],
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
        shares.push((known, check.within(share, 1e-6..=0.9, "a share from 1e-6 to 0.9: 0.1 is 10 % more or less")));
    }
    for empty in [&raw.tolerance, &raw.process].into_iter().flatten().filter(|t| t.get_ref().is_empty()) {
        check.wrong(empty, "found no tolerance, expected at least one parameter with its share");
    }
    if raw.tolerance.is_none() && raw.process.is_none() {
        check.wrong(place, "found [robust] without a tolerance, expected `tolerance` or `process`");
    }
    let process = process(check, raw, &types);
    let scatters = |t: &&'static Declaration, s: &Scatter| {
        Tolerances::scattered(&[Some((t, None))], &[*s]).edges() > 0 || matches!(s, Scatter::Hardness(_))
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
        let samples = *s.samples.get_ref();
        if !(100..=MOST_SAMPLES).contains(&samples) {
            check.wrong(&s.samples, format!("found {samples}, expected a whole number of designs from 100 to {MOST_SAMPLES}"));
        }
        let percentile = check.within(&s.percentile, 1.0..=99.9, "per cent of the designs from 1 to 99.9");
        let needed = (BEYOND / (0.01 * percentile.min(100.0 - percentile))).ceil() as i64;
        if (100..needed).contains(&samples) {
            check.wrong(
                &s.samples,
                format!("found {samples} designs for {percentile} per cent, expected at least {needed}: ten beyond the percentile, for a confidence interval with both ends"),
            );
        }
        Sampling {
            percentile,
            samples: samples.clamp(1, MOST_SAMPLES) as usize,
            normal: matches!(s.distribution, RawDistribution::Normal),
        }
    });
    (!shares.is_empty() || !process.is_empty()).then_some(RobustSpec { shares, process, search: raw.search.unwrap_or(true), sampling })
}

/// What a process scatters.
fn process(check: &mut Check, raw: &RawRobust, types: &[&'static Declaration]) -> Vec<Scatter> {
    let mut list = Vec::new();
    for (key, amount) in raw.process.iter().flat_map(|p| p.get_ref()) {
        let known = process_keys().into_iter().find(|known| known == key);
        let has = |kind: Sheared| types.iter().any(|t| shape(t).is_some_and(|s| s.sheared == kind));
        let is_had = match key.as_str() {
            HARDNESS => has(Sheared::Rubber),
            VISCOSITY => has(Sheared::Oil),
            _ => types.iter().any(|t| shape(t).zip(t.index(key)).is_some_and(|(s, i)| !s.material().contains(&i))),
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
            HARDNESS => Scatter::Hardness(check.within(amount, 0.1..=20.0, "a hardness from 0.1 to 20 Shore A")),
            VISCOSITY => Scatter::Viscosity(0.01 * check.within(amount, 0.1..=90.0, "a share from 0.1 to 90 %")),
            key => Scatter::Amount(key, check.positive(amount)),
        });
    }
    list
}

/// Types that each absorber may have, of every given design and of what is optimised.
fn types_of(optimise: Option<&OptimiseSpec>, designs: &[&DesignSpec]) -> Vec<Vec<Vec<&'static Declaration>>> {
    let given = |d: &&DesignSpec| d.absorbers.iter().map(|m| m.absorber.declaration().into_iter().collect()).collect();
    designs.iter().map(given).chain(optimise.map(|o| o.absorbers.iter().map(|a| a.types.clone()).collect())).collect()
}
