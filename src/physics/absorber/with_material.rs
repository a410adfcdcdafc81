//! A law with its material: in each state of that, the parameters are those of the reference state times a factor.

use super::cooling::{Cooling, ToAir};
use super::dynamic_stiffness::{Operating, OperatingOver, SpringAndDamper};
use super::large_twist::LargeTwist;
use super::law::{ByFactor, Declaration, Law};
use super::material::{Material, Thermal};
use super::material_state::State;
use super::parts::{Number, Parts};
use crate::numerics::C64;
use crate::numerics::taylor::Taylor;
use std::sync::Arc;

/// A law with its material: itself, as long as it is asked for no state of that.
#[derive(Debug, Clone)]
pub struct WithMaterial {
    law: Arc<dyn Law>,
    material: Arc<Material>,
}

impl WithMaterial {
    /// A law with what is known of its material; in each state as many factors as it has parameters.
    pub fn of(law: Arc<dyn Law>, material: &Arc<Material>) -> Arc<dyn Law> {
        let own = law.parts().zip(material.thermal);
        let material = match own {
            Some((parts, thermal)) if matches!(thermal.cooling.to_air, ToAir::Own { .. }) => {
                let to_air = ToAir::Own { radius: 0.5 * parts.outer_diameter, width: parts.width };
                let cooling = Cooling { to_air, ..thermal.cooling };
                Arc::new(Material { thermal: Some(Thermal { cooling, ..thermal }), ..Material::clone(material) })
            }
            _ => material.clone(),
        };
        if *material == Material::default() { law } else { Arc::new(Self { law, material }) }
    }
}

/// A law with its material at a temperature, °C: itself where nothing is said of how it follows that.
pub(crate) fn at_temperature(law: &Arc<dyn Law>, celsius: f64) -> Arc<dyn Law> {
    match law.material().and_then(|m| m.thermal) {
        Some(thermal) => changed(law, law.declaration().followed(thermal.law.factor(celsius))),
        None => law.clone(),
    }
}

/// A law with its parameters times factors; its values stay those of the law.
pub(super) fn changed(law: &Arc<dyn Law>, factors: Vec<f64>) -> Arc<dyn Law> {
    changed_by(law, (factors, Vec::new()))
}

/// A law with its parameters times factors, then with amounts added; its values stay those of the law.
pub(super) fn changed_by(law: &Arc<dyn Law>, (factors, amounts): (Vec<f64>, Vec<f64>)) -> Arc<dyn Law> {
    Arc::new(Changed::new(law.clone(), factors, amounts))
}

/// A law whose parameters are those of another times factors, with amounts added where there are any; its values are those of the other.
#[derive(Debug, Clone)]
struct Changed {
    reference: Arc<dyn Law>,
    now: Arc<dyn Law>,
    factors: Vec<f64>,
    amounts: Vec<f64>,
}

/// Parameters times factors, with amounts added where there are any.
fn times_and_plus(values: &[f64], factors: &[f64], amounts: &[f64]) -> Vec<f64> {
    let mut changed: Vec<f64> = values.iter().zip(factors).map(|(v, f)| v * f).collect();
    changed.iter_mut().zip(amounts).for_each(|(v, a)| *v += a);
    changed
}

impl Changed {
    fn new(reference: Arc<dyn Law>, factors: Vec<f64>, amounts: Vec<f64>) -> Self {
        let values = times_and_plus(&reference.values(), &factors, &amounts);
        Self { now: reference.rebuilt(&values), reference, factors, amounts }
    }
}

impl Changed {
    /// The parameters of the law as it is now, from those of the reference.
    fn changed_over(&self, values: &[Taylor]) -> Vec<Taylor> {
        let amount = |i: usize| C64::from(self.amounts.get(i).copied().unwrap_or(0.0));
        values.iter().zip(&self.factors).enumerate().map(|(i, (v, f))| v.times_number(C64::from(*f)).plus_number(amount(i))).collect()
    }
}

