//! Receptance method: an absorber on a station is a rank-one change of the chain, so the chain is solved once per study.
//!
//! With u0 the station's angle and y0 the output without absorber, H the station's receptance, h the output per unit torque there and
//! z the absorber's dynamic stiffness: y = y0 - h z u0/(1 + z H) = (y0 + z (y0 H - h u0))/(1 + z H), exactly.

use super::factored::Factored;
use super::kernel::{self, Points};
use super::{Direct, Grid, Quantity, Response, ResponseError, Work};
use crate::absorber::{Host, Mounted};
use crate::drivetrain::System;
use crate::numerics::{C64, ZERO};
use crate::units::RAD_PER_S_PER_RPM;
use std::sync::Arc;

/// Near an undamped resonance of the base, y0 H and h u0 are huge and cancel; where they lose more than this factor the direct solve
/// takes over. It leaves an error of about 1e5 roundings, 2e-11.
const LARGEST_CANCELLATION: f64 = 1e5;

/// Tables of the base for absorbers on one station.
#[derive(Debug)]
pub struct Receptance<'a> {
    direct: Direct<'a>,
    station: usize,
    tables: Vec<(Quantity, Arc<Points>)>,
    /// Points (index in a sweep) left to the direct solve, one list a table.
    singular: Vec<Vec<usize>>,
    /// Solves spent on the tables.
    pub setup: Work,
}

impl<'a> Receptance<'a> {
    /// Solves the base for absorbers on `station` and the given quantities. Other stations and quantities are left to the direct solve.
    pub fn new(system: &'a System, grid: &'a Grid, station: usize, quantities: &[Quantity]) -> Self {
        let direct = Direct::new(system, grid);
        let mut setup = Work::default();
        let empty = |q: &Quantity| (*q, Points { ring: matches!(q, Quantity::RingTwist(_)), ..Points::default() });
        let mut tables: Vec<(Quantity, Points)> = quantities.iter().map(empty).collect();
        let mut singular = vec![Vec::new(); quantities.len()];
        let mut solver = Factored::new(system);
        for (i, &speed_rpm) in grid.speed_rpm.iter().enumerate() {
            for (n, order) in system.excitation.orders.iter().enumerate() {
                let base = direct.base(&mut solver, &[station], quantities, n, speed_rpm, &mut setup).ok();
                for (t, (_, points)) in tables.iter_mut().enumerate() {
                    let (mut y0, mut g, mut h) = (ZERO, ZERO, ZERO);
                    let mut usable = false;
                    if let Some(b) = &base {
                        let (output, receptance) = (b.outputs[t].0, b.receptance[(0, 0)]);
                        let (p, q) = (output * receptance, b.outputs[t].1[0] * b.stations[0]);
                        // under torque on the hub alone y0 H = h u0, but for rounding
                        let zero = points.ring || (system.flexible.is_none() && system.loaded == [station]);
                        (y0, g, h) = (output, if zero { ZERO } else { p - q }, receptance);
                        // the hub's own angle has g = 0 exactly, term by term
                        usable = g == ZERO || p.norm() + q.norm() <= LARGEST_CANCELLATION * g.norm();
                        usable &= y0.is_finite() && g.is_finite() && h.is_finite();
                        if !usable {
                            (y0, g, h) = (ZERO, ZERO, ZERO);
                        }
                    }
                    if !usable {
                        singular[t].push(i * system.orders() + n);
                    }
                    points.omega.push(order.omega(speed_rpm));
                    points.shaft_speed.push(speed_rpm * RAD_PER_S_PER_RPM);
                    for (target, value) in [(&mut points.y0, y0), (&mut points.g, g), (&mut points.h, h)] {
                        target[0].push(value.re);
                        target[1].push(value.im);
                    }
                }
            }
        }
        let tables = tables.into_iter().map(|(quantity, points)| (quantity, Arc::new(points))).collect();
        Self { direct, station, tables, singular, setup }
    }

