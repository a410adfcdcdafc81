//! The inner loop of the joint receptance method: several points of its tables at a time.

// every loop runs over the lanes of several arrays at once
#![allow(clippy::needless_range_loop)]

use super::lane::{LANES, Lane};
use crate::absorber::{Absorber, Condensed, Host, Mounted, Operating};
use hartog_kernel::kernel;
use nalgebra::{DMatrix, DVector};

/// Where terms are this many times their sum, the direct solve takes over.
pub(super) const LARGEST_CANCELLATION: f64 = 1e5;

/// Some points of the tables.
#[derive(Debug, Clone)]
pub(super) struct Table {
    pub at: [Operating; LANES],
    /// Whether the base can be used.
    pub usable: [bool; LANES],
    /// Angle of each station under the torque.
    pub stations: Vec<Lane>,
    /// Angle of a station per unit torque at another one, row by row.
    pub receptance: Vec<Lane>,
    /// Of each quantity, its value under the torque and per unit torque at each station.
    pub outputs: Vec<(Lane, Vec<Lane>)>,
}

/// An absorber on a station: its dynamic stiffness as a fraction.
#[derive(Debug, Clone, Copy)]
struct Hub {
    /// Place of the station in the tables.
    place: usize,
    numerator: Lane,
    denominator: Lane,
}

/// A design at the points of a table.
#[derive(Debug, Default)]
pub(super) struct Points {
    hubs: Vec<Hub>,
    /// Of each absorber the hub below it and its twist per angle of the station over the hub's denominator.
    rings: Vec<(usize, Lane)>,
    /// Of each station with absorbers: numerator and denominator of their sum.
    sums: Vec<(Lane, Lane)>,
    /// Of each such station, its angle over that denominator.
    angles: Vec<Lane>,
    /// Whether digits are lost.
    lost: [bool; LANES],
    condensed: Condensed,
}

impl Points {
    /// Condenses the absorbers and solves for the angles of their stations. `place`: of a station in the tables.
    pub fn solve(&mut self, table: &Table, design: &[Mounted], place: impl Fn(usize) -> usize) {
        self.hubs.clear();
        self.rings.clear();
        if design.iter().any(|m| matches!(m.on, Host::Ring(_))) {
            self.condense(table, design, place);
        } else {
            for (index, mounted) in design.iter().enumerate() {
                let Host::Station(station) = mounted.on else { continue };
                let (numerator, denominator, twist) = single(table, mounted);
                self.hubs.push(Hub { place: place(station), numerator, denominator });
                self.rings.push((index, twist));
            }
        }
        angles(self, table);
        if table.stations.len() > 2 {
            self.angles_of_many(table);
        }
    }

    /// Rings on rings, point by point.
    fn condense(&mut self, table: &Table, design: &[Mounted], place: impl Fn(usize) -> usize) {
        for (lane, at) in table.at.iter().enumerate() {
            self.condensed.set(design, *at);
            if lane == 0 {
                let hub = |station: usize| Hub { place: place(station), numerator: Lane::ZERO, denominator: Lane::ZERO };
                self.hubs.extend(self.condensed.hubs.iter().map(|h| hub(h.station)));
                self.rings.extend(self.condensed.rings.iter().map(|r| (r.hub, Lane::ZERO)));
            }
            for (hub, own) in self.hubs.iter_mut().zip(&self.condensed.hubs) {
                hub.numerator.set(lane, own.numerator);
                hub.denominator.set(lane, own.denominator);
            }
            for (ring, own) in self.rings.iter_mut().zip(&self.condensed.rings) {
                ring.1.set(lane, own.twist);
            }
        }
    }

    /// Of three stations and more, point by point with exchange of rows.
    fn angles_of_many(&mut self, table: &Table) {
        let n = table.stations.len();
        for lane in 0..LANES {
            let element = |k: usize, l: usize| {
                let own = if k == l { self.sums[k].1 } else { Lane::ZERO };
                own.get(lane) + table.receptance[k * n + l].get(lane) * self.sums[l].0.get(lane)
            };
            let right = DVector::from_fn(n, |k, _| table.stations[k].get(lane));
            match DMatrix::from_fn(n, n, element).lu().solve(&right) {
                Some(solved) => self.angles.iter_mut().zip(solved.iter()).for_each(|(angle, s)| angle.set(lane, *s)),
                None => self.lost[lane] = true,
            }
        }
    }

    /// A quantity of the tables, and at which points it can be relied on.
    pub fn output(&self, table: &Table, index: usize) -> (Lane, [bool; LANES]) {
        output(self, table, index)
    }

