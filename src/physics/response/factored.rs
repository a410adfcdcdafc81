//! The system at one frequency, absorbers condensed onto their stations: a row of stations factored with exchange of rows, a tree from its leaves to
//! its root.
//!
//! Beside a shaft that is far stiffer than inertia at that frequency, what ties stations to inertial space is lost in the rounding of its stiffness: torques of shafts are then unknowns, too.

use super::flexible_point::{Absorbers, FlexiblePoint};
use super::known_points::Wanted;
use super::shaft_torques::ShaftTorques;
use super::{Quantity, ResponseError, Work};
use crate::absorber::mounted::station_of;
use crate::absorber::{Condensed, Mounted, Operating};
use crate::drivetrain::{Station, System};
use crate::numerics::sparse::Sparse;
use crate::numerics::tridiagonal::Singular;
use crate::numerics::{C64, ZERO};
use crate::units::RAD_PER_S_PER_RPM;
use std::sync::Arc;

/// Stiffness of the stiffest shaft over omega² times the inertia of the chain above which torques of shafts are unknowns: below, rounding of the stiffness leaves an error of some 1e-9.
const STIFF: f64 = 1e5;

/// The factored system at one frequency.
///
/// The column of a station with absorbers is scaled by their denominators d (see [`Condensed`]), so that the
/// unknown there is q = theta/d: finite and exact where an undamped ring resonates.
pub(crate) struct Factored<'a> {
    system: &'a System,
    /// Circular frequency, rad/s.
    pub omega: f64,
    matrix: Sparse,
    /// In place of the matrix beside a stiff shaft.
    shaft_torques: Option<ShaftTorques>,
    /// Whether there is one at this frequency.
    stiff: bool,
    /// In the place of both where the crank is flexible.
    flexible: Option<FlexiblePoint<'a>>,
    /// Answers of the flexible crank that are asked for; all without.
    rows: Option<Arc<[usize]>>,
    /// Of the chain, kg m².
    inertia: f64,
    /// Of its shafts: no stiffness (N m/rad) and no damping (N m s/rad) is larger, on either side of a gear.
    stiffest: (f64, f64),
    /// Torque on each station, N m.
    pub torque: Vec<C64>,
    /// Unknowns under it.
    pub x: Vec<C64>,
    scale: Vec<C64>,
    /// The absorbers.
    pub condensed: Condensed,
    /// Of each absorber on a station, the denominators of the others there.
    pub others: Vec<C64>,
}

impl<'a> Factored<'a> {
    pub fn new(system: &'a System) -> Self {
        let (chain, n) = (&system.chain, system.chain.len());
        let most =
            |of: &dyn Fn(&Station) -> f64| (0..n - 1).map(|i| of(&chain.stations[i]) * chain.gear(i).powi(2).max(1.0)).fold(0.0, f64::max);
        Self {
            system,
            omega: 0.0,
            matrix: if system.chain.is_row() { Sparse::row(n) } else { Sparse::tree((0..n - 1).map(|i| system.chain.next(i)).collect()) },
            shaft_torques: None,
            stiff: false,
            flexible: None,
            rows: None,
            inertia: chain.total_inertia(),
            stiffest: (most(&|s| s.stiffness_to_next * (1.0 + s.loss_factor_to_next)), most(&|s| s.damping_to_next)),
            torque: vec![ZERO; n],
            x: vec![ZERO; n],
            scale: vec![C64::from(1.0); n],
            condensed: Condensed::default(),
            others: Vec::new(),
        }
    }

    /// Assembles and factors at the frequency of an order at a speed.
    pub fn factor(&mut self, design: &[Mounted], index: usize, speed_rpm: f64) -> Result<(), ResponseError> {
        let order = self.system.excitation.orders[index];
        let at = Operating { omega: order.omega(speed_rpm), shaft_speed: speed_rpm * RAD_PER_S_PER_RPM };
        if let Some(crank) = &self.system.flexible {
            let sums = self.sums(design, at);
            let point = FlexiblePoint::new(crank, (index, speed_rpm), &sums, self.rows.clone())
                .map_err(|_| ResponseError::unbounded(order, speed_rpm))?;
            self.flexible = Some(point);
            return Ok(());
        }
        self.factor_at(design, at).map_err(|_| ResponseError::unbounded(order, speed_rpm))
    }

    /// Of a flexible crank asks no more from now on than what quantities are made of.
    pub fn ask(&mut self, design: &[Mounted], quantities: &[Quantity]) {
        self.rows = Some(self.wanted(design, quantities).rows);
    }

