//! Receptance method for absorbers on several stations, or several on one: a change of the chain of their number in rank.
//!
//! With u0 the angles of the stations and y0 the output without absorbers, H the receptances between the stations, h the outputs per unit torque there and
//! z = N/D of every absorber: (D + H N) q = u0 with q the angles over their denominators, and y = y0 - h N q, exactly.

use super::direct::BasePoint;
use super::factored::Factored;
use super::joint_lanes::{LARGEST_CANCELLATION, Points, Table};
use super::lane::{LANES, Lane};
use super::{Direct, Grid, Quantity, Response, ResponseError, Work};
use crate::absorber::mounted::station_of;
use crate::absorber::{Mounted, Operating};
use crate::drivetrain::System;
use crate::numerics::C64;
use crate::units::RAD_PER_S_PER_RPM;

/// Tables of the base for absorbers on some stations.
#[derive(Debug)]
pub struct JointReceptance<'a> {
    direct: Direct<'a>,
    stations: Vec<usize>,
    quantities: Vec<Quantity>,
    /// Speed by speed, the orders of a speed together.
    tables: Vec<Table>,
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
        let places: Vec<(usize, f64)> =
            grid.speed_rpm.iter().flat_map(|speed_rpm| (0..system.orders()).map(move |order| (order, *speed_rpm))).collect();
        let mut solver = Factored::new(system);
        let table = |places: &[(usize, f64)]| {
            let mut bases = places.iter().map(|(order, speed_rpm)| {
                let shaft_speed = speed_rpm * RAD_PER_S_PER_RPM;
                let at = Operating { omega: system.excitation.orders[*order].value() * shaft_speed, shaft_speed };
                let base = direct.base(&mut solver, stations, &quantities, *order, *speed_rpm, &mut setup).ok();
                // useless where the base is singular or the stations can hardly be told apart
                (at, base.filter(|b| b.is_finite() && distinct(b)))
            });
            table(&mut bases, stations.len(), quantities.len())
        };
        let tables = places.chunks(LANES).map(table).collect();
        Self { direct, stations: stations.to_vec(), quantities, tables, setup }
    }

    /// Index of a quantity in the tables, where they answer for this design; for the twist of a ring any.
    fn answers(&self, design: &[Mounted], quantity: Quantity) -> Option<usize> {
        let known = (0..design.len()).all(|i| self.stations.contains(&station_of(design, i)));
        let index = if matches!(quantity, Quantity::RingTwist(_)) { Some(0) } else { self.quantities.iter().position(|q| *q == quantity) };
        index.filter(|_| known && !design.is_empty())
    }
}

/// Points of a table one after the other; past the last one it is repeated.
fn table(bases: &mut dyn Iterator<Item = (Operating, Option<BasePoint>)>, stations: usize, quantities: usize) -> Table {
    let lanes = |n: usize| vec![Lane::ZERO; n];
    let mut table = Table {
        at: [Operating { omega: 0.0, shaft_speed: 0.0 }; LANES],
        usable: [false; LANES],
        stations: lanes(stations),
        receptance: lanes(stations * stations),
        outputs: vec![(Lane::ZERO, lanes(stations)); quantities],
    };
    for (lane, (at, base)) in bases.enumerate() {
        table.at[lane..].fill(at);
        let Some(base) = base else { continue };
        table.usable[lane] = true;
        table.stations.iter_mut().zip(&base.stations).for_each(|(to, from)| to.set(lane, *from));
        let across = (0..stations).flat_map(|i| (0..stations).map(move |j| (i, j)));
        table.receptance.iter_mut().zip(across).for_each(|(to, from)| to.set(lane, base.receptance[from]));
        for ((value, per_torque), (own, each)) in table.outputs.iter_mut().zip(&base.outputs) {
            value.set(lane, *own);
            per_torque.iter_mut().zip(each).for_each(|(to, from)| to.set(lane, *from));
        }
    }
    table
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
        if self.answers(design, quantity).is_none() {
            return self.direct.sweep(design, quantity, out, work);
        }
        *out = self.sweep_each(design, &[quantity], work)?.pop().unwrap_or_default();
        Ok(())
    }

    fn sweep_each(&self, design: &[Mounted], quantities: &[Quantity], work: &mut Work) -> Result<Vec<Vec<C64>>, ResponseError> {
        let Some(indices) = quantities.iter().map(|q| self.answers(design, *q)).collect::<Option<Vec<usize>>>() else {
            return self.direct.sweep_each(design, quantities, work);
        };
        let orders = self.system().orders();
        let count = self.grid().len() * orders;
        let place = |station: usize| self.stations.iter().position(|s| *s == station).unwrap_or_default();
        let mut all = vec![Vec::with_capacity(count); quantities.len()];
        let mut points = Points::default();
        for (table, first) in self.tables.iter().zip((0..count).step_by(LANES)) {
            points.solve(table, design, place);
            for ((quantity, index), out) in quantities.iter().zip(&indices).zip(&mut all) {
                let (values, reliable) = match quantity {
                    Quantity::RingTwist(absorber) => points.twist(table, *absorber),
                    _ => points.output(table, *index),
                };
                for (lane, point) in (first..count.min(first + LANES)).enumerate() {
                    work.receptance_points += 1;
                    out.push(if reliable[lane] {
                        values.get(lane)
                    } else {
                        work.singular_points += 1;
                        self.direct.order_at(design, *quantity, point % orders, self.grid().speed_rpm[point / orders], work)?
                    });
                }
            }
        }
        Ok(all)
    }
}
