//! What ties a ring to its hub: a complex dynamic stiffness, and what hartog is told of its type in one place. Schema, validation, tables, columns and the variables
//! of optimisers come from the declaration; the response methods ask for S and its derivatives, and know no types.

use super::closed_forms::EngineMode;
use super::dynamic_stiffness::{Operating, OperatingOver, SpringAndDamper};
use super::large_twist::LargeTwist;
use super::material::Material;
use super::material_state::State;
use super::parameter::{Follows, Parameter, STIFFNESS};
use super::parts::{Number, Parts};
use crate::numerics::C64;
use crate::numerics::taylor::Taylor;
use std::fmt::Debug;
use std::sync::Arc;

/// S at some points by the logarithm of a factor: real and imaginary part of a numerator, and a real denominator.
pub(crate) type ByFactor<'s> = Box<dyn Fn(f64, [&mut [f64]; 3]) + 's>;

/// The law of a ring: torque from hub to ring per twist between them, S(omega, shaft speed), N m/rad. A law is passive (Im S >= 0 for omega > 0).
pub trait Law: Debug + Send + Sync {
    /// The type, with its parameters.
    fn declaration(&self) -> &'static Declaration;

    /// Values of the declared parameters in their order, ring inertia first.
    fn values(&self) -> Vec<f64>;

    /// Inertia of the ring, kg m²: the first of the values.
    fn ring_inertia(&self) -> f64;

    /// S, N m/rad.
    fn dynamic_stiffness(&self, at: Operating) -> C64;

    /// Derivatives of S with respect to the declared parameters, one each; with respect to the ring inertia zero where S does not depend on it.
    fn derivatives(&self, at: Operating) -> Vec<C64>;

    /// The spring and the damper, where S is that of constant ones: methods then need no S at every frequency, and methods in time apply.
    fn spring_and_damper(&self) -> Option<SpringAndDamper> {
        None
    }

    /// Whether S depends on the speed of the shaft.
    fn depends_on_speed(&self) -> bool {
        false
    }

    /// Whether S depends on frequency alone, and is an analytic function of ln omega within π/2 of the real axis, as functions of (i omega tau)^a are for 0 < a <= 1: tables then compute it at a
    /// few frequencies, and by polynomials, to rounding, at all others.
    fn is_analytic(&self) -> bool {
        false
    }

    /// The same law with other values of the declared parameters.
    fn rebuilt(&self, values: &[f64]) -> Arc<dyn Law> {
        (self.declaration().build)(values)
    }

    /// The law in a state of its material; nothing where that changes nothing.
    fn in_state(&self, _: State) -> Option<Arc<dyn Law>> {
        None
    }

    /// What is known of its material; nothing where nothing is said of it.
    fn material(&self) -> Option<&Material> {
        None
    }

    /// Inertia of a hub or housing that is part of it, kg m²: beside that of a design.
    fn hub_inertia(&self) -> f64 {
        0.0
    }

    /// What its dimensions come to; `None` where it is no damper by its dimensions.
    fn parts(&self) -> Option<&Parts<f64>> {
        None
    }

    /// The same with the derivatives with respect to its dimensions, which are the first of the declared parameters.
    fn parts_by_dimensions(&self) -> Option<Box<Parts<Number>>> {
        None
    }

    /// Largest shear strain per twist, 1/rad: of its dimensions, or of the shape that its material gives; `None` where neither is known, or nothing is sheared.
    fn strain_per_twist(&self) -> Option<f64> {
        match self.parts() {
            Some(parts) => Some(parts.strain_per_twist).filter(|s| *s > 0.0),
            None => Some(self.material()?.geometry?.strain_per_twist()),
        }
    }

    /// Largest stress of its springs per twist, Pa/rad; `None` where no dimensions tell it.
    fn stress_per_twist(&self) -> Option<f64> {
        self.parts().map(|p| p.stress_per_twist).filter(|s| *s > 0.0)
    }

    /// Its equations at large twist; nothing where S is all there is to the law.
    fn large_twist(&self) -> Option<&dyn LargeTwist> {
        None
    }

