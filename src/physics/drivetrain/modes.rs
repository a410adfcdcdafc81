//! Undamped modes of a chain and what follows from them.

use super::{Chain, Station};
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
    /// Of a flexible crank.
    flexible: Option<Flexible>,
}

/// What modes of a flexible crank have beside the motion of its stations.
#[derive(Debug, Clone, PartialEq)]
#[doc(hidden)]
pub struct Flexible {
    /// phi' C phi.
    pub viscous: DMatrix<f64>,
    /// phi' (eta K) phi.
    pub hysteretic: DMatrix<f64>,
    /// Share of the kinetic energy of each in rotation about the axis.
    pub torsion: Vec<f64>,
}

/// An absorber in rotation about the axis leaves modes with a smaller share of it alone.
const COUPLED: f64 = 0.02;

impl Modes {
    /// Solves K phi = omega² J phi \[Villalva 2014\] eq. (4.2).
    pub fn new(chain: &Chain) -> Self {
        let (lambda, shapes) = eigen::generalised(&chain.stiffness_matrix(), &chain.inertias());
        let rigid = chain.rigid_bodies();
        let omega: Vec<f64> = lambda.iter().enumerate().map(|(i, l)| if i < rigid { 0.0 } else { l.max(0.0).sqrt() }).collect();
        let mut modes = Self { omega, shapes, rigid, damping: Vec::new(), flexible: None };
        modes.damping = modes.ratios(chain);
        modes
    }

    /// Modes of a flexible crank at rest: frequencies, motion of the stations about the axis, and the rest.
    #[doc(hidden)]
    pub fn flexible(omega: Vec<f64>, shapes: DMatrix<f64>, flexible: Flexible, chain: &Chain) -> Self {
        let rigid = omega.iter().filter(|w| **w == 0.0).count();
        let mut modes = Self { omega, shapes, rigid, damping: Vec::new(), flexible: Some(flexible) };
        modes.damping = modes.ratios(chain);
        modes
    }

    fn ratios(&self, chain: &Chain) -> Vec<f64> {
        (0..self.omega.len())
            .map(|i| {
                let omega = self.omega[i];
                if omega == 0.0 { 0.0 } else { 0.5 * self.damping_between(chain, i, i, omega) / omega }
            })
            .collect()
    }

    /// Element of the modal damping matrix phi' C phi, 1/s; hysteretic damping enters as the viscous damping equal to it at `omega`.
    pub(crate) fn damping_between(&self, chain: &Chain, i: usize, j: usize, omega: f64) -> f64 {
        if let Some(Flexible { viscous, hysteretic, .. }) = &self.flexible {
            return viscous[(i, j)] + if omega > 0.0 { hysteretic[(i, j)] / omega } else { 0.0 };
        }
        let phi = |station: usize, mode: usize| self.shapes[(station, mode)];
        let element = |(n, s): (usize, &Station)| {
            let to_ground = s.damping_to_ground * phi(n, i) * phi(n, j);
            let link = s.damping_to_next + if omega > 0.0 { s.stiffness_to_next * s.loss_factor_to_next / omega } else { 0.0 };
            let twist = |mode: usize| chain.link(n).of(|station| phi(station, mode));
            if link == 0.0 { to_ground } else { to_ground + link * twist(i) * twist(j) }
        };
        chain.stations.iter().enumerate().map(element).sum()
    }

    /// Modes that an absorber can move: all of a chain, those of a flexible crank that turn about the axis.
    pub(crate) fn coupled(&self) -> Vec<usize> {
        let is_coupled = |i: &usize| self.flexible.as_ref().is_none_or(|f| f.torsion[*i] >= COUPLED);
        (0..self.omega.len()).filter(is_coupled).collect()
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
