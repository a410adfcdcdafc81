//! Designs with an absorber whose twist is not small, over speed: all steady motions that are found, which of them last, and the largest of those.

use super::large_twist_measures::{AtLargeTwist, Told, largest_from_rest, synthesiser};
use super::{DesignResult, Progress};
use crate::absorber::Mounted;
use crate::input::{LimitSpec, Study};
use crate::numerics::maximise::maximise;
use crate::numerics::synthesis::Synthesiser;
use crate::objective::{Measure, Over, PeakFinder};
use crate::optimise::checkpoint::remembered;
use crate::response::large_twist::{Balance, Curve, CurvePoint, Stability, Steady};
use crate::response::{ResponseError, Work};
use rayon::prelude::*;

/// A steady motion.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct LargePoint {
    /// rpm.
    pub speed_rpm: f64,
    /// Half peak-to-peak of the twist that the study reports, rad.
    pub twist: f64,
    /// Largest twist of the ring, from where it rests, rad.
    pub ring_twist: f64,
    /// Mean power that the absorber dissipates, W.
    pub power: f64,
    /// Whether it lasts; nothing where that cannot be told.
    pub stable: Option<bool>,
    /// Whether its speed is one of the study.
    pub asked: bool,
}

/// A design over speed.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
pub struct LargeTwistOfDesign {
    /// Its name.
    pub design: String,
    /// Index of the absorber.
    pub absorber: usize,
    /// Harmonics of the working cycle that were balanced.
    pub harmonics: usize,
    /// Relative change of the peak with twice as many.
    pub change: f64,
    /// Curves of motions that are connected over speed.
    pub curves: Vec<Vec<LargePoint>>,
    /// Whether every curve was followed to its ends.
    pub whole: bool,
    /// The largest twist of a motion that may last; nothing where there is none.
    pub peak: Option<LargePoint>,
    /// Objective and limits at its own amplitude.
    pub at_large_twist: AtLargeTwist,
    /// Where the absorber's travel ends, rad.
    pub travel: Option<f64>,
    /// Speeds of the study at which no steady motion is known, rpm: the design does not hold what is asked of it there.
    pub without_motion: Vec<f64>,
}

/// Harmonics that are balanced at least: those of a few orders make others.
const LEAST: usize = 8;
/// With twice the harmonics the peak may change by the tolerance of the study; else there are half as many again, so often at most.
const MOST_GROWTHS: usize = 4;
/// Halvings for the place where stability ends.
const HALVINGS: usize = 20;

/// Every design with an absorber whose law is one of large twist.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance of the chain, with the design.
#[doc(hidden)]
pub fn large_twist<'d>(
    study: &Study,
    finder: &PeakFinder,
    shown: &[&'d DesignResult],
    progress: &dyn Progress,
) -> Result<Vec<LargeTwistOfDesign>, (&'d DesignResult, ResponseError)> {
    let followed: Vec<&&DesignResult> = shown.iter().filter(|d| Balance::new(finder.system, &d.absorbers, &[], 1).is_some()).collect();
    if !followed.is_empty() {
        progress.stage("motions at their own amplitude", followed.len());
    }
    let one = |d: &&&'d DesignResult| {
        let follow_motions = || of_design(study, finder, (&d.name, &d.absorbers));
        let found = remembered(progress.memory(), &("large twist", &d.name, &d.absorbers), follow_motions)
            .map_err(|error| (**d, error))
            .transpose();
        progress.step();
        found
    };
    followed.par_iter().filter_map(one).collect()
}

/// Judges designs by the worse of small twist and of their own amplitude.
pub(crate) fn judge<'d>(designs: impl Iterator<Item = &'d mut DesignResult>, found: &[LargeTwistOfDesign], limits: &[LimitSpec]) {
    for design in designs {
        if let Some(own) = found.iter().find(|own| own.design == design.name) {
            own.at_large_twist.judge(design, limits);
        }
    }
}

