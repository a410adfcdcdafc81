//! The law of a damper by its dimensions: that of its compound or oil, as stiff or as viscous as the drawing makes it.

use super::shape::Shape;
use crate::absorber::dynamic_stiffness::Operating;
use crate::absorber::law::{ByFactor, Declaration, Law};
use crate::absorber::parts::{Number, Parts, Sheared};
use crate::absorber::{Carreau, FractionalZener};
use crate::numerics::{C64, ImaginaryPower};
use crate::units::PA_PER_MPA;
use std::sync::Arc;

/// Points whose loss is computed at once.
const LANES: usize = 64;

/// A damper by its dimensions.
#[derive(Debug, Clone)]
struct Constructed {
    shape: &'static Shape,
    values: Vec<f64>,
    parts: Parts<f64>,
    law: Own,
    /// The power of the frequency in its law: one point costs less by it.
    power: ImaginaryPower,
}

/// The law of what is sheared, as stiff or viscous as B times its modulus or viscosity.
#[derive(Debug, Clone, Copy)]
enum Own {
    Rubber(FractionalZener),
    Oil(Carreau),
}

impl Own {
    fn law(&self) -> &dyn Law {
        match self {
            Self::Rubber(law) => law,
            Self::Oil(law) => law,
        }
    }
}

/// A damper of a shape with these values.
pub(super) fn build(shape: &'static Shape, values: &[f64]) -> Arc<dyn Law> {
    let parts = shape.parts_of(values);
    let of = |i: usize| values[shape.dimensions + i];
    let strength = parts.factor * of(0) * unit(shape);
    let (law, exponent) = match shape.sheared {
        Sheared::Rubber => {
            let (glass_ratio, relaxation_time, exponent) = (of(1), of(2), of(3));
            (
                Own::Rubber(FractionalZener { ring_inertia: values[0], stiffness: strength, glass_ratio, relaxation_time, exponent }),
                exponent,
            )
        }
        Sheared::Oil => {
            let (relaxation_time, transition, flow_index) = (of(1), of(2), of(3));
            (Own::Oil(Carreau { ring_inertia: values[0], damping: strength, relaxation_time, transition, flow_index }), transition)
        }
    };
    Arc::new(Constructed { shape, values: values.to_vec(), parts, law, power: ImaginaryPower::new(exponent) })
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
        match &self.law {
            Own::Rubber(law) => law.stiffness_of(self.power.branchless(at.omega * law.relaxation_time)),
            Own::Oil(law) => law.stiffness_of(at.omega, self.power.of(at.omega * law.relaxation_time)),
        }
    }
    fn dynamic_stiffness_each(&self, at: &[Operating], out: &mut [C64]) {
        self.law.law().dynamic_stiffness_each(at, out);
    }
    fn loss_each(&self, at: &[Operating], out: &mut [f64]) {
        let mut s = [C64::ZERO; LANES];
        for (at, out) in at.chunks(LANES).zip(out.chunks_mut(LANES)) {
            self.dynamic_stiffness_each(at, &mut s[..at.len()]);
            out.iter_mut().zip(at.iter().zip(&s)).for_each(|(out, (at, s))| *out = 0.5 * at.omega * s.im);
        }
    }
    fn followed_each<'s>(&'s self, at: &'s [Operating]) -> Option<ByFactor<'s>> {
        self.law.law().followed_each(at)
    }
    fn is_analytic(&self) -> bool {
        self.law.law().is_analytic()
    }
    fn derivatives(&self, at: Operating) -> Vec<C64> {
        // S is proportional to B and to the modulus or viscosity
        let own = self.law.law().derivatives(at);
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
