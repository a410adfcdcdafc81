//! What joins any nodes of a shaft with each other, as a reduced structure does: matrices over all unknowns.

use super::motion::{Answer, Turning};
use crate::numerics::C64;
use nalgebra::{DMatrix, DVector};

/// Matrices over all unknowns of a shaft, six a node.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Superelement {
    pub stiffness: DMatrix<f64>,
    /// Loss factors times stiffness.
    pub loss: DMatrix<f64>,
    pub damping: DMatrix<f64>,
    pub mass: DMatrix<f64>,
    pub gyroscopic: DMatrix<f64>,
    /// K_s + Kc - Z.
    pub turning: DMatrix<f64>,
}

/// The factors of unknowns as a vector over all of them.
pub(super) fn vector(factors: &Answer, unknowns: usize) -> DVector<f64> {
    let mut all = DVector::zeros(unknowns);
    factors.iter().for_each(|(node, k, factor)| all[6 * node + k] += factor);
    all
}

impl Superelement {
    /// Nothing, over the unknowns of so many nodes.
    pub fn zeros(nodes: usize) -> Self {
        let zeros = || DMatrix::zeros(6 * nodes, 6 * nodes);
        Self { stiffness: zeros(), loss: zeros(), damping: zeros(), mass: zeros(), gyroscopic: zeros(), turning: zeros() }
    }

    /// A spring with a loss and a damper against a motion.
    pub fn tie(&mut self, motion: &Answer, [stiffness, loss, damping]: [f64; 3]) {
        let v = vector(motion, self.mass.nrows());
        let block = &v * v.transpose();
        self.stiffness += &block * stiffness;
        self.loss += &block * loss;
        self.damping += block * damping;
    }

    /// What a pull across a motion does to it, per square of the speed.
    pub fn pull(&mut self, motion: &Answer, stiffness: f64) {
        let v = vector(motion, self.mass.nrows());
        self.turning += &v * v.transpose() * stiffness;
    }

    /// Leaves out what rotation does.
    pub(super) fn without_rotation(&mut self) {
        self.gyroscopic.fill(0.0);
        self.turning.fill(0.0);
    }

    /// Its dynamic stiffness between two unknowns.
    pub fn between(&self, (i, j): (usize, usize), at: Turning) -> C64 {
        let (w, speed, place) = (at.omega, at.speed, (i, j));
        C64::new(
            self.stiffness[place] - self.mass[place] * (w * w) + self.turning[place] * (speed * speed),
            self.loss[place] + w * (self.damping[place] + speed * self.gyroscopic[place]),
        )
    }
}
