//! Ranges of speed that a society's rule bars: round each critical speed at which a design breaks its limit.

use super::evaluation_plan::EvaluationPlan;
use super::systems::engines_in;
use crate::absorber::Mounted;
use crate::fatigue::shaft_rules::{HIGHEST_BARRED, barred};
use crate::input::LimitSpec;
use crate::objective::in_operation::absorbers;
use crate::objective::{Condition, Measure, Peak, PeakFinder, Place, Within, holds};
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
        let Some(rule) = limit.rule.filter(|_| !holds(*ratio)) else { continue };
        for condition in wanted.judged_in(design) {
            for finder in engines_in(condition, finders) {
                let mounted = absorbers(condition, finder, design)?;
                let peaks = finder.peaks(&mounted, &limit.of.measure, 1.0 / ratio, &mut Work::default())?;
                for peak in &peaks {
                    let Some((critical_rpm, own)) = critical(finder, &mounted, limit, (peak, &peaks))? else { continue };
                    let (from_rpm, to_rpm) = barred(critical_rpm, rule.rated_rpm);
                    let mut range = BarredRange { limit: index, condition, critical_rpm, ratio: own, from_rpm, to_rpm, objection: None };
                    // ranges that meet are one, round the critical speed that breaks the limit most
                    list.retain(|r| {
                        let meets =
                            (r.limit, r.condition) == (index, condition) && r.from_rpm <= range.to_rpm && range.from_rpm <= r.to_rpm;
                        if meets {
                            range.absorb(r);
                        }
                        !meets
                    });
                    let in_service = matches!(condition, Condition::Firing | Condition::InOperation);
                    range.objection = match () {
                        () if rule.transient.is_some_and(|most| range.ratio > most) => Some(Objection::Transient),
                        () if in_service && range.to_rpm > HIGHEST_BARRED * rule.rated_rpm => Some(Objection::TooHigh),
                        () => None,
                    };
                    list.push(range);
                }
            }
        }
    }
    list.sort_by(|a, b| a.limit.cmp(&b.limit).then(a.critical_rpm.total_cmp(&b.critical_rpm)));
    Ok(list)
}

/// The critical speed that a peak of stress over its limit belongs to, rpm, and that ratio there; nothing where no order resonates or the limit holds.
///
/// Where the limit has a corner, the peak may be the corner's alone, on the flank of a critical speed that has a peak of its own, or beside the top of the stress, which then has none.
fn critical(
    finder: &PeakFinder,
    mounted: &[Mounted],
    limit: &LimitSpec,
    (peak, all): (&Peak, &[Peak]),
) -> Result<Option<(f64, f64)>, ResponseError> {
    let (of, at) = (&limit.of.measure, peak.speed_rpm);
    if holds(peak.value / limit.limit) || peak.place != Place::Interior {
        return Ok(None);
    }
    if !of.within.kinks().any(|kink| is_same_speed(kink, at)) {
        return Ok(Some((at, peak.value / limit.limit)));
    }
    let stress = Measure { within: Within { factors: Vec::new(), ..of.within.clone() }, ..of.clone() };
    let ratio = |top: &Peak| top.value * of.within.weight(top.speed_rpm) / limit.limit;
    let between = |top: &Peak| {
        let (low, high) = (at.min(top.speed_rpm), at.max(top.speed_rpm));
        all.iter().any(|p| (low..=high).contains(&p.speed_rpm) && !is_same_speed(p.speed_rpm, at))
    };
    let tops = finder.peaks(mounted, &stress, 0.0, &mut Work::default())?;
    let own = tops.iter().filter(|top| top.place == Place::Interior && !holds(ratio(top)) && !between(top));
    let nearest = own.min_by(|a, b| (a.speed_rpm - at).abs().total_cmp(&(b.speed_rpm - at).abs()));
    Ok(nearest.map(|top| (top.speed_rpm, ratio(top))))
}