/// A design; nothing where all its laws are of small twist.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance of the chain.
#[doc(hidden)]
pub fn of_design(
    study: &Study,
    finder: &PeakFinder,
    (name, design): (&str, &[Mounted]),
) -> Result<Option<LargeTwistOfDesign>, ResponseError> {
    let highest = finder.system.excitation.harmonics.iter().max().map_or(LEAST, |h| LEAST.max(*h as usize));
    let mut quantities = vec![study.twist];
    let Some(index) = Balance::new(finder.system, design, &[], 1).map(|b| b.index) else { return Ok(None) };
    let mut told = |measure| Told::new(measure, index, finder.system, &mut quantities);
    let objective = told(&study.objective.measure);
    let limits: Vec<Option<Told>> = study.limits.iter().map(|l| told(&l.of.measure)).collect();
    let balance = |harmonics| Balance::new(finder.system, design, &quantities, harmonics);
    let Some(mut own) = balance(highest) else { return Ok(None) };
    let range = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    let largest = finder.peak(design, &Measure::new(vec![study.twist], Over::Synthesis), &mut Work::default())?;
    let mut known = largest.map_or(Ok(None), |p| own.at(p.speed_rpm))?;
    for growth in 0.. {
        let Some(twice) = balance(2 * own.harmonics()) else { return Ok(None) };
        let more = || balance((3 * own.harmonics()).div_ceil(2));
        let (seen, finer_seen) = (Seen::new(&own), Seen::new(&twice));
        let change = |steady: &Steady| -> Result<f64, ResponseError> {
            let finer = own.refined(&twice, steady)?;
            Ok(finer.map_or(f64::INFINITY, |finer| (finer_seen.value(&finer) / seen.value(steady) - 1.0).abs()))
        };
        // a motion near the peak tells of too few harmonics before all are found
        if let Some(steady) = known.take()
            && growth < MOST_GROWTHS
            && change(&steady)? > study.tolerance
        {
            let Some(finer) = more() else { return Ok(None) };
            known = finer.at(steady.speed_rpm)?;
            own = finer;
            continue;
        }
        let curves = own.curves(&study.speeds_rpm, &mut Work::default())?;
        let points: Vec<Vec<LargePoint>> = curves.iter().map(|c| c.points.iter().map(|p| seen.point(p)).collect()).collect();
        let twist = |steady: &Steady| seen.value(steady);
        let peak = peak(&own, &curves, range, &twist, &|c, i| points[c][i].twist)?;
        let change = peak.as_ref().map_or(Ok(0.0), |peak| change(&peak.steady))?;
        if change > study.tolerance && growth < MOST_GROWTHS && curves.iter().all(|c| c.whole) {
            let Some(finer) = more() else { return Ok(None) };
            own = finer;
            continue;
        }
        let most = |told: &Told| -> Result<Option<f64>, ResponseError> {
            if told.is(study.twist) {
                return Ok(peak.as_ref().map(|peak| peak.value));
            }
            let value = |steady: &Steady| told.value(&seen.0, steady);
            Ok(self::peak(&own, &curves, range, &value, &|c, i| value(&curves[c].points[i].steady))?.map(|peak| peak.value))
        };
        let without_motion: Vec<f64> = study.speeds_rpm.iter().copied().filter(|s| !curves.iter().any(|c| reaches(c, *s))).collect();
        let over_limit = |(told, limit): (&Option<Told>, &LimitSpec)| -> Result<Option<f64>, ResponseError> {
            Ok(told.as_ref().map_or(Ok(None), &most)?.map(|value| value / limit.limit))
        };
        let at_large_twist = AtLargeTwist {
            alone: own.law.large_twist().is_some_and(|l| !l.counts_when_small()),
            has_motion: without_motion.is_empty(),
            objective: objective.as_ref().map_or(Ok(None), &most)?,
            limits: limits.iter().zip(&study.limits).map(over_limit).collect::<Result<_, _>>()?,
        };
        return Ok(Some(LargeTwistOfDesign {
            design: name.to_owned(),
            absorber: own.index,
            harmonics: own.harmonics(),
            change,
            whole: curves.iter().all(|c| c.whole),
            curves: points,
            peak: peak.map(|peak| seen.motion(&peak.steady, peak.stability, false)),
            at_large_twist,
            travel: own.law.large_twist().and_then(|l| l.largest_twist()),
            without_motion,
        }));
    }
    unreachable!("the last growth returns")
}

