//! Phasors of all designs of a box at one speed: the base is solved once, and absorbers whose parameters are Taylor models are put on it.
//!
//! A ring of inertia J on a law S (m = -omega² J, hub b = -omega² J_hub) loads its station with z = n/d, d = S + m, n = S m + b d. With u0 the angle of the station and y0 an output without
//! absorber, H the receptance of the station and h the output per unit torque there, y = y0 - h n f with f = u0/(d + H n); of several absorbers on stations d_i f_i + sum H_ij n_j f_j = u0_i. The ring
//! turns by -m f against its hub. For one absorber d + H n = c S + t is linear in S: n/(c S + t) is taken as one inverse.

use super::direct::BasePoint;
use super::factored::Factored;
use super::{Direct, Quantity, Work};
use crate::absorber::{Absorber, Host, Law, Mounted, Operating};
use crate::numerics::C64;
use crate::numerics::taylor::Taylor;
use crate::units::RAD_PER_S_PER_RPM;
use std::sync::Arc;

/// Share of their size to which solutions of the base are trusted: rows are exchanged for the largest pivot, and the rest of a solution is at most some thousand roundings.
pub const TRUSTED: f64 = 1e-12;
/// Where what a locked ring makes of the base cancels by more than this, n and the inverse are multiplied instead.
const CANCELS: f64 = 1e-4;

/// An absorber whose parameters are Taylor models.
#[derive(Debug, Clone)]
pub struct Enclosed {
    /// Where its station stands among those of the base.
    station: usize,
    /// Beside the ring, kg m².
    hub: f64,
    /// Its law; `None` where the ring turns with its hub.
    law: Option<Arc<dyn Law>>,
    values: Vec<Taylor>,
    /// kg m².
    ring: Taylor,
}

impl Enclosed {
    /// An absorber with these values of its parameters in place of its own, on one of some stations; `None` where it sits on a ring or its hub follows from its dimensions.
    pub fn of(mounted: &Mounted, values: Vec<Taylor>, stations: &[usize]) -> Option<Self> {
        let Host::Station(own) = mounted.on else { return None };
        let station = stations.iter().position(|s| *s == own)?;
        match &mounted.absorber {
            Absorber::Ring(law) if law.parts().is_some() => None,
            Absorber::Ring(law) => {
                let ring = law.ring_over(&values);
                Some(Self { station, hub: mounted.hub(), law: Some(law.clone()), values, ring })
            }
            Absorber::Locked { ring_inertia } => {
                let ring = Taylor::constant(C64::from(*ring_inertia));
                Some(Self { station, hub: mounted.hub(), law: None, values, ring })
            }
        }
    }

    /// d, n, m and S.
    fn fraction(&self, at: Operating) -> Option<[Taylor; 4]> {
        let (own, hub) = (self.inertial(at), self.hub_inertial(at));
        let number = |x: f64| Taylor::constant(C64::from(x));
        let Some(law) = &self.law else { return Some([number(1.0), own.plus(&hub), number(0.0), number(0.0)]) };
        let s = law.over(&self.values, at)?;
        let d = s.plus(&own);
        Some([d, s.times(&own).plus(&hub.times(&d)), own, s])
    }

    fn inertial(&self, at: Operating) -> Taylor {
        self.ring.times_number(C64::from(-at.omega * at.omega))
    }

    fn hub_inertial(&self, at: Operating) -> Taylor {
        Taylor::constant(C64::from(-at.omega * at.omega * self.hub))
    }
}

/// The base at one speed.
#[derive(Debug)]
pub struct BaseAtSpeed {
    at: Vec<Operating>,
    points: Vec<BasePoint>,
}

impl BaseAtSpeed {
    /// With the receptances of some stations (at most two) and what quantities of the chain are; `None` where it resonates without damping.
    pub fn new(direct: &Direct, stations: &[usize], quantities: &[Quantity], speed_rpm: f64) -> Option<Self> {
        let (system, mut solver) = (direct.system, Factored::new(direct.system));
        let at = system.excitation.orders.iter();
        let at = at.map(|order| Operating { omega: order.omega(speed_rpm), shaft_speed: speed_rpm * RAD_PER_S_PER_RPM }).collect();
        let point = |order| {
            let found = direct.base(&mut solver, stations, quantities, order, speed_rpm, &mut Work::default());
            found.ok().filter(BasePoint::is_finite)
        };
        Some(Self { at, points: (0..system.orders()).map(point).collect::<Option<_>>()? })
    }

    /// Number of orders.
    pub fn orders(&self) -> usize {
        self.at.len()
    }

    /// Circular frequency of an order, rad/s.
    pub fn omega(&self, order: usize) -> f64 {
        self.at[order].omega
    }

