//! A law that is another one at every speed of the shaft, as temperature and strain make it.

use super::dynamic_stiffness::Operating;
use super::law::{Declaration, Law};
use super::material::Material;
use super::parts::{Number, Parts};
use crate::numerics::C64;
use std::fmt::{self, Debug, Formatter};
use std::sync::Arc;

/// A law by the speed of the shaft, rad/s; its values are those of the reference.
struct Varying<F> {
    reference: Arc<dyn Law>,
    at: F,
}

/// The law that is `at(shaft speed)` at each speed, rad/s; derivatives are those at the state of that speed, held.
pub(crate) fn varying(reference: Arc<dyn Law>, at: impl Fn(f64) -> Arc<dyn Law> + Send + Sync + 'static) -> Arc<dyn Law> {
    Arc::new(Varying { reference, at })
}

impl<F> Debug for Varying<F> {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.debug_tuple("Varying").field(&self.reference).finish()
    }
}

impl<F: Fn(f64) -> Arc<dyn Law> + Send + Sync> Law for Varying<F> {
    fn declaration(&self) -> &'static Declaration {
        self.reference.declaration()
    }
    fn values(&self) -> Vec<f64> {
        self.reference.values()
    }
    fn ring_inertia(&self) -> f64 {
        self.reference.ring_inertia()
    }
    fn dynamic_stiffness(&self, at: Operating) -> C64 {
        (self.at)(at.shaft_speed).dynamic_stiffness(at)
    }
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        (self.at)(at.shaft_speed).derivatives(at)
    }
    fn depends_on_speed(&self) -> bool {
        // S does, slowly: narrow resonances, which are looked for by this, are those of the reference
        self.reference.depends_on_speed()
    }
    fn hub_inertia(&self) -> f64 {
        self.reference.hub_inertia()
    }
    fn parts(&self) -> Option<&Parts<f64>> {
        self.reference.parts()
    }
    fn parts_by_dimensions(&self) -> Option<Box<Parts<Number>>> {
        self.reference.parts_by_dimensions()
    }
    fn rebuilt(&self, values: &[f64]) -> Arc<dyn Law> {
        self.reference.rebuilt(values)
    }
    fn material(&self) -> Option<&Material> {
        self.reference.material()
    }
    fn dynamic_stiffness_each(&self, at: &[Operating], out: &mut [C64]) {
        // points of one speed stand together
        let mut from = 0;
        for together in at.chunk_by(|a, b| a.shaft_speed == b.shaft_speed) {
            let to = from + together.len();
            (self.at)(together[0].shaft_speed).dynamic_stiffness_each(together, &mut out[from..to]);
            from = to;
        }
    }
}
