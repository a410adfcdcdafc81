//! Phasors of all designs of a box at one speed: the base is solved once, and absorbers whose parameters are Taylor models are put on it.
//!
//! A ring of inertia J on a law S (m = -omega² J, hub b = -omega² J_hub) loads its station with z = n/d, d = S + m, n = S m + b d. With u the angle of the station and y an output without it,
//! H the receptance of the station and h the output per unit torque there, the output with it is y - h n f with f = u/(d + H n), and the ring turns by -m f against its hub. d + H n is linear in S, so
//! that n/(d + H n) is taken as one inverse. Of several absorbers on stations each is put on what the ones before it leave.

use super::factored::Factored;
use super::known_points::Wanted;
use super::{Direct, Quantity, Work};
use crate::absorber::{Absorber, Host, Law, Mounted, Operating};
use crate::drivetrain::Chain;
use crate::numerics::taylor::Taylor;
use crate::numerics::{C64, ZERO};
use crate::units::RAD_PER_S_PER_RPM;
use std::borrow::Cow;
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
    kind: Kind,
}

#[derive(Debug, Clone)]
enum Kind {
    Ring {
        law: Arc<dyn Law>,
        values: Vec<Taylor>,
        /// 1/(kg m²).
        inverse_inertia: Taylor,
    },
    /// The ring turns with its hub: its inertia, kg m².
    Locked(f64),
}

impl Enclosed {
    /// An absorber with these values of its parameters in place of its own, on one of some stations; `None` where it sits on a ring or its hub follows from its dimensions.
    pub fn of(mounted: &Mounted, values: Vec<Taylor>, stations: &[usize]) -> Option<Self> {
        let Host::Station(own) = mounted.on else { return None };
        let station = stations.iter().position(|s| *s == own)?;
        let kind = match &mounted.absorber {
            Absorber::Ring(law) if law.parts().is_some() => return None,
            Absorber::Ring(law) => Kind::Ring { law: law.clone(), inverse_inertia: law.ring_over(&values).inverse()?, values },
            Absorber::Locked { ring_inertia } => Kind::Locked(*ring_inertia),
        };
        Some(Self { station, hub: mounted.hub(), kind })
    }

    /// Its corners; `None` where the ring is locked.
    pub fn corners(&self) -> Option<Corners> {
        let Kind::Ring { law, values, .. } = &self.kind else { return None };
        let own = |v: &Taylor| v.slopes.iter().position(|g| *g != ZERO);
        let variables: Vec<usize> = values.iter().filter_map(own).collect();
        let corner = |corner: usize| {
            let sign = |i: usize| variables.iter().position(|v| *v == i).map_or(0.0, |k| if corner >> k & 1 == 1 { 1.0 } else { -1.0 });
            let value = |v: &Taylor| v.centre.re + own(v).map_or(0.0, |i| sign(i) * v.slopes[i].re);
            let values: Vec<f64> = values.iter().map(value).collect();
            let held: Vec<Taylor> = values.iter().map(|x| Taylor::constant(C64::from(*x))).collect();
            let ring_inertia = law.ring_over(&held).centre.re;
            (values, ring_inertia)
        };
        let corners = (0..1usize << variables.len()).map(corner).collect();
        Some(Corners { law: Some(law.clone()), hub: self.hub, variables, corners })
    }
}

/// An absorber at the corners of a box.
#[derive(Debug, Clone)]
pub struct Corners {
    /// `None` where there is no absorber.
    law: Option<Arc<dyn Law>>,
    hub: f64,
    variables: Vec<usize>,
    /// Parameters and inertia of the ring at each corner, the first variable fastest.
    corners: Vec<(Vec<f64>, f64)>,
}

impl Corners {
    /// No absorber.
    pub(super) fn none() -> Self {
        Self { law: None, hub: 0.0, variables: Vec::new(), corners: vec![(Vec::new(), 0.0)] }
    }

    /// Indices of the variables that its parameters depend on.
    pub fn variables(&self) -> &[usize] {
        &self.variables
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.corners.len()
    }

    /// d and n times the denominator of S, at a corner; `None` where S is no quotient.
    pub(super) fn load(&self, corner: usize, at: Operating) -> Option<[C64; 2]> {
        let Some(law) = &self.law else { return Some([C64::from(1.0), ZERO]) };
        let (values, ring_inertia) = &self.corners[corner];
        let by = -at.omega * at.omega;
        let ([p, q], m) = (law.quotient(values, at)?, by * ring_inertia);
        let d = p + q * m;
        Some([d, p * m + d * (by * self.hub)])
    }
}

/// The base at one speed.
#[derive(Debug)]
pub struct BaseAtSpeed {
    pub(super) at: Vec<Operating>,
    pub(super) points: Vec<Point>,
}