    /// S at many points.
    fn dynamic_stiffness_each(&self, at: &[Operating], out: &mut [C64]) {
        for (out, at) in out.iter_mut().zip(at) {
            *out = self.dynamic_stiffness(*at);
        }
    }

    /// S at some points by the logarithm of the factor that temperature puts on the material ([`Parameter::follows`]), where what does not depend on it is worth computing once.
    fn followed_each<'s>(&'s self, _: &'s [Operating]) -> Option<ByFactor<'s>> {
        None
    }

    /// S where declared parameters, frequency and speed are anything that these models hold, complex ones with them; `None` where the type has no enclosure, or where these are too wide for it.
    fn over(&self, _values: &[Taylor], _at: &OperatingOver) -> Option<Taylor> {
        None
    }

    /// S = P/Q with P and Q linear in each declared parameter by itself, for values of these; the inertia of the ring is the first of them, and in neither. `None` where the law is no such quotient.
    fn quotient(&self, _values: &[f64], _at: Operating) -> Option<[C64; 2]> {
        None
    }

    /// The inertia of the ring where declared parameters are anything that these models hold.
    fn ring_over(&self, values: &[Taylor]) -> Taylor {
        values[0]
    }

    /// Mean power dissipated at one frequency per square of the twist's amplitude (zero to peak), W/rad²: omega Im S/2.
    fn loss(&self, at: Operating) -> f64 {
        match self.spring_and_damper() {
            Some(s) => 0.5 * s.damping * at.omega * at.omega,
            None => 0.5 * at.omega * self.dynamic_stiffness(at).im,
        }
    }

    /// The same at many points.
    fn loss_each(&self, at: &[Operating], out: &mut [f64]) {
        out.iter_mut().zip(at).for_each(|(out, at)| *out = self.loss(*at));
    }

    /// Mean power dissipated at one frequency by a twist whose amplitude (rad, zero to peak) has this square, W.
    fn dissipated_power(&self, at: Operating, twist_square: f64) -> f64 {
        self.loss(at) * twist_square
    }
}

/// A closed-form optimum of a type.
#[derive(Debug, Clone, Copy)]
pub struct ClosedForm {
    /// The word used in studies.
    pub name: &'static str,
    /// Whether searches start from it for every mode, or for the first one only.
    pub every_mode: bool,
    /// Whether it is an optimum of its source; else it is a start only, and no design can be seeded by it.
    pub is_optimum: bool,
    /// Values of the type's parameters for a ring of this inertia (kg m²) on this mode.
    pub values: fn(f64, EngineMode) -> Vec<f64>,
}

/// A type of absorber.
pub struct Declaration {
    /// The word used in studies and tables.
    pub name: &'static str,
    /// What it is, in a sentence.
    pub about: &'static str,
    /// Its parameters, the ring inertia first.
    pub parameters: &'static [Parameter],
    /// A law with these values.
    pub build: fn(&[f64]) -> Arc<dyn Law>,
    /// Closed-form optima: where searches start.
    pub closed_forms: &'static [ClosedForm],
}

impl std::fmt::Debug for Declaration {
    /// Its name, which tells all of it.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

impl PartialEq for Declaration {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Declaration {}

impl Declaration {
    /// Factors on the parameters where temperature changes the material by a factor.
    #[doc(hidden)]
    pub fn followed(&self, factor: f64) -> Vec<f64> {
        let factor_of = |p: &Parameter| match p.follows {
            Follows::Nothing => 1.0,
            Follows::Factor => factor,
            Follows::Inverse => 1.0 / factor,
        };
        self.parameters.iter().map(factor_of).collect()
    }

    /// Whether its stiffness itself is multiplied by the factor: a law that is the same at every frequency, where a shift of frequency means nothing.
    #[doc(hidden)]
    pub fn stiffness_follows(&self) -> bool {
        self.parameters.iter().any(|p| p.key == STIFFNESS.key && p.follows == Follows::Factor)
    }

    /// Index of a parameter by its key.
    pub fn index(&self, key: &str) -> Option<usize> {
        self.parameters.iter().position(|p| p.key == key)
    }
}
