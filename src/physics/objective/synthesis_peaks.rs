//! Peaks of the synthesis of all orders, or of what the crank makes of it: speeds that could win are synthesised, and the branches of the extremes over the cycle followed.

use super::local_maxima::{self, Candidate};
use super::measure::Over;
use super::peak::{Peak, Place};
use super::peak_search::{LEVEL, LargestPeaks, PeakFinder};
use super::peak_tracking::{Branches, OnBranch, Peaked};
use super::point_metric::{Above, PointMetric};
use super::speeds::{SMOOTH, SMOOTH_OF_MARGINS, Speeds};
use crate::absorber::Mounted;
use crate::numerics::extremes::{Most, Precision};
use crate::numerics::lazy_extremes::Screen;
use crate::numerics::synthesis::{Extremes, bound, dominating};
use crate::numerics::{C64, ZERO, abs_sums};
use crate::response::{Quantity, ResponseError, Work};

/// Known speeds that bound their neighbours, this far off.
const NEAR: usize = 2;
/// Share of a peak within which other pairs of extremes in the cycle are followed.
const BRANCHES: f64 = 0.03;
/// Half the range of a sum of lines grows no faster than its lines are bent; the share of a crank's strength that is used grows with the mean, too.
const USED_PER_RANGE: f64 = 2.0;
/// The same round a narrow resonance: phases turn by half a cycle within its width, and other extremes take over.
const NARROW_BRANCHES: f64 = 0.1;

/// What is known at the speeds.
struct Screened {
    /// Sums of the magnitudes of orders, how far they may rise between speeds, and bounds of the values by both.
    sums: Vec<f64>,
    rises: Vec<f64>,
    bounds: Vec<f64>,
    /// Local maxima among the speeds that matter.
    candidates: Vec<Candidate>,
    /// Minus infinity at the other speeds, but for neighbours of candidates.
    values: Vec<f64>,
    /// No sum has wider extremes.
    most: Vec<Most>,
    /// The largest value, or what was known before.
    top: f64,
}

/// What is known at some speeds, with the index there of each of the speeds that are looked at now.
#[derive(Clone, Copy)]
struct Before<'k>(Option<(&'k Screened, &'k [Option<usize>])>);

impl<'k> Before<'k> {
    fn at(self, i: usize) -> Option<(&'k Screened, usize)> {
        self.0.and_then(|(known, indices)| indices[i].map(|j| (known, j)))
    }
}

