//! Peaks over speed of numbers that are smooth over speed: of statistics of the orders here, of powers by their own values.

use super::local_maxima;
use super::measure::{Measure, Over};
use super::peak::{Peak, Place};
use super::peak_search::{LargestPeaks, PeakFinder};
use super::sharp_resonances::{RISE, bend, resolved_values};
use super::speeds::Speeds;
use super::statistic::Statistic;
use crate::absorber::Mounted;
use crate::numerics::synthesis::dominating;
use crate::numerics::{C64, ZERO};
use crate::response::{Quantity, ResponseError, Work};

/// Below this share of the largest known value a maximum is not refined.
const LEAST_SHARE: f64 = 0.5;

impl PeakFinder<'_> {
    /// A statistic of a quantity at a speed, with the phasors.
    pub(super) fn statistic_at(
        &self,
        (design, quantity): (&[Mounted], Quantity),
        Statistic(row): Statistic,
        speed_rpm: f64,
        work: &mut Work,
    ) -> Result<(f64, Vec<C64>), ResponseError> {
        let mut y = vec![ZERO; self.system.orders()];
        self.direct.at(design, quantity, speed_rpm, &mut y, work)?;
        Ok(((row.value)(&y), y))
    }

    /// Local maxima of a statistic of a quantity on a part of the range.
    pub(super) fn statistics(
        &self,
        design: &[Mounted],
        (quantity, measure, statistic): (Quantity, &Measure, Statistic),
        (speeds, sweep): (&Speeds, &[C64]),
        found: &mut LargestPeaks,
        work: &mut Work,
    ) -> Result<(), ResponseError> {
        let orders = self.system.orders();
        let weight = |speed: f64| measure.within.weight(speed);
        let values: Vec<f64> = sweep.chunks(orders).zip(&speeds.rpm).map(|(y, speed)| (statistic.0.value)(y) * weight(*speed)).collect();
        let value_at = |speed: f64, work: &mut Work| Ok(self.statistic_at((design, quantity), statistic, speed, work)?.0 * weight(speed));
        // the number grows by no more than a magnitude does
        let rise = |i: usize, n: usize| {
            let y = |j: usize| sweep[j * orders + n];
            bend(&speeds.rpm, i, y).min(RISE * y(i).norm().max(y(i + 1).norm())) * weight(speeds.rpm[i])
        };
        let peak_at = |speed_rpm: f64, place, work: &mut Work| {
            let (value, y) = self.statistic_at((design, quantity), statistic, speed_rpm, work)?;
            let (order, order_value) = dominating(&y);
            let weight = weight(speed_rpm);
            let over = Over::Statistic(statistic);
            Ok(Peak { value: value * weight, weight, over, speed_rpm, order, order_value, quantity, extremes: None, place })
        };
        self.smooth_peaks((design, quantity), (speeds, &values), (LEAST_SHARE, (RISE, rise)), (value_at, peak_at), found, work)
    }

    /// Local maxima of what is smooth over speed, by its values at known speeds. `least`: below this share of the largest known value none is refined; `most`: the share by which all orders
    /// together may raise a value between two speeds; `rise`: by how much one of them may, from an index of a speed to the next.
    pub(super) fn smooth_peaks(
        &self,
        of: (&[Mounted], Quantity),
        (speeds, values): (&Speeds, &Vec<f64>),
        (least, (most, rise)): (f64, (f64, impl Fn(usize, usize) -> f64)),
        (value_at, peak_at): (
            impl Fn(f64, &mut Work) -> Result<f64, ResponseError> + Copy,
            impl Fn(f64, Place, &mut Work) -> Result<Peak, ResponseError>,
        ),
        found: &mut LargestPeaks,
        work: &mut Work,
    ) -> Result<(), ResponseError> {
        let wanted = found.keep * values.iter().copied().fold(found.best, f64::max);
        let can_matter = (0..self.system.orders(), |value| (1.0 + most) * value, rise);
        let finer = resolved_values((speeds, values), wanted, can_matter, |speed| value_at(speed, work))?;
        let (speeds, values) = finer.as_ref().map_or((speeds, values), |f| (&f.0, &f.1));
        let known = found.peaks.iter().map(|peak| peak.value).chain(values.iter().copied()).fold(0.0, f64::max);
        let top = known.max(found.best);
        for candidate in local_maxima::maxima(&speeds.rpm, values) {
            if candidate.value < least * found.keep * known {
                break;
            }
            let wanted = found.keep * found.best.max(top);
            let smooth = if self.refine && candidate.may_reach(wanted, speeds.is_narrow(candidate.index)) {
                local_maxima::smooth_top(candidate.index, speeds, values, |speed| value_at(speed, work))?
            } else {
                None
            };
            let peak = match smooth {
                Some(speed_rpm) => Some((speed_rpm, Place::Interior)),
                None => self.refined(of, candidate, speeds, wanted, value_at, work)?,
            };
            if let Some((speed_rpm, place)) = peak {
                found.put(peak_at(speed_rpm, place, work)?);
            }
        }
        Ok(())
    }

    /// Derivatives of a peak's value by the parameters of some absorbers, at its speed.
    pub(super) fn statistic_gradients(
        &self,
        (design, absorbers): (&[Mounted], &[usize]),
        statistic: Statistic,
        peak: &Peak,
        work: &mut Work,
    ) -> Result<Vec<Vec<f64>>, ResponseError> {
        let y = self.statistic_at((design, peak.quantity), statistic, peak.speed_rpm, work)?.1;
        let all = self.direct.sensitivities(design, absorbers, peak.quantity, 0..y.len(), peak.speed_rpm, work)?;
        let slopes: Vec<f64> = (0..y.len()).map(|n| peak.weight * (statistic.0.slope)(&y, n)).collect();
        let gradient_of = |changes: Vec<Vec<C64>>| {
            let mut gradient = vec![0.0; changes.first().map_or(0, Vec::len)];
            for ((y, slope), changes) in y.iter().zip(&slopes).zip(&changes) {
                gradient.iter_mut().zip(changes).for_each(|(g, d)| *g += slope * (y.conj() * d).re);
            }
            gradient
        };
        Ok(all.into_iter().map(gradient_of).collect())
    }
}
