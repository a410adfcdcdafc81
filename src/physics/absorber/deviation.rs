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
        let one = |(m, factors): (&Mounted, Vec<f64>)| {
            let Absorber::Ring(law) = &m.absorber else { return m.clone() };
            Mounted { absorber: Absorber::Ring(changed(law, factors)), ..m.clone() }
        };
        design.iter().zip(self.within(design).factors).map(one).collect()
    }

    /// What of it a design can have: factors that lead past the range of a parameter lead to its end, and a parameter that is zero stays so.
    #[doc(hidden)]
    pub fn within(&self, design: &[Mounted]) -> Self {
        let one = |(m, factors): (&Mounted, &Vec<f64>)| {
            let Absorber::Ring(law) = &m.absorber else { return factors.clone() };
            let within = |((p, value), factor): ((&super::Parameter, f64), &f64)| {
                if value == 0.0 || *factor == 1.0 { 1.0 } else { p.range.nearest(value * factor) / value }
            };
            law.declaration().parameters.iter().zip(law.values()).zip(factors).map(within).collect()
        };
        Self { factors: design.iter().zip(&self.factors).map(one).collect() }
    }
}