    /// What of a flexible crank quantities are made of.
    pub(super) fn wanted(&self, design: &[Mounted], quantities: &[Quantity]) -> Wanted {
        self.wanted_at((0..design.len()).map(|i| station_of(design, i)).collect(), quantities)
    }

    /// The same with absorbers on some stations.
    pub(super) fn wanted_at(&self, mut stations: Vec<usize>, quantities: &[Quantity]) -> Wanted {
        let chain = &self.system.chain;
        stations.sort_unstable();
        stations.dedup();
        let rows_of = |quantity: &Quantity| match quantity {
            Quantity::ShaftTorque(s) => vec![chain.len() + s],
            q => q.difference(chain).map_or_else(Vec::new, |d| std::iter::once(d.from).chain(d.to.map(|to| to.0)).collect()),
        };
        let mut rows: Vec<usize> = quantities.iter().flat_map(rows_of).chain(stations.iter().copied()).collect();
        rows.sort_unstable();
        rows.dedup();
        Wanted { rows: rows.into(), stations }
    }

    /// Condenses the absorbers; returns numerator and denominator of their sum on each station that has some.
    fn sums(&mut self, design: &[Mounted], at: Operating) -> Vec<(usize, C64, C64)> {
        self.omega = at.omega;
        self.others.clear();
        self.scale.fill(C64::from(1.0));
        self.condensed.set(design, at);
        let mut sums: Vec<(usize, C64, C64)> = Vec::new();
        for (hub, z) in self.condensed.hubs.iter().enumerate() {
            let h = z.station;
            match sums.iter_mut().find(|s| s.0 == h) {
                Some((_, above, below)) => (*above, *below) = (*above * z.denominator + z.numerator * *below, *below * z.denominator),
                None => sums.push((h, z.numerator, z.denominator)),
            }
            for (others, _) in self.others.iter_mut().zip(&self.condensed.hubs[..hub]).filter(|o| o.1.station == h) {
                *others *= z.denominator;
            }
            self.others.push(self.scale[h]);
            self.scale[h] *= z.denominator;
        }
        sums
    }

    /// The same at any frequency and speed.
    pub(crate) fn factor_at(&mut self, design: &[Mounted], at: Operating) -> Result<(), Singular> {
        let (omega, chain, n) = (at.omega, &self.system.chain, self.system.chain.len());
        self.omega = omega;
        let size = omega * omega * self.inertia;
        self.stiff = self.stiffest.0 + omega * self.stiffest.1 > STIFF * size && size > 0.0;
        let matrix = if self.stiff {
            let all = self.shaft_torques.get_or_insert_with(|| ShaftTorques::new(chain));
            all.set(chain, omega, size);
            (0..n).for_each(|i| all.matrix.diagonal()[ShaftTorques::place(i)] = chain.ground_stiffness(i, omega));
            &mut all.matrix
        } else {
            for (i, diagonal) in self.matrix.diagonal().iter_mut().enumerate() {
                *diagonal = chain.ground_stiffness(i, omega);
            }
            for i in 0..n - 1 {
                let s = chain.shaft_stiffness(i, omega);
                let gear = chain.gear(i);
                self.matrix.diagonal()[i] += s;
                self.matrix.diagonal()[chain.next(i)] += s * (gear * gear);
                self.matrix.set_link(i, -s * gear);
            }
            &mut self.matrix
        };
        self.others.clear();
        self.scale.fill(C64::from(1.0));
        self.condensed.set(design, at);
        for (hub, z) in self.condensed.hubs.iter().enumerate() {
            let h = z.station;
            let place = if self.stiff { ShaftTorques::place(h) } else { h };
            // the diagonal and everything scaled so far, times the new denominator, plus the new numerator times the old scale
            let diagonal = matrix.diagonal()[place];
            matrix.scale_column(place, z.denominator);
            matrix.diagonal()[place] = diagonal * z.denominator + z.numerator * self.scale[h];
            for (others, _) in self.others.iter_mut().zip(&self.condensed.hubs[..hub]).filter(|o| o.1.station == h) {
                *others *= z.denominator;
            }
            self.others.push(self.scale[h]);
            self.scale[h] *= z.denominator;
        }
        matrix.factor()
    }

    /// Whether torques of shafts are unknowns: beside a very stiff shaft.
    pub(super) fn is_stiff(&self) -> bool {
        self.stiff
    }

