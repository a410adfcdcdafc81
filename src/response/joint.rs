//! Receptance method for absorbers on several stations, or several on one: a change of the chain of their number in rank.
//!
//! With u0 the angles of the stations and y0 the output without absorbers, H the receptances between the stations, h the outputs per unit torque there and
//! z = N/D of every absorber: (D + H N) q = u0 with q the angles over their denominators, and y = y0 - h N q, exactly.

use super::direct::BasePoint;
use super::{Direct, Grid, Quantity, Response, ResponseError, Work};
use crate::absorber::mounted::station_of;
use crate::absorber::{Condensed, Mounted, Operating};
use crate::drivetrain::System;
use crate::numerics::{C64, ZERO};
use crate::units::RAD_PER_S_PER_RPM;
use nalgebra::{DMatrix, DVector, SMatrix, SVector};

/// Where terms are this many times their sum, or receptances of two stations this nearly alike, the direct solve takes over.
const LARGEST_CANCELLATION: f64 = 1e5;

/// Tables of the base for absorbers on some stations.
#[derive(Debug)]
pub struct JointReceptance<'a> {
    direct: Direct<'a>,
    stations: Vec<usize>,
    quantities: Vec<Quantity>,
    /// Speed by speed, the orders of a speed together; nothing where the base is singular or the stations can hardly be told apart.
    points: Vec<Option<BasePoint>>,
    /// Solves spent on the tables.
    pub setup: Work,
}

impl<'a> JointReceptance<'a> {
    /// Solves the base for absorbers on `stations` and the given quantities (twists of rings need none). Other stations and quantities are left to
    /// the direct solve.
    pub fn new(system: &'a System, grid: &'a Grid, stations: &[usize], quantities: &[Quantity]) -> Self {
        let direct = Direct::new(system, grid);
        let quantities: Vec<Quantity> = quantities.iter().copied().filter(|q| !matches!(q, Quantity::RingTwist(_))).collect();
        let mut setup = Work::default();
        let mut points = Vec::with_capacity(grid.len() * system.orders());
        for &speed_rpm in &grid.speed_rpm {
            for order in 0..system.orders() {
                let base = direct.base(stations, &quantities, order, speed_rpm, &mut setup).ok();
                points.push(base.filter(|b| b.is_finite() && distinct(b)));
            }
        }
        Self { direct, stations: stations.to_vec(), quantities, points, setup }
    }

    /// Index of a quantity in the tables, where they answer for this design; for the twist of a ring any.
    fn answers(&self, design: &[Mounted], quantity: Quantity) -> Option<usize> {
        let known = (0..design.len()).all(|i| self.stations.contains(&station_of(design, i)));
        let index = if matches!(quantity, Quantity::RingTwist(_)) { Some(0) } else { self.quantities.iter().position(|q| *q == quantity) };
        index.filter(|_| known && !design.is_empty())
    }

    /// The phasor at a point of the tables; nothing where it has to be solved directly.
    fn phasor_at(&self, base: &BasePoint, condensed: &Condensed, quantity: Quantity, index: usize) -> Option<C64> {
        let place = |station: usize| self.stations.iter().position(|s| *s == station).unwrap_or_default();
        let hubs = &condensed.hubs;
        let matrix = |k: usize, l: usize| {
            let own = if k == l { hubs[k].denominator } else { ZERO };
            own + base.receptance[(place(hubs[k].station), place(hubs[l].station))] * hubs[l].numerator
        };
        let right = |k: usize| base.stations[place(hubs[k].station)];
        let q = match hubs.len() {
            1 => vec![right(0) / matrix(0, 0)],
            2 => SMatrix::<C64, 2, 2>::from_fn(matrix).lu().solve(&SVector::<C64, 2>::from_fn(|k, _| right(k)))?.as_slice().to_vec(),
            3 => SMatrix::<C64, 3, 3>::from_fn(matrix).lu().solve(&SVector::<C64, 3>::from_fn(|k, _| right(k)))?.as_slice().to_vec(),
            n => DMatrix::from_fn(n, n, matrix).lu().solve(&DVector::from_fn(n, |k, _| right(k)))?.as_slice().to_vec(),
        };
        if let Quantity::RingTwist(a) = quantity {
            let ring = &condensed.rings[a];
            return Some(ring.twist * q[ring.hub]);
        }
        let (output, per_torque) = &base.outputs[index];
        let (mut y, mut size) = (*output, output.norm());
        for (hub, q) in hubs.iter().zip(&q) {
            let term = per_torque[place(hub.station)] * hub.numerator * q;
            y -= term;
            size += term.norm();
        }
        (y.is_finite() && size <= LARGEST_CANCELLATION * y.norm()).then_some(y)
    }
}

/// Whether the receptances of any two stations can be told apart.
fn distinct(base: &BasePoint) -> bool {
    let h = &base.receptance;
    let n = h.nrows();
    (0..n).flat_map(|i| (0..i).map(move |j| (i, j))).all(|(i, j)| {
        let (own, across) = (h[(i, i)] * h[(j, j)], h[(i, j)] * h[(j, i)]);
        own.norm() + across.norm() <= LARGEST_CANCELLATION * (own - across).norm()
    })
}

impl Response for JointReceptance<'_> {
    fn name(&self) -> &'static str {
        "receptance"
    }

    fn grid(&self) -> &Grid {
        self.direct.grid()
    }

    fn system(&self) -> &System {
        self.direct.system
    }

    fn phasor(&self, design: &[Mounted], quantity: Quantity, at: (usize, f64), work: &mut Work) -> Result<C64, ResponseError> {
        let (order, speed_rpm) = at;
        self.direct.order_at(design, quantity, order, speed_rpm, work)
    }

    fn sweep(&self, design: &[Mounted], quantity: Quantity, out: &mut Vec<C64>, work: &mut Work) -> Result<(), ResponseError> {
        let Some(index) = self.answers(design, quantity) else { return self.direct.sweep(design, quantity, out, work) };
        let (system, orders) = (self.system(), self.system().orders());
        let mut condensed = Condensed::default();
        out.clear();
        for (i, base) in self.points.iter().enumerate() {
            let (order, speed_rpm) = (i % orders, self.grid().speed_rpm[i / orders]);
            let shaft_speed = speed_rpm * RAD_PER_S_PER_RPM;
            work.receptance_points += 1;
            let found = base.as_ref().and_then(|base| {
                condensed.set(design, Operating { omega: system.excitation.orders[order].value() * shaft_speed, shaft_speed });
                self.phasor_at(base, &condensed, quantity, index)
            });
            out.push(match found {
                Some(y) => y,
                None => {
                    work.singular_points += 1;
                    self.direct.order_at(design, quantity, order, speed_rpm, work)?
                }
            });
        }
        Ok(())
    }

    fn sweep_each(&self, design: &[Mounted], quantities: &[Quantity], work: &mut Work) -> Result<Vec<Vec<C64>>, ResponseError> {
        if quantities.iter().any(|q| self.answers(design, *q).is_none()) {
            return self.direct.sweep_each(design, quantities, work);
        }
        let one = |q: &Quantity| {
            let mut out = Vec::new();
            self.sweep(design, *q, &mut out, work).map(|()| out)
        };
        quantities.iter().map(one).collect()
    }
}
