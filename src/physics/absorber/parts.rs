//! What the drawing of a damper comes to: sizes, masses and inertias, with their derivatives by its dimensions where they are asked for.

use crate::numerics::dual::Dual;

/// Most dimensions of a shape, the inertia of the ring among them.
pub const MOST: usize = 8;
/// A length, area or inertia with its derivatives by the dimensions.
pub type Number = Dual<MOST>;

/// What a drawing comes to, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parts<T> {
    /// B of what is sheared, m³.
    pub factor: T,
    /// Largest shear strain per twist, 1/rad.
    pub strain_per_twist: T,
    /// Of a housing, kg m²; zero where the hub is another part.
    pub hub_inertia: T,
    /// kg.
    pub ring_mass: T,
    /// Of a housing, kg.
    pub hub_mass: T,
    /// Of what is sheared, m³.
    pub sheared_volume: T,
    /// Outer diameter of all of it, m.
    pub outer_diameter: T,
    /// Width of all of it, m.
    pub width: T,
    /// Diameter that is free inside: of what is sheared, or of the housing, m.
    pub bore: T,
    /// Inner and outer radius of the ring, m.
    pub ring: [T; 2],
    /// Width of the ring, m.
    pub ring_width: T,
    /// Length of a sleeve or a wedge at its outer edge, thickness of a disc, radial gap of a housing, m.
    pub sheared_length: T,
}

impl<T: Copy> Parts<T> {
    pub(super) fn map<U>(&self, f: impl Fn(T) -> U) -> Parts<U> {
        Parts {
            factor: f(self.factor),
            strain_per_twist: f(self.strain_per_twist),
            hub_inertia: f(self.hub_inertia),
            ring_mass: f(self.ring_mass),
            hub_mass: f(self.hub_mass),
            sheared_volume: f(self.sheared_volume),
            outer_diameter: f(self.outer_diameter),
            width: f(self.width),
            bore: f(self.bore),
            ring: self.ring.map(&f),
            ring_width: f(self.ring_width),
            sheared_length: f(self.sheared_length),
        }
    }
}

/// What is sheared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sheared {
    /// Rubber.
    Rubber,
    /// Silicone oil.
    Oil,
}

/// Density of rubber where no compound is named, kg/m³: assumption.
const RUBBER_DENSITY: f64 = 1150.0;
/// Density of silicone oil where none is named, kg/m³: assumption, 960 to 980 for all viscosities that matter.
const OIL_DENSITY: f64 = 970.0;

impl Sheared {
    /// Density where none is named, kg/m³: assumption.
    #[doc(hidden)]
    pub fn density(self) -> f64 {
        match self {
            Self::Rubber => RUBBER_DENSITY,
            Self::Oil => OIL_DENSITY,
        }
    }
}
