//! Peaks over speed of what the twist of a ring makes in what carries it, by the dimensions of the absorber: shear strain in rubber, stress in springs.

use super::design_cache::Shared;
use super::measure::{Measure, Over};
use super::peak::Peak;
use super::peak_search::{Asked, PeakFinder};
use crate::absorber::construction::{shape, strain_derivatives, stress_derivatives};
use crate::absorber::{Medium, Mounted};
use crate::response::{Quantity, ResponseError, Work};

/// Strain (1/rad) or stress of springs (Pa/rad) per twist of the ring that a quantity is of.
pub(super) fn per_twist(design: &[Mounted], quantity: Quantity, over: Over) -> Option<f64> {
    let Quantity::RingTwist(i) = quantity else { return None };
    let law = design.get(i)?.absorber.law()?;
    if over == Over::SpringStress {
        return law.stress_per_twist();
    }
    // oil bears any strain
    let is_oil = shape(law.declaration()).is_some_and(|s| s.medium == Medium::Oil);
    law.strain_per_twist().filter(|_| !is_oil)
}

/// The twist that a peak of strain or stress is of, as its measure and peak.
fn of_twist(measure: &Measure, peak: &Peak, per_twist: f64) -> (Measure, Peak) {
    let twist = Measure { quantities: vec![peak.quantity], over: Over::Synthesis, within: measure.within.clone() };
    let (value, order_value) = (peak.value / per_twist, peak.order_value / per_twist);
    (twist, Peak { over: Over::Synthesis, value, order_value, ..*peak })
}

impl PeakFinder<'_> {
    /// Local maxima of the strain or stress of every absorber of the measure that has one; those that are asked for.
    pub(super) fn strains(
        &self,
        design: &[Mounted],
        measure: &Measure,
        asked: Asked,
        shared: &Shared,
        work: &mut Work,
    ) -> Result<Vec<Peak>, ResponseError> {
        let mut all: Vec<Peak> = Vec::new();
        for quantity in &measure.quantities {
            let Some(per_twist) = per_twist(design, *quantity, measure.over).filter(|s| *s > 0.0) else { continue };
            let twist = Measure { quantities: vec![*quantity], over: Over::Synthesis, within: measure.within.clone() };
            let asked = Asked { least: asked.least / per_twist, ..asked };
            let found = self.peaks_knowing(design, &twist, asked, shared, work)?;
            let made = |p: Peak| Peak { over: measure.over, value: p.value * per_twist, order_value: p.order_value * per_twist, ..p };
            all.extend(found.into_iter().map(made));
        }
        let largest = all.iter().map(|p| p.value).fold(0.0, f64::max);
        all.retain(|p| p.value >= asked.keep * largest);
        all.sort_by(|a, b| b.value.total_cmp(&a.value));
        Ok(all)
    }

    /// Derivatives by the parameters of some absorbers: of the twist, and of the strain or stress that it makes.
    pub(super) fn strain_gradients(
        &self,
        (design, absorbers): (&[Mounted], &[usize]),
        measure: &Measure,
        peak: &Peak,
        work: &mut Work,
    ) -> Result<Vec<Vec<f64>>, ResponseError> {
        let Some(per_twist) = per_twist(design, peak.quantity, peak.over) else { return Ok(vec![Vec::new(); absorbers.len()]) };
        let (twist, of) = of_twist(measure, peak, per_twist);
        let by_absorber = self.gradients(design, absorbers, &twist, &of, work)?;
        let by_dimensions = if peak.over == Over::SpringStress { stress_derivatives } else { strain_derivatives };
        let one = |index: &usize| {
            let mut gradient: Vec<f64> = by_absorber[*index].iter().map(|g| per_twist * g).collect();
            let own = design[*index].absorber.law().filter(|_| peak.quantity == Quantity::RingTwist(*index));
            let by = own.map_or_else(Vec::new, |law| by_dimensions(law.as_ref()));
            gradient.iter_mut().zip(by).for_each(|(g, d)| *g += peak.value * d);
            gradient
        };
        Ok(absorbers.iter().map(one).collect())
    }

    /// Strain or stress of a design at the speed of a peak of another design near it.
    pub(super) fn strain_at_peak(
        &self,
        design: &[Mounted],
        (measure, peak): (&Measure, &Peak),
        work: &mut Work,
    ) -> Result<f64, ResponseError> {
        let Some(per_twist) = per_twist(design, peak.quantity, peak.over) else { return Ok(0.0) };
        let (twist, of) = of_twist(measure, peak, per_twist);
        Ok(per_twist * self.at_least(design, (&twist, &of), work)?)
    }
}
