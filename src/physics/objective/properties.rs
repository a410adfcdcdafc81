//! Measures that a design has at no speed.

use super::measure::{Measure, Over, Price, Property};
use super::peak::Peak;
use super::peak_search::PeakFinder;
use crate::absorber::construction::shape;
use crate::absorber::parameter::STIFFNESS;
use crate::absorber::{Absorber, Law, Mounted, Parts};
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

/// Mass of a damper by its dimensions, kg.
#[doc(hidden)]
pub fn mass(law: &dyn Law, parts: &Parts<f64>) -> f64 {
    parts.ring_mass + parts.hub_mass + element(law, parts).0
}

/// Mass of what is sheared or of the springs, kg, and what a kg of it costs beside the ring, where a table says so.
fn element(law: &dyn Law, parts: &Parts<f64>) -> (f64, Option<f64>) {
    let named = law.material().and_then(|m| m.substance.as_ref());
    let density = named.map_or_else(|| shape(law.declaration()).map_or(0.0, |s| s.medium.density()), |s| s.density);
    (density * parts.element_volume, named.map(|s| s.price))
}

fn volume(parts: &Parts<f64>) -> f64 {
    0.25 * std::f64::consts::PI * parts.outer_diameter * parts.outer_diameter * parts.width
}

fn cost(law: &dyn Law, parts: &Parts<f64>, price: Price) -> f64 {
    let (mass, named) = element(law, parts);
    let is_spring = shape(law.declaration()).is_some_and(|s| s.medium.is_spring());
    let per_kg = named.unwrap_or(if is_spring { price.ring } else { 0.0 });
    price.fixed + price.ring * parts.ring_mass + price.housing * parts.hub_mass + price.diameter * parts.outer_diameter + per_kg * mass
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
        let of_parts = |of: &dyn Fn(&dyn Law, &Parts<f64>) -> f64| -> Option<Vec<(f64, Quantity)>> {
            let own = |i: usize| {
                let law = design.get(i)?.absorber.law()?;
                Some((of(law.as_ref(), law.parts()?), Quantity::RingTwist(i)))
            };
            let found: Vec<_> = measure.absorbers().filter_map(own).collect();
            (!found.is_empty()).then_some(found)
        };
        let sum_of = |found: Vec<(f64, Quantity)>| (found.iter().map(|f| f.0).sum(), found[0].1);
        let largest = |found: Vec<(f64, Quantity)>| found.into_iter().reduce(|a, b| if b.0 > a.0 { b } else { a });
        match property {
            Property::RingInertia => sum(&|m| m.absorber.ring_inertia()),
            Property::TotalInertia => sum(&|m| m.absorber.ring_inertia() + m.hub()),
            Property::LossFactor => {
                let loss_of = |i: usize| Some((loss_factor(&design.get(i)?.absorber)?, Quantity::RingTwist(i)));
                measure.absorbers().filter_map(loss_of).reduce(|a, b| if b.0 > a.0 { b } else { a })
            }
            Property::Mass => of_parts(&|law, p| mass(law, p)).map(sum_of),
            Property::Volume => of_parts(&|_, p| volume(p)).map(sum_of),
            Property::Cost(price) => of_parts(&|law, p| cost(law, p, price)).map(sum_of),
            Property::OuterDiameter => of_parts(&|_, p| p.outer_diameter).and_then(largest),
            Property::Width => of_parts(&|_, p| p.width).and_then(largest),
            Property::Bore => of_parts(&|_, p| 1.0 / p.bore).and_then(largest),
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