    /// Twist of a ring.
    pub fn twist(&self, table: &Table, absorber: usize) -> (Lane, [bool; LANES]) {
        let (hub, twist) = &self.rings[absorber];
        let own = &self.hubs[*hub];
        // angle over the denominator of the hub: that over all denominators, times the others
        let beside = |(i, h): (usize, &Hub)| (i != *hub && h.place == own.place).then_some(h.denominator);
        let others = self.hubs.iter().enumerate().filter_map(beside).fold(Lane::ONE, |product, d| product.by(&d));
        let y = self.angles[own.place].by(&others).by(twist);
        let mut reliable = table.usable;
        for l in 0..LANES {
            reliable[l] &= !self.lost[l] && y.re[l].is_finite() && y.im[l].is_finite();
        }
        (y, reliable)
    }
}

/// Of one ring on a station: numerator and denominator of its dynamic stiffness, and twist of the ring per angle of the station over that denominator.
fn single(table: &Table, mounted: &Mounted) -> (Lane, Lane, Lane) {
    let square = table.at.map(|at| at.omega * at.omega);
    let ring_inertia = mounted.absorber.ring_inertia();
    let Absorber::Ring(law) = &mounted.absorber else {
        let inertia = ring_inertia + mounted.hub();
        return (Lane { re: square.map(|s| -s * inertia), im: [0.0; LANES] }, Lane::ONE, Lane::ZERO);
    };
    let spring = match law.spring_and_damper() {
        Some(s) => Lane { re: [s.stiffness; LANES], im: table.at.map(|at| at.omega * s.damping) },
        None => {
            let mut s = [crate::numerics::ZERO; LANES];
            law.dynamic_stiffness_each(&table.at, &mut s);
            Lane { re: s.map(|s| s.re), im: s.map(|s| s.im) }
        }
    };
    fraction(&square, &spring, (ring_inertia, mounted.hub()))
}

/// S m - D omega² J_hub and D = S + m with m = -omega² J; and -m.
#[kernel]
fn fraction(square: &[f64; LANES], spring: &Lane, (ring_inertia, hub_inertia): (f64, f64)) -> (Lane, Lane, Lane) {
    let inertial = square.map(|s| -s * ring_inertia);
    let hub = square.map(|s| s * hub_inertia);
    let mut denominator = *spring;
    for l in 0..LANES {
        denominator.re[l] += inertial[l];
    }
    let numerator = spring.scaled(&inertial).minus(&denominator.scaled(&hub));
    (numerator, denominator, Lane { re: inertial.map(|m| -m), im: [0.0; LANES] })
}

/// Sums of what acts on each station, and the angles of one or two stations over their denominators.
#[kernel]
fn angles(p: &mut Points, table: &Table) {
    let n = table.stations.len();
    p.sums.clear();
    p.sums.resize(n, (Lane::ZERO, Lane::ONE));
    for hub in &p.hubs {
        let (above, below) = &mut p.sums[hub.place];
        *above = above.by(&hub.denominator).plus(&hub.numerator.by(below));
        *below = below.by(&hub.denominator);
    }
    p.angles.clear();
    p.angles.resize(n, Lane::ZERO);
    p.lost = [false; LANES];
    let element = |k: usize, l: usize| {
        let coupled = table.receptance[k * n + l].by(&p.sums[l].0);
        if k == l { coupled.plus(&p.sums[k].1) } else { coupled }
    };
    match n {
        1 => p.angles[0] = table.stations[0].over(&element(0, 0)),
        2 => {
            let (a, b, c, d) = (element(0, 0), element(0, 1), element(1, 0), element(1, 1));
            let (own, across) = (a.by(&d), b.by(&c));
            let determinant = own.minus(&across);
            let (size_own, size_across, size) = (own.norm(), across.norm(), determinant.norm());
            for l in 0..LANES {
                p.lost[l] = size_own[l] + size_across[l] > LARGEST_CANCELLATION * size[l];
            }
            let (x, y) = (&table.stations[0], &table.stations[1]);
            p.angles[0] = d.by(x).minus(&b.by(y)).over(&determinant);
            p.angles[1] = a.by(y).minus(&c.by(x)).over(&determinant);
        }
        _ => {}
    }
}

#[kernel]
fn output(p: &Points, table: &Table, index: usize) -> (Lane, [bool; LANES]) {
    let (base, per_torque) = &table.outputs[index];
    let (mut y, mut size) = (*base, base.norm());
    for (place, (sum, angle)) in p.sums.iter().zip(&p.angles).enumerate() {
        let term = per_torque[place].by(&sum.0).by(angle);
        y = y.minus(&term);
        let own = term.norm();
        for l in 0..LANES {
            size[l] += own[l];
        }
    }
    let total = y.norm();
    let mut reliable = table.usable;
    for l in 0..LANES {
        reliable[l] &= !p.lost[l] && y.re[l].is_finite() && y.im[l].is_finite() && size[l] <= LARGEST_CANCELLATION * total[l];
    }
    (y, reliable)
}
