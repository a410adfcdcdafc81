//! What the drawing of a damper comes to: sizes, masses and inertias, with their derivatives by its dimensions where they are asked for.

use crate::numerics::dual::Dual;

/// Most dimensions of a shape, the inertia of the ring among them.
pub const MOST: usize = 9;
/// A length, area or inertia with its derivatives by the dimensions.
pub type Number = Dual<MOST>;

/// What a drawing comes to, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parts<T> {
    /// What its law is as strong as: B of what is sheared, m³; static stiffness of springs, N m/rad; square of the order that pendulums are tuned to.
    pub factor: T,
    /// Largest shear strain per twist, 1/rad; zero where neither rubber nor oil is sheared.
    pub strain_per_twist: T,
    /// Largest stress of the springs per twist, Pa/rad: of bending or of shear; zero where there are none.
    pub stress_per_twist: T,
    /// Of a housing, or of pendulum masses about their own centres, kg m²: what moves with the hub; zero where the hub is another part.
    pub hub_inertia: T,
    /// Of the ring, or of the pendulum masses, kg.
    pub ring_mass: T,
    /// Of a housing, kg.
    pub hub_mass: T,
    /// Of what is sheared, or of the springs, m³.
    pub element_volume: T,
    /// Outer diameter of all of it, m.
    pub outer_diameter: T,
    /// Width of all of it, m.
    pub width: T,
    /// Diameter that is free inside: of what is sheared, of the springs, or of the housing, m.
    pub bore: T,
    /// Inner and outer radius of the ring, m.
    pub ring: [T; 2],
    /// Width of the ring, m.
    pub ring_width: T,
    /// Length of a sleeve or a wedge at its outer edge, thickness of a disc, radial gap of a housing, width of a leaf, outer diameter of a coil, m; zero of pendulums.
    pub element_length: T,
    /// Where the torque acts: of the slots that leaves rest in, of the axes of coil springs, of the centres of pendulum masses, m; zero of what is sheared.
    pub radius: T,
}

impl<T: Copy> Parts<T> {
    pub(super) fn map<U>(&self, f: impl Fn(T) -> U) -> Parts<U> {
        Parts {
            factor: f(self.factor),
            strain_per_twist: f(self.strain_per_twist),
            stress_per_twist: f(self.stress_per_twist),
            hub_inertia: f(self.hub_inertia),
            ring_mass: f(self.ring_mass),
            hub_mass: f(self.hub_mass),
            element_volume: f(self.element_volume),
            outer_diameter: f(self.outer_diameter),
            width: f(self.width),
            bore: f(self.bore),
            ring: self.ring.map(&f),
            ring_width: f(self.ring_width),
            element_length: f(self.element_length),
            radius: f(self.radius),
        }
    }
}

/// What carries the ring.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Medium {
    /// Rubber, which is sheared.
    Rubber,
    /// Silicone oil, which is sheared.
    Oil,
    /// Leaf springs of steel.
    Leaves,
    /// Coil springs of steel.
    Coils,
    /// The centrifugal field, of pendulums.
    Field,
}

/// Density of rubber where no compound is named, kg/m³: assumption.
const RUBBER_DENSITY: f64 = 1150.0;
/// Density of silicone oil where none is named, kg/m³: assumption, 960 to 980 for all viscosities that matter.
const OIL_DENSITY: f64 = 970.0;
/// Density of spring steel, kg/m³: assumption, the same within half a per cent for all that springs are made of.
const SPRING_STEEL_DENSITY: f64 = 7850.0;

impl Medium {
    /// Density where none is named, kg/m³: assumption.
    #[doc(hidden)]
    pub fn density(self) -> f64 {
        match self {
            Self::Rubber => RUBBER_DENSITY,
            Self::Oil => OIL_DENSITY,
            Self::Leaves | Self::Coils => SPRING_STEEL_DENSITY,
            Self::Field => 0.0,
        }
    }

    /// Whether it is sheared: a compound or an oil, which studies name.
    #[doc(hidden)]
    pub fn is_sheared(self) -> bool {
        match self {
            Self::Rubber | Self::Oil => true,
            Self::Leaves | Self::Coils | Self::Field => false,
        }
    }

    /// Whether it is a spring, whose stress counts.
    #[doc(hidden)]
    pub fn is_spring(self) -> bool {
        match self {
            Self::Leaves | Self::Coils => true,
            Self::Rubber | Self::Oil | Self::Field => false,
        }
    }
}
