//! A law at an amplitude of strain.

use super::dynamic_stiffness::Operating;
use super::law::{Declaration, Law};
use super::material::Material;
use super::parts::{Number, Parts};
use crate::numerics::C64;
use std::sync::Arc;

/// A law at an amplitude of strain, one for all frequencies; its values are those at the reference.
#[derive(Debug, Clone)]
struct Strained {
    law: Arc<dyn Law>,
    factors: (f64, f64),
}

/// A law at an amplitude of strain: itself where nothing is said of how it follows that.
pub(crate) fn at_strain(law: &Arc<dyn Law>, strain: f64) -> Arc<dyn Law> {
    match law.material().and_then(|m| m.amplitude) {
        Some(kraus) => Arc::new(Strained { law: law.clone(), factors: kraus.factors(strain) }),
        None => law.clone(),
    }
}

impl Strained {
    fn scaled(&self, s: C64) -> C64 {
        C64::new(s.re * self.factors.0, s.im * self.factors.1)
    }
}

impl Law for Strained {
    fn declaration(&self) -> &'static Declaration {
        self.law.declaration()
    }
    fn values(&self) -> Vec<f64> {
        self.law.values()
    }
    fn ring_inertia(&self) -> f64 {
        self.law.ring_inertia()
    }
    fn dynamic_stiffness(&self, at: Operating) -> C64 {
        self.scaled(self.law.dynamic_stiffness(at))
    }
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        self.law.derivatives(at).into_iter().map(|d| self.scaled(d)).collect()
    }
    fn depends_on_speed(&self) -> bool {
        self.law.depends_on_speed()
    }
    fn hub_inertia(&self) -> f64 {
        self.law.hub_inertia()
    }
    fn parts(&self) -> Option<&Parts<f64>> {
        self.law.parts()
    }
    fn parts_by_dimensions(&self) -> Option<Box<Parts<Number>>> {
        self.law.parts_by_dimensions()
    }
    fn rebuilt(&self, values: &[f64]) -> Arc<dyn Law> {
        Arc::new(Self { law: self.law.rebuilt(values), factors: self.factors })
    }
    fn material(&self) -> Option<&Material> {
        self.law.material()
    }
}