/// Whether a curve has a motion at a speed, at a point or between two that follow each other.
fn reaches(curve: &Curve, speed_rpm: f64) -> bool {
    let speed = |p: &CurvePoint| p.steady.speed_rpm;
    let between = |p: &[CurvePoint]| {
        let (a, b) = (speed(&p[0]), speed(&p[1]));
        (a.min(b)..=a.max(b)).contains(&speed_rpm)
    };
    curve.points.first().is_some_and(|p| speed(p) == speed_rpm) || curve.points.windows(2).any(between)
}

/// What is seen of a motion with so many harmonics.
struct Seen(Synthesiser);

impl Seen {
    fn new(balance: &Balance) -> Self {
        Self(synthesiser(balance))
    }

    fn value(&self, steady: &Steady) -> f64 {
        self.0.extremes(&steady.quantities[0]).half_peak_to_peak
    }

    fn point(&self, point: &CurvePoint) -> LargePoint {
        self.motion(&point.steady, point.stability, point.asked)
    }

    fn motion(&self, steady: &Steady, stability: Stability, asked: bool) -> LargePoint {
        let stable = match stability {
            Stability::Stable(_) => Some(true),
            Stability::Unstable(_) => Some(false),
            Stability::Unknown => None,
        };
        LargePoint {
            speed_rpm: steady.speed_rpm,
            twist: self.value(steady),
            ring_twist: largest_from_rest(&self.0, steady),
            power: steady.power,
            stable,
            asked,
        }
    }
}

/// The motion where a value is largest.
struct Peak {
    steady: Steady,
    stability: Stability,
    value: f64,
}

/// The largest value that may last: the best point, refined towards its neighbours, or to where stability ends. Values at the points of the curves are given.
fn peak(
    balance: &Balance,
    curves: &[Curve],
    range: (f64, f64),
    value: &dyn Fn(&Steady) -> f64,
    known: &dyn Fn(usize, usize) -> f64,
) -> Result<Option<Peak>, ResponseError> {
    let places = curves.iter().enumerate().flat_map(|(c, curve)| (0..curve.points.len()).map(move |i| (c, i)));
    let lasting = places.filter(|(c, i)| curves[*c].points[*i].stability.may_last()).map(|(c, i)| (c, i, known(c, i)));
    let Some((c, i, at)) = lasting.reduce(|m, p| if p.2 > m.2 { p } else { m }) else { return Ok(None) };
    let points = &curves[c].points;
    let mut best = Peak { steady: points[i].steady.clone(), stability: points[i].stability, value: at };
    for j in [i.checked_sub(1), Some(i + 1).filter(|j| *j < points.len())].into_iter().flatten() {
        let motion_at = |share: f64| balance.between(&curves[c], (i, j), share);
        let end = if points[j].stability.may_last() { 1.0 } else { end_of_stability(balance, &motion_at)? };
        let mut top: Option<(Steady, f64)> = None;
        maximise(0.0, end, |share| {
            let Some(found) = motion_at(share)?.filter(|f| (range.0..=range.1).contains(&f.speed_rpm)) else { return Ok(0.0) };
            let own = value(&found);
            if top.as_ref().is_none_or(|top| own > top.1) {
                top = Some((found, own));
            }
            Ok(own)
        })?;
        if let Some((steady, value)) = top.filter(|top| top.1 > best.value) {
            let stability = balance.stability(&steady);
            if stability.may_last() {
                best = Peak { steady, stability, value };
            }
        }
    }
    Ok(Some(best))
}

/// Share of the way to an unstable neighbour up to which motions last.
fn end_of_stability(balance: &Balance, at: &dyn Fn(f64) -> Result<Option<Steady>, ResponseError>) -> Result<f64, ResponseError> {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        match at(middle)? {
            Some(steady) if balance.stability(&steady).may_last() => low = middle,
            _ => high = middle,
        }
    }
    Ok(low)
}
