//! Ranges of speed that a society's rule bars: round each critical speed at which a design breaks its limit, as far as it is broken; and the largest stress by a rule.

use super::evaluation_plan::EvaluationPlan;
use super::systems::engines_in;
use crate::absorber::Mounted;
use crate::fatigue::shaft_rules::barred;
use crate::input::{LimitOfRule, LimitSpec};
use crate::objective::in_operation::absorbers;
use crate::objective::{AtExceptedSpeeds, Condition, Measure, Peak, PeakFinder, Place, Within, holds};
use crate::response::grid::is_same_speed;
use crate::response::{ResponseError, Work};

/// A barred range.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct BarredRange {
    /// Index of the limit.
    pub limit: usize,
    /// In which it is broken.
    pub condition: Condition,
    /// At which it is broken most, rpm.
    pub critical_rpm: f64,
    /// Stress there over the limit.
    pub ratio: f64,
    /// rpm.
    pub from_rpm: f64,
    /// rpm.
    pub to_rpm: f64,
    /// Why the rule does not let it be barred.
    pub objection: Option<Objection>,
    /// Whether the study excepts it: the limit is not judged there.
    pub excepted: bool,
}

/// Why a rule does not let a range be barred.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Objection {
    /// The stress in it is above that for passing through.
    Transient,
    /// It reaches above 0.8 of the rated speed in normal firing.
    TooHigh,
}

impl Objection {
    /// In words, behind "allowed".
    #[doc(hidden)]
    pub fn words(self) -> &'static str {
        match self {
            Self::Transient => "the stress in it is above that for passing through",
            Self::TooHigh => "it reaches above 0.8 of the rated speed",
        }
    }
}

impl BarredRange {
    fn absorb(&mut self, other: &Self) {
        if other.ratio > self.ratio {
            (self.ratio, self.critical_rpm) = (other.ratio, other.critical_rpm);
        }
        (self.from_rpm, self.to_rpm) = (self.from_rpm.min(other.from_rpm), self.to_rpm.max(other.to_rpm));
    }
}

/// A limit that is broken outside the ranges, too.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct StillBroken {
    /// Index of the limit.
    pub limit: usize,
    /// Stress over the limit, where it is largest.
    pub ratio: f64,
    /// rpm.
    pub speed_rpm: f64,
}

/// Where limits by rules are broken outside the barred ranges, at their worst: on the flank of a critical speed, at an end of the range, or where nothing resonates.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance.
pub(crate) fn still_broken(
    finders: &[PeakFinder],
    design: &[Mounted],
    wanted: &EvaluationPlan,
    ratios: &[f64],
    barred: &[BarredRange],
) -> Result<Vec<StillBroken>, ResponseError> {
    let mut list = Vec::new();
    for (index, (limit, _)) in wanted.limits.iter().zip(ratios).enumerate().filter(|(_, (l, r))| l.rule.is_some() && !holds(**r)) {
        let mut worst: Option<StillBroken> = None;
        for condition in wanted.judged_in(design) {
            for finder in engines_in(condition, finders) {
                let mut outside = limit.of.measure.clone();
                let own = barred.iter().filter(|b| (b.limit, b.condition) == (index, condition));
                outside.within.ranges = without(&outside.within.ranges, &finder.grid.speed_rpm, own);
                if outside.within.ranges.is_empty() {
                    continue;
                }
                let Some(peak) = finder.peak(&absorbers(condition, finder, design)?, &outside, &mut Work::default())? else { continue };
                let ratio = peak.value / limit.limit;
                if !holds(ratio) && worst.is_none_or(|w| ratio > w.ratio) {
                    worst = Some(StillBroken { limit: index, ratio, speed_rpm: peak.speed_rpm });
                }
            }
        }
        list.extend(worst);
    }
    Ok(list)
}

/// Ranges of speed (all of a grid where there are none) without barred ones.
fn without<'b>(ranges: &[(f64, f64)], speeds_rpm: &[f64], barred: impl Iterator<Item = &'b BarredRange>) -> Vec<(f64, f64)> {
    let whole = [(speeds_rpm[0], speeds_rpm[speeds_rpm.len() - 1])];
    let mut left = if ranges.is_empty() { whole.to_vec() } else { ranges.to_vec() };
    for b in barred {
        let parts = |(low, high): (f64, f64)| [(low, high.min(b.from_rpm)), (low.max(b.to_rpm), high)];
        left = left.into_iter().flat_map(parts).filter(|r| r.0 < r.1).collect();
    }
    left
}

