//! What is known of the material of an absorber besides its law.

use super::cooling::Cooling;
use super::geometry::Geometry;
use super::kraus::Kraus;
use super::life::StrainLife;
use super::material_state::State;
use super::substance::Substance;
use super::temperature::TemperatureLaw;
use std::sync::Arc;

/// Factors on the parameters of a type in a state, in the order of their declaration.
#[derive(Debug, Clone, PartialEq)]
pub struct Factors {
    /// The state.
    pub state: State,
    /// One for the ring inertia.
    pub factors: Vec<f64>,
}

/// What decides the temperature of an absorber.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thermal {
    /// How the material follows it.
    pub law: TemperatureLaw,
    /// What cools it.
    pub cooling: Cooling,
}

/// What is known of a material and of how it is used.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Material {
    /// Its states.
    pub states: Vec<Factors>,
    /// What decides its temperature.
    pub thermal: Option<Thermal>,
    /// What of it is sheared.
    pub geometry: Option<Geometry>,
    /// How it follows the amplitude of its strain, where the geometry tells that.
    pub amplitude: Option<Kraus>,
    /// Cycles of that strain that it bears.
    pub life: Option<StrainLife>,
    /// The compound or oil, where a study names one.
    pub substance: Option<Arc<Substance>>,
}

impl Material {
    /// What a state leaves of it: the cycles of strain that it bears, with the shape that is sheared.
    pub(super) fn lasting(&self) -> Self {
        Self {
            geometry: self.geometry.filter(|_| self.life.is_some()),
            life: self.life,
            substance: self.substance.clone(),
            ..Self::default()
        }
    }

    /// Whether it says that its state follows from the motion: by heat, or by strain.
    pub(crate) fn follows_motion(&self) -> bool {
        self.thermal.is_some() || self.amplitude.is_some()
    }
}