impl PeakFinder<'_> {
    /// Sums of the magnitudes of orders, how far they may rise between speeds, and bounds of the values by both; rough ones where these are below `least`.
    fn bounds(&self, metric: PointMetric, (speeds, sweep): (&Speeds, &[C64]), before: Before, least: f64) -> [Vec<f64>; 3] {
        let orders = self.system.orders();
        let sum = |i: usize| before.at(i).map_or_else(|| bound(&sweep[i * orders..(i + 1) * orders]), |(known, j)| known.sums[j]);
        let sums: Vec<f64> = (0..speeds.rpm.len()).map(sum).collect();
        // The sum of magnitudes bounds the synthesis at that speed, and most speeds need none. Between speeds a peak may rise further; how far
        // shows in the growth towards it.
        let rises: Vec<f64> = (0..sums.len()).map(|i| if self.refine { local_maxima::growth(&sums, i) } else { 1.0 }).collect();
        let bound = |i: usize| {
            if let Some((known, j)) = before.at(i).filter(|(known, j)| known.rises[*j] == rises[i]) {
                return known.bounds[j];
            }
            let (speed_rpm, sum) = (speeds.rpm[i], sums[i] * rises[i]);
            let rough = metric.rough_bound(speed_rpm, sum);
            if rough < least { rough } else { metric.bound(speed_rpm, sum) }
        };
        let bounds = (0..sums.len()).map(bound).collect();
        [sums, rises, bounds]
    }

    /// Local maxima among the speeds that matter; `best`: the largest value known before.
    fn candidates(
        &self,
        metric: PointMetric,
        (speeds, sweep): (&Speeds, &[C64]),
        before: Before,
        (keep, best): (f64, f64),
        work: &mut Work,
    ) -> Screened {
        let orders = self.system.orders();
        let phasors = |i: usize| &sweep[i * orders..(i + 1) * orders];
        let [sums, rises, bounds] = self.bounds(metric, (speeds, sweep), before, keep * best);
        // what is refined is found to rounding between the speeds
        let mut screen = Screen::new(&self.synthesiser, if self.refine { Precision::Millionth } else { Precision::Rounding });
        let mut know = |i: usize, (rise, wanted): (f64, f64)| {
            if let Some((known, j)) = before.at(i) {
                let (value, most) = (known.values[j], known.most[j]);
                if !metric.may_reach(speeds.rpm[i], (most.half_peak_to_peak * rise, most.middle * rise), wanted) {
                    return Above { value: f64::NEG_INFINITY, most };
                }
                if value > f64::NEG_INFINITY {
                    return Above { value, most };
                }
            }
            work.syntheses += 1;
            metric.value_above(&mut screen, speeds.rpm[i], phasors(i), (rise, wanted))
        };
        // what is known of a neighbour bounds a sum, too: by no more than their terms differ
        let mut most: Vec<Option<Most>> = vec![None; bounds.len()];
        let by_neighbour = |i: usize, most: &[Option<Most>], wanted: f64| {
            let near = (1..=NEAR).flat_map(|d| [i.checked_sub(d), Some(i + d)]).flatten();
            let (j, known) = near.filter_map(|j| Some((j, most.get(j).copied().flatten()?))).next()?;
            let change = abs_sums::of_difference(phasors(i), phasors(j));
            let own = Most { half_peak_to_peak: known.half_peak_to_peak + change, middle: known.middle + change };
            let able = metric.may_reach(speeds.rpm[i], (own.half_peak_to_peak * rises[i], own.middle * rises[i]), wanted);
            (!able).then_some(own)
        };
        let (mut values, mut top) = (vec![f64::NEG_INFINITY; bounds.len()], best);
        // the largest first: the others need less then
        let by_bound = |a: &usize, b: &usize| bounds[*b].total_cmp(&bounds[*a]).then(a.cmp(b));
        let first = (0..bounds.len()).filter(|i| bounds[*i] > 0.0).min_by(by_bound);
        let mut order: Vec<usize> = Vec::new();
        if let Some(i) = first.filter(|i| bounds[*i] >= keep * top) {
            let known = know(i, (rises[i], keep * top));
            (values[i], most[i], top) = (known.value, Some(known.most), top.max(known.value));
            order.extend((0..bounds.len()).filter(|j| *j != i && bounds[*j] > 0.0 && bounds[*j] >= keep * top));
            order.sort_unstable_by(by_bound);
        }
        for i in order {
            let wanted = keep * top;
            if bounds[i] < wanted {
                break;
            }
            most[i] = by_neighbour(i, &most, wanted).or_else(|| {
                let known = know(i, (rises[i], wanted));
                values[i] = known.value;
                Some(known.most)
            });
            top = top.max(values[i]);
        }
        let mut candidates = local_maxima::maxima(&speeds.rpm, &values);
        if self.refine {
            // estimates need both neighbours, which are no candidates for that
            for i in candidates.iter().map(|c| c.index) {
                for j in [i.saturating_sub(1), (i + 1).min(values.len() - 1)] {
                    if values[j] == f64::NEG_INFINITY {
                        values[j] = know(j, (1.0, 0.0)).value;
                    }
                }
            }
            let mattered: Vec<usize> = candidates.iter().map(|c| c.index).collect();
            candidates = local_maxima::maxima(&speeds.rpm, &values);
            candidates.retain(|c| mattered.contains(&c.index));
        }
        let most = most.into_iter().zip(&sums).map(|(m, sum)| m.unwrap_or(Most { half_peak_to_peak: *sum, middle: *sum })).collect();
        Screened { sums, rises, bounds, candidates, values, most, top }
    }

    /// Whether the value may reach `wanted` between a known speed and the next where the phasors of the sum are off straight lines by no more than `bend`, together.
    fn may_reach(metric: PointMetric, speeds: &Speeds, known: &Screened, (i, bend): (usize, f64), wanted: f64) -> bool {
        let able = |j: usize| {
            let Most { half_peak_to_peak, middle } = known.most[j];
            if known.values[j] > f64::NEG_INFINITY {
                known.values[j] * (1.0 + USED_PER_RANGE * bend / half_peak_to_peak.max(f64::MIN_POSITIVE)) >= wanted
            } else {
                metric.may_reach(speeds.rpm[j], (half_peak_to_peak + bend, middle + bend), wanted)
            }
        };
        able(i) || able(i + 1)
    }

    pub(super) fn synthesised(
        &self,
        design: &[Mounted],
        (quantity, over, metric): (Quantity, Over, PointMetric),
        (speeds, sweep): (&Speeds, &[C64]),
        found: &mut LargestPeaks,
        work: &mut Work,
    ) -> Result<(), ResponseError> {
        let mut known = self.candidates(metric, (speeds, sweep), Before(None), (found.keep, found.best), work);
        let wanted = found.keep * found.best.max(known.top);
        let can_matter = |i: usize, bend: f64| Self::may_reach(metric, speeds, &known, (i, bend), wanted);
        let widest = |i: usize| known.most[i].half_peak_to_peak;
        let (smooth, is_quick) = if matches!(over, Over::Margin(_)) { (SMOOTH_OF_MARGINS, false) } else { (SMOOTH, true) };
        let finer = if known.top > 0.0 {
            self.resolved(design, quantity, (speeds, sweep), (smooth, is_quick), (widest, can_matter), work)?
        } else {
            None
        };
        if let Some(finer) = &finer {
            let before = Before(Some((&known, finer.known.as_slice())));
            known = self.candidates(metric, (&finer.speeds, &finer.sweep), before, (found.keep, found.best), work);
        }
        let (speeds, sweep) = finer.as_ref().map_or((speeds, sweep), |finer| (&finer.speeds, &finer.sweep));
        let Screened { candidates, values, top, .. } = known;
        let branches = Branches { finder: self, design, quantity, metric, speeds, sweep };
        let followed = self.refine && !metric.asks_for_all();
        let mut y = vec![ZERO; self.system.orders()];
        for candidate in candidates {
            let wanted = found.keep * found.best.max(top);
            let narrow = speeds.is_narrow(candidate.index);
            if followed && !candidate.may_reach(wanted, narrow) {
                continue;
            }
            let share = if narrow { NARROW_BRANCHES } else { BRANCHES };
            let quick = if followed { branches.peak(candidate.index, share, &mut y, work)? } else { None };
            let Some((speed_rpm, place, pairs)) = (match quick {
                Some(peak) => Some(peak),
                None => {
                    let candidate = exactly(&branches, candidate, &values, work);
                    self.searched(&branches, candidate, (followed.then_some(share), wanted), &mut y, work)?
                }
            }) else {
                continue;
            };
            let peak = |extremes: Extremes, speed_rpm, place, y: &[C64]| {
                let (order, order_value) = dominating(y);
                let (value, weight) = (metric.value(speed_rpm, &extremes, y), metric.weight(speed_rpm));
                Peak { value, weight, over, speed_rpm, order, order_value, quantity, extremes: Some(extremes), place }
            };
            let mut pairs = pairs.into_iter();
            found.put(peak(pairs.next().unwrap_or_default(), speed_rpm, place, &y));
            // Other pairs of extremes in the cycle may peak nearby, as high or nearly so: each is a smooth function of its own.
            for start in pairs {
                let Some((top, place)) = branches.other(candidate.index, &start, ((speed_rpm, place), wanted), &mut y, work)? else {
                    continue;
                };
                let OnBranch { speed_rpm: at, value, extremes } = top;
                // a smaller range round a higher mean may use more than the whole cycle does: it is no row of its own
                if value <= metric.value(at, &self.synthesiser.extremes(&y), &y) * (1.0 + LEVEL) {
                    found.put(peak(extremes, at, place, &y));
                }
            }
        }
        Ok(())
    }

    /// Where a peak of the largest of all branches lies, the pairs of extremes there and the phasors, by search of the speeds beside a candidate; nothing where it cannot reach
    /// `wanted`. `share`: of pairs that are asked for besides the largest.
    fn searched(
        &self,
        branches: &Branches,
        candidate: Candidate,
        (share, wanted): (Option<f64>, f64),
        y: &mut [C64],
        work: &mut Work,
    ) -> Result<Option<Peaked>, ResponseError> {
        let Branches { design, quantity, metric, speeds, .. } = *branches;
        let extremes_at = |speed_rpm: f64, y: &mut [C64], work: &mut Work| -> Result<Extremes, ResponseError> {
            self.direct.at(design, quantity, speed_rpm, y, work)?;
            work.syntheses += 1;
            Ok(self.synthesiser.extremes(y))
        };
        let value_at = |speed: f64, work: &mut Work| extremes_at(speed, y, work).map(|e| metric.value(speed, &e, y));
        let Some((mut speed_rpm, place)) = self.refined((design, quantity), candidate, speeds, wanted, value_at, work)? else {
            return Ok(None);
        };
        let mut extremes = extremes_at(speed_rpm, y, work)?;
        if share.is_some() && place == Place::Interior && speed_rpm == speeds.rpm[candidate.index] && !speeds.kink[candidate.index] {
            // nothing higher was met on either side: among several tops the search may have ended on a lower one. The branch itself has one
            let (up, value) = branches.searched_top(candidate.index, &extremes, y, work)?;
            speed_rpm = if value > metric.value(speed_rpm, &extremes, y) { up } else { speed_rpm };
            extremes = extremes_at(speed_rpm, y, work)?;
        }
        let pairs = share.map_or_else(|| vec![extremes], |share| self.synthesiser.pairs(y, share));
        Ok(Some((speed_rpm, place, pairs)))
    }
}

/// A candidate by values to rounding, at a neighbour where that is higher.
fn exactly(branches: &Branches, candidate: Candidate, values: &[f64], work: &mut Work) -> Candidate {
    if !branches.finder.refine || branches.metric.asks_for_all() {
        return candidate;
    }
    let mut values = values.to_vec();
    let mut known = std::collections::HashSet::new();
    let mut i = candidate.index;
    loop {
        let near = i.saturating_sub(1)..=(i + 1).min(values.len() - 1);
        for j in near.clone() {
            if known.insert(j) {
                values[j] = branches.largest(j, work);
            }
        }
        let higher = near.fold(i, |m, j| if values[j] > values[m] { j } else { m });
        if higher == i {
            return Candidate::of(&branches.speeds.rpm, &values, i);
        }
        i = higher;
    }
}
