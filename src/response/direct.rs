//! Direct solution: the dynamic stiffness of chain and absorbers, tridiagonal once the rings are condensed onto their stations.

use super::batch::{Block, LANES, Lane};
use super::{Grid, Quantity, Response, ResponseError, Work};
use crate::absorber::{Mounted, Ring};
use crate::drivetrain::System;
use crate::numerics::tridiagonal::Tridiagonal;
use crate::numerics::{C64, ZERO};
use crate::units::RAD_PER_S_PER_RPM;

/// Solves (K + i omega C - omega² J + z(omega)) theta = T at every order and speed.
#[derive(Debug)]
pub struct Direct<'a> {
    /// The system.
    pub system: &'a System,
    grid: &'a Grid,
}

/// Several points are solved at once without exchange of rows; one that cancels by more than this is solved again with it. Below, the error is at
/// most about as many roundings.
const LARGEST_CANCELLATION: f64 = 1e4;

/// An absorber in the factored system.
struct RingOf {
    station: usize,
    /// Denominators of the other absorbers on the station.
    others: C64,
    /// Twist of the ring per hub angle, times its own denominator.
    ring: f64,
}

/// The factored system at one frequency.
///
/// The column of a station with absorbers is scaled by their denominators d (see [`crate::absorber::DynamicStiffness`]), so that the
/// unknown there is q = theta/d: finite and exact where an undamped ring resonates.
struct Factored<'a> {
    system: &'a System,
    omega: f64,
    matrix: Tridiagonal,
    /// Right-hand side, then unknowns.
    x: Vec<C64>,
    scale: Vec<C64>,
    rings: Vec<RingOf>,
}

impl<'a> Factored<'a> {
    fn new(system: &'a System) -> Self {
        let n = system.chain.len();
        Self { system, omega: 0.0, matrix: Tridiagonal::zeros(n), x: vec![ZERO; n], scale: vec![C64::from(1.0); n], rings: Vec::new() }
    }

    /// Assembles and factors at the frequency of an order at a speed.
    fn factor(&mut self, design: &[Mounted], order: usize, speed_rpm: f64) -> Result<(), ResponseError> {
        let order = self.system.excitation.orders[order];
        let omega = order.value() * speed_rpm * RAD_PER_S_PER_RPM;
        let (chain, n) = (&self.system.chain, self.system.chain.len());
        self.omega = omega;
        for i in 0..n {
            self.matrix.diagonal[i] = chain.ground_stiffness(i, omega);
        }
        for i in 0..n - 1 {
            let s = chain.shaft_stiffness(i, omega);
            self.matrix.diagonal[i] += s;
            self.matrix.diagonal[i + 1] += s;
            self.matrix.upper[i] = -s;
            self.matrix.lower[i] = -s;
        }
        self.rings.clear();
        self.scale.fill(C64::from(1.0));
        for mounted in design {
            let h = mounted.station;
            let z = mounted.dynamic_stiffness(omega);
            // the diagonal and everything scaled so far, times the new denominator, plus the new numerator times the old scale
            self.matrix.diagonal[h] = self.matrix.diagonal[h] * z.denominator + z.numerator * self.scale[h];
            for ring in self.rings.iter_mut().filter(|r| r.station == h) {
                ring.others *= z.denominator;
            }
            self.rings.push(RingOf { station: h, others: self.scale[h], ring: z.ring });
            self.scale[h] *= z.denominator;
            if h > 0 {
                self.matrix.upper[h - 1] *= z.denominator;
            }
            if h + 1 < n {
                self.matrix.lower[h] *= z.denominator;
            }
        }
        self.matrix.factor().map_err(|_| ResponseError::unbounded(order, speed_rpm))
    }

    /// Solves for the torque of an order (an index) at a speed.
    fn solve(&mut self, design: &[Mounted], (order, speed_rpm): (usize, f64), work: &mut Work) -> Result<(), ResponseError> {
        work.direct_solves += 1;
        self.factor(design, order, speed_rpm)?;
        self.system.torque(order, speed_rpm, &mut self.x);
        self.matrix.solve(&mut self.x);
        Ok(())
    }

    /// Phasors of quantities under the torque of an order (an index) at a speed, given to `put` one by one; zero, even at a resonance, where
    /// there is no torque.
    fn phasors(
        &mut self,
        design: &[Mounted],
        quantities: &[Quantity],
        at: (usize, f64),
        work: &mut Work,
        mut put: impl FnMut(usize, C64),
    ) -> Result<(), ResponseError> {
        self.system.torque(at.0, at.1, &mut self.x);
        let still = self.x.iter().all(|t| *t == ZERO);
        if !still {
            self.solve(design, at, work)?;
        }
        for (i, quantity) in quantities.iter().enumerate() {
            let y = if still { ZERO } else { self.output(*quantity, &self.x) };
            if !y.is_finite() {
                return Err(ResponseError::unbounded(self.system.excitation.orders[at.0], at.1));
            }
            put(i, y);
        }
        Ok(())
    }

