//! The law of a damper by its dimensions: that of its compound, its oil, its springs or its pendulums, as strong as the drawing makes it.

use super::own::Own;
use super::shape::Shape;
use crate::absorber::dynamic_stiffness::{Operating, SpringAndDamper};
use crate::absorber::law::{ByFactor, Declaration, Law};
use crate::absorber::parts::{Number, Parts};
use crate::numerics::C64;
use std::sync::Arc;

/// Points whose loss is computed at once.
const LANES: usize = 64;

/// A damper by its dimensions.
#[derive(Debug, Clone)]
struct Constructed {
    shape: &'static Shape,
    values: Vec<f64>,
    parts: Parts<f64>,
    own: Own,
}

/// A damper of a shape with these values.
pub(super) fn build(shape: &'static Shape, values: &[f64]) -> Arc<dyn Law> {
    let parts = shape.parts_of(values);
    Arc::new(Constructed { shape, values: values.to_vec(), parts, own: Own::new(shape, values, parts.factor) })
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
        self.own.dynamic_stiffness(at)
    }
    fn dynamic_stiffness_each(&self, at: &[Operating], out: &mut [C64]) {
        self.own.law().dynamic_stiffness_each(at, out);
    }
    fn loss_each(&self, at: &[Operating], out: &mut [f64]) {
        let mut s = [C64::ZERO; LANES];
        for (at, out) in at.chunks(LANES).zip(out.chunks_mut(LANES)) {
            self.dynamic_stiffness_each(at, &mut s[..at.len()]);
            out.iter_mut().zip(at.iter().zip(&s)).for_each(|(out, (at, s))| *out = 0.5 * at.omega * s.im);
        }
    }
    fn followed_each<'s>(&'s self, at: &'s [Operating]) -> Option<ByFactor<'s>> {
        self.own.law().followed_each(at)
    }
    fn spring_and_damper(&self) -> Option<SpringAndDamper> {
        self.own.law().spring_and_damper()
    }
    fn depends_on_speed(&self) -> bool {
        self.own.law().depends_on_speed()
    }
    fn is_analytic(&self) -> bool {
        self.own.law().is_analytic()
    }
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        let by = self.shape.with_derivatives(&self.values).factor.by;
        self.own.derivatives(at, (self.shape, &self.values), (self.parts.factor, &by))
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
