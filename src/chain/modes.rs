//! Undamped modes of a chain and what follows from them.

use super::Chain;
use crate::engine::Order;
use crate::numerics::eigen;
use crate::units::{HZ_PER_RAD_PER_S, HZ_PER_RPM};
use nalgebra::DMatrix;

/// Undamped modes, ascending. Rigid ones come first, with frequency exactly zero.
#[derive(Debug, Clone, PartialEq)]
pub struct Modes {
    /// Circular natural frequencies, rad/s.
    pub omega: Vec<f64>,
    /// Mode shapes in columns, scaled to phi' J phi = 1 (unit 1/sqrt(kg m²)).
    pub shapes: DMatrix<f64>,
    /// How many modes are rigid.
    pub rigid: usize,
    damping: Vec<f64>,
}

impl Modes {
    /// Solves K phi = omega² J phi \[Villalva 2014\] eq. (4.2).
    pub fn new(chain: &Chain) -> Self {
        let (lambda, shapes) = eigen::generalised(&chain.stiffness_matrix(), &chain.inertias());
        let rigid = chain.rigid_bodies();
        let omega: Vec<f64> = lambda.iter().enumerate().map(|(i, l)| if i < rigid { 0.0 } else { l.max(0.0).sqrt() }).collect();
        let c = chain.damping_matrix();
        let hysteretic = chain.assemble(|s| s.stiffness_to_next * s.loss_factor_to_next, |_| 0.0);
        let damping = (0..omega.len())
            .map(|i| {
                let phi = shapes.column(i);
                let quadratic = |m: &DMatrix<f64>| (m * phi).dot(&phi);
                if omega[i] == 0.0 { 0.0 } else { 0.5 * (quadratic(&c) / omega[i] + quadratic(&hysteretic) / (omega[i] * omega[i])) }
            })
            .collect();
        Self { omega, shapes, rigid, damping }
    }

    /// Elastic modes: indices of modes with a frequency.
    pub fn elastic(&self) -> std::ops::Range<usize> {
        self.rigid..self.omega.len()
    }

    /// Natural frequencies of the elastic modes, Hz.
    pub fn frequencies_hz(&self) -> Vec<f64> {
        self.elastic().map(|i| self.omega[i] * HZ_PER_RAD_PER_S).collect()
    }

    /// Fraction of critical damping of a mode from the diagonal of the modal damping matrix, hysteretic damping at the natural frequency
    /// included. An estimate: good for light damping.
    pub fn damping_ratio(&self, mode: usize) -> f64 {
        self.damping[mode]
    }

    /// Inertia that, put at `station`, has the kinetic energy of the mode: 1/phi², kg m²; infinite at a node.
    pub fn equivalent_inertia(&self, mode: usize, station: usize) -> f64 {
        let phi = self.shapes[(station, mode)];
        1.0 / (phi * phi)
    }

    /// Speed at which an order meets a mode, rpm.
    pub fn critical_speed_rpm(&self, mode: usize, order: Order) -> f64 {
        self.omega[mode] * HZ_PER_RAD_PER_S / HZ_PER_RPM / order.value()
    }
}
