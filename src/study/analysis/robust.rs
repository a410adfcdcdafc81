//! Designs within the tolerances of a study: the worst of the box, a percentile of random designs with its confidence interval, and the band of the response over speed.

use super::{DesignResult, Progress};
use crate::absorber::Deviation;
use crate::input::{LimitSpec, RobustSpec, Sampling, Study};
use crate::objective::{Measure, PeakFinder};
use crate::optimise::checkpoint::remembered;
use crate::optimise::proof::{WorstBound, worst_bound};
use crate::optimise::{LoadCase, Tolerances, robust};
use crate::response::{ResponseError, Work};
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use rayon::prelude::*;

/// A percentile of random designs.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Percentile {
    /// The value that so many per cent of the designs do not exceed.
    pub value: f64,
    /// Bounds of its 95 % confidence interval, by ranks: the number of designs below a percentile is binomial, taken as normal.
    pub between: (f64, f64),
}

/// The largest of a measure in the box, and where.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Worst {
    /// As drawn, in the unit of the measure; of a limit over it.
    pub nominal: f64,
    /// At its worst; infinite where nothing damps a resonance somewhere in the box.
    pub value: f64,
    /// Where.
    pub deviation: Deviation,
    /// What no combination within the tolerances is proved to be above.
    #[serde(default)]
    pub bound: Option<WorstBound>,
}

/// A design within the tolerances.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct RobustOfDesign {
    /// Its name.
    pub design: String,
    /// The study's objective, the largest over the conditions that an optimum is to hold in.
    pub worst: Worst,
    /// Of each limit.
    pub limits: Vec<Worst>,
    /// Of random designs.
    pub percentile: Option<Percentile>,
    /// Smallest and largest twist that the study reports at each of its speeds, over the corners of the box and as drawn, rad.
    pub band: Vec<(f64, f64)>,
}

/// Normal deviate of a 95 % interval.
const TWO_SIDED_95: f64 = 1.959_964;

/// Every design with a parameter that has a tolerance.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance as drawn, with the design.
#[doc(hidden)]
pub fn robust<'d>(
    study: &Study,
    (finder, cases): (&PeakFinder, &[LoadCase]),
    shown: &[&'d DesignResult],
    progress: &dyn Progress,
) -> Result<Vec<RobustOfDesign>, (&'d DesignResult, ResponseError)> {
    let Some(spec) = &study.robust else { return Ok(Vec::new()) };
    let seed = study.optimise.as_ref().map_or(1, |o| o.seed);
    progress.stage("tolerances", shown.len());
    let one = |d: &&'d DesignResult| {
        let tolerances = Tolerances::scattered_of(&d.absorbers, &spec.scatter());
        let sample_tolerances = || within(study, (finder, cases), d, (spec, &tolerances, seed));
        let found = (tolerances.edges() > 0).then(|| {
            remembered(
                progress.memory(),
                &("tolerances", &d.name, &d.absorbers, spec.prove.map(|e| (e.gap.to_bits(), e.boxes))),
                sample_tolerances,
            )
            .map_err(|error| (*d, error))
        });
        progress.step();
        found
    };
    shown.par_iter().filter_map(one).collect()
}

fn within(
    study: &Study,
    (finder, cases): (&PeakFinder, &[LoadCase]),
    d: &DesignResult,
    (spec, tolerances, seed): (&RobustSpec, &Tolerances, u64),
) -> Result<RobustOfDesign, ResponseError> {
    let objective = &study.objective.measure;
    let in_cases = |cases: &[LoadCase], measure: &Measure, unit: f64| -> Result<Worst, ResponseError> {
        let nominal = crate::optimise::largest(cases.iter(), &d.absorbers, measure, &mut Work::default())?;
        let (point, value) = tolerances.worst(|p| robust::deviated(cases, &d.absorbers, &tolerances.at(p), measure), seed);
        let bound = spec.prove.and_then(|effort| worst_bound(cases, &d.absorbers, tolerances, (measure, value), effort));
        let bound = bound.map(|b| WorstBound { value: b.value / unit, ..b });
        Ok(Worst { nominal: nominal / unit, value: value / unit, deviation: tolerances.at(&point).within(&d.absorbers), bound })
    };
    let worst = |measure: &Measure, unit: f64| in_cases(cases, measure, unit);
    let in_service: Vec<LoadCase> = cases.iter().filter(|c| c.condition.is_service()).copied().collect();
    let of_limit = |l: &LimitSpec| -> Result<Worst, ResponseError> {
        l.to_limit().excepted.iter().try_fold(worst(&l.of.measure, l.limit)?, |known, e| {
            let own = in_cases(if e.in_service { &in_service } else { cases }, &e.measure, e.limit)?;
            let nominal = known.nominal.max(own.nominal);
            let both = known.bound.zip(own.bound);
            let bound = both.map(|(a, b)| WorstBound { value: a.value.max(b.value), boxes: a.boxes + b.boxes });
            Ok(Worst { nominal, bound, ..if own.value > known.value { own } else { known } })
        })
    };
    Ok(RobustOfDesign {
        design: d.name.clone(),
        worst: worst(objective, 1.0)?,
        limits: study.limits.iter().map(of_limit).collect::<Result<_, _>>()?,
        percentile: spec.sampling.map(|s| percentile(cases, d, objective, (tolerances, s, seed))),
        band: band(study, finder, d, tolerances)?,
    })
}

fn percentile(
    cases: &[LoadCase],
    d: &DesignResult,
    objective: &Measure,
    (tolerances, s, seed): (&Tolerances, Sampling, u64),
) -> Percentile {
    let mut generator = Xoshiro256PlusPlus::seed_from_u64(seed);
    let points: Vec<Vec<f64>> = (0..s.samples).map(|_| tolerances.sample(s.normal, &mut generator)).collect();
    let value = |p: &Vec<f64>| robust::deviated(cases, &d.absorbers, &tolerances.at(p), objective);
    let mut values: Vec<f64> = points.par_iter().map(value).collect();
    values.sort_by(f64::total_cmp);
    let (n, share) = (s.samples as f64, s.percentile / 100.0);
    let half = TWO_SIDED_95 * (n * share * (1.0 - share)).sqrt();
    let value_at_rank = |rank: f64| values[(rank.ceil().max(1.0) as usize).min(values.len()) - 1];
    Percentile { value: value_at_rank(n * share), between: (value_at_rank(n * share - half), value_at_rank(n * share + half + 1.0)) }
}

fn band(study: &Study, finder: &PeakFinder, d: &DesignResult, tolerances: &Tolerances) -> Result<Vec<(f64, f64)>, ResponseError> {
    let mut band = vec![(f64::INFINITY, 0.0_f64); study.speeds_rpm.len()];
    let corners = tolerances.corners();
    for point in std::iter::once(vec![0.0; tolerances.edges()]).chain(corners) {
        let design = tolerances.at(&point).of(&d.absorbers);
        let phasors = finder.direct.at_each(&design, &[study.twist], &study.speeds_rpm, &mut Work::default())?.swap_remove(0);
        for (own, value) in band.iter_mut().zip(finder.synthesis(&phasors)) {
            *own = (own.0.min(value), own.1.max(value));
        }
    }
    Ok(band)
}
