//! What searches ask of a design: its peak from tables where they are within tolerance, else exactly.

use super::design_cache::Shared;
use super::measure::{Measure, Over};
use super::peak::Peak;
use super::peak_search::{Asked, PeakFinder, lowest};
use super::point_metric::PointMetric;
use super::surrogate::{Scratch, Surrogate};
use crate::absorber::Mounted;
use crate::numerics::ZERO;
use crate::response::{ResponseError, Work};

impl<'a> PeakFinder<'a> {
    /// Lets searches ask tables first for their measure; a peak whose estimated error is above `tolerance` is found exactly.
    #[must_use]
    #[doc(hidden)]
    pub fn with_surrogate(mut self, surrogate: Option<Surrogate<'a>>, tolerance: f64) -> Self {
        self.surrogates.extend(surrogate.map(|s| (s, tolerance)));
        self
    }

    /// Value of the largest peak of `measure` for a search: from tables where they are within tolerance, else exactly; nothing where it is below `least`.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where nothing damps a resonance.
    #[doc(hidden)]
    pub fn value(
        &self,
        design: &[Mounted],
        (measure, least): (&Measure, f64),
        shared: &Shared,
        work: &mut Work,
    ) -> Result<f64, ResponseError> {
        if let ([mounted], Some((surrogate, tolerance))) = (design, self.surrogate(measure))
            && surrogate.takes(mounted)
        {
            let found = surrogate.peak(mounted, &mut Scratch::default(), work);
            if found.error <= tolerance {
                work.evaluations += 1;
                work.surrogate_evaluations += 1;
                return Ok(found.value);
            }
        }
        self.exact_value(design, (measure, least), shared, work)
    }

    /// The same without tables.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where nothing damps a resonance.
    pub(crate) fn exact_value(
        &self,
        design: &[Mounted],
        (measure, least): (&Measure, f64),
        shared: &Shared,
        work: &mut Work,
    ) -> Result<f64, ResponseError> {
        let peaks = self.peaks_knowing(design, measure, Asked { least, ..Asked::LARGEST }, shared, work)?;
        Ok(lowest(peaks).map_or(0.0, |peak| peak.value))
    }

    /// What a measure of a design is at least: its value at the speed of a peak of another design; zero where that says nothing.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where nothing damps a resonance.
    #[doc(hidden)]
    pub fn at_least(&self, design: &[Mounted], (measure, peak): (&Measure, &Peak), work: &mut Work) -> Result<f64, ResponseError> {
        match peak.over {
            Over::Synthesis | Over::Margin(_) => {
                let mut y = vec![ZERO; self.system.orders()];
                self.direct.at(design, peak.quantity, peak.speed_rpm, &mut y, work)?;
                work.syntheses += 1;
                let metric = PointMetric::of(measure.over, peak.quantity, &measure.within, self.margin, None);
                Ok(metric.value(peak.speed_rpm, &self.synthesiser.extremes(&y), &y))
            }
            Over::Orders | Over::Order(_) => {
                let y = self.direct.order_at(design, peak.quantity, peak.order, peak.speed_rpm, work)?;
                Ok(peak.weight * y.norm())
            }
            Over::Strain | Over::SpringStress => self.strain_at_peak(design, (measure, peak), work),
            Over::Statistic(statistic) => Ok(peak.weight * self.statistic_at((design, peak.quantity), statistic, peak.speed_rpm, work)?.0),
            _ => Ok(0.0),
        }
    }

    /// Value of a measure of a design at the speed of a peak of another design near it; `None` of a measure that is not found speed by speed.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where nothing damps a resonance.
    pub(crate) fn value_at_peak(
        &self,
        design: &[Mounted],
        (measure, peak): (&Measure, &Peak),
        work: &mut Work,
    ) -> Result<Option<f64>, ResponseError> {
        match peak.over {
            Over::Synthesis | Over::Margin(_) | Over::Orders | Over::Order(_) | Over::Statistic(_) => {
                Ok(Some(self.at_least(design, (measure, peak), work)?))
            }
            Over::Strain | Over::SpringStress => self.strain_at_peak(design, (measure, peak), work).map(Some),
            Over::Power => Ok(Some(self.powers_at(design, measure, peak.speed_rpm, work)?.iter().sum::<f64>() * peak.weight)),
            _ => Ok(None),
        }
    }

    /// The tables for a measure, where there are any, and the error they may have.
    fn surrogate(&self, measure: &Measure) -> Option<(&Surrogate<'a>, f64)> {
        self.surrogates.iter().find(|s| s.0.measure() == measure).map(|(surrogate, tolerance)| (surrogate, *tolerance))
    }

    /// Index of the design of one absorber with the lowest peak, by tables, among those that they answer for; nothing without tables.
    #[doc(hidden)]
    pub fn best_of(&self, designs: impl Iterator<Item = Vec<Mounted>>, measure: &Measure) -> Option<usize> {
        let (surrogate, _) = self.surrogate(measure)?;
        let (mut scratch, mut best) = (Scratch::default(), None);
        for (i, design) in designs.enumerate() {
            let [mounted] = design.as_slice() else { continue };
            if !surrogate.takes(mounted) {
                continue;
            }
            let level = best.map_or(f64::INFINITY, |b: (usize, f64)| b.1);
            if let Some(found) = surrogate.peak_below(mounted, level, &mut scratch, &mut Work::default())
                && found.value < level
            {
                best = Some((i, found.value));
            }
        }
        best.map(|b| b.0)
    }
}