    fn phasor(&mut self, design: &[Mounted], quantity: Quantity, at: (usize, f64), work: &mut Work) -> Result<C64, ResponseError> {
        let mut found = ZERO;
        self.phasors(design, &[quantity], at, work, |_, y| found = y)?;
        Ok(found)
    }

    /// The quantity from a solution.
    fn output(&self, quantity: Quantity, x: &[C64]) -> C64 {
        let theta = |i: usize| self.scale[i] * x[i];
        match quantity {
            Quantity::Twist { from, to } => theta(from) - to.map_or(ZERO, theta),
            Quantity::ShaftTorque(s) => self.system.chain.shaft_stiffness(s, self.omega) * (theta(s) - theta(s + 1)),
            Quantity::RingTwist(a) => {
                let r = &self.rings[a];
                r.others * r.ring * x[r.station]
            }
        }
    }
}

/// Response of the base to torque and to a unit torque at a station, at one point.
pub(super) struct BasePoint {
    /// Quantity under the torque.
    pub output: C64,
    /// Quantity per unit torque at the station.
    pub output_per_torque: C64,
    /// Angle of the station under the torque.
    pub station: C64,
    /// Angle of the station per unit torque at the station.
    pub receptance: C64,
}

impl<'a> Direct<'a> {
    /// For the speeds of `grid`.
    pub fn new(system: &'a System, grid: &'a Grid) -> Self {
        Self { system, grid }
    }

