//! One absorber of a design at one speed, its law left open: what the rest does to its host is solved once, whatever the law.
//!
//! With u0 the angle of the host under the torque of an order and H its receptance, both without the ring, a ring of inertia J on a law S twists by omega² J u0/(S - omega² J (1 + S H)) against its host.

use super::factored::Factored;
use super::{Direct, Quantity, ResponseError, Work};
use crate::absorber::mounted::with_law;
use crate::absorber::{Absorber, Host, Law, Mounted, Operating};
use crate::numerics::{C64, ZERO};
use crate::units::RAD_PER_S_PER_RPM;
use rayon::prelude::*;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

/// u0 and H of every order.
type OfOrders = Vec<(C64, C64)>;

/// u0 and H at the speeds of a grid, for designs of one ring alone on a station: the same whatever the ring.
#[derive(Debug, Default)]
pub(crate) struct Hosts {
    /// By speed; nothing where the chain resonates.
    stations: BTreeMap<usize, Vec<Option<OfOrders>>>,
}

impl Hosts {
    /// For these designs at the speeds of `direct`.
    pub fn of<'d>(direct: &Direct, designs: impl Iterator<Item = &'d [Mounted]>) -> Self {
        let mut stations = BTreeMap::new();
        for station in designs.filter_map(single) {
            let at = |speed: &f64| host(direct, &[], station, *speed);
            stations.entry(station).or_insert_with(|| direct.grid().speed_rpm.par_iter().map(at).collect());
        }
        Self { stations }
    }

    /// For a design at a speed of the grid.
    fn get(&self, design: &[Mounted], speed: usize) -> Option<&[(C64, C64)]> {
        self.stations.get(&single(design)?)?.get(speed)?.as_deref()
    }
}

/// The station that carries a ring alone.
fn single(design: &[Mounted]) -> Option<usize> {
    match design {
        [Mounted { on: Host::Station(station), hub_inertia: 0.0, .. }] => Some(*station),
        _ => None,
    }
}

/// One absorber of a design at one speed.
pub(crate) struct OpenLaw<'a> {
    direct: &'a Direct<'a>,
    design: &'a [Mounted],
    index: usize,
    speed_rpm: f64,
    at: Vec<Operating>,
    /// u0 and H of every order; nothing where the absorber sits on a ring or carries one, or where the rest resonates: the whole is solved then.
    host: Option<Cow<'a, [(C64, C64)]>>,
}

impl<'a> OpenLaw<'a> {
    /// Absorber `index` of a design at a speed; `known`: hosts, and which speed of their grid this is.
    pub fn new(direct: &'a Direct<'a>, (design, index): (&'a [Mounted], usize), speed_rpm: f64, known: Option<(&'a Hosts, usize)>) -> Self {
        let (orders, shaft_speed) = (&direct.system.excitation.orders, speed_rpm * RAD_PER_S_PER_RPM);
        let at = orders.iter().map(|order| Operating { omega: order.omega(speed_rpm), shaft_speed }).collect();
        let alone = !design.iter().any(|m| m.on == Host::Ring(index));
        let solved = || match design[index].on {
            Host::Station(station) if alone => {
                let mut rest = design.to_vec();
                rest[index].absorber = Absorber::Locked { ring_inertia: 0.0 };
                host(direct, &rest, station, speed_rpm)
            }
            _ => None,
        };
        let host = known.and_then(|(hosts, speed)| hosts.get(design, speed)).map(Cow::Borrowed).or_else(|| solved().map(Cow::Owned));
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
            let twist: Vec<C64> = self.on_host(law, host).map(|(twist, _)| twist).collect();
            if twist.iter().all(|y| y.is_finite()) {
                return Ok(twist);
            }
        }
        let quantities = [Quantity::RingTwist(self.index)];
        Ok(self.direct.at_each(&self.with(law), &quantities, &[self.speed_rpm], &mut Work::default())?.swap_remove(0))
    }

    /// Mean power that the law dissipates, W: sum over orders of omega Im S |ring twist|²/2.
    ///
    /// # Errors
    /// As [`Self::ring_twist`].
    pub fn power(&self, law: &Arc<dyn Law>) -> Result<f64, ResponseError> {
        if let Some(host) = &self.host {
            let power: f64 = self.on_host(law, host).map(|(twist, rate)| 0.5 * rate * twist.norm_sqr()).sum();
            if power.is_finite() {
                return Ok(power);
            }
        }
        let twist = self.ring_twist(law)?;
        Ok(self.at.iter().zip(&twist).map(|(at, y)| law.dissipated_power(*at, y.norm_sqr())).sum())
    }

    /// The same by the factor that temperature puts on the material of a law, where that is quicker; it is not finite where the whole has to be solved.
    pub(crate) fn power_by_factor<'s>(&'s self, law: &'s dyn Law) -> Option<impl FnMut(f64) -> f64 + 's> {
        let (host, each) = (self.host.as_ref()?, law.followed_each(&self.at)?);
        let mut stiffness = vec![ZERO; self.at.len()];
        // the twist is w² J u0/(S (1 - w² J H) - w² J): what does not depend on S is computed once
        let known = |(at, (u0, receptance)): (&Operating, &(C64, C64))| {
            let inertial = law.ring_inertia() * at.omega * at.omega;
            (0.5 * at.omega * inertial * inertial * u0.norm_sqr(), 1.0 - inertial * receptance, inertial)
        };
        let known: Vec<(f64, C64, f64)> = self.at.iter().zip(host.iter()).map(known).collect();
        Some(move |factor: f64| {
            each(factor, &mut stiffness);
            known.iter().zip(&stiffness).map(|((weight, held, inertial), s)| weight * s.im / (s * held - inertial).norm_sqr()).sum()
        })
    }

    /// Twist of the ring and omega Im S for each order.
    fn on_host<'s>(&'s self, law: &Arc<dyn Law>, host: &'s [(C64, C64)]) -> impl Iterator<Item = (C64, f64)> + 's {
        let mut stiffness = vec![ZERO; self.at.len()];
        law.dynamic_stiffness_each(&self.at, &mut stiffness);
        self.of_stiffness(law.ring_inertia(), &stiffness, host).collect::<Vec<_>>().into_iter()
    }

    /// The same where S is known.
    fn of_stiffness<'s>(&'s self, ring: f64, stiffness: &'s [C64], host: &'s [(C64, C64)]) -> impl Iterator<Item = (C64, f64)> + 's {
        self.at.iter().zip(stiffness).zip(host).map(move |((at, s), (u0, receptance))| {
            let inertial = ring * at.omega * at.omega;
            (inertial * u0 / (s - inertial * (1.0 + s * receptance)), at.omega * s.im)
        })
    }
}

/// Angle of a station and its receptance for each order, with the rest of a design.
fn host(direct: &Direct, rest: &[Mounted], station: usize, speed_rpm: f64) -> Option<OfOrders> {
    let mut solver = Factored::new(direct.system);
    let mut unit = vec![ZERO; direct.system.chain.len()];
    let one = |order: usize| {
        solver.solve(rest, (order, speed_rpm), &mut Work::default()).ok()?;
        unit.fill(ZERO);
        unit[station] = C64::from(1.0);
        solver.matrix.solve(&mut unit);
        let found = (solver.angle(station, &solver.x), solver.angle(station, &unit));
        (found.0.is_finite() && found.1.is_finite()).then_some(found)
    };
    (0..direct.system.orders()).map(one).collect()
}
