//! Direct solution: the dynamic stiffness of chain and absorbers, tridiagonal once the rings are condensed onto their stations.

use super::batch::Block;
use super::factored::Factored;
use super::known_points::{AtSpeed, KnownPoints, Wanted};
use super::lane::{LANES, Lane};
use super::output::Output;
use super::{Grid, Quantity, Response, ResponseError, Work};
use crate::absorber::condensed::Hub;
use crate::absorber::mounted::station_of;
use crate::absorber::{Mounted, Operating};
use crate::drivetrain::{FlexibleCrank, System};
use crate::numerics::{C64, ZERO};
use crate::units::RAD_PER_S_PER_RPM;
use nalgebra::DMatrix;

/// Solves (K + i omega C - omega² J + z(omega)) theta = T at every order and speed.
#[derive(Debug)]
pub struct Direct<'a> {
    /// The system.
    pub system: &'a System,
    grid: &'a Grid,
    known: KnownPoints,
}

/// Several points are solved at once without exchange of rows; one that cancels by more than this is solved again with it. Below, the error is at
/// most about as many roundings.
pub(super) const LARGEST_CANCELLATION: f64 = 1e4;

/// Response of the base to its torque and to a unit torque at each of some stations, at one point.
#[derive(Debug)]
pub(super) struct BasePoint {
    /// Angle of each station under the torque.
    pub stations: Vec<C64>,
    /// Angle of a station (row) per unit torque at another one (column).
    pub receptance: DMatrix<C64>,
    /// Of each quantity, its value under the torque and per unit torque at each station.
    pub outputs: Vec<(C64, Vec<C64>)>,
}

impl BasePoint {
    /// Whether every number is one.
    pub fn is_finite(&self) -> bool {
        let outputs = self.outputs.iter().flat_map(|(y, each)| std::iter::once(y).chain(each));
        self.stations.iter().chain(self.receptance.iter()).chain(outputs).all(|y| y.is_finite())
    }
}

impl<'a> Direct<'a> {
    /// For the speeds of `grid`.
    pub fn new(system: &'a System, grid: &'a Grid) -> Self {
        Self { system, grid, known: KnownPoints::default() }
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
        self.points(design, &[quantity], &[speed_rpm], work, |_, n, y| out[n] = y)
    }

    /// Phasors of several quantities at any speeds, one sweep each.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance.
    #[doc(hidden)]
    pub fn at_each(
        &self,
        design: &[Mounted],
        quantities: &[Quantity],
        speeds: &[f64],
        work: &mut Work,
    ) -> Result<Vec<Vec<C64>>, ResponseError> {
        let mut out = vec![Vec::with_capacity(speeds.len() * self.system.orders()); quantities.len()];
        self.points(design, quantities, speeds, work, |i, _, y| out[i].push(y))?;
        Ok(out)
    }

    /// Answers of a flexible crank without absorbers at a speed; the index of the order that has none at an undamped resonance.
    pub(super) fn of_crank(&self, crank: &FlexibleCrank, wanted: &Wanted, speed_rpm: f64) -> Result<AtSpeed, usize> {
        self.known.at((self.system, crank), wanted, speed_rpm)
    }

    /// Phasors of quantities at speeds, given to `put` with the index of the quantity and of the point (orders of a speed together, ascending).
    fn points(
        &self,
        design: &[Mounted],
        quantities: &[Quantity],
        speeds: &[f64],
        work: &mut Work,
        mut put: impl FnMut(usize, usize, C64),
    ) -> Result<(), ResponseError> {
        let orders = self.system.orders();
        if let Some(crank) = &self.system.flexible {
            let mut solver = Factored::new(self.system);
            let wanted = solver.wanted(design, quantities);
            for (i, speed) in speeds.iter().enumerate() {
                let known = self.of_crank(crank, &wanted, *speed);
                let known = known.map_err(|order| ResponseError::unbounded(self.system.excitation.orders[order], *speed))?;
                for (order, known) in known.chunks(wanted.len().max(1)).enumerate() {
                    let put = |quantity: usize, y| put(quantity, i * orders + order, y);
                    solver.phasors_of_known((design, quantities), (order, *speed), (&wanted, known), work, put)?;
                }
            }
            return Ok(());
        }
        let places = speeds.iter().flat_map(|speed| (0..orders).map(move |order| (order, *speed)));
        self.places(design, quantities, (speeds.len() * orders, places), work, put)
    }