    /// The speeds.
    pub fn grid(&self) -> &'a Grid {
        self.grid
    }

    /// Phasors of `quantity` at one speed (any), for each order.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance.
    pub fn at(
        &self,
        design: &[Mounted],
        quantity: Quantity,
        speed_rpm: f64,
        out: &mut [C64],
        work: &mut Work,
    ) -> Result<(), ResponseError> {
        let mut block = Block::new(self.system.chain.len(), design.len());
        self.speed(&mut block, design, &[quantity], speed_rpm, work, |_, n, y| out[n] = y)
    }

    /// Phasors of several quantities at any speeds, one sweep each.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance.
    pub fn at_each(
        &self,
        design: &[Mounted],
        quantities: &[Quantity],
        speeds: &[f64],
        work: &mut Work,
    ) -> Result<Vec<Vec<C64>>, ResponseError> {
        let mut block = Block::new(self.system.chain.len(), design.len());
        let mut out = vec![Vec::with_capacity(speeds.len() * self.system.orders()); quantities.len()];
        for &speed_rpm in speeds {
            self.speed(&mut block, design, quantities, speed_rpm, work, |i, _, y| out[i].push(y))?;
        }
        Ok(out)
    }

    /// Phasors of quantities at one speed, given to `put` with the index of the quantity and of the order, orders ascending.
    fn speed(
        &self,
        block: &mut Block,
        design: &[Mounted],
        quantities: &[Quantity],
        speed_rpm: f64,
        work: &mut Work,
        mut put: impl FnMut(usize, usize, C64),
    ) -> Result<(), ResponseError> {
        let (system, orders) = (self.system, self.system.orders());
        let torques = system.torques(speed_rpm);
        let mut scalar: Option<Factored> = None;
        let mut outputs = Vec::with_capacity(quantities.len());
        for first in (0..orders).step_by(LANES) {
            // lanes beyond the last order repeat it
            let order = |lane: usize| (first + lane).min(orders - 1);
            let mut still = [true; LANES];
            block.x.fill(Lane::ZERO);
            for (lane, still) in still.iter_mut().enumerate() {
                block.omega[lane] = system.excitation.orders[order(lane)].value() * speed_rpm * RAD_PER_S_PER_RPM;
                torques.each(order(lane), |station, torque| {
                    *still &= torque == ZERO;
                    block.x[station].set(lane, torque);
                });
            }
            block.solve(&system.chain.stations, design);
            outputs.clear();
            outputs.extend(quantities.iter().map(|q| self.output(block, *q)));
            for (lane, still) in still.into_iter().enumerate().take(orders - first) {
                let n = first + lane;
                if still {
                    (0..quantities.len()).for_each(|i| put(i, n, ZERO));
                    continue;
                }
                if block.cancelled[lane] <= LARGEST_CANCELLATION && outputs.iter().all(|y| y.get(lane).is_finite()) {
                    work.direct_solves += 1;
                    outputs.iter().enumerate().for_each(|(i, y)| put(i, n, y.get(lane)));
                } else {
                    let solver = scalar.get_or_insert_with(|| Factored::new(system));
                    solver.phasors(design, quantities, (n, speed_rpm), work, |i, y| put(i, n, y))?;
                }
            }
        }
        Ok(())
    }

    /// The quantity at every point of a block.
    fn output(&self, block: &Block, quantity: Quantity) -> Lane {
        let between = |a: usize, b: usize| block.twist[a..b].iter().fold(Lane::ZERO, |sum, t| sum.plus(t));
        match quantity {
            Quantity::Twist { from, to: None } => block.x[from],
            Quantity::Twist { from, to: Some(to) } if from <= to => between(from, to),
            Quantity::Twist { from, to: Some(to) } => between(to, from).minus(),
            Quantity::ShaftTorque(s) => {
                let stiffness = |lane: usize| self.system.chain.shaft_stiffness(s, block.omega[lane]);
                let mut torque = block.twist[s];
                (0..LANES).for_each(|lane| torque.set(lane, stiffness(lane) * torque.get(lane)));
                torque
            }
            Quantity::RingTwist(a) => block.ring[a],
        }
    }

    /// The phasor of one order (an index) at one speed.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance.
    pub fn order_at(
        &self,
        design: &[Mounted],
        quantity: Quantity,
        order: usize,
        speed_rpm: f64,
        work: &mut Work,
    ) -> Result<C64, ResponseError> {
        Factored::new(self.system).phasor(design, quantity, (order, speed_rpm), work)
    }

    /// Derivatives of the phasors of `quantity` at one speed with respect to ring inertia, stiffness and damping of absorber `index` of
    /// the design, for each of the given orders: dy/dp = -(dy/dT_hub) theta_hub dz/dp.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance.
    pub fn sensitivity(
        &self,
        design: &[Mounted],
        index: usize,
        quantity: Quantity,
        orders: std::ops::Range<usize>,
        speed_rpm: f64,
        work: &mut Work,
    ) -> Result<Vec<[C64; 3]>, ResponseError> {
        let mut solver = Factored::new(self.system);
        let mut hub = vec![ZERO; self.system.chain.len()];
        orders
            .map(|order| {
                solver.solve(design, (order, speed_rpm), work)?;
                let mounted = &design[index];
                hub.fill(ZERO);
                hub[mounted.station] = C64::from(1.0);
                solver.matrix.solve(&mut hub);
                let z = mounted.dynamic_stiffness(solver.omega);
                // theta_hub over this absorber's denominator is finite; the second denominator of dz/dp is divided out here
                let hub_over_denominator = solver.rings[index].others * solver.x[mounted.station];
                let factor = -solver.output(quantity, &hub) * hub_over_denominator / z.denominator;
                Ok(mounted.gradient_times_denominator2(solver.omega).map(|g| factor * g))
            })
            .collect()
    }

    /// Response of the system without absorber at one point, for several quantities, with the receptances of `station`.
    pub(super) fn base(
        &self,
        station: usize,
        quantities: &[Quantity],
        order: usize,
        speed_rpm: f64,
        work: &mut Work,
    ) -> Result<Vec<BasePoint>, ResponseError> {
        let mut solver = Factored::new(self.system);
        let mut unit = vec![ZERO; self.system.chain.len()];
        solver.solve(&[], (order, speed_rpm), work)?;
        unit[station] = C64::from(1.0);
        solver.matrix.solve(&mut unit);
        let point = |q: &Quantity| match q {
            // a ring follows its hub
            Quantity::RingTwist(_) => (solver.x[station], unit[station]),
            q => (solver.output(*q, &solver.x), solver.output(*q, &unit)),
        };
        Ok(quantities
            .iter()
            .map(|q| {
                let (output, output_per_torque) = point(q);
                BasePoint { output, output_per_torque, station: solver.x[station], receptance: unit[station] }
            })
            .collect())
    }

    /// Mean power dissipated in the damper of absorber `index` at one speed, W: sum over orders of c (omega |ring twist|)²/2.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance.
    pub fn dissipated_power(&self, design: &[Mounted], index: usize, speed_rpm: f64, work: &mut Work) -> Result<f64, ResponseError> {
        let mut twist = vec![ZERO; self.system.orders()];
        self.at(design, Quantity::RingTwist(index), speed_rpm, &mut twist, work)?;
        Ok(self.power_of_twist(design, index, speed_rpm, &twist))
    }

    /// The same from the phasors of the ring twist.
    pub fn power_of_twist(&self, design: &[Mounted], index: usize, speed_rpm: f64, twist: &[C64]) -> f64 {
        let rate = |n: usize| self.system.excitation.orders[n].value() * speed_rpm * RAD_PER_S_PER_RPM;
        twist.iter().enumerate().map(|(n, y)| 0.5 * design[index].absorber.damping() * (rate(n) * y.norm()).powi(2)).sum()
    }
}

impl Response for Direct<'_> {
    super::method::identity!("direct");

    fn phasor(&self, design: &[Mounted], quantity: Quantity, at: (usize, f64), work: &mut Work) -> Result<C64, ResponseError> {
        let (order, speed_rpm) = at;
        self.order_at(design, quantity, order, speed_rpm, work)
    }

    fn sweep(&self, design: &[Mounted], quantity: Quantity, out: &mut Vec<C64>, work: &mut Work) -> Result<(), ResponseError> {
        *out = self.sweep_each(design, &[quantity], work)?.swap_remove(0);
        Ok(())
    }

    fn sweep_each(&self, design: &[Mounted], quantities: &[Quantity], work: &mut Work) -> Result<Vec<Vec<C64>>, ResponseError> {
        self.at_each(design, quantities, &self.grid.speed_rpm, work)
    }
}
