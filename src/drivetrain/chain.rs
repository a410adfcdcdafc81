//! The torsional chain: rigid stations in a row, joined by shaft lengths.

use crate::numerics::{C64, I};
use nalgebra::DMatrix;

/// A rigid inertia, with what joins it to the next one and to the ground.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Station {
    /// Unique in the chain.
    pub name: String,
    /// kg m².
    pub inertia: f64,
    /// N m/rad; zero joins nothing.
    pub stiffness_to_next: f64,
    /// N m s/rad.
    pub damping_to_next: f64,
    /// Hysteretic: the shaft's complex stiffness is k (1 + i eta).
    pub loss_factor_to_next: f64,
    /// N m/rad.
    pub stiffness_to_ground: f64,
    /// N m s/rad.
    pub damping_to_ground: f64,
    /// Throws (from 0) whose torque acts here.
    pub throws: Vec<usize>,
}

/// Stations in a row; the last one's `*_to_next` are zero.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// At least one.
    pub stations: Vec<Station>,
}

impl Chain {
    /// Number of stations.
    pub fn len(&self) -> usize {
        self.stations.len()
    }

    /// Never true for a checked chain.
    pub fn is_empty(&self) -> bool {
        self.stations.is_empty()
    }

    /// Index of a station by name.
    pub fn find(&self, name: &str) -> Option<usize> {
        self.stations.iter().position(|s| s.name == name)
    }

    /// Name of a shaft length.
    pub(crate) fn shaft_name(&self, shaft: usize) -> String {
        format!("{}-{}", self.stations[shaft].name, self.stations[shaft + 1].name)
    }

    /// Complex stiffness of the shaft after station `shaft` at circular frequency `omega`: k (1 + i eta) + i omega c, N m/rad.
    pub(crate) fn shaft_stiffness(&self, shaft: usize, omega: f64) -> C64 {
        let s = &self.stations[shaft];
        C64::new(s.stiffness_to_next, s.stiffness_to_next * s.loss_factor_to_next + omega * s.damping_to_next)
    }

    /// What ties station `i` to inertial space at `omega`: k + i omega c - omega² J, N m/rad.
    pub(crate) fn ground_stiffness(&self, i: usize, omega: f64) -> C64 {
        let s = &self.stations[i];
        s.stiffness_to_ground - omega * omega * s.inertia + I * (omega * s.damping_to_ground)
    }

    /// Sum of all inertias, kg m².
    pub fn total_inertia(&self) -> f64 {
        self.stations.iter().map(|s| s.inertia).sum()
    }

    /// Inertias, kg m²: the diagonal of J.
    pub fn inertias(&self) -> Vec<f64> {
        self.stations.iter().map(|s| s.inertia).collect()
    }

    /// K, N m/rad (n by n).
    pub fn stiffness_matrix(&self) -> DMatrix<f64> {
        let n = self.len();
        let mut k = DMatrix::zeros(n, n);
        for (i, s) in self.stations.iter().enumerate() {
            k[(i, i)] += s.stiffness_to_ground;
            if i + 1 < n {
                k[(i, i)] += s.stiffness_to_next;
                k[(i + 1, i + 1)] += s.stiffness_to_next;
                k[(i, i + 1)] -= s.stiffness_to_next;
                k[(i + 1, i)] -= s.stiffness_to_next;
            }
        }
        k
    }

    /// Bodies that no spring ties to the ground: shafts without stiffness cut the chain. Each has one rigid mode.
    pub fn rigid_bodies(&self) -> usize {
        let mut free = 0;
        let mut tied = false;
        for (i, s) in self.stations.iter().enumerate() {
            tied |= s.stiffness_to_ground > 0.0;
            if i + 1 == self.len() || s.stiffness_to_next == 0.0 {
                free += usize::from(!tied);
                tied = false;
            }
        }
        free
    }
}