    /// The same at so many places: an order and a speed each.
    pub(super) fn places(
        &self,
        design: &[Mounted],
        quantities: &[Quantity],
        (count, mut places): (usize, impl Iterator<Item = (usize, f64)>),
        work: &mut Work,
        mut put: impl FnMut(usize, usize, C64),
    ) -> Result<(), ResponseError> {
        let system = self.system;
        if system.flexible.is_some() {
            let mut solver = Factored::new(system);
            solver.ask(design, quantities);
            return places.enumerate().try_for_each(|(point, at)| solver.phasors(design, quantities, at, work, |i, y| put(i, point, y)));
        }
        let Some(mut place) = places.next() else { return Ok(()) };
        let mut block = Block::new(&system.chain, design.len());
        let mut torques = system.torques(place.1);
        let mut at = [place; LANES];
        let mut scalar: Option<Factored> = None;
        let made_of: Vec<Output> = quantities.iter().map(|q| Output::of(&system.chain, *q)).collect();
        let mut outputs = Vec::with_capacity(quantities.len());
        for first in (0..count).step_by(LANES) {
            let mut still = [true; LANES];
            block.x.fill(Lane::ZERO);
            for (lane, still) in still.iter_mut().enumerate() {
                let (order, speed) = place;
                at[lane] = place;
                block.omega[lane] = system.excitation.orders[order].omega(speed);
                block.shaft_speed[lane] = speed * RAD_PER_S_PER_RPM;
                torques.each(order, |station, torque| {
                    *still &= torque == ZERO;
                    block.x[station].set(lane, torque);
                });
                // lanes beyond the last point repeat it
                if let Some(next) = places.next() {
                    if next.1 != speed {
                        torques = system.torques(next.1);
                    }
                    place = next;
                }
            }
            block.solve(&system.chain.stations, design);
            outputs.clear();
            outputs.extend(made_of.iter().map(|output| output.value(&system.chain, &block)));
            for (lane, still) in still.into_iter().enumerate().take(count - first) {
                let point = first + lane;
                if still {
                    (0..quantities.len()).for_each(|i| put(i, point, ZERO));
                } else if block.cancelled[lane] <= LARGEST_CANCELLATION && outputs.iter().all(|y| y.get(lane).is_finite()) {
                    work.direct_solves += 1;
                    outputs.iter().enumerate().for_each(|(i, y)| put(i, point, y.get(lane)));
                } else {
                    let solver = scalar.get_or_insert_with(|| Factored::new(system));
                    solver.phasors(design, quantities, at[lane], work, |i, y| put(i, point, y))?;
                }
            }
        }
        Ok(())
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

    /// Torque of every absorber on its station at an order (an index) and a speed, N m.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance.
    #[doc(hidden)]
    pub fn absorber_torques(&self, design: &[Mounted], at: (usize, f64), work: &mut Work) -> Result<Vec<(usize, C64)>, ResponseError> {
        let mut solver = Factored::new(self.system);
        solver.ask(design, &[]);
        solver.solve(design, at, work)?;
        let torque_of_hub = |(hub, z): (usize, &Hub)| (z.station, -solver.hub(hub, z.numerator, &solver.x));
        Ok(solver.condensed.hubs.iter().enumerate().map(torque_of_hub).collect())
    }

    /// Derivatives of the phasors of `quantity` at one speed with respect to the parameters of absorber `index` of the design
    /// (ring inertia first), for each of the given orders: dy/dp = -(dy/dT) theta dz/dp with angle and torque at what carries the absorber.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance; [`ResponseError::NotApplicable`] for the twist of a locked ring.
    pub(crate) fn sensitivity(
        &self,
        design: &[Mounted],
        index: usize,
        quantity: Quantity,
        orders: std::ops::Range<usize>,
        speed_rpm: f64,
        work: &mut Work,
    ) -> Result<Vec<Vec<C64>>, ResponseError> {
        Ok(self.sensitivities(design, &[index], quantity, orders, speed_rpm, work)?.swap_remove(0))
    }

    /// The same for several absorbers, each with its own list of orders.
    ///
    /// # Errors
    /// As [`Direct::sensitivity`].
    pub(crate) fn sensitivities(
        &self,
        design: &[Mounted],
        absorbers: &[usize],
        quantity: Quantity,
        orders: std::ops::Range<usize>,
        speed_rpm: f64,
        work: &mut Work,
    ) -> Result<Vec<Vec<Vec<C64>>>, ResponseError> {
        let mut solver = Factored::new(self.system);
        solver.ask(design, &[quantity]);
        let mut all = vec![Vec::with_capacity(orders.len()); absorbers.len()];
        for order in orders {
            solver.solve(design, (order, speed_rpm), work)?;
            let at = Operating { omega: solver.omega, shaft_speed: speed_rpm * RAD_PER_S_PER_RPM };
            if let Quantity::RingTwist(of) = quantity {
                let found = self.ring_changes(design, (absorbers, of), &mut solver, at, &mut |i, own| all[i].push(own));
                found.ok_or(ResponseError::NotApplicable { method: "direct", why: "a locked ring has no twist" })?;
            } else {
                self.changes(design, (absorbers, quantity), &mut solver, at, &mut |i, own| all[i].push(own));
            }
        }
        Ok(all)
    }

    /// The derivatives of a quantity of the chain at one order, the system being solved for its torque, given to `put` with the place in the list of absorbers.
    fn changes(
        &self,
        design: &[Mounted],
        (absorbers, quantity): (&[usize], Quantity),
        solver: &mut Factored,
        at: Operating,
        put: &mut dyn FnMut(usize, Vec<C64>),
    ) {
        let mut unit = Vec::new();
        let mut solved = None;
        for (i, &index) in absorbers.iter().enumerate() {
            let station = station_of(design, index);
            if solved != Some(station) {
                unit = solver.under_unit(station);
                solved = Some(station);
            }
            let condensed = &solver.condensed;
            let ring = &condensed.rings[index];
            // the host's angle over this absorber's denominator is finite; the second denominator of dz/dp is divided out here
            let host_over_denominator = solver.hub(ring.hub, ring.host, &solver.x);
            // by reciprocity a torque on the host does at the station what one on the station does at the host
            let output = solver.output(quantity, &unit) * condensed.host_per_station(design, index);
            let factor = -output * host_over_denominator / condensed.denominator(index);
            put(i, condensed.gradient_times_denominator2(design, index, at).into_iter().map(|g| factor * g).collect());
        }
    }

    /// Response of the system without absorber at one point, for several quantities, with the receptances of `stations`.
    pub(super) fn base(
        &self,
        solver: &mut Factored,
        stations: &[usize],
        quantities: &[Quantity],
        order: usize,
        speed_rpm: f64,
        work: &mut Work,
    ) -> Result<BasePoint, ResponseError> {
        solver.solve(&[], (order, speed_rpm), work)?;
        let units: Vec<Vec<C64>> = stations.iter().map(|station| solver.under_unit(*station)).collect();
        let output = |q: &Quantity| match q {
            // a ring follows its hub: that of the first station
            Quantity::RingTwist(_) => (solver.angle(stations[0], &solver.x), units.iter().map(|u| solver.angle(stations[0], u)).collect()),
            q => (solver.output(*q, &solver.x), units.iter().map(|u| solver.output(*q, u)).collect()),
        };
        Ok(BasePoint {
            stations: stations.iter().map(|s| solver.angle(*s, &solver.x)).collect(),
            receptance: DMatrix::from_fn(stations.len(), stations.len(), |i, j| solver.angle(stations[i], &units[j])),
            outputs: quantities.iter().map(output).collect(),
        })
    }

    /// Mean power dissipated in the damper of absorber `index` at one speed, W: sum over orders of omega Im S |ring twist|²/2.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance.
    pub fn dissipated_power(&self, design: &[Mounted], index: usize, speed_rpm: f64, work: &mut Work) -> Result<f64, ResponseError> {
        let mut twist = vec![ZERO; self.system.orders()];
        self.at(design, Quantity::RingTwist(index), speed_rpm, &mut twist, work)?;
        Ok(self.power_of_twist(design, index, speed_rpm, &twist))
    }

    /// The same from the phasors of the ring twist.
    #[doc(hidden)]
    pub fn power_of_twist(&self, design: &[Mounted], index: usize, speed_rpm: f64, twist: &[C64]) -> f64 {
        let Some(law) = design[index].absorber.law() else { return 0.0 };
        let shaft_speed = speed_rpm * RAD_PER_S_PER_RPM;
        let at: Vec<Operating> =
            self.system.excitation.orders.iter().map(|order| Operating { omega: order.omega(speed_rpm), shaft_speed }).collect();
        let mut losses = vec![0.0; at.len()];
        law.loss_each(&at, &mut losses);
        losses.iter().zip(twist).map(|(loss, y)| loss * y.norm_sqr()).sum()
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
