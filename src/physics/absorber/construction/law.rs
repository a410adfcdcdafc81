//! The law of a damper by its dimensions: that of its compound or oil, as stiff or as viscous as the drawing makes it.

use super::shape::Shape;
use crate::absorber::dynamic_stiffness::Operating;
use crate::absorber::law::{ByFactor, Declaration, Law};
use crate::absorber::parts::{Number, Parts, Sheared};
use crate::absorber::{Carreau, FractionalZener};
use crate::numerics::{C64, ImaginaryPower};
use crate::units::PA_PER_MPA;
use std::sync::Arc;

/// A damper by its dimensions.
#[derive(Debug, Clone)]
struct Constructed {
    shape: &'static Shape,
    values: Vec<f64>,
    parts: Parts<f64>,
    /// Of rubber or oil, B times its modulus or viscosity.
    law: Arc<dyn Law>,
    /// Of rubber the same law, with the power of its frequency: one point costs less by it.
    rubber: Option<(FractionalZener, ImaginaryPower)>,
}

/// A damper of a shape with these values.
pub(super) fn build(shape: &'static Shape, values: &[f64]) -> Arc<dyn Law> {
    let parts = shape.parts_of(values);
    let of = |i: usize| values[shape.dimensions + i];
    let strength = parts.factor * of(0) * unit(shape);
    let zener =
        || FractionalZener { ring_inertia: values[0], stiffness: strength, glass_ratio: of(1), relaxation_time: of(2), exponent: of(3) };
    let rubber = (shape.sheared == Sheared::Rubber).then(|| (zener(), ImaginaryPower::new(of(3))));
    let law: Arc<dyn Law> = match shape.sheared {
        Sheared::Rubber => Arc::new(zener()),
        Sheared::Oil => {
            Arc::new(Carreau { ring_inertia: values[0], damping: strength, relaxation_time: of(1), transition: of(2), flow_index: of(3) })
        }
    };
    Arc::new(Constructed { shape, values: values.to_vec(), parts, law, rubber })
}

/// Pa, or Pa s, per unit of the parameter that says how stiff or viscous the material is.
fn unit(shape: &Shape) -> f64 {
    match shape.sheared {
        Sheared::Rubber => PA_PER_MPA,
        Sheared::Oil => 1.0,
    }
}

impl Law for Constructed {
    fn declaration(&self) -> &'static Declaration {
        self.shape.declaration
    }
    fn values(&self) -> Vec<f64> {
        self.values.clone()
    }
    fn ring_inertia(&self) -> f64 {
        self.values[0]
    }
    fn dynamic_stiffness(&self, at: Operating) -> C64 {
        match &self.rubber {
            Some((law, power)) => law.stiffness_of(power.branchless(at.omega * law.relaxation_time)),
            None => self.law.dynamic_stiffness(at),
        }
    }
    fn dynamic_stiffness_each(&self, at: &[Operating], out: &mut [C64]) {
        self.law.dynamic_stiffness_each(at, out);
    }
    fn followed_each<'s>(&'s self, at: &'s [Operating]) -> Option<ByFactor<'s>> {
        self.law.followed_each(at)
    }
    fn is_analytic(&self) -> bool {
        self.law.is_analytic()
    }
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        // S is proportional to B and to the modulus or viscosity
        let own = self.law.derivatives(at);
        let by_factor = own[1] * self.values[self.shape.dimensions] * unit(self.shape);
        let by_strength = own[1] * self.parts.factor * unit(self.shape);
        let by = self.shape.with_derivatives(&self.values).factor.by;
        let dimensions = by.into_iter().take(self.shape.dimensions).map(|d| by_factor * d);
        dimensions.chain([by_strength]).chain(own[2..].iter().copied()).collect()
    }
    fn hub_inertia(&self) -> f64 {
        self.parts.hub_inertia
    }
    fn parts(&self) -> Option<&Parts<f64>> {
        Some(&self.parts)
    }
    fn parts_by_dimensions(&self) -> Option<Box<Parts<Number>>> {
        Some(Box::new(self.shape.with_derivatives(&self.values)))
    }
}