/// What a law that stands in for another one passes on.
macro_rules! stands_in {
    ($values:ident, $now:ident) => {
        fn declaration(&self) -> &'static Declaration {
            self.$values.declaration()
        }
        fn values(&self) -> Vec<f64> {
            self.$values.values()
        }
        fn ring_inertia(&self) -> f64 {
            self.$now.ring_inertia()
        }
        fn dynamic_stiffness(&self, at: Operating) -> C64 {
            self.$now.dynamic_stiffness(at)
        }
        fn spring_and_damper(&self) -> Option<SpringAndDamper> {
            self.$now.spring_and_damper()
        }
        fn depends_on_speed(&self) -> bool {
            self.$now.depends_on_speed()
        }
        fn is_analytic(&self) -> bool {
            self.$now.is_analytic()
        }
        fn large_twist(&self) -> Option<&dyn LargeTwist> {
            self.$now.large_twist()
        }
        fn hub_inertia(&self) -> f64 {
            self.$now.hub_inertia()
        }
        fn parts(&self) -> Option<&Parts<f64>> {
            self.$now.parts()
        }
        fn dynamic_stiffness_each(&self, at: &[Operating], out: &mut [C64]) {
            self.$now.dynamic_stiffness_each(at, out);
        }
        fn loss_each(&self, at: &[Operating], out: &mut [f64]) {
            self.$now.loss_each(at, out);
        }
        fn followed_each<'s>(&'s self, at: &'s [Operating]) -> Option<ByFactor<'s>> {
            self.$now.followed_each(at)
        }
    };
}

impl Law for WithMaterial {
    stands_in!(law, law);
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        self.law.derivatives(at)
    }
    fn over(&self, values: &[Taylor], at: &OperatingOver) -> Option<Taylor> {
        self.law.over(values, at)
    }
    fn quotient(&self, values: &[f64], at: Operating) -> Option<[C64; 2]> {
        self.law.quotient(values, at)
    }
    fn ring_over(&self, values: &[Taylor]) -> Taylor {
        self.law.ring_over(values)
    }
    fn parts_by_dimensions(&self) -> Option<Box<Parts<Number>>> {
        self.law.parts_by_dimensions()
    }
    fn rebuilt(&self, values: &[f64]) -> Arc<dyn Law> {
        Self::of(self.law.rebuilt(values), &self.material)
    }
    fn in_state(&self, state: State) -> Option<Arc<dyn Law>> {
        match self.material.states.iter().find(|s| s.state == state) {
            // its cycles of strain count in every state
            Some(found) => Some(Self::of(changed(&self.law, found.factors.clone()), &Arc::new(self.material.lasting()))),
            // what is known of the material leaves what the law itself knows
            None => Some(Arc::new(Self { law: self.law.in_state(state)?, material: self.material.clone() })),
        }
    }
    fn material(&self) -> Option<&Material> {
        Some(&self.material)
    }
}

impl Law for Changed {
    stands_in!(reference, now);
    fn material(&self) -> Option<&Material> {
        self.reference.material()
    }
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        self.now.derivatives(at).into_iter().zip(&self.factors).map(|(d, f)| d * *f).collect()
    }
    fn over(&self, values: &[Taylor], at: &OperatingOver) -> Option<Taylor> {
        self.now.over(&self.changed_over(values), at)
    }
    fn quotient(&self, values: &[f64], at: Operating) -> Option<[C64; 2]> {
        self.now.quotient(&times_and_plus(values, &self.factors, &self.amounts), at)
    }
    fn ring_over(&self, values: &[Taylor]) -> Taylor {
        self.now.ring_over(&self.changed_over(values))
    }
    fn parts_by_dimensions(&self) -> Option<Box<Parts<Number>>> {
        let by = |x: Number| x.rescaled(|i| self.factors.get(i).copied().unwrap_or(1.0));
        self.now.parts_by_dimensions().map(|parts| Box::new(parts.map(by)))
    }
    fn rebuilt(&self, values: &[f64]) -> Arc<dyn Law> {
        Arc::new(Self::new(self.reference.rebuilt(values), self.factors.clone(), self.amounts.clone()))
    }
}
