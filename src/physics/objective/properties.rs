//! Measures that a design has at no speed.

use super::measure::{Measure, Over, Property};
use super::peak::Peak;
use super::peak_search::PeakFinder;
use crate::absorber::parameter::STIFFNESS;
use crate::absorber::{Absorber, Mounted};
use crate::drivetrain::natural;
use crate::response::Quantity;

/// Relative step of differences.
const STEP: f64 = 1e-5;

/// Loss factor of a damper whose spring has come to nothing: infinite, as a number.
const NO_SPRING: f64 = 1e9;

/// Loss factor at the ring's own frequency on its held hub: of spring and damper together, or of any other law; nothing where there is no such frequency.
fn loss_factor(absorber: &Absorber) -> Option<f64> {
    if let Some((loss, _)) = absorber.implied_loss_factor() {
        return Some(loss.min(NO_SPRING));
    }
    if absorber.value(STIFFNESS.key) == Some(0.0) && absorber.damping().is_some_and(|c| c > 0.0) {
        return Some(NO_SPRING);
    }
    natural::own_loss_factor(absorber.law().filter(|law| law.spring_and_damper().is_none())?.as_ref())
}

impl PeakFinder<'_> {
    /// A property as the only peak of its measure; nothing where no absorber has it.
    pub(super) fn property(&self, design: &[Mounted], measure: &Measure, property: Property) -> Option<Peak> {
        let (value, quantity) = self.value_of(design, measure, property)?;
        (value > 0.0).then(|| Peak::nowhere(value, Over::Property(property), quantity))
    }

    /// The value, and the ring that has it.
    fn value_of(&self, design: &[Mounted], measure: &Measure, property: Property) -> Option<(f64, Quantity)> {
        let first = measure.quantities.first().copied();
        let sum = |of: &dyn Fn(&Mounted) -> f64| Some((measure.absorbers().filter_map(|i| design.get(i)).map(of).sum(), first?));
        match property {
            Property::RingInertia => sum(&|m| m.absorber.ring_inertia()),
            Property::TotalInertia => sum(&|m| m.absorber.ring_inertia() + m.hub_inertia),
            Property::LossFactor => {
                let loss_of = |i: usize| Some((loss_factor(&design.get(i)?.absorber)?, Quantity::RingTwist(i)));
                measure.absorbers().filter_map(loss_of).reduce(|a, b| if b.0 > a.0 { b } else { a })
            }
            Property::Band { low, high } => {
                let inside = |f: f64| (f / low).min(high / f);
                let all = natural::frequencies_hz(&self.system.chain, &self.system.modes, design);
                Some((all.into_iter().map(inside).fold(0.0, f64::max), Quantity::RingTwist(0)))
            }
        }
    }

    /// Derivatives by the parameters of absorber `index`, by central differences: properties are smooth and cost next to nothing.
    pub(super) fn property_gradient(&self, design: &[Mounted], index: usize, measure: &Measure, property: Property) -> Vec<f64> {
        let Absorber::Ring(law) = &design[index].absorber else { return Vec::new() };
        let values = law.values();
        let value_at = |parameter: usize, x: f64| {
            let mut moved = design.to_vec();
            let mut values = values.clone();
            values[parameter] = x;
            moved[index].absorber = Absorber::Ring(law.rebuilt(&values));
            self.value_of(&moved, measure, property).map_or(0.0, |v| v.0)
        };
        let slope = |(parameter, x): (usize, &f64)| {
            let step = STEP * x.abs();
            if step > 0.0 { (value_at(parameter, x + step) - value_at(parameter, x - step)) / (2.0 * step) } else { 0.0 }
        };
        values.iter().enumerate().map(slope).collect()
    }
}
