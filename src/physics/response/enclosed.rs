//! Phasors of all designs of a box at one speed: the base is solved once, and absorbers whose parameters are Taylor models are put on it.
//!
//! A ring of inertia J on a law S (m = -omega² J, hub b = -omega² J_hub) loads its station with z = n/d, d = S + m, n = S m + b d. With u0 the angle of the station and y0 an output without
//! absorber, H the receptance of the station and h the output per unit torque there, y = y0 - h n f with f = u0/(d + H n); of several absorbers on stations d_i f_i + sum H_ij n_j f_j = u0_i. The ring
//! turns by -m f against its hub. For one absorber d + H n = c S + t is linear in S: n/(c S + t) is taken as one inverse.

use super::factored::Factored;
use super::{Direct, Quantity, Work};
use crate::absorber::{Absorber, Host, Law, Mounted, Operating};
use crate::drivetrain::Chain;
use crate::numerics::taylor::Taylor;
use crate::numerics::{C64, ZERO};
use crate::units::RAD_PER_S_PER_RPM;
use std::sync::Arc;

/// Roundings that a solution of the base is trusted to, of each entry of its matrix: rows are exchanged for the largest pivot, so that it is that of a matrix with other last digits.
const ROUNDINGS: f64 = 64.0 * f64::EPSILON;
/// Share of its size to which a solution is trusted where that is not known: of a flexible crank, and beside a shaft that is far stiffer than inertia.
const TRUSTED: f64 = 1e-9;
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
    points: Vec<Point>,
}

/// The base at one order, each number with what it may be off by.
#[derive(Debug)]
struct Point {
    /// Angle of each station under the torque.
    angles: Vec<Taylor>,
    /// Angle of a station per unit torque at another one, row after row.
    receptances: Vec<Vec<Taylor>>,
    /// Of each quantity of the chain, its value under the torque and per unit torque at each station.
    outputs: Vec<(Taylor, Vec<Taylor>)>,
}

impl Point {
    /// `None` where the chain resonates without damping.
    fn new(solver: &mut Factored, chain: &Chain, (stations, quantities): (&[usize], &[Quantity]), at: (usize, f64)) -> Option<Self> {
        solver.solve(&[], at, &mut Work::default()).ok()?;
        let omega = solver.omega;
        let angles_of = |solver: &Factored, x: &[C64]| -> Vec<C64> { (0..chain.len()).map(|i| solver.angle(i, x)).collect() };
        let unit = |solver: &Factored, station: usize| {
            let x = solver.under_unit(station);
            (angles_of(solver, &x), x)
        };
        let own = (angles_of(solver, &solver.x), solver.x.clone());
        let units: Vec<_> = stations.iter().map(|s| unit(solver, *s)).collect();
        let known = |y: C64, adjoint: &[C64], x: &[C64]| {
            let doubt = solver.doubt(adjoint, x).map_or(TRUSTED * y.norm(), |d| ROUNDINGS * (d + y.norm()));
            Taylor { rest: doubt, ..Taylor::constant(y) }
        };
        let angle = |i: usize, of: &[C64]| known(of[stations[i]], &units[i].0, of);
        let all = 0..stations.len();
        let output = |q: &Quantity| {
            let Some(difference) = q.difference(chain) else {
                return (Taylor::constant(ZERO), vec![Taylor::constant(ZERO); stations.len()]);
            };
            let from = unit(solver, difference.from).0;
            let to = difference.to.map(|(to, gear)| (unit(solver, to).0, gear));
            let factor = match q {
                Quantity::ShaftTorque(shaft) => chain.shaft_stiffness(*shaft, omega).norm(),
                q => q.of_angle(C64::from(1.0), omega).norm(),
            };
            let adjoint = |i: usize| (from[i] - to.as_ref().map_or(ZERO, |(to, gear)| to[i] * *gear)) * (difference.scale * factor);
            let adjoint: Vec<C64> = (0..chain.len()).map(adjoint).collect();
            // the difference of two angles loses digits of its own
            let lost = |angles: &[C64]| {
                let to = difference.to.map_or(0.0, |(to, gear)| gear.abs() * angles[to].norm());
                ROUNDINGS * (difference.scale * factor).abs() * (angles[difference.from].norm() + to)
            };
            let value = |(angles, x): &(Vec<C64>, Vec<C64>)| {
                let known = known(solver.output(*q, x), &adjoint, angles);
                Taylor { rest: known.rest + solver.doubt(&adjoint, angles).map_or(0.0, |_| lost(angles)), ..known }
            };
            (value(&own), units.iter().map(value).collect())
        };
        let point = Self {
            angles: all.clone().map(|i| angle(i, &own.0)).collect(),
            receptances: all.clone().map(|i| all.clone().map(|j| angle(i, &units[j].0)).collect()).collect(),
            outputs: quantities.iter().map(output).collect(),
        };
        let numbers = point.angles.iter().chain(point.receptances.iter().flatten());
        let is_finite = numbers.chain(point.outputs.iter().flat_map(|(y, by)| std::iter::once(y).chain(by))).all(Taylor::is_finite);
        is_finite.then_some(point)
    }
}

impl BaseAtSpeed {
    /// With the receptances of some stations (at most two) and what quantities of the chain are; `None` where it resonates without damping.
    pub fn new(direct: &Direct, stations: &[usize], quantities: &[Quantity], speed_rpm: f64) -> Option<Self> {
        let (system, mut solver) = (direct.system, Factored::new(direct.system));
        let at = system.excitation.orders.iter();
        let at = at.map(|order| Operating { omega: order.omega(speed_rpm), shaft_speed: speed_rpm * RAD_PER_S_PER_RPM }).collect();
        let point = |order| Point::new(&mut solver, &system.chain, (stations, quantities), (order, speed_rpm));
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
                        let held = |y: Taylor, (a, s): (&Enclosed, &Solved)| y.minus(&by[a.station].times(&s.torque));
                        [absorbers.iter().zip(&solved).fold(*own, held), none]
                    }
                };
                put(i, order, y);
            }
        }
        Some(())
    }
}

/// What an absorber does: the torque with which it holds its station back, N m, the twist of its ring, rad, and S times that, N m.
struct Solved {
    torque: Taylor,
    twist: Taylor,
    moment: Taylor,
}

/// One absorber: n/(c S + t) = a/c + (b m - a t/c)/(c S + t) with a = m + b, c = 1 + H a and t = m (1 + H b).
fn alone(absorber: &Enclosed, at: Operating, point: &Point) -> Option<Solved> {
    let (angle, receptance) = (point.angles[absorber.station], point.receptances[absorber.station][absorber.station]);
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
fn both(absorbers: [&Enclosed; 2], at: Operating, point: &Point) -> Option<Vec<Solved>> {
    let [i, j] = absorbers.map(|a| a.station);
    let ([d1, n1, m1, s1], [d2, n2, m2, s2]) = (absorbers[0].fraction(at)?, absorbers[1].fraction(at)?);
    let h = |a: usize, b: usize| point.receptances[a][b];
    let (u1, u2) = (point.angles[i], point.angles[j]);
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
