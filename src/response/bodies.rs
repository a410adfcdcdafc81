//! Chain and rings as bodies of their own: matrices of the whole system, for methods that do not condense the rings.

use super::Quantity;
use crate::absorber::{Kind, Mounted, Ring};
use crate::drivetrain::{Station, System};
use nalgebra::DMatrix;

/// Stations, then rings that move.
#[derive(Debug, Clone)]
pub struct Bodies {
    /// kg m², the diagonal of J.
    pub inertia: Vec<f64>,
    /// K, N m/rad.
    pub stiffness: DMatrix<f64>,
    /// C, N m s/rad.
    pub damping: DMatrix<f64>,
    /// Hysteretic part of the stiffness, eta k, N m/rad.
    pub hysteresis: DMatrix<f64>,
    /// Station and body of each absorber; locked rings are part of their station.
    pub rings: Vec<(usize, usize)>,
}

fn link(matrix: &mut DMatrix<f64>, i: usize, j: usize, value: f64) {
    matrix[(i, i)] += value;
    matrix[(j, j)] += value;
    matrix[(i, j)] -= value;
    matrix[(j, i)] -= value;
}

impl Bodies {
    /// Of a system with a design.
    pub fn new(system: &System, design: &[Mounted]) -> Self {
        let n = system.chain.len();
        let moving = design.iter().filter(|m| m.absorber.kind() != Kind::Locked).count();
        let zeros = || DMatrix::zeros(n + moving, n + moving);
        let mut bodies =
            Self { inertia: system.chain.inertias(), stiffness: zeros(), damping: zeros(), hysteresis: zeros(), rings: Vec::new() };
        for (i, s) in system.chain.stations.iter().enumerate() {
            bodies.stiffness[(i, i)] += s.stiffness_to_ground;
            bodies.damping[(i, i)] += s.damping_to_ground;
            if i + 1 < n {
                bodies.shaft(i, s);
            }
        }
        for m in design {
            let a = &m.absorber;
            bodies.inertia[m.station] += m.hub_inertia;
            if a.kind() == Kind::Locked {
                bodies.inertia[m.station] += a.ring_inertia();
                bodies.rings.push((m.station, m.station));
                continue;
            }
            let body = bodies.inertia.len();
            bodies.inertia.push(a.ring_inertia());
            link(&mut bodies.stiffness, m.station, body, a.stiffness());
            link(&mut bodies.damping, m.station, body, a.damping());
            bodies.rings.push((m.station, body));
        }
        bodies
    }

    fn shaft(&mut self, i: usize, s: &Station) {
        link(&mut self.stiffness, i, i + 1, s.stiffness_to_next);
        link(&mut self.damping, i, i + 1, s.damping_to_next);
        link(&mut self.hysteresis, i, i + 1, s.stiffness_to_next * s.loss_factor_to_next);
    }

    /// Number of bodies.
    pub fn len(&self) -> usize {
        self.inertia.len()
    }

    /// Never true.
    pub fn is_empty(&self) -> bool {
        self.inertia.is_empty()
    }

    /// The two bodies whose angles differ by a quantity; `None`: the ground, or nothing for the torque of a shaft.
    pub fn between(&self, quantity: Quantity) -> (usize, Option<usize>) {
        match quantity {
            Quantity::Twist { from, to } => (from, to),
            Quantity::ShaftTorque(s) => (s, Some(s + 1)),
            Quantity::RingTwist(r) => (self.rings[r].1, Some(self.rings[r].0)),
        }
    }
}
