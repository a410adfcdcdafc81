//! Ranges of speed that a society's rule bars: round each critical speed at which a design breaks its limit.

use super::systems::engines_in;
use super::wanted::Wanted;
use crate::absorber::Mounted;
use crate::fatigue::shaft_rules::{HIGHEST_BARRED, barred};
use crate::objective::{Condition, PeakFinder, Place, holds};
use crate::response::{ResponseError, Work};

/// A barred range.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct BarredRange {
    /// Index of the limit.
    pub limit: usize,
    /// In which it is broken.
    pub condition: Condition,
    /// rpm.
    pub critical_rpm: f64,
    /// Stress there over the limit.
    pub ratio: f64,
    /// rpm.
    pub from_rpm: f64,
    /// rpm.
    pub to_rpm: f64,
    /// Whether the rule lets a range be barred there: none above 0.8 of the rated speed in normal firing.
    pub allowed: bool,
}

/// Critical speeds closer than this share are one.
const SAME: f64 = 1e-3;

/// Those of a design, of its limits by rules (`ratios`: each limited measure over its limit), in every condition that it is to hold in.
///
/// # Errors
/// [`ResponseError::Unbounded`] where nothing damps a resonance.
pub(crate) fn ranges(
    finders: &[PeakFinder],
    design: &[Mounted],
    wanted: &Wanted,
    ratios: &[f64],
) -> Result<Vec<BarredRange>, ResponseError> {
    let mut list: Vec<BarredRange> = Vec::new();
    for (index, (limit, ratio)) in wanted.limits.iter().zip(ratios).enumerate() {
        let Some(rated) = limit.rated_rpm.filter(|_| !holds(*ratio)) else { continue };
        for condition in wanted.held {
            for finder in engines_in(*condition, finders) {
                let mounted = condition.absorbers(design);
                for peak in finder.peaks(&mounted, &limit.of.measure, 1.0 / ratio, &mut Work::default())? {
                    let (own, critical_rpm) = (peak.value / limit.limit, peak.speed_rpm);
                    let known = |r: &&mut BarredRange| {
                        (r.limit, r.condition) == (index, *condition) && (r.critical_rpm / critical_rpm - 1.0).abs() < SAME
                    };
                    if holds(own) || peak.place != Place::Interior {
                        continue;
                    }
                    if let Some(known) = list.iter_mut().find(known) {
                        known.ratio = known.ratio.max(own);
                        continue;
                    }
                    let (from_rpm, to_rpm) = barred(critical_rpm, rated);
                    let allowed = *condition != Condition::Firing || to_rpm <= HIGHEST_BARRED * rated;
                    list.push(BarredRange { limit: index, condition: *condition, critical_rpm, ratio: own, from_rpm, to_rpm, allowed });
                }
            }
        }
    }
    list.sort_by(|a, b| a.limit.cmp(&b.limit).then(a.critical_rpm.total_cmp(&b.critical_rpm)));
    Ok(list)
}
