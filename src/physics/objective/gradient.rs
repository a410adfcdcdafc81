//! Derivatives of peaks with respect to the parameters of an absorber.

use super::measure::{Measure, Over};
use super::peak::Peak;
use super::peak_search::PeakFinder;
use super::point_metric::{DIFFERENCE, PointMetric};
use crate::absorber::Mounted;
use crate::numerics::maximise::maximise;
use crate::numerics::{C64, ZERO};
use crate::response::{ResponseError, Work};

/// Speeds beside a peak on a ridge, a share of its own, within which it is found again for a slightly other design.
const BESIDE: f64 = 1e-3;
/// That other design is this many times as far away as where nothing has to be found again.
const FARTHER: f64 = 30.0;

/// Absorber by absorber.
fn each(absorbers: &[usize], of: impl FnMut(usize) -> Result<Vec<f64>, ResponseError>) -> Result<Vec<Vec<f64>>, ResponseError> {
    absorbers.iter().copied().map(of).collect()
}

impl PeakFinder<'_> {
    /// Derivatives of a peak's value with respect to the parameters of absorber `index`, ring inertia first. At fixed speed and cycle angles they are exact, because a
    /// peak is stationary in both (or held by an end of the range); of a multiaxial margin by differences. Dang Van's sums have peaks on ridges over speed, which move
    /// with the design: those are found again.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance.
    pub fn gradient(
        &self,
        design: &[Mounted],
        index: usize,
        measure: &Measure,
        peak: &Peak,
        work: &mut Work,
    ) -> Result<Vec<f64>, ResponseError> {
        Ok(self.gradients(design, &[index], measure, peak, work)?.swap_remove(index))
    }

    /// The same for some absorbers, by absorber; nothing for the others.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance.
    pub(crate) fn gradients(
        &self,
        design: &[Mounted],
        absorbers: &[usize],
        measure: &Measure,
        peak: &Peak,
        work: &mut Work,
    ) -> Result<Vec<Vec<f64>>, ResponseError> {
        let list = match peak.over {
            Over::Synthesis | Over::Margin(_) => self.synthesis_gradients((design, absorbers), measure, peak, work)?,
            Over::Power => {
                let mut list = self.power_gradients(&self.direct, (design, absorbers), measure, peak.speed_rpm, work)?;
                list.iter_mut().flatten().for_each(|g| *g *= peak.weight);
                list
            }
            Over::Strain | Over::SpringStress => self.strain_gradients((design, absorbers), measure, peak, work)?,
            Over::Orders | Over::Order(_) => each(absorbers, |index| self.order_gradient((design, index), peak, work))?,
            Over::Statistic(statistic) => self.statistic_gradients((design, absorbers), statistic, peak, work)?,
            Over::Temperature => each(absorbers, |index| self.temperature_gradient((design, index), measure, peak, work))?,
            Over::AtDuty(point) => each(absorbers, |index| self.at_duty_gradient((design, index), peak, point, work))?,
            Over::Mean | Over::MeanPower => each(absorbers, |index| self.mean_gradient((design, index), measure, peak.quantity, work))?,
            Over::Damage => each(absorbers, |index| self.damage_gradient((design, index), peak.quantity, work))?,
            Over::Property(property) => each(absorbers, |index| Ok(self.property_gradient(design, index, measure, property)))?,
        };
        let mut by_absorber = vec![Vec::new(); design.len()];
        absorbers.iter().zip(list).for_each(|(index, own)| by_absorber[*index] = own);
        Ok(by_absorber)
    }

    fn order_gradient(&self, (design, index): (&[Mounted], usize), peak: &Peak, work: &mut Work) -> Result<Vec<f64>, ResponseError> {
        let y = self.direct.order_at(design, peak.quantity, peak.order, peak.speed_rpm, work)?;
        let change = self.direct.sensitivity(design, index, peak.quantity, peak.order..peak.order + 1, peak.speed_rpm, work)?;
        Ok(change[0].iter().map(|d| peak.weight * (y.conj() * d).re / y.norm()).collect())
    }

    fn synthesis_gradients(
        &self,
        (design, absorbers): (&[Mounted], &[usize]),
        measure: &Measure,
        peak: &Peak,
        work: &mut Work,
    ) -> Result<Vec<Vec<f64>>, ResponseError> {
        let Some(extremes) = &peak.extremes else { return Ok(vec![Vec::new(); absorbers.len()]) };
        let metric = PointMetric::of(peak.over, peak.quantity, &measure.within, self.margin, None);
        if metric.has_ridges() {
            return absorbers.iter().map(|index| self.gradient_on_ridge((design, *index), peak, metric, work)).collect();
        }
        let mut phasors = vec![ZERO; self.system.orders()];
        if metric.asks_for_all() {
            self.direct.at(design, peak.quantity, peak.speed_rpm, &mut phasors, work)?;
        }
        let changes = self.changes((design, absorbers), peak, peak.speed_rpm, work)?;
        let derivatives = |own: &Vec<Vec<C64>>| metric.derivatives(&self.synthesiser, peak.speed_rpm, (extremes, &phasors), own);
        Ok(changes.iter().map(derivatives).collect())
    }

    /// Derivatives of the phasors of a peak's quantity at a speed: by absorber, by each of its values.
    fn changes(
        &self,
        (design, absorbers): (&[Mounted], &[usize]),
        peak: &Peak,
        speed_rpm: f64,
        work: &mut Work,
    ) -> Result<Vec<Vec<Vec<C64>>>, ResponseError> {
        let by_order = |own: Vec<Vec<C64>>| -> Vec<Vec<C64>> {
            let parameters = own.first().map_or(0, Vec::len);
            (0..parameters).map(|p| own.iter().map(|c| c[p]).collect()).collect()
        };
        let all = self.direct.sensitivities(design, absorbers, peak.quantity, 0..self.system.orders(), speed_rpm, work)?;
        Ok(all.into_iter().map(by_order).collect())
    }

    fn gradient_on_ridge(
        &self,
        of: (&[Mounted], usize),
        peak: &Peak,
        metric: PointMetric,
        work: &mut Work,
    ) -> Result<Vec<f64>, ResponseError> {
        let mut y = vec![ZERO; self.system.orders()];
        self.direct.at(of.0, peak.quantity, peak.speed_rpm, &mut y, work)?;
        let length = |y: &[C64]| y.iter().map(|y| y.norm_sqr()).sum::<f64>().sqrt();
        let changes_at = |speed: f64, work: &mut Work| Ok(self.changes((of.0, &[of.1]), peak, speed, work)?.swap_remove(0));
        let here = changes_at(peak.speed_rpm, work)?;
        let steps: Vec<f64> = here.iter().map(|change| FARTHER * DIFFERENCE * length(&y) / length(change)).collect();
        let range = (self.grid.speed_rpm[0], self.grid.speed_rpm[self.grid.len() - 1]);
        let low = (peak.speed_rpm * (1.0 - BESIDE)).max(range.0);
        let high = (peak.speed_rpm * (1.0 + BESIDE)).min(range.1);
        let mut gradient = vec![0.0; steps.len()];
        for (p, step) in steps.into_iter().enumerate().filter(|s| s.1.is_finite()) {
            let mut value = |speed: f64, step: f64| -> Result<f64, ResponseError> {
                self.direct.at(of.0, peak.quantity, speed, &mut y, work)?;
                let change = &changes_at(speed, work)?[p];
                y.iter_mut().zip(change).for_each(|(y, d)| *y += d * step);
                Ok(metric.value(speed, &self.synthesiser.extremes(&y), &y))
            };
            let mut top = |step: f64| -> Result<f64, ResponseError> {
                let at_ends = value(low, step)?.max(value(high, step)?);
                Ok(if low < high { at_ends.max(maximise(low, high, |speed| value(speed, step))?.1) } else { at_ends })
            };
            gradient[p] = (top(step)? - top(-step)?) / (2.0 * step);
        }
        Ok(gradient)
    }
}
