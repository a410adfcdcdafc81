//! What is built instead of what was drawn: parameters times factors.

use super::mounted::{Absorber, Mounted};
use super::with_material::changed;

/// Factors on the parameters of the absorbers of a design, one list an absorber in the order of its declaration.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Deviation {
    /// One where a parameter is as drawn.
    pub factors: Vec<Vec<f64>>,
}

impl Deviation {
    /// The design as built: what leaves the range of a parameter stays at its end. Rings that are locked stay as they are.
    pub fn of(&self, design: &[Mounted]) -> Vec<Mounted> {
        let one = |(m, factors): (&Mounted, &Vec<f64>)| {
            let Absorber::Ring(law) = &m.absorber else { return m.clone() };
            let within = |((p, value), factor): ((&super::Parameter, f64), &f64)| {
                if value == 0.0 { *factor } else { p.range.nearest(value * factor) / value }
            };
            let factors = law.declaration().parameters.iter().zip(law.values()).zip(factors).map(within).collect();
            Mounted { absorber: Absorber::Ring(changed(law, factors)), ..m.clone() }
        };
        design.iter().zip(&self.factors).map(one).collect()
    }
}