/// Those of a design, of its limits by rules (`ratios`: each limited measure over its limit), in every condition that it is to hold in.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance.
pub(crate) fn ranges(
    finders: &[PeakFinder],
    design: &[Mounted],
    wanted: &EvaluationPlan,
    ratios: &[f64],
) -> Result<Vec<BarredRange>, ResponseError> {
    let mut list: Vec<BarredRange> = Vec::new();
    for (index, (limit, ratio)) in wanted.limits.iter().zip(ratios).enumerate() {
        let Some(rule) = limit.rule.as_ref().filter(|_| !holds(*ratio)) else { continue };
        for condition in wanted.judged_in(design) {
            for finder in engines_in(condition, finders) {
                let mounted = absorbers(condition, finder, design)?;
                let peaks = finder.peaks(&mounted, &limit.of.measure, 1.0 / ratio, &mut Work::default())?;
                let stress =
                    Measure { within: Within { factors: Vec::new(), ..limit.of.measure.within.clone() }, ..limit.of.measure.clone() };
                let tops = if peaks.is_empty() { Vec::new() } else { finder.peaks(&mounted, &stress, 0.0, &mut Work::default())? };
                for peak in &peaks {
                    let Some((critical_rpm, own)) = critical(limit, peak, (&peaks, &tops)) else { continue };
                    let (from_rpm, to_rpm) = extended(finder, &mounted, (limit, peak), barred(critical_rpm, rule.rated_rpm))?;
                    let mut range = BarredRange {
                        limit: index,
                        condition,
                        critical_rpm,
                        ratio: own,
                        from_rpm,
                        to_rpm,
                        objection: None,
                        excepted: false,
                    };
                    // ranges that meet are one, round the critical speed that breaks the limit most
                    list.retain(|r| {
                        let meets =
                            (r.limit, r.condition) == (index, condition) && r.from_rpm <= range.to_rpm && range.from_rpm <= r.to_rpm;
                        if meets {
                            range.absorb(r);
                        }
                        !meets
                    });
                    range.objection = objection(rule, &range);
                    list.push(range);
                }
            }
        }
    }
    list.sort_by(|a, b| a.limit.cmp(&b.limit).then(a.critical_rpm.total_cmp(&b.critical_rpm)));
    Ok(list)
}

/// The stress in a range that a study excepts over what the rule allows there, as searches hold it; zero where that is not judged.
pub(crate) fn over_allowed(limit: &LimitSpec, range: &BarredRange) -> f64 {
    let is_here = |e: &&AtExceptedSpeeds| e.measure.within.ranges.contains(&(range.from_rpm, range.to_rpm));
    let all = limit.to_limit().excepted;
    let here = all.iter().filter(is_here).filter(|e| range.condition.counts(e.in_service));
    here.map(|e| range.ratio * limit.limit / e.limit).fold(0.0, f64::max)
}

/// Why a rule does not let a range be barred, where it does not.
fn objection(rule: &LimitOfRule, range: &BarredRange) -> Option<Objection> {
    match () {
        () if rule.transient.is_some_and(|most| !holds(range.ratio / most)) => Some(Objection::Transient),
        () if range.condition.is_service() && rule.is_too_high(range.to_rpm) => Some(Objection::TooHigh),
        () => None,
    }
}

/// Ranges of speed that a study excepts from limits by rules, in every condition that a design is judged in: what is excepted is to be barred, and a rule does not let every range be.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance.
pub(crate) fn excepted(finders: &[PeakFinder], design: &[Mounted], wanted: &EvaluationPlan) -> Result<Vec<BarredRange>, ResponseError> {
    let mut list: Vec<BarredRange> = Vec::new();
    for (index, limit) in wanted.limits.iter().enumerate() {
        let Some(rule) = &limit.rule else { continue };
        for (from_rpm, to_rpm) in limit.excepted() {
            let there = limit.within(vec![(from_rpm, to_rpm)]);
            for condition in wanted.judged_in(design) {
                for finder in engines_in(condition, finders) {
                    let Some(peak) = finder.peak(&absorbers(condition, finder, design)?, &there, &mut Work::default())? else { continue };
                    let (critical_rpm, ratio) = (peak.speed_rpm, peak.value / limit.limit);
                    let mut range =
                        BarredRange { limit: index, condition, critical_rpm, ratio, from_rpm, to_rpm, objection: None, excepted: true };
                    let same = |r: &BarredRange| (r.limit, r.condition, r.from_rpm) == (index, condition, from_rpm);
                    if list.iter().any(|r| same(r) && r.ratio >= ratio) {
                        continue;
                    }
                    range.objection = objection(rule, &range).filter(|_| !holds(ratio));
                    list.retain(|r| !same(r));
                    list.push(range);
                }
            }
        }
    }
    Ok(list)
}

/// A top of the stress this near to a peak of stress over its limit, as a share of the speed, is the same resonance.
const NEAR: f64 = 0.02;

