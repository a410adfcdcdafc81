//! Extremes of one sum after another, of which few matter.

use super::extremes::{Extremes, Most, Precision};
use super::samples::Samples;
use super::synthesis::Synthesiser;
use crate::numerics::C64;

/// Finds extremes where they may matter.
#[derive(Debug)]
pub(crate) struct Screen<'s> {
    synthesiser: &'s Synthesiser,
    precision: Precision,
    samples: Samples,
}

impl<'s> Screen<'s> {
    /// As right as `precision` says.
    pub(crate) fn new(synthesiser: &'s Synthesiser, precision: Precision) -> Self {
        Self { synthesiser, precision, samples: Samples::default() }
    }

    /// The extremes; nothing where `can_matter` says no to bounds of them, which come with them.
    pub(crate) fn extremes_if(&mut self, phasors: &[C64], can_matter: impl Fn(Most) -> bool) -> (Option<Extremes>, Most) {
        if phasors.len() == 1 {
            let own = self.synthesiser.extremes(phasors);
            return (Some(own), Most::of(&own));
        }
        let samples = &mut self.samples;
        self.synthesiser.sample(phasors, samples);
        let (reach, sampled) = (self.synthesiser.reach(phasors), samples.extremes());
        let most = Most { half_peak_to_peak: sampled.half_peak_to_peak + reach, middle: sampled.middle.abs() + reach };
        let extremes = can_matter(most).then(|| match self.precision {
            Precision::Rounding => self.synthesiser.polished(phasors, samples),
            Precision::Millionth => Extremes::of(samples.near_end(1.0, reach), samples.near_end(-1.0, reach)),
        });
        (extremes, most)
    }
}