    /// The table that answers for this design, if there is one.
    fn table<'d>(&self, design: &'d [Mounted], quantity: Quantity) -> Option<(usize, &'d Mounted)> {
        let [mounted] = design else { return None };
        if mounted.on != Host::Station(self.station) {
            return None;
        }
        self.tables.iter().position(|t| t.0 == quantity).map(|t| (t, mounted))
    }

    /// Every `stride`-th speed of the grid and the last of the table of a quantity, for many absorbers; nothing where there is no table, or where
    /// some of its points need direct solutions.
    pub fn rows(&self, quantity: Quantity, stride: usize) -> Option<Rows> {
        let t = self.tables.iter().position(|t| t.0 == quantity)?;
        if !self.singular[t].is_empty() {
            return None;
        }
        let (all, orders) = (&self.tables[t].1, self.direct.system.orders());
        let rows_of = |points: Arc<Points>| Some(Rows { points, orders, station: self.station });
        if stride == 1 {
            return rows_of(all.clone());
        }
        let mut points = Points { ring: all.ring, ..Points::default() };
        for i in every(stride, self.grid().len()) {
            let row = i * orders..(i + 1) * orders;
            points.omega.extend(&all.omega[row.clone()]);
            points.shaft_speed.extend(&all.shaft_speed[row.clone()]);
            for part in 0..2 {
                points.y0[part].extend(&all.y0[part][row.clone()]);
                points.g[part].extend(&all.g[part][row.clone()]);
                points.h[part].extend(&all.h[part][row.clone()]);
            }
        }
        rows_of(Arc::new(points))
    }

    /// Replaces the points near a singular base by direct solutions.
    fn mend(
        &self,
        table: usize,
        design: &[Mounted],
        quantity: Quantity,
        work: &mut Work,
        mut put: impl FnMut(usize, C64),
    ) -> Result<(), ResponseError> {
        let orders = self.direct.system.orders();
        let singular = &self.singular[table];
        let places = singular.iter().map(|point| (point % orders, self.direct.grid().speed_rpm[point / orders]));
        self.direct.places(design, &[quantity], (singular.len(), places), work, |_, i, y| {
            put(singular[i], y);
        })?;
        work.singular_points += singular.len() as u64;
        Ok(())
    }
}

/// Every `stride`-th of so many speeds, and the last.
pub(crate) fn every(stride: usize, count: usize) -> impl Iterator<Item = usize> {
    (0..count - 1).step_by(stride).chain([count - 1])
}

/// Rows of a receptance table, one a speed.
#[derive(Debug, Clone)]
pub struct Rows {
    points: Arc<Points>,
    orders: usize,
    /// Station of the absorbers.
    pub station: usize,
}

impl Rows {
    /// Number of rows.
    pub fn len(&self) -> usize {
        self.points.omega.len() / self.orders
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.points.omega.is_empty()
    }

    /// Phasors of an absorber on the station, from row `first` on, for as many rows as there is room for.
    pub fn phasors(&self, mounted: &Mounted, first: usize, out: &mut [C64]) {
        kernel::phasors(&self.points, mounted, first * self.orders, out);
    }
}

impl Response for Receptance<'_> {
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
        let Some((t, mounted)) = self.table(design, quantity) else { return self.direct.sweep(design, quantity, out, work) };
        let points = &self.tables[t].1;
        work.receptance_points += points.omega.len() as u64;
        out.resize(points.omega.len(), ZERO);
        kernel::phasors(points, mounted, 0, out);
        self.mend(t, design, quantity, work, |i, y| out[i] = y)
    }

    fn sweep_each(&self, design: &[Mounted], quantities: &[Quantity], work: &mut Work) -> Result<Vec<Vec<C64>>, ResponseError> {
        if quantities.iter().any(|q| self.table(design, *q).is_none()) {
            return self.direct.sweep_each(design, quantities, work);
        }
        let one = |q: &Quantity| {
            let mut out = Vec::new();
            self.sweep(design, *q, &mut out, work).map(|()| out)
        };
        quantities.iter().map(one).collect()
    }

    fn squares(&self, design: &[Mounted], quantity: Quantity, out: &mut Vec<f64>, work: &mut Work) -> Result<(), ResponseError> {
        let Some((t, mounted)) = self.table(design, quantity) else { return self.direct.squares(design, quantity, out, work) };
        let points = &self.tables[t].1;
        work.receptance_points += points.omega.len() as u64;
        out.resize(points.omega.len(), 0.0);
        kernel::squares(points, mounted, out);
        self.mend(t, design, quantity, work, |i, y| out[i] = y.norm_sqr())
    }
}