/// The critical speed that a peak of stress over its limit belongs to, rpm, and that ratio there; `None` where no order resonates or the limit holds. `tops`: of the stress itself.
///
/// Where the limit has a corner, the peak may be the corner's alone, on the flank of a critical speed that has a peak of its own, or beside the top of the stress, which then has none. Where the limit falls and rises
/// steeply, as that of cranks round their rated speed, the stress may have no top at all.
fn critical(limit: &LimitSpec, peak: &Peak, (all, tops): (&[Peak], &[Peak])) -> Option<(f64, f64)> {
    let (of, at) = (&limit.of.measure, peak.speed_rpm);
    if holds(peak.value / limit.limit) || peak.place != Place::Interior {
        return None;
    }
    let ratio = |top: &Peak| top.value * of.within.weight(top.speed_rpm) / limit.limit;
    let between = |top: &Peak| {
        let (low, high) = (at.min(top.speed_rpm), at.max(top.speed_rpm));
        all.iter().any(|p| (low..=high).contains(&p.speed_rpm) && !is_same_speed(p.speed_rpm, at))
    };
    let is_near = |top: &Peak| (top.speed_rpm / at - 1.0).abs() <= NEAR;
    let is_corner = of.within.kinks().any(|kink| is_same_speed(kink, at));
    let own = tops.iter().filter(|top| top.place == Place::Interior && (!holds(ratio(top)) || (!is_corner && is_near(top))));
    if !is_corner && own.clone().any(is_near) {
        return Some((at, peak.value / limit.limit));
    }
    let nearest = own.filter(|top| !between(top)).min_by(|a, b| (a.speed_rpm - at).abs().total_cmp(&(b.speed_rpm - at).abs()))?;
    if is_corner { Some((nearest.speed_rpm, ratio(nearest))) } else { Some((at, peak.value / limit.limit)) }
}

/// Between a speed at which a limit is broken and one at which it holds, the end of what is broken is found to this share.
const END: f64 = 1e-6;

/// A barred range, rpm, with what lies beside it and is broken, too (the width of the rule is taken as the least, an assumption): by the speeds of the grid, its ends found between two of them.
fn extended(
    finder: &PeakFinder,
    mounted: &[Mounted],
    (limit, peak): (&LimitSpec, &Peak),
    (from_rpm, to_rpm): (f64, f64),
) -> Result<(f64, f64), ResponseError> {
    let speeds = &finder.grid.speed_rpm;
    let within = &limit.of.measure.within.ranges;
    let (first, last) = (speeds[0], speeds[speeds.len() - 1]);
    let (first, last) = (within.first().map_or(first, |r| r.0), within.last().map_or(last, |r| r.1));
    let below: Vec<f64> = speeds.iter().rev().copied().filter(|s| *s < from_rpm && *s >= first).collect();
    let above: Vec<f64> = speeds.iter().copied().filter(|s| *s > to_rpm && *s <= last).collect();
    let is_broken = |speed_rpm: f64| -> Result<bool, ResponseError> {
        if !(first..=last).contains(&speed_rpm) {
            return Ok(false);
        }
        let there = Peak { speed_rpm, weight: limit.of.measure.within.weight(speed_rpm), ..*peak };
        let value = finder.at_least(mounted, (&limit.of.measure, &there), &mut Work::default())?;
        Ok(!holds(value / limit.limit))
    };
    let end = |end_rpm: f64, beyond: &[f64]| -> Result<f64, ResponseError> {
        let mut broken = end_rpm;
        if !is_broken(broken)? {
            return Ok(broken);
        }
        for speed in beyond {
            if is_broken(*speed)? {
                broken = *speed;
                continue;
            }
            let (mut inside, mut outside) = (broken, *speed);
            while (inside - outside).abs() > END * inside {
                let middle = 0.5 * (inside + outside);
                if is_broken(middle)? { inside = middle } else { outside = middle }
            }
            return Ok(outside);
        }
        Ok(broken)
    };
    Ok((end(from_rpm, &below)?, end(to_rpm, &above)?))
}

/// Where a design uses most of a limit by a rule.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct RuleStress {
    /// Index of the limit.
    pub limit: usize,
    /// In which that is.
    pub condition: Condition,
    /// Of a misfire the cylinder (from 0).
    pub cylinder: Option<usize>,
    /// rpm.
    pub speed_rpm: f64,
    /// Stress over the limit there.
    pub ratio: f64,
    /// The limit there over that at the rated speed.
    pub of_rated: f64,
}

/// The largest of each limit by a rule, over the conditions that the design is judged in.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance.
pub(crate) fn rule_stresses(finders: &[PeakFinder], design: &[Mounted], wanted: &EvaluationPlan) -> Result<Vec<RuleStress>, ResponseError> {
    let mut list = Vec::new();
    for (index, limit) in wanted.limits.iter().enumerate().filter(|l| l.1.rule.is_some()) {
        let (of, mut worst) = (&limit.of.measure, None);
        for condition in wanted.judged_in(design) {
            for finder in engines_in(condition, finders) {
                let Some(peak) = finder.peak(&absorbers(condition, finder, design)?, of, &mut Work::default())? else { continue };
                let (ratio, of_rated) = (peak.value / limit.limit, 1.0 / of.within.weight(peak.speed_rpm));
                let cylinder = finder.system.excitation.units.misfiring();
                let own = RuleStress { limit: index, condition, cylinder, speed_rpm: peak.speed_rpm, ratio, of_rated };
                worst = worst.filter(|w: &RuleStress| w.ratio >= ratio).or(Some(own));
            }
        }
        list.extend(worst);
    }
    Ok(list)
}
