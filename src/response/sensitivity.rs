//! Derivatives of a response by the parameters of an absorber, several orders at a time.

use super::batch::Block;
use super::direct::{Direct, LARGEST_CANCELLATION};
use super::factored::Factored;
use super::lane::{LANES, Lane};
use super::output::Output;
use super::{Quantity, ResponseError, Work};
use crate::absorber::mounted::station_of;
use crate::absorber::{Condensed, Mounted, Operating};
use crate::numerics::{C64, ZERO};
use crate::units::RAD_PER_S_PER_RPM;

impl Direct<'_> {
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
        if let Quantity::RingTwist(of) = quantity {
            return self.sensitivity_of_ring(design, (index, of), orders, speed_rpm, work);
        }
        let (chain, excitation) = (&self.system.chain, &self.system.excitation);
        let (station, output, shaft_speed) = (station_of(design, index), Output::of(chain, quantity), speed_rpm * RAD_PER_S_PER_RPM);
        let torques = self.system.torques(speed_rpm);
        let mut block = Block::new(chain, design.len());
        let (mut condensed, mut scalar) = (Condensed::default(), None);
        let mut list = Vec::with_capacity(orders.len());
        for first in orders.clone().step_by(LANES) {
            block.x.fill(Lane::ZERO);
            for lane in 0..LANES {
                // lanes beyond the last order repeat it
                let order = (first + lane).min(orders.end - 1);
                (block.omega[lane], block.shaft_speed[lane]) = (excitation.orders[order].omega(speed_rpm), shaft_speed);
                torques.each(order, |station, torque| block.x[station].set(lane, torque));
            }
            block.solve(&chain.stations, design);
            let angle = block.x[station];
            block.x.fill(Lane::ZERO);
            block.x[station] = Lane::ONE;
            block.solve(&chain.stations, design);
            // by reciprocity a torque on the station does at the output what one at the output does at the station
            let per_torque = output.value(chain, &block);
            for (lane, order) in (first..orders.end).enumerate().take(LANES) {
                let at = Operating { omega: block.omega[lane], shaft_speed };
                condensed.set(design, at);
                let ring = &condensed.rings[index];
                let host_over_denominator = ring.host * angle.get(lane) / condensed.hubs[ring.hub].denominator;
                let factor = dz_factor(&condensed, design, index, (per_torque.get(lane), host_over_denominator));
                if block.cancelled[lane] <= LARGEST_CANCELLATION && factor.is_finite() {
                    work.direct_solves += 1;
                    list.push(condensed.gradient_times_denominator2(design, index, at).into_iter().map(|g| factor * g).collect());
                } else {
                    let solver = scalar.get_or_insert_with(|| Factored::new(self.system));
                    list.push(exchanged(solver, design, index, (quantity, station), (order, speed_rpm), work)?);
                }
            }
        }
        Ok(list)
    }
}

/// What dz/dp times the square of the denominator of an absorber is multiplied by, from the output per torque on its station and the angle of its host over the denominator.
fn dz_factor(condensed: &Condensed, design: &[Mounted], index: usize, (per_torque, host_over_denominator): (C64, C64)) -> C64 {
    -(per_torque * condensed.host_per_station(design, index)) * host_over_denominator / condensed.denominator(index)
}

/// The same of one order, with exchange of rows.
fn exchanged(
    solver: &mut Factored,
    design: &[Mounted],
    index: usize,
    (quantity, station): (Quantity, usize),
    (order, speed_rpm): (usize, f64),
    work: &mut Work,
) -> Result<Vec<C64>, ResponseError> {
    solver.solve(design, (order, speed_rpm), work)?;
    let mut unit = vec![ZERO; solver.x.len()];
    unit[station] = C64::from(1.0);
    solver.matrix.solve(&mut unit);
    let (condensed, at) = (&solver.condensed, Operating { omega: solver.omega, shaft_speed: speed_rpm * RAD_PER_S_PER_RPM });
    let ring = &condensed.rings[index];
    // the host's angle over this absorber's denominator is finite; the second denominator of dz/dp is divided out here
    let host_over_denominator = solver.hub(ring.hub, ring.host, &solver.x);
    let factor = dz_factor(condensed, design, index, (solver.output(quantity, &unit), host_over_denominator));
    Ok(condensed.gradient_times_denominator2(design, index, at).into_iter().map(|g| factor * g).collect())
}
