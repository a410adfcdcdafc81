//! The equations of a chain with the torques of its shafts as unknowns beside the angles of its stations.
//!
//! Equilibrium of station i: g_i theta_i + tau_i - (gear times torque of every shaft that leads to it) = T_i; of its shaft: theta_i - gear theta_next - tau_i/s_i = 0. A rigid shaft has 1/s = 0: unlike in the
//! stiffness matrix nothing is added to a huge stiffness and lost in its rounding. Stations and shafts follow each other (station, shaft after it, the next station), so that a row stays a row and a tree a tree.

use crate::drivetrain::Chain;
use crate::numerics::sparse::Sparse;
use crate::numerics::{C64, ZERO};

/// The equations at one frequency. The unknown of a shaft is its torque over its unit, which gives all unknowns and equations one size.
#[derive(Debug)]
pub(super) struct ShaftTorques {
    pub matrix: Sparse,
    /// Unit of each shaft's torque, N m.
    unit: Vec<f64>,
    stiffness: Vec<C64>,
}

impl ShaftTorques {
    /// Of a chain, without numbers yet.
    pub fn new(chain: &Chain) -> Self {
        let (n, parent) = (chain.len(), |node: usize| if node.is_multiple_of(2) { node + 1 } else { 2 * chain.next(node / 2) });
        let matrix = if chain.is_row() { Sparse::row(2 * n - 1) } else { Sparse::tree((0..2 * n - 2).map(parent).collect()) };
        Self { matrix, unit: vec![0.0; n - 1], stiffness: vec![ZERO; n - 1] }
    }

    /// Place of a station among the unknowns.
    pub fn place(station: usize) -> usize {
        2 * station
    }

    /// Sets all that the shafts put into the equations; `size`: of what ties stations to inertial space, N m/rad.
    pub fn set(&mut self, chain: &Chain, omega: f64, size: f64) {
        for i in 0..chain.len() - 1 {
            let s = chain.shaft_stiffness(i, omega);
            let unit = s.norm().min(size);
            (self.unit[i], self.stiffness[i]) = (unit, s);
            // no shaft, no torque
            self.matrix.diagonal()[2 * i + 1] = if unit == 0.0 { C64::from(-size) } else { -(unit / s) * unit };
            self.matrix.set_link(2 * i, C64::from(unit));
            self.matrix.set_link(2 * i + 1, C64::from(-unit * chain.gear(i)));
        }
    }

    /// Torque of a shaft from a solution, N m.
    pub fn torque(&self, shaft: usize, x: &[C64]) -> C64 {
        self.unit[shaft] * x[2 * shaft + 1]
    }

    /// Twist of a shaft from a solution, rad; nothing where it is hardly joined, and angles tell.
    pub fn twist(&self, shaft: usize, x: &[C64]) -> Option<C64> {
        let s = self.stiffness[shaft];
        (self.unit[shaft] < s.norm()).then(|| self.torque(shaft, x) / s)
    }
}