/// A quantity under the torque of an order, and per unit torque at each station.
#[derive(Debug, Clone)]
pub(super) struct Output {
    pub own: Taylor,
    pub by: Vec<Taylor>,
}

/// The base at one order, each number with what it may be off by.
#[derive(Debug, Clone)]
pub(super) struct Point {
    /// Angle of each station under the torque.
    pub angles: Vec<Taylor>,
    /// Angle of a station per unit torque at another one, row after row.
    pub receptances: Vec<Vec<Taylor>>,
    /// Of each quantity of the chain.
    pub outputs: Vec<Output>,
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
                return Output { own: Taylor::constant(ZERO), by: vec![Taylor::constant(ZERO); stations.len()] };
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
            Output { own: value(&own), by: units.iter().map(value).collect() }
        };
        let point = Self {
            angles: all.clone().map(|i| angle(i, &own.0)).collect(),
            receptances: all.clone().map(|i| all.clone().map(|j| angle(i, &units[j].0)).collect()).collect(),
            outputs: quantities.iter().map(output).collect(),
        };
        let numbers = point.angles.iter().chain(point.receptances.iter().flatten());
        let is_finite = numbers.chain(point.outputs.iter().flat_map(|o| std::iter::once(&o.own).chain(&o.by))).all(Taylor::is_finite);
        is_finite.then_some(point)
    }

    /// Of a flexible crank whose answers are known.
    fn of_crank(
        (solver, chain): (&Factored, &Chain),
        (stations, quantities): (&[usize], &[Quantity]),
        (wanted, known): (&Wanted, &[C64]),
    ) -> Option<Self> {
        let answers = 2 * chain.len() - 1;
        let own = wanted.under_load(known, answers);
        let units: Vec<Vec<C64>> = stations.iter().map(|s| wanted.under_unit(*s, known, answers)).collect();
        let trusted = |y: C64| Taylor { rest: TRUSTED * y.norm(), ..Taylor::constant(y) };
        let output = |q: &Quantity| match q.difference(chain) {
            None => Output { own: Taylor::constant(ZERO), by: vec![Taylor::constant(ZERO); stations.len()] },
            Some(_) => Output { own: trusted(solver.output(*q, &own)), by: units.iter().map(|x| trusted(solver.output(*q, x))).collect() },
        };
        let is_finite = own.iter().chain(units.iter().flatten()).all(|y| y.is_finite());
        is_finite.then(|| Self {
            angles: stations.iter().map(|s| trusted(own[*s])).collect(),
            receptances: stations.iter().map(|s| units.iter().map(|x| trusted(x[*s])).collect()).collect(),
            outputs: quantities.iter().map(output).collect(),
        })
    }
}

impl BaseAtSpeed {
    /// With the receptances of some stations and what quantities of the chain are; `None` where it resonates without damping.
    pub fn new(direct: &Direct, stations: &[usize], quantities: &[Quantity], speed_rpm: f64) -> Option<Self> {
        let (system, mut solver) = (direct.system, Factored::new(direct.system));
        let at = system.excitation.orders.iter();
        let at: Vec<Operating> =
            at.map(|order| Operating { omega: order.omega(speed_rpm), shaft_speed: speed_rpm * RAD_PER_S_PER_RPM }).collect();
        if let Some(crank) = system.flexible.as_ref().filter(|_| !stations.is_empty()) {
            let wanted = solver.wanted_at(stations.to_vec(), quantities);
            let known = direct.of_crank(crank, &wanted, speed_rpm).ok()?;
            let of_order = |(at, known): (&Operating, &[C64])| {
                solver.bare(*at);
                Point::of_crank((&solver, &system.chain), (stations, quantities), (&wanted, known))
            };
            let points = at.iter().zip(known.chunks(wanted.len().max(1))).map(of_order).collect::<Option<_>>()?;
            return Some(Self { at, points });
        }
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
        (0..self.orders()).try_for_each(|order| self.phasors_of(order, absorbers, quantities, |i, y| put(i, order, y)))
    }