    /// Unknowns under torques on the stations.
    pub fn under(&self, torques: &[C64]) -> Vec<C64> {
        if self.flexible.is_some() {
            let mut sum = vec![ZERO; 2 * torques.len() - 1];
            for (station, torque) in torques.iter().enumerate().filter(|t| *t.1 != ZERO) {
                sum.iter_mut().zip(self.under_unit(station)).for_each(|(sum, x)| *sum += torque * x);
            }
            return sum;
        }
        let mut x = Vec::new();
        self.put_under(torques, &mut x);
        x
    }

    /// Unknowns under a unit torque on a station.
    pub(crate) fn under_unit(&self, station: usize) -> Vec<C64> {
        let n = self.torque.len();
        if let Some(point) = &self.flexible {
            // singular: not finite, as where the chain is
            return point.under_unit(station).unwrap_or_else(|_| vec![C64::from(f64::NAN); 2 * n - 1]);
        }
        let mut x = Vec::new();
        self.put_under_unit(station, &mut x);
        x
    }

    /// The same in place, of a chain.
    pub(super) fn put_under_unit(&self, station: usize, x: &mut Vec<C64>) {
        let n = self.torque.len();
        x.clear();
        x.resize(if self.stiff { 2 * n - 1 } else { n }, ZERO);
        x[self.place(station)] = C64::from(1.0);
        self.solve_in_place(x);
    }

    fn put_under(&self, torques: &[C64], x: &mut Vec<C64>) {
        x.clear();
        if self.stiff {
            x.resize(2 * torques.len() - 1, ZERO);
            torques.iter().enumerate().for_each(|(i, torque)| x[ShaftTorques::place(i)] = *torque);
        } else {
            x.extend_from_slice(torques);
        }
        self.solve_in_place(x);
    }

    fn solve_in_place(&self, x: &mut [C64]) {
        self.with_torques().map_or(&self.matrix, |all| &all.matrix).solve(x);
    }

    /// Solves for the torque on the stations.
    pub(crate) fn solve_torque(&mut self) {
        let mut x = std::mem::take(&mut self.x);
        self.put_under(&self.torque, &mut x);
        self.x = x;
    }

    /// Solves for the torque of an order (an index) at a speed.
    pub fn solve(&mut self, design: &[Mounted], (order, speed_rpm): (usize, f64), work: &mut Work) -> Result<(), ResponseError> {
        work.direct_solves += 1;
        self.factor(design, order, speed_rpm)?;
        if let Some(point) = &self.flexible {
            let unbounded = |_| ResponseError::unbounded(self.system.excitation.orders[order], speed_rpm);
            self.x = point.under_load(self.system).map_err(unbounded)?;
            return Ok(());
        }
        self.system.torque(order, speed_rpm, &mut self.torque);
        self.solve_torque();
        Ok(())
    }

    /// Phasors of quantities under the torque of an order (an index) at a speed, given to `put` one by one; zero, even at a resonance, where
    /// there is no torque.
    pub fn phasors(
        &mut self,
        design: &[Mounted],
        quantities: &[Quantity],
        at: (usize, f64),
        work: &mut Work,
        mut put: impl FnMut(usize, C64),
    ) -> Result<(), ResponseError> {
        if self.system.flexible.is_none() {
            self.system.torque(at.0, at.1, &mut self.torque);
        }
        let still = self.system.flexible.is_none() && self.torque.iter().all(|t| *t == ZERO);
        if !still {
            self.solve(design, at, work)?;
        }
        for (i, quantity) in quantities.iter().enumerate() {
            let y = if still { ZERO } else { self.output(*quantity, &self.x) };
            put(i, self.finite(y, at)?);
        }
        Ok(())
    }

    /// Makes outputs those of answers without absorbers.
    pub(super) fn bare(&mut self, at: Operating) {
        self.sums(&[], at);
    }

    /// The same of a flexible crank whose answers at an order without absorbers are known.
    pub(super) fn phasors_of_known(
        &mut self,
        (design, quantities): (&[Mounted], &[Quantity]),
        (order, speed_rpm): (usize, f64),
        (wanted, known): (&Wanted, &[C64]),
        work: &mut Work,
        mut put: impl FnMut(usize, C64),
    ) -> Result<(), ResponseError> {
        work.direct_solves += 1;
        let excited = self.system.excitation.orders[order];
        let sums = self.sums(design, Operating { omega: excited.omega(speed_rpm), shaft_speed: speed_rpm * RAD_PER_S_PER_RPM });
        let answers = 2 * self.torque.len() - 1;
        let unbounded = |_| ResponseError::unbounded(excited, speed_rpm);
        if let [sum] = sums.as_slice() {
            self.x.resize(answers, ZERO);
            wanted.with_one(*sum, known, &mut self.x).map_err(unbounded)?;
        } else {
            let columns = sums.iter().map(|s| wanted.under_unit(s.0, known, answers)).collect();
            let absorbers = Absorbers::new(&sums, columns);
            self.x = absorbers.and_then(|a| a.put_on(wanted.under_load(known, answers))).map_err(unbounded)?;
        }
        for (i, quantity) in quantities.iter().enumerate() {
            put(i, self.finite(self.output(*quantity, &self.x), (order, speed_rpm))?);
        }
        Ok(())
    }

