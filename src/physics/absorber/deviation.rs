//! What is built instead of what was drawn: parameters times factors, with amounts added.

use super::law::Law;
use super::mounted::{Absorber, Mounted};
use super::with_material::changed_by;

/// Factors on the parameters of the absorbers of a design, and amounts that are added, one list an absorber in the order of its declaration.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Deviation {
    /// One where a parameter is as drawn.
    pub factors: Vec<Vec<f64>>,
    /// In the unit of the parameter, after its factor; nothing where nothing is added.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub amounts: Vec<Vec<f64>>,
}

impl Deviation {
    /// The design as built: what leaves the range of a parameter stays at its end. Rings that are locked stay as they are.
    pub fn of(&self, design: &[Mounted]) -> Vec<Mounted> {
        let one = |(i, (m, factors)): (usize, (&Mounted, Vec<f64>))| {
            let Absorber::Ring(law) = &m.absorber else { return m.clone() };
            let amounts = self.amounts.get(i).map_or(&[][..], Vec::as_slice);
            let (factors, amounts) =
                if amounts.iter().all(|a| *a == 0.0) { (factors, Vec::new()) } else { apart(law.as_ref(), &self.factors[i], amounts) };
            Mounted { absorber: Absorber::Ring(changed_by(law, (factors, amounts))), ..m.clone() }
        };
        design.iter().zip(self.within(design).factors).enumerate().map(one).collect()
    }

    /// What of it a design can have: factors that lead past the range of a parameter lead to its end, and a parameter that is zero stays so.
    #[doc(hidden)]
    pub fn within(&self, design: &[Mounted]) -> Self {
        let one = |(i, (m, factors)): (usize, (&Mounted, &Vec<f64>))| {
            let Absorber::Ring(law) = &m.absorber else { return factors.clone() };
            let amount = |p: usize| self.amounts.get(i).and_then(|a| a.get(p)).copied().unwrap_or(0.0);
            let within = |(i, ((p, value), factor)): (usize, ((&super::Parameter, f64), &f64))| {
                if value == 0.0 || *factor == 1.0 && amount(i) == 0.0 { 1.0 } else { p.range.nearest(value * factor + amount(i)) / value }
            };
            law.declaration().parameters.iter().zip(law.values()).zip(factors).enumerate().map(within).collect()
        };
        Self { factors: design.iter().zip(&self.factors).enumerate().map(one).collect(), amounts: Vec::new() }
    }
}

/// Factors and amounts of a law's parameters, apart; what would leave the range of a parameter ends there by its factor alone.
fn apart(law: &dyn Law, factors: &[f64], amounts: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let one = |((p, value), (factor, amount)): ((&super::Parameter, f64), (&f64, &f64))| {
        let (built, nearest) = (value * factor + amount, p.range.nearest(value * factor + amount));
        if value == 0.0 {
            (1.0, 0.0)
        } else if built == nearest && built > 0.0 {
            (*factor, *amount)
        } else {
            (nearest.max(f64::MIN_POSITIVE) / value, 0.0)
        }
    };
    law.declaration().parameters.iter().zip(law.values()).zip(factors.iter().zip(amounts)).map(one).unzip()
}
