//! What may vary in an absorber, and the coordinates an optimiser sees.

use crate::absorber::{Kind, Mounted, Ring};

/// A value of an absorber.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parameter {
    /// kg m².
    RingInertia,
    /// N m/rad.
    Stiffness,
    /// N m s/rad.
    Damping,
}

/// A value free between bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Variable {
    /// Which value.
    pub parameter: Parameter,
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
        (x / self.scale).asinh()
    }

    /// Value of a coordinate, kept within the bounds.
    pub fn value(&self, w: f64) -> f64 {
        (self.scale * w.sinh()).clamp(self.lower, self.upper)
    }

    /// d value / d coordinate.
    pub fn slope(&self, x: f64) -> f64 {
        x.hypot(self.scale)
    }
}

/// A family of absorbers on one station.
#[derive(Debug, Clone, PartialEq)]
pub struct Space {
    /// Type.
    pub kind: Kind,
    /// Station of the hub.
    pub station: usize,
    /// kg m².
    pub hub_inertia: f64,
    /// Ring inertia, stiffness and damping where they do not vary.
    pub fixed: [f64; 3],
    /// What varies.
    pub variables: Vec<Variable>,
}

impl Space {
    /// The absorber at a point.
    pub fn absorber(&self, w: &[f64]) -> Mounted {
        let mut values = self.fixed;
        for (v, w) in self.variables.iter().zip(w) {
            values[v.parameter as usize] = v.value(*w);
        }
        let absorber = self.kind.build(values[0], values[1], values[2]);
        Mounted { station: self.station, hub_inertia: self.hub_inertia, absorber }
    }

    /// The point of an absorber, moved into the bounds.
    pub fn point(&self, absorber: &impl Ring) -> Vec<f64> {
        let values = [absorber.ring_inertia(), absorber.stiffness(), absorber.damping()];
        self.variables.iter().map(|v| v.coordinate(values[v.parameter as usize].clamp(v.lower, v.upper))).collect()
    }

    /// Bounds of each coordinate.
    pub fn bounds(&self) -> Vec<(f64, f64)> {
        self.variables.iter().map(|v| (v.coordinate(v.lower), v.coordinate(v.upper))).collect()
    }

    /// Derivatives with respect to the coordinates from those with respect to ring inertia, stiffness and damping.
    pub fn chain_rule(&self, w: &[f64], gradient: [f64; 3]) -> Vec<f64> {
        self.variables.iter().zip(w).map(|(v, w)| gradient[v.parameter as usize] * v.slope(v.value(*w))).collect()
    }

    /// The same family with the ring inertia held.
    pub fn with_ring_inertia(&self, ring_inertia: f64) -> Self {
        let mut space = self.clone();
        space.fixed[Parameter::RingInertia as usize] = ring_inertia;
        space.variables.retain(|v| v.parameter != Parameter::RingInertia);
        space
    }
}
