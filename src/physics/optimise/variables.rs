//! What may vary in the absorbers of a design, and the coordinates an optimiser sees.

use crate::absorber::{Absorber, Declaration, Host, Material, Mounted, WithMaterial};
use crate::numerics::elementary::Elementary;
use std::sync::Arc;

/// A parameter free between bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Variable {
    /// Index of the absorber in the design.
    pub absorber: usize,
    /// Index of the parameter in its declaration.
    pub parameter: usize,
    /// Not negative.
    pub lower: f64,
    /// Above `lower`.
    pub upper: f64,
    /// Where the coordinate turns from linear (below) to logarithmic (above): small against values that matter.
    pub scale: f64,
}

impl Variable {
    /// Coordinate of a value: asinh(x/scale). Logarithmic over the decades that matter, and zero stays within reach.
    pub fn coordinate(&self, x: f64) -> f64 {
        (x / self.scale).area_hyperbolic_sine()
    }

    /// Value of a coordinate, kept within the bounds.
    pub fn value(&self, w: f64) -> f64 {
        (self.scale * w.hyperbolic_sine()).clamp(self.lower, self.upper)
    }

    /// d value / d coordinate.
    pub fn slope(&self, x: f64) -> f64 {
        x.hypotenuse(self.scale)
    }
}

/// An absorber of a family: its type, its place, and the values of what does not vary.
#[derive(Debug, Clone, PartialEq)]
pub struct Slot {
    /// Type.
    pub declaration: &'static Declaration,
    /// What carries the hub.
    pub on: Host,
    /// kg m².
    pub hub_inertia: f64,
    /// A value for each parameter of the type; those of variables are not looked at.
    pub values: Vec<f64>,
    /// Its material.
    pub material: Arc<Material>,
}

/// A family of designs: absorbers of given types in their places.
#[derive(Debug, Clone, PartialEq)]
pub struct Space {
    /// The absorbers.
    pub slots: Vec<Slot>,
    /// What varies.
    pub variables: Vec<Variable>,
}

impl Space {
    /// Values of all parameters at a point, by absorber.
    pub fn values(&self, w: &[f64]) -> Vec<Vec<f64>> {
        let mut values: Vec<Vec<f64>> = self.slots.iter().map(|s| s.values.clone()).collect();
        for (v, w) in self.variables.iter().zip(w) {
            values[v.absorber][v.parameter] = v.value(*w);
        }
        values
    }

    /// The design at a point.
    pub fn design(&self, w: &[f64]) -> Vec<Mounted> {
        let mounted = |(slot, values): (&Slot, Vec<f64>)| {
            let absorber = Absorber::Ring(WithMaterial::of((slot.declaration.build)(&values), &slot.material));
            Mounted { on: slot.on, hub_inertia: slot.hub_inertia, absorber }
        };
        self.slots.iter().zip(self.values(w)).map(mounted).collect()
    }

    /// The design at a point, for a reader: type, parameter and value.
    pub(crate) fn named(&self, w: &[f64]) -> Vec<(&'static str, &'static str, f64)> {
        let named_values = |(slot, values): (&Slot, Vec<f64>)| {
            let declaration = slot.declaration;
            declaration.parameters.iter().zip(values).map(|(p, value)| (declaration.name, p.key, value)).collect::<Vec<_>>()
        };
        self.slots.iter().zip(self.values(w)).flat_map(named_values).collect()
    }

    /// The point of given values (a row an absorber), moved into the bounds.
    pub fn point(&self, values: &[Vec<f64>]) -> Vec<f64> {
        self.variables.iter().map(|v| v.coordinate(values[v.absorber][v.parameter].clamp(v.lower, v.upper))).collect()
    }

    /// The point of a design of the family, moved into the bounds.
    #[doc(hidden)]
    pub fn point_of(&self, design: &[Mounted]) -> Vec<f64> {
        self.point(&design.iter().filter_map(|m| m.absorber.law().map(|law| law.values())).collect::<Vec<_>>())
    }

    /// Bounds of each coordinate.
    pub fn bounds(&self) -> Vec<(f64, f64)> {
        self.variables.iter().map(|v| (v.coordinate(v.lower), v.coordinate(v.upper))).collect()
    }

    /// Derivatives with respect to the coordinates from those with respect to the parameters (a row an absorber; rows that are too short are
    /// of parameters without influence).
    pub(crate) fn chain_rule(&self, w: &[f64], gradient: &[Vec<f64>]) -> Vec<f64> {
        let by_parameter = |v: &Variable| gradient[v.absorber].get(v.parameter).copied().unwrap_or(0.0);
        self.variables.iter().zip(w).map(|(v, w)| by_parameter(v) * v.slope(v.value(*w))).collect()
    }

    /// Whether anything of an absorber varies.
    pub fn varies(&self, absorber: usize) -> bool {
        self.variables.iter().any(|v| v.absorber == absorber)
    }

    /// Whether another family has the same absorbers and variables, but for the ring inertia of its first absorber, which both hold, and for bounds, which may follow the ring.
    #[doc(hidden)]
    pub fn is_but_for_ring(&self, other: &Self) -> bool {
        let free = |space: &Self| -> Vec<(usize, usize)> { space.variables.iter().map(|v| (v.absorber, v.parameter)).collect() };
        let variables = free(self);
        let is_held = |i: usize, p: usize| (i, p) != (0, 0) && !variables.contains(&(i, p));
        let alike = |(i, (a, b)): (usize, (&Slot, &Slot))| {
            let held = (0..a.values.len()).filter(|p| is_held(i, *p)).all(|p| a.values[p] == b.values[p]);
            a.declaration == b.declaration && a.on == b.on && a.hub_inertia == b.hub_inertia && a.material == b.material && held
        };
        variables == free(other)
            && !variables.contains(&(0, 0))
            && self.slots.len() == other.slots.len()
            && self.slots.iter().zip(&other.slots).enumerate().all(alike)
    }

    /// The same family with the ring inertia of its first absorber held.
    #[must_use]
    pub(crate) fn with_ring_inertia(&self, ring_inertia: f64) -> Self {
        let mut space = self.clone();
        space.slots[0].values[0] = ring_inertia;
        space.variables.retain(|v| (v.absorber, v.parameter) != (0, 0));
        space
    }
}
