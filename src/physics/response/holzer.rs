//! Holzer's method: angle and torque carried along the chain from one end to the other (transfer matrices), absorbers condensed.
//!
//! Two marches, one from an angle of one at the first station without torque, one from rest with the torque; the torque behind the last
//! station must vanish. On long chains and above the resonances of single shafts both grow and their difference loses digits: more than
//! `LARGEST_CANCELLATION` is refused.

use super::{Grid, Quantity, Response, ResponseError, Work};
use crate::absorber::{Condensed, Mounted, Operating};
use crate::drivetrain::System;
use crate::numerics::{C64, ZERO};
use crate::units::RAD_PER_S_PER_RPM;

/// Growth of the marches over the solution that is left; an error of about this many roundings remains.
pub(crate) const LARGEST_CANCELLATION: f64 = 1e6;

/// Transfer matrices along the chain.
#[derive(Debug)]
#[doc(hidden)]
pub struct Holzer<'a> {
    system: &'a System,
    grid: &'a Grid,
}

impl<'a> Holzer<'a> {
    /// For the speeds of `grid`.
    pub fn new(system: &'a System, grid: &'a Grid) -> Self {
        Self { system, grid }
    }
}

impl Response for Holzer<'_> {
    super::method::identity!("holzer");

    fn phasor(&self, design: &[Mounted], quantity: Quantity, at: (usize, f64), work: &mut Work) -> Result<C64, ResponseError> {
        let (order, speed_rpm) = at;
        let (chain, n) = (&self.system.chain, self.system.chain.len());
        let excited = self.system.excitation.orders[order];
        let omega = excited.omega(speed_rpm);
        if !chain.is_row() {
            return Err(ResponseError::NotApplicable {
                method: "holzer",
                why: "it marches along a row of stations: no branches, no gears",
            });
        }
        work.marches += 1;
        let mut torque = vec![ZERO; n];
        self.system.torque(order, speed_rpm, &mut torque);
        if torque.iter().all(|t| *t == ZERO) {
            return Ok(ZERO);
        }
        // what each station is tied to the ground with, absorbers included
        let mut tie: Vec<C64> = (0..n).map(|i| chain.ground_stiffness(i, omega)).collect();
        let unbounded = || ResponseError::unbounded(excited, speed_rpm);
        let condensed = Condensed::new(design, Operating { omega, shaft_speed: speed_rpm * RAD_PER_S_PER_RPM });
        for z in &condensed.hubs {
            if z.denominator == ZERO {
                return Err(ResponseError::NotApplicable { method: "holzer", why: "an undamped ring resonates, its hub stands still" });
            }
            tie[z.station] += z.numerator / z.denominator;
        }
        // angles of both marches, and torque in the shaft behind each station
        let (mut free, mut forced) = (vec![ZERO; n], vec![ZERO; n]);
        free[0] = C64::from(1.0);
        let (mut free_torque, mut forced_torque) = (ZERO, ZERO);
        let mut largest: f64 = 0.0;
        for i in 0..n {
            // torque behind a station: what came in front, less what ties it, plus what acts
            free_torque += tie[i] * free[i];
            forced_torque += tie[i] * forced[i] - torque[i];
            if i + 1 < n {
                let shaft = chain.shaft_stiffness(i, omega);
                if shaft == ZERO {
                    return Err(ResponseError::NotApplicable { method: "holzer", why: "a link has neither stiffness nor damping" });
                }
                free[i + 1] = free[i] + free_torque / shaft;
                forced[i + 1] = forced[i] + forced_torque / shaft;
            }
        }
        let first = -forced_torque / free_torque;
        let theta: Vec<C64> = free.iter().zip(&forced).map(|(a, b)| first * a + b).collect();
        let size = theta.iter().map(|t| t.norm()).fold(0.0, f64::max);
        for (a, b) in free.iter().zip(&forced) {
            largest = largest.max((first * a).norm().max(b.norm()));
        }
        if !size.is_finite() || !largest.is_finite() {
            return Err(unbounded());
        }
        if largest > LARGEST_CANCELLATION * size {
            return Err(ResponseError::LostDigits { method: "holzer", order: excited, speed_rpm, factor: largest / size });
        }
        let y = match quantity {
            Quantity::Twist { from, to } => theta[from] - to.map_or(ZERO, |to| theta[to]),
            Quantity::Motion(station, rate) => rate.of(theta[station], omega),
            Quantity::ShaftTorque(s) => chain.shaft_stiffness(s, omega) * (theta[s] - theta[s + 1]),
            Quantity::RingTwist(r) => {
                let ring = &condensed.rings[r];
                let hub = &condensed.hubs[ring.hub];
                theta[hub.station] * ring.twist / hub.denominator
            }
        };
        if y.is_finite() { Ok(y) } else { Err(unbounded()) }
    }
}
