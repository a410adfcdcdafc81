//! Means over the points of a duty.

use super::duty::DutyLoad;
use super::measure::{Measure, Over};
use super::peak::Peak;
use super::peak_search::PeakFinder;
use crate::absorber::Mounted;
use crate::numerics::synthesis::Extremes;
use crate::numerics::{C64, ZERO};
use crate::response::{Direct, Quantity, ResponseError, Work};

/// Share of a value within which other pairs of extremes in the cycle are rows of their own.
const BRANCHES: f64 = 0.05;

impl<'a> PeakFinder<'a> {
    fn at(&self, point: &'a DutyLoad) -> Direct<'a> {
        Direct::new(&point.system, self.grid)
    }

    /// The mean of a measure as its only peak: of several quantities the largest mean, of powers their sum; nothing without a duty.
    pub(super) fn mean(&self, design: &[Mounted], measure: &Measure, work: &mut Work) -> Result<Option<Peak>, ResponseError> {
        let Some(&first) = measure.quantities.first() else { return Ok(None) };
        let mut most = (0.0, first);
        if measure.over == Over::MeanPower {
            for point in self.duty {
                for ring in measure.absorbers() {
                    most.0 += point.share * self.at(point).dissipated_power(design, ring, point.speed_rpm, work)?;
                }
            }
        } else {
            for quantity in &measure.quantities {
                let mut mean = 0.0;
                for point in self.duty {
                    mean += point.share * self.extremes_at(design, *quantity, point, work)?.half_peak_to_peak;
                }
                most = if mean > most.0 { (mean, *quantity) } else { most };
            }
        }
        let (value, quantity) = most;
        Ok((value > 0.0).then(|| Peak::nowhere(value, measure.over, quantity)))
    }

    fn extremes_at(&self, design: &[Mounted], quantity: Quantity, point: &'a DutyLoad, work: &mut Work) -> Result<Extremes, ResponseError> {
        let mut y = vec![ZERO; point.system.orders()];
        self.at(point).at(design, quantity, point.speed_rpm, &mut y, work)?;
        work.syntheses += 1;
        Ok(self.synthesiser.extremes(&y))
    }

    /// Derivatives of a mean by the parameters of absorber `index`, at fixed angles in the cycle, where each value is stationary.
    pub(super) fn mean_gradient(
        &self,
        (design, index): (&[Mounted], usize),
        measure: &Measure,
        quantity: Quantity,
        work: &mut Work,
    ) -> Result<Vec<f64>, ResponseError> {
        let mut gradient: Vec<f64> = Vec::new();
        for point in self.duty {
            let direct = self.at(point);
            let own = if measure.over == Over::MeanPower {
                self.power_gradient(&direct, (design, index), measure, point.speed_rpm, work)?
            } else {
                let extremes = self.extremes_at(design, quantity, point, work)?;
                let changes = direct.sensitivity(design, index, quantity, 0..point.system.orders(), point.speed_rpm, work)?;
                self.along(&extremes, &changes)
            };
            gradient.resize(own.len(), 0.0);
            gradient.iter_mut().zip(own).for_each(|(sum, own)| *sum += point.share * own);
        }
        Ok(gradient)
    }

    /// The value at one point of the duty, and the branches of the extremes over the cycle that come near it: each is smooth, their largest is not.
    pub(super) fn at_duty(
        &self,
        design: &[Mounted],
        measure: &Measure,
        (point, keep): (usize, f64),
        work: &mut Work,
    ) -> Result<Vec<Peak>, ResponseError> {
        let (Some(at), Some(&quantity)) = (self.duty.get(point), measure.quantities.first()) else { return Ok(Vec::new()) };
        let mut y = vec![ZERO; at.system.orders()];
        self.at(at).at(design, quantity, at.speed_rpm, &mut y, work)?;
        work.syntheses += 1;
        let peak = |extremes: Extremes| {
            let nowhere = Peak::nowhere(extremes.half_peak_to_peak, measure.over, quantity);
            Peak { extremes: Some(extremes), ..nowhere }
        };
        let pairs = if keep < 1.0 { self.synthesiser.pairs(&y, (1.0 - keep).min(BRANCHES)) } else { vec![self.synthesiser.extremes(&y)] };
        let mut peaks: Vec<Peak> = pairs.into_iter().map(peak).collect();
        peaks.retain(|p| p.value > 0.0);
        Ok(peaks)
    }

    /// Derivatives of the same by the parameters of absorber `index`, at fixed angles in the cycle.
    pub(super) fn at_duty_gradient(
        &self,
        (design, index): (&[Mounted], usize),
        peak: &Peak,
        point: usize,
        work: &mut Work,
    ) -> Result<Vec<f64>, ResponseError> {
        let (Some(at), Some(extremes)) = (self.duty.get(point), &peak.extremes) else { return Ok(Vec::new()) };
        let changes = self.at(at).sensitivity(design, index, peak.quantity, 0..at.system.orders(), at.speed_rpm, work)?;
        Ok(self.along(extremes, &changes))
    }

    /// Derivatives of half the range of extremes by the changes of the orders.
    fn along(&self, extremes: &Extremes, changes: &[Vec<C64>]) -> Vec<f64> {
        let parameters = changes.first().map_or(0, Vec::len);
        let by_order: Vec<Vec<C64>> = (0..parameters).map(|p| changes.iter().map(|c| c[p]).collect()).collect();
        self.synthesiser.derivatives_of(extremes, by_order.iter().map(Vec::as_slice)).map(|d| d.0).collect()
    }
}