    /// The same of one order.
    pub fn phasors_of(
        &self,
        order: usize,
        absorbers: &[Enclosed],
        quantities: &[Quantity],
        mut put: impl FnMut(usize, [Taylor; 2]),
    ) -> Option<()> {
        let none = Taylor::constant(ZERO);
        let (at, point) = (&self.at[order], &self.points[order]);
        let Some((last, others)) = absorbers.split_last() else {
            point.outputs.iter().enumerate().for_each(|(i, output)| put(i, [output.own, none]));
            return Some(());
        };
        let mut base = Cow::Borrowed(point);
        let mut twists: Vec<[Output; 2]> = Vec::with_capacity(others.len());
        for (k, absorber) in others.iter().enumerate() {
            let ring = Ring::on(absorber, *at, &base)?;
            let stations: Vec<usize> = absorbers[k + 1..].iter().map(|a| a.station).collect();
            twists.iter_mut().flatten().for_each(|output| *output = ring.held(output, &base, &stations));
            twists.push(ring.twist(&base, &stations));
            base = Cow::Owned(ring.put_on(&base, &stations));
        }
        // nothing is put on what the last one leaves
        let ring = Ring::on(last, *at, &base)?;
        let angle = &base.angles[last.station];
        let torque = ring.share.times(angle);
        let with_it = |output: &Output| output.own.minus(&torque.times(&output.by[last.station]));
        for (i, quantity) in quantities.iter().enumerate() {
            let y = match quantity {
                Quantity::RingTwist(absorber) => match twists.get(*absorber) {
                    Some(twist) => twist.each_ref().map(with_it),
                    None => [ring.twist.times(angle), ring.moment.times(angle)],
                },
                _ => [with_it(&base.outputs[i]), none],
            };
            put(i, y);
        }
        Some(())
    }
}

/// A ring on a base: with u the angle of its station and H the receptance there, both without it, it holds the station back with the torque `share` u and twists by `twist` u.
struct Ring {
    station: usize,
    share: Taylor,
    twist: Taylor,
    /// S times the twist.
    moment: Taylor,
}

impl Ring {
    /// With r = 1/m and g = 1 + H b, n/(d + H n) = (a S + b)/(e S + g), a = 1 + b r and e = H + g r, and this is a/e + (b - a g/e)/(e S + g): the inertia of the ring is in r alone, times S.
    fn on(absorber: &Enclosed, at: Operating, base: &Point) -> Option<Self> {
        let station = absorber.station;
        let receptance = base.receptances[station][station];
        let one = C64::from(1.0);
        let inertial = |inertia: f64| Taylor::constant(C64::from(-at.omega * at.omega * inertia));
        let (law, values, inverse_inertia) = match &absorber.kind {
            Kind::Ring { law, values, inverse_inertia } => (law, values, inverse_inertia),
            Kind::Locked(ring) => {
                let (load, none) = (inertial(ring + absorber.hub), Taylor::constant(ZERO));
                let share = load.times(&receptance.times(&load).plus_number(one).inverse()?);
                return Some(Self { station, share, twist: none, moment: none });
            }
        };
        let hub = inertial(absorber.hub);
        let g = receptance.times(&hub).plus_number(one);
        let s = law.over(values, &at.into())?;
        let r = inverse_inertia.times_number(C64::from(-1.0 / (at.omega * at.omega)));
        let (a, by_r) = (hub.times(&r).plus_number(one), g.times(&r));
        let e = receptance.plus(&by_r);
        let inverse = e.times(&s).plus(&g).inverse()?;
        let share = match e.inverse().filter(|_| e.centre.norm() > CANCELS * (receptance.centre.norm() + by_r.centre.norm())) {
            Some(by) => {
                let locked = a.times(&by);
                locked.plus(&hub.minus(&locked.times(&g)).times(&inverse))
            }
            None => s.times(&a).plus(&hub).times(&inverse),
        };
        let twist = inverse.times_number(C64::from(-1.0));
        Some(Self { station, share, twist, moment: s.times(&twist) })
    }

    /// An output of the base with the ring on it, per unit torque at some stations.
    fn held(&self, output: &Output, base: &Point, stations: &[usize]) -> Output {
        let torque = self.share.times(&output.by[self.station]);
        let mut held = Output { own: output.own.minus(&torque.times(&base.angles[self.station])), by: output.by.clone() };
        stations.iter().for_each(|k| held.by[*k] = output.by[*k].minus(&torque.times(&base.receptances[self.station][*k])));
        held
    }

    /// Its own twist and moment.
    fn twist(&self, base: &Point, stations: &[usize]) -> [Output; 2] {
        [self.twist, self.moment].map(|factor| {
            let mut by = vec![Taylor::constant(ZERO); base.angles.len()];
            stations.iter().for_each(|k| by[*k] = factor.times(&base.receptances[self.station][*k]));
            Output { own: factor.times(&base.angles[self.station]), by }
        })
    }

    /// The base with the ring on it, as far as others on some stations ask for it.
    fn put_on(&self, base: &Point, stations: &[usize]) -> Point {
        let mut next = Point { outputs: base.outputs.iter().map(|o| self.held(o, base, stations)).collect(), ..base.clone() };
        for i in stations {
            let torque = self.share.times(&base.receptances[*i][self.station]);
            next.angles[*i] = base.angles[*i].minus(&torque.times(&base.angles[self.station]));
            stations.iter().for_each(|k| {
                next.receptances[*i][*k] = base.receptances[*i][*k].minus(&torque.times(&base.receptances[self.station][*k]))
            });
        }
        next
    }
}