    /// Phasors of the quantities that the base was made for, order after order: `put` is given the index of the quantity, the order, the phasor and, of the twist of a ring, the moment S times it.
    /// `None` where a design of the box may be without finite response.
    pub fn phasors(&self, absorbers: &[Enclosed], quantities: &[Quantity], mut put: impl FnMut(usize, usize, [Taylor; 2])) -> Option<()> {
        for (order, (at, point)) in self.at.iter().zip(&self.points).enumerate() {
            let solved = match absorbers {
                [] => Vec::new(),
                [one] => vec![alone(one, *at, point)?],
                [one, two] => both([one, two], *at, point)?,
                _ => return None,
            };
            for (i, quantity) in quantities.iter().enumerate() {
                let none = Taylor::constant(C64::from(0.0));
                let y = match quantity {
                    Quantity::RingTwist(absorber) => [solved[*absorber].twist, solved[*absorber].moment],
                    _ => {
                        let (own, by) = &point.outputs[i];
                        let held = |y: Taylor, (a, s): (&Enclosed, &Solved)| y.minus(&trusted(by[a.station]).times(&s.torque));
                        [absorbers.iter().zip(&solved).fold(trusted(*own), held), none]
                    }
                };
                put(i, order, y);
            }
        }
        Some(())
    }
}

fn trusted(number: C64) -> Taylor {
    Taylor::known_to(number, TRUSTED)
}

/// What an absorber does: the torque with which it holds its station back, N m, the twist of its ring, rad, and S times that, N m.
struct Solved {
    torque: Taylor,
    twist: Taylor,
    moment: Taylor,
}

/// One absorber: n/(c S + t) = a/c + (b m - a t/c)/(c S + t) with a = m + b, c = 1 + H a and t = m (1 + H b).
fn alone(absorber: &Enclosed, at: Operating, point: &BasePoint) -> Option<Solved> {
    let (angle, receptance) = (trusted(point.stations[absorber.station]), trusted(point.receptance[(absorber.station, absorber.station)]));
    let (own, hub) = (absorber.inertial(at), absorber.hub_inertial(at));
    let a = own.plus(&hub);
    let held = receptance.times(&a);
    let c = held.plus_number(C64::from(1.0));
    let Some(law) = &absorber.law else {
        let torque = a.times(&angle).times(&c.inverse()?);
        let none = Taylor::constant(C64::from(0.0));
        return Some(Solved { torque, twist: none, moment: none });
    };
    let s = law.over(&absorber.values, at)?;
    let t = own.times(&receptance.times(&hub).plus_number(C64::from(1.0)));
    let inverse = c.times(&s).plus(&t).inverse()?;
    let share = match c.inverse().filter(|_| c.centre.norm() > CANCELS * (1.0 + held.centre.norm())) {
        Some(by) => {
            let locked = a.times(&by);
            locked.plus(&hub.times(&own).minus(&locked.times(&t)).times(&inverse))
        }
        None => s.times(&a).plus(&hub.times(&own)).times(&inverse),
    };
    let twist = own.times(&inverse).times(&angle).times_number(C64::from(-1.0));
    Some(Solved { torque: share.times(&angle), twist, moment: s.times(&twist) })
}

/// Two absorbers on stations, by Cramer's rule.
fn both(absorbers: [&Enclosed; 2], at: Operating, point: &BasePoint) -> Option<Vec<Solved>> {
    let [i, j] = absorbers.map(|a| a.station);
    let ([d1, n1, m1, s1], [d2, n2, m2, s2]) = (absorbers[0].fraction(at)?, absorbers[1].fraction(at)?);
    let h = |a: usize, b: usize| trusted(point.receptance[(a, b)]);
    let (u1, u2) = (trusted(point.stations[i]), trusted(point.stations[j]));
    let (own1, own2) = (d1.plus(&h(i, i).times(&n1)), d2.plus(&h(j, j).times(&n2)));
    let (by2, by1) = (h(i, j).times(&n2), h(j, i).times(&n1));
    let inverse = own1.times(&own2).minus(&by1.times(&by2)).inverse()?;
    let f1 = u1.times(&own2).minus(&u2.times(&by2)).times(&inverse);
    let f2 = u2.times(&own1).minus(&u1.times(&by1)).times(&inverse);
    let solved = |[n, m, s]: [Taylor; 3], f: Taylor| {
        let twist = m.times(&f).times_number(C64::from(-1.0));
        Solved { torque: n.times(&f), twist, moment: s.times(&twist) }
    };
    Some(vec![solved([n1, m1, s1], f1), solved([n2, m2, s2], f2)])
}
