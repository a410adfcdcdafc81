//! Peaks of single orders.

use super::local_maxima;
use super::measure::Measure;
use super::peak::Peak;
use super::peak_search::{LargestPeaks, PeakFinder};
use super::sharp_resonances::{RISE, resolved_values};
use super::speeds::Speeds;
use crate::absorber::Mounted;
use crate::response::{Quantity, Response, ResponseError, Work};
use std::ops::Range;

impl PeakFinder<'_> {
    /// Magnitudes of a quantity at all speeds and orders (speed by speed).
    pub(super) fn magnitudes(
        &self,
        design: &[Mounted],
        quantity: Quantity,
        speeds: &Speeds,
        work: &mut Work,
    ) -> Result<Vec<f64>, ResponseError> {
        let mut grid = Vec::new();
        self.method.squares(design, quantity, &mut grid, work)?;
        grid.iter_mut().for_each(|v| *v = v.sqrt());
        let added = self.direct.at_each(design, &[quantity], &speeds.added_rpm(), work)?.swap_remove(0);
        let added: Vec<f64> = added.iter().map(|y| y.norm()).collect();
        Ok(speeds.merge(grid, &added, self.system.orders()))
    }

    pub(super) fn single_orders(
        &self,
        design: &[Mounted],
        (quantity, measure, only): (Quantity, &Measure, Range<usize>),
        (speeds, sweep): (&Speeds, &[f64]),
        found: &mut LargestPeaks,
        work: &mut Work,
    ) -> Result<(), ResponseError> {
        let orders = self.system.orders();
        let weights: Vec<f64> = speeds.rpm.iter().map(|s| measure.within.weight(*s)).collect();
        let weighted = |order: usize| sweep.iter().skip(order).step_by(orders).zip(&weights).map(|(v, w)| v * w);
        let mut top = only.clone().flat_map(weighted).fold(found.best, f64::max);
        for order in only {
            let values: Vec<f64> = weighted(order).collect();
            let order_at = |speed: f64, work: &mut Work| self.direct.order_at(design, quantity, order, speed, work).map(|y| y.norm());
            let value_at = |speed: f64, work: &mut Work| order_at(speed, work).map(|y| y * measure.within.weight(speed));
            let wanted = found.keep * found.best.max(top);
            let rise = |i: usize, _: usize| RISE * values[i].max(values[i + 1]);
            let can_matter = (order..order + 1, |value| (1.0 + RISE) * value, rise);
            let finer = resolved_values((speeds, &values), wanted, can_matter, |speed| value_at(speed, work))?;
            let (speeds, values) = finer.as_ref().map_or((speeds, &values), |f| (&f.0, &f.1));
            top = values.iter().copied().fold(top, f64::max);
            for candidate in local_maxima::maxima(&speeds.rpm, values) {
                let wanted = found.keep * found.best.max(top);
                let Some((speed_rpm, place)) = self.refined((design, quantity), candidate, speeds, wanted, value_at, work)? else {
                    continue;
                };
                let (order_value, weight) = (order_at(speed_rpm, work)?, measure.within.weight(speed_rpm));
                let value = order_value * weight;
                found.put(Peak { value, weight, over: measure.over, speed_rpm, order, order_value, quantity, extremes: None, place });
            }
        }
        Ok(())
    }
}
