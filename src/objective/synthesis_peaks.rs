//! Peaks of the synthesis of all orders, or of what the crank makes of it: speeds that could win are synthesised, and the branches of the extremes over the cycle followed.

use super::local_maxima;
use super::measure::Over;
use super::peak::{Peak, Place};
use super::peak_search::{Found, LEVEL, PeakFinder};
use super::point_metric::PointMetric;
use super::speeds::Speeds;
use crate::absorber::Mounted;
use crate::numerics::maximise::maximise;
use crate::numerics::synthesis::{Extremes, bound, dominating};
use crate::numerics::{C64, ZERO};
use crate::response::{Quantity, ResponseError, Work};

/// Share of a peak within which other pairs of extremes in the cycle are followed.
const BRANCHES: f64 = 0.03;
/// The same round a narrow resonance: phases turn by half a cycle within its width, and other extremes take over.
const NARROW_BRANCHES: f64 = 0.1;
/// A maximum closer to a neighbouring speed than this share of the distance is none.
const EDGE: f64 = 1e-3;

impl PeakFinder<'_> {
    /// Values at the speeds that matter (the others stay at minus infinity), and the largest of them and of `best`.
    fn values(&self, metric: PointMetric, speeds: &Speeds, sweep: &[C64], (keep, best): (f64, f64), work: &mut Work) -> (Vec<f64>, f64) {
        let orders = self.system.orders();
        let sums: Vec<f64> = sweep.chunks(orders).map(bound).collect();
        // The sum of magnitudes bounds the synthesis at that speed, and most speeds need none. Between speeds a peak may rise further; how far
        // shows in the growth towards it.
        let rises: Vec<f64> = (0..sums.len()).map(|i| if self.refine { local_maxima::growth(&sums, i) } else { 1.0 }).collect();
        let bounds: Vec<f64> = (0..sums.len()).map(|i| metric.bound(speeds.rpm[i], sums[i] * rises[i])).collect();
        let mut values = vec![f64::NEG_INFINITY; bounds.len()];
        let mut top = best;
        let mut know = |i: usize, values: &mut Vec<f64>, wanted: f64, rise: f64| {
            work.syntheses += 1;
            let y = &sweep[i * orders..(i + 1) * orders];
            values[i] = metric.value_above(&self.synthesiser, speeds.rpm[i], y, (rise, wanted));
        };
        // the largest first: the others need less then
        let mut order: Vec<usize> = (0..bounds.len()).filter(|i| bounds[*i] > 0.0).collect();
        order.sort_unstable_by(|a, b| bounds[*b].total_cmp(&bounds[*a]).then(a.cmp(b)));
        for i in order {
            if bounds[i] < keep * top {
                break;
            }
            know(i, &mut values, keep * top, rises[i]);
            top = top.max(values[i]);
        }
        if self.refine {
            // estimates need both neighbours
            for c in local_maxima::maxima(&speeds.rpm, &values) {
                for j in [c.index.saturating_sub(1), (c.index + 1).min(values.len() - 1)] {
                    if values[j] == f64::NEG_INFINITY {
                        know(j, &mut values, 0.0, 1.0);
                    }
                }
            }
        }
        (values, top)
    }

    pub(super) fn synthesised(
        &self,
        design: &[Mounted],
        (quantity, over, metric): (Quantity, Over, PointMetric),
        (speeds, sweep): (&Speeds, &[C64]),
        found: &mut Found,
        work: &mut Work,
    ) -> Result<(), ResponseError> {
        let orders = self.system.orders();
        let (values, top) = self.values(metric, speeds, sweep, (found.keep, found.best), work);
        let mut y = vec![ZERO; orders];
        let at = |speed_rpm: f64, y: &mut [C64], work: &mut Work| -> Result<Extremes, ResponseError> {
            self.direct.at(design, quantity, speed_rpm, y, work)?;
            work.syntheses += 1;
            Ok(self.synthesiser.extremes(y))
        };
        for candidate in local_maxima::maxima(&speeds.rpm, &values) {
            let value_at = |speed: f64, work: &mut Work| at(speed, &mut y, work).map(|e| metric.value(speed, &e, &y));
            let Some((mut speed_rpm, place)) =
                self.refined((design, quantity), candidate, speeds, found.keep * found.best.max(top), value_at, work)?
            else {
                continue;
            };
            let mut extremes = at(speed_rpm, &mut y, work)?;
            let reach = (speeds.rpm[candidate.index.saturating_sub(2)], speeds.rpm[(candidate.index + 2).min(values.len() - 1)]);
            let followed = self.refine && !metric.asks_for_all();
            if followed && place == Place::Interior && speed_rpm == speeds.rpm[candidate.index] && !speeds.kink[candidate.index] {
                // nothing higher was met on either side: among several tops the search may have ended on a lower one. The branch itself has one
                let (up, value) = self.top_of_branch((design, quantity, metric), &extremes, reach, work)?;
                speed_rpm = if value > metric.value(speed_rpm, &extremes, &y) { up } else { speed_rpm };
                extremes = at(speed_rpm, &mut y, work)?;
            }
            let peak = |extremes: Extremes, speed_rpm, place, y: &[C64]| {
                let (order, order_value) = dominating(y);
                let (value, weight) = (metric.value(speed_rpm, &extremes, y), metric.weight(speed_rpm));
                Peak { value, weight, over, speed_rpm, order, order_value, quantity, extremes: Some(extremes), place }
            };
            found.put(peak(extremes, speed_rpm, place, &y));
            if !followed {
                continue;
            }
            // Other pairs of extremes in the cycle may peak nearby, as high or nearly so: each is a smooth function of its own.
            let share = if speeds.is_narrow(candidate.index) { NARROW_BRANCHES } else { (1.0 - found.keep).clamp(0.002, BRANCHES) };
            for start in self.synthesiser.alternatives(&y, share) {
                let top = self.top_of_branch((design, quantity, metric), &start, reach, work)?;
                // a branch may be held by the same end of the range
                let held = place == Place::End && {
                    let extremes = self.on_branch((design, quantity), &start, speed_rpm, &mut y, work)?;
                    metric.value(speed_rpm, &extremes, &y) >= top.1
                };
                let (at, place) = if held { (speed_rpm, Place::End) } else { (top.0, Place::Interior) };
                let margin = EDGE * (reach.1 - reach.0);
                if !held && !(reach.0 + margin..=reach.1 - margin).contains(&at) {
                    // it rises beyond the neighbours, and is no maximum here
                    continue;
                }
                let extremes = self.on_branch((design, quantity), &start, at, &mut y, work)?;
                // a smaller range round a higher mean may use more than the whole cycle does: it is no row of its own
                if metric.value(at, &extremes, &y) <= metric.value(at, &self.synthesiser.extremes(&y), &y) * (1.0 + LEVEL) {
                    found.put(peak(extremes, at, place, &y));
                }
            }
        }
        Ok(())
    }

    /// The extremes of the branch of `from` at a speed, and the phasors there.
    fn on_branch(
        &self,
        (design, quantity): (&[Mounted], Quantity),
        from: &Extremes,
        speed_rpm: f64,
        y: &mut [C64],
        work: &mut Work,
    ) -> Result<Extremes, ResponseError> {
        self.direct.at(design, quantity, speed_rpm, y, work)?;
        Ok(self.synthesiser.branch(y, from))
    }

    /// Speed and value of the maximum of a branch between two speeds.
    fn top_of_branch(
        &self,
        (design, quantity, metric): (&[Mounted], Quantity, PointMetric),
        from: &Extremes,
        (low, high): (f64, f64),
        work: &mut Work,
    ) -> Result<(f64, f64), ResponseError> {
        let mut y = vec![ZERO; self.system.orders()];
        let mut value = |speed: f64| self.on_branch((design, quantity), from, speed, &mut y, work).map(|e| metric.value(speed, &e, &y));
        if low < high { maximise(low, high, value) } else { Ok((low, value(low)?)) }
    }
}
