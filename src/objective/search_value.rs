//! What searches ask of a design: its peak from tables where they are right enough, else exactly.

use super::measure::Measure;
use super::peaks::PeakFinder;
use super::surrogate::{Quick, Scratch};
use crate::absorber::Mounted;
use crate::response::{Quantity, ResponseError, Work};

impl PeakFinder<'_> {
    /// Lets searches ask tables first, for the synthesis of `quantity`; a peak whose estimated error is above `tolerance` is found exactly.
    #[must_use]
    pub fn with_quick(mut self, quick: Option<Quick>, quantity: Quantity, tolerance: f64) -> Self {
        self.quick = quick.map(|q| (q, quantity, tolerance));
        self
    }

    /// Value of the largest peak of `measure` for a search: from tables where they are right enough, else exactly.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where nothing damps a resonance.
    pub fn value(&self, design: &[Mounted], measure: &Measure, work: &mut Work) -> Result<f64, ResponseError> {
        if let ([mounted], Some((quick, tolerance))) = (design, self.quick(measure))
            && quick.takes(mounted)
        {
            let found = quick.peak(mounted, &mut Scratch::default(), work);
            if found.error <= tolerance {
                work.evaluations += 1;
                work.quick_evaluations += 1;
                return Ok(found.value);
            }
        }
        Ok(self.peak(design, measure, work)?.map_or(0.0, |p| p.value))
    }

    /// The tables for a measure, where there are any, and the error they may have.
    fn quick(&self, measure: &Measure) -> Option<(&Quick, f64)> {
        let (quick, quantity, tolerance) = self.quick.as_ref()?;
        (measure.synthesised() == Some(*quantity)).then_some((quick, *tolerance))
    }

    /// Index of the absorber with the lowest peak, by tables, among those that they answer for; nothing without tables.
    pub fn best_of(&self, absorbers: impl Iterator<Item = Mounted>, measure: &Measure) -> Option<usize> {
        let (quick, _) = self.quick(measure)?;
        let (mut scratch, mut best) = (Scratch::default(), None);
        for (i, mounted) in absorbers.enumerate().filter(|(_, m)| quick.takes(m)) {
            let level = best.map_or(f64::INFINITY, |b: (usize, f64)| b.1);
            if let Some(found) = quick.peak_below(&mounted, level, &mut scratch, &mut Work::default())
                && found.value < level
            {
                best = Some((i, found.value));
            }
        }
        best.map(|b| b.0)
    }
}
