//! Chain and rings as bodies of their own: matrices of the whole system, for methods that do not condense the rings.

use super::Quantity;
use crate::absorber::{Absorber, Host, Law, Mounted};
use crate::drivetrain::{Chain, Difference, Station, System};
use nalgebra::DMatrix;
use std::sync::Arc;

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
    /// The two bodies of each absorber, what carries it and its ring; of a locked ring both are the carrier.
    pub rings: Vec<(usize, usize)>,
    /// Laws that are no constant spring and damper, with the absorbers they belong to: not in the matrices.
    pub laws: Vec<(usize, Arc<dyn Law>)>,
}

/// Adds what acts on angle i less `gear` times angle j.
fn link(matrix: &mut DMatrix<f64>, i: usize, (j, gear): (usize, f64), value: f64) {
    matrix[(i, i)] += value;
    matrix[(j, j)] += value * gear * gear;
    matrix[(i, j)] -= value * gear;
    matrix[(j, i)] -= value * gear;
}

/// Body of the ring of an absorber: rings that move follow the stations.
fn ring_body(design: &[Mounted], index: usize, stations: usize) -> usize {
    stations + design[..index].iter().filter(|m| m.absorber.law().is_some()).count()
}

/// Body that carries a hub.
fn host_body(design: &[Mounted], on: Host, stations: usize) -> usize {
    match on {
        Host::Station(station) => station,
        Host::Ring(inner) if design[inner].absorber.law().is_none() => host_body(design, design[inner].on, stations),
        Host::Ring(inner) => ring_body(design, inner, stations),
    }
}

impl Bodies {
    /// Of a system with a design.
    pub fn new(system: &System, design: &[Mounted]) -> Self {
        let n = system.chain.len();
        let moving = design.iter().filter(|m| m.absorber.law().is_some()).count();
        let zeros = || DMatrix::zeros(n + moving, n + moving);
        let inertia = system.chain.inertias().into_iter().chain(std::iter::repeat_n(0.0, moving)).collect();
        let mut bodies = Self { inertia, stiffness: zeros(), damping: zeros(), hysteresis: zeros(), rings: Vec::new(), laws: Vec::new() };
        for (i, s) in system.chain.stations.iter().enumerate() {
            bodies.stiffness[(i, i)] += s.stiffness_to_ground;
            bodies.damping[(i, i)] += s.damping_to_ground;
            if i + 1 < n {
                bodies.shaft(i, (system.chain.next(i), system.chain.gear(i)), s);
            }
        }
        for (index, m) in design.iter().enumerate() {
            let host = host_body(design, m.on, n);
            bodies.inertia[host] += m.hub();
            let Absorber::Ring(law) = &m.absorber else {
                bodies.inertia[host] += m.absorber.ring_inertia();
                bodies.rings.push((host, host));
                continue;
            };
            let body = ring_body(design, index, n);
            bodies.inertia[body] += law.ring_inertia();
            match law.spring_and_damper() {
                Some(s) => {
                    link(&mut bodies.stiffness, host, (body, 1.0), s.stiffness);
                    link(&mut bodies.damping, host, (body, 1.0), s.damping);
                }
                None => bodies.laws.push((index, law.clone())),
            }
            bodies.rings.push((host, body));
        }
        bodies
    }

    fn shaft(&mut self, i: usize, next: (usize, f64), s: &Station) {
        link(&mut self.stiffness, i, next, s.stiffness_to_next);
        link(&mut self.damping, i, next, s.damping_to_next);
        link(&mut self.hysteresis, i, next, s.stiffness_to_next * s.loss_factor_to_next);
    }

    /// Number of bodies.
    pub fn len(&self) -> usize {
        self.inertia.len()
    }

    /// Never true.
    pub fn is_empty(&self) -> bool {
        self.inertia.is_empty()
    }

    /// The angles of two bodies that a quantity is, or that it is the stiffness of a shaft times.
    pub(crate) fn between(&self, chain: &Chain, quantity: Quantity) -> Difference {
        match (quantity, quantity.difference(chain)) {
            (_, Some(difference)) => difference,
            (Quantity::RingTwist(r), None) => Difference { from: self.rings[r].1, to: Some((self.rings[r].0, 1.0)), scale: 1.0 },
            (_, None) => unreachable!("only the twist of a ring is no difference of stations"),
        }
    }
}
