//! Peaks of one design: what its measures share is evaluated once, and a measure that is asked for again is known.

use super::design_cache::Shared;
use super::measure::Measure;
use super::peak::Peak;
use super::peak_search::{Asked, PeakFinder, lowest};
use crate::absorber::Mounted;
use crate::response::{ResponseError, Work};

/// The largest peaks of one design.
#[doc(hidden)]
pub struct DesignPeaks<'d> {
    /// Of its system.
    pub finder: &'d PeakFinder<'d>,
    /// Its absorbers.
    pub design: &'d [Mounted],
    shared: Shared,
    known: Vec<(Measure, Option<Peak>)>,
}

impl<'d> DesignPeaks<'d> {
    /// Of a design; `measures`: those that will be asked for, as far as they are known.
    pub fn new<'m>(finder: &'d PeakFinder<'d>, design: &'d [Mounted], measures: impl Iterator<Item = &'m Measure>) -> Self {
        Self { finder, design, shared: Shared::of(measures), known: Vec::new() }
    }

    /// The largest peak of a measure, as [`PeakFinder::peak`] finds it.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where nothing damps a resonance.
    pub fn peak(&mut self, measure: &Measure, work: &mut Work) -> Result<Option<Peak>, ResponseError> {
        if let Some((_, peak)) = self.known.iter().find(|k| k.0 == *measure) {
            return Ok(*peak);
        }
        let peak = lowest(self.finder.peaks_knowing(self.design, measure, Asked::LARGEST, &self.shared, work)?);
        self.known.push((measure.clone(), peak));
        Ok(peak)
    }
}
