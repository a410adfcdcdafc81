//! A rigid body on a node.

use super::{Real, across, cross, gyroscopic, tilting};
use nalgebra::{Matrix3, SMatrix, Vector3};

/// A rigid body, in turning axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// kg.
    pub mass: f64,
    /// Of its centre from its node, m.
    pub arm: Vector3<f64>,
    /// About its centre, kg m².
    pub tensor: Matrix3<f64>,
}

/// What a body puts on its node: M, G, and Kc - Z.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct OnNode {
    pub mass: Real,
    pub gyroscopic: Real,
    pub turning: Real,
}

impl Body {
    /// A mass without extent.
    pub fn point(mass: f64) -> Self {
        Self { mass, arm: Vector3::zeros(), tensor: Matrix3::zeros() }
    }

    /// Its matrices on a node at `place`: with A = [1, -S(d)] M = m A'A + I, G = 2 m A' S(e) A + g(I), Z = m A' P A,
    /// Kc = k(I) + (d·F) 1 - (d F' + F d')/2, F = m P (place + d).
    pub(crate) fn on(&self, place: Vector3<f64>) -> OnNode {
        let (m, d) = (self.mass, self.arm);
        let mut motion = SMatrix::<f64, 3, 6>::zeros();
        motion.fixed_view_mut::<3, 3>(0, 0).copy_from(&Matrix3::identity());
        motion.fixed_view_mut::<3, 3>(0, 3).copy_from(&-cross(d));
        let rotations = |block: Matrix3<f64>| {
            let mut whole = Real::zeros();
            whole.fixed_view_mut::<3, 3>(3, 3).copy_from(&block);
            whole
        };
        let force = across() * (place + d) * m;
        let preload = Matrix3::identity() * d.dot(&force) - (d * force.transpose() + force * d.transpose()) * 0.5;
        OnNode {
            mass: motion.transpose() * motion * m + rotations(self.tensor),
            gyroscopic: motion.transpose() * cross(Vector3::z()) * motion * (2.0 * m) + rotations(gyroscopic(&self.tensor)),
            turning: rotations(tilting(&self.tensor) + preload) - motion.transpose() * across() * motion * m,
        }
    }
}