    /// A phasor at an order and a speed, unless nothing bounds it.
    fn finite(&self, y: C64, (order, speed_rpm): (usize, f64)) -> Result<C64, ResponseError> {
        if y.is_finite() { Ok(y) } else { Err(ResponseError::unbounded(self.system.excitation.orders[order], speed_rpm)) }
    }

    pub fn phasor(&mut self, design: &[Mounted], quantity: Quantity, at: (usize, f64), work: &mut Work) -> Result<C64, ResponseError> {
        let mut found = ZERO;
        self.phasors(design, &[quantity], at, work, |_, y| found = y)?;
        Ok(found)
    }

    /// Angle of a station from a solution.
    pub fn angle(&self, station: usize, x: &[C64]) -> C64 {
        self.scale[station] * x[self.place(station)]
    }

    /// By how much rounding of the entries of the matrix changes an output whose value per unit torque at each station is `adjoint`, times as many roundings, where no absorber is on the chain: to first order the sum of
    /// |adjoint_i| |entry_ij| |x_j|. `None` of a flexible crank and beside a stiff shaft, whose entries are others.
    pub(super) fn doubt(&self, adjoint: &[C64], x: &[C64]) -> Option<f64> {
        let (chain, omega) = (&self.system.chain, self.omega);
        if self.flexible.is_some() || self.stiff {
            return None;
        }
        let at_station = |i: usize| {
            let s = &chain.stations[i];
            (s.stiffness_to_ground.abs() + omega * (s.damping_to_ground + omega * s.inertia)) * adjoint[i].norm() * x[i].norm()
        };
        let on_shaft = |i: usize| {
            let (next, gear) = (chain.next(i), chain.gear(i).abs());
            let both = |y: &[C64]| y[i].norm() + gear * y[next].norm();
            chain.shaft_stiffness(i, omega).norm() * both(adjoint) * both(x)
        };
        Some((0..chain.len()).map(at_station).sum::<f64>() + (0..chain.len() - 1).map(on_shaft).sum::<f64>())
    }

    /// Place of a station among the unknowns.
    fn place(&self, station: usize) -> usize {
        if self.stiff { ShaftTorques::place(station) } else { station }
    }

    /// Shafts with their torques among the unknowns.
    fn with_torques(&self) -> Option<&ShaftTorques> {
        self.shaft_torques.as_ref().filter(|_| self.stiff)
    }

    /// Twist of the shaft after a station from a solution.
    fn shaft_twist(&self, shaft: usize, x: &[C64]) -> C64 {
        let by_torque = self.with_torques().and_then(|all| all.twist(shaft, x));
        by_torque.unwrap_or_else(|| self.system.chain.link(shaft).of(|i| self.angle(i, x)))
    }

    /// The quantity from a solution.
    pub fn output(&self, quantity: Quantity, x: &[C64]) -> C64 {
        let theta = |i: usize| self.angle(i, x);
        match quantity {
            Quantity::Twist { from, to: Some(to) } if self.stiff => {
                self.system.chain.path(from, to).into_iter().map(|(shaft, weight)| self.shaft_twist(shaft, x) * weight).sum()
            }
            Quantity::Twist { .. } | Quantity::Motion(..) => {
                quantity.of_angle(quantity.difference(&self.system.chain).map_or(ZERO, |twist| twist.of(theta)), self.omega)
            }
            Quantity::ShaftTorque(s) if self.system.flexible.is_some() => x[self.torque.len() + s],
            Quantity::ShaftTorque(s) if self.stiff => self.with_torques().map_or(ZERO, |all| all.torque(s, x)),
            Quantity::ShaftTorque(s) => self.system.chain.shaft_stiffness(s, self.omega) * self.system.chain.link(s).of(theta),
            Quantity::RingTwist(a) => {
                let ring = &self.condensed.rings[a];
                self.hub(ring.hub, ring.twist, x)
            }
        }
    }

    /// A factor times the angle of a station over the denominator of a hub on it.
    pub fn hub(&self, hub: usize, factor: C64, x: &[C64]) -> C64 {
        self.others[hub] * factor * x[self.place(self.condensed.hubs[hub].station)]
    }
}
