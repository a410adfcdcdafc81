//! One absorber of a design at one speed, its law left open: what the rest does to its host is solved once, whatever the law.
//!
//! With u0 the angle of the host under the torque of an order and H its receptance, both without the ring, a ring of inertia J on a law S twists by omega² J u0/(S - omega² J (1 + S H)) against its host.

use super::factored::Factored;
use super::{Direct, Quantity, ResponseError, Work};
use crate::absorber::mounted::with_law;
use crate::absorber::{Absorber, Host, Law, Mounted, Operating};
use crate::numerics::{C64, ZERO};
use crate::units::RAD_PER_S_PER_RPM;
use std::sync::Arc;

/// One absorber of a design at one speed.
pub(crate) struct OpenLaw<'a> {
    direct: &'a Direct<'a>,
    design: &'a [Mounted],
    index: usize,
    speed_rpm: f64,
    at: Vec<Operating>,
    /// u0 and H of every order; nothing where the absorber sits on a ring or carries one, or where the rest resonates: the whole is solved then.
    host: Option<Vec<(C64, C64)>>,
}

impl<'a> OpenLaw<'a> {
    /// Absorber `index` of a design at a speed.
    pub fn new(direct: &'a Direct<'a>, (design, index): (&'a [Mounted], usize), speed_rpm: f64) -> Self {
        let (orders, shaft_speed) = (&direct.system.excitation.orders, speed_rpm * RAD_PER_S_PER_RPM);
        let at = orders.iter().map(|order| Operating { omega: order.omega(speed_rpm), shaft_speed }).collect();
        let alone = !design.iter().any(|m| m.on == Host::Ring(index));
        let host = match design[index].on {
            Host::Station(station) if alone => host(direct, (design, index), station, speed_rpm),
            _ => None,
        };
        Self { direct, design, index, speed_rpm, at, host }
    }

    /// The whole design with a law for the absorber.
    pub fn with(&self, law: &Arc<dyn Law>) -> Vec<Mounted> {
        with_law(self.design, self.index, |_| law.clone())
    }

    /// Twist of the ring for each order, rad.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] at an undamped resonance.
    pub fn ring_twist(&self, law: &Arc<dyn Law>) -> Result<Vec<C64>, ResponseError> {
        if let Some(host) = &self.host {
            let mut stiffness = vec![ZERO; self.at.len()];
            law.dynamic_stiffness_each(&self.at, &mut stiffness);
            let one = |((at, s), (u0, receptance)): ((&Operating, &C64), &(C64, C64))| {
                let inertial = law.ring_inertia() * at.omega * at.omega;
                inertial * u0 / (s - inertial * (1.0 + s * receptance))
            };
            let twist: Vec<C64> = self.at.iter().zip(&stiffness).zip(host).map(one).collect();
            if twist.iter().all(|y| y.is_finite()) {
                return Ok(twist);
            }
        }
        let quantities = [Quantity::RingTwist(self.index)];
        Ok(self.direct.at_each(&self.with(law), &quantities, &[self.speed_rpm], &mut Work::default())?.swap_remove(0))
    }

    /// Mean power that the law dissipates under such a twist, W.
    pub fn power(&self, law: &Arc<dyn Law>, twist: &[C64]) -> f64 {
        self.at.iter().zip(twist).map(|(at, y)| law.dissipated_power(*at, y.norm())).sum()
    }
}

/// Angle of a station and its receptance for each order, the ring of the absorber taken off.
fn host(direct: &Direct, (design, index): (&[Mounted], usize), station: usize, speed_rpm: f64) -> Option<Vec<(C64, C64)>> {
    let mut rest = design.to_vec();
    rest[index].absorber = Absorber::Locked { ring_inertia: 0.0 };
    let mut solver = Factored::new(direct.system);
    let mut unit = vec![ZERO; direct.system.chain.len()];
    let one = |order: usize| {
        solver.solve(&rest, (order, speed_rpm), &mut Work::default()).ok()?;
        unit.fill(ZERO);
        unit[station] = C64::from(1.0);
        solver.matrix.solve(&mut unit);
        let found = (solver.angle(station, &solver.x), solver.angle(station, &unit));
        (found.0.is_finite() && found.1.is_finite()).then_some(found)
    };
    (0..direct.system.orders()).map(one).collect()
}
