//! The response of a design as a function of frequency: in the middle of an interval or of a disc of complex frequencies its value and slope, and how far from that tangent it may be there; and what changes of the absorbers make of it.
//!
//! With A(omega) the dynamic stiffness of chain and rings (each ring an unknown of its own), A0 = A(omega0) and E = A - A0, an output a^T A^-1 T is
//! a'^T T - a'^T E x + a'^T E A^-1 E x, with a' = A0^-1 a and x = A0^-1 T. Each unknown weighed by its inertia M, |M^1/2 A^-1 M^1/2| <= N/(1 - N e): N is the Frobenius norm of M^1/2 A0^-1 M^1/2, and e no
//! less than the norm of M^-1/2 E M^-1/2. What is larger than an affine function by at most g in a disc of complex frequencies bends by no more than 2 g/r² at a distance r from its rim (Cauchy).

use super::factored::Factored;
use super::tangent::{Parabola, Tangent};
use super::{Quantity, Rate};
use crate::absorber::{Absorber, Host, Law, Mounted, Operating, OperatingOver};
use crate::drivetrain::{Difference, System};
use crate::numerics::taylor::{MOST, Taylor};
use crate::numerics::{C64, I, ZERO};
use crate::units::RAD_PER_S_PER_RPM;

/// What the change of A in the disc may amount to, N e.
const LARGEST_CHANGE: f64 = 0.6;
/// Halvings of the radius, at most.
const HALVINGS: usize = 60;
/// Share of a rest that rounding may add to it: the solutions behind it are trusted to far more digits.
const ROUNDED: f64 = 1e-6;

/// A ring among the unknowns.
#[derive(Debug)]
struct Ring {
    station: usize,
    inertia: f64,
    /// S over the box, about its value in the middle.
    stiffness: Taylor,
}

/// What is added to a design.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Change {
    /// To S of an absorber (an index), N m/rad.
    Law(usize, Taylor),
    /// To -omega² times the inertia of its ring, N m/rad.
    Inertia(usize, Taylor),
}

/// What a box holds.
#[derive(Debug, Clone, Copy)]
enum Over {
    /// Frequencies in a disc: real and imaginary part are the first two variables.
    Disc,
    /// Real frequencies: the first variable.
    Interval,
}

/// A system with its absorbers over a box of frequencies, about its middle.
#[derive(Debug)]
pub struct AboutFrequency<'a> {
    system: &'a System,
    /// Circular frequency, rad/s.
    pub omega: f64,
    /// No frequency of the box is farther from the middle, rad/s.
    pub radius: f64,
    over: Over,
    order: usize,
    speed_rpm: f64,
    /// Columns of A0^-1, one after the other: stations, then rings.
    inverse: Vec<C64>,
    /// Of each unknown, kg m².
    masses: Vec<f64>,
    rings: Vec<Ring>,
    /// Of each absorber, its place among the rings; `None` where it is locked.
    places: Vec<Option<usize>>,
    /// No less than |M^1/2 A^-1 M^1/2| in the box.
    norm: f64,
}

/// A torque or an output on the unknowns, solved for, with what the change of A makes of it.
struct Solved {
    x: Vec<C64>,
    /// C x.
    damped: Vec<C64>,
    /// No less than |M^-1/2 E x| in the box.
    changed: f64,
}

impl<'a> AboutFrequency<'a> {
    /// A design at an order (an index) and a speed, in as large a disc as its resonances leave; `None` of a flexible crank, beside very stiff shafts, of absorbers on rings or without an enclosure, and where it resonates without damping.
    pub fn new(system: &'a System, design: &[Mounted], order: usize, speed_rpm: f64) -> Option<Self> {
        Self::disc(&mut Factored::new(system), (system, design), order, speed_rpm)
    }

    /// The same by a solver of the system.
    pub(crate) fn disc(solver: &mut Factored, (system, design): (&'a System, &[Mounted]), order: usize, speed_rpm: f64) -> Option<Self> {
        let mut found = Self::at(solver, (system, design), (order, speed_rpm), Over::Disc)?;
        found.widen(design).then_some(found)
    }

    /// A design at an order (an index) over an interval of speeds: its middle and width, rpm. As [`Self::new`]; `None`, too, where the interval is too long.
    pub(crate) fn interval(
        solver: &mut Factored,
        (system, design): (&'a System, &[Mounted]),
        (order, speed_rpm, width_rpm): (usize, f64, f64),
    ) -> Option<Self> {
        let mut found = Self::at(solver, (system, design), (order, speed_rpm), Over::Interval)?;
        found.radius = 0.5 * width_rpm * found.omega / speed_rpm;
        if !found.enclose_laws(design) {
            return None;
        }
        let change = found.norm * found.change_of_all(system.chain.largest_damping(&found.masses));
        found.norm /= 1.0 - change;
        (change <= LARGEST_CHANGE).then_some(found)
    }

    fn at(solver: &mut Factored, (system, design): (&'a System, &[Mounted]), (order, speed_rpm): (usize, f64), over: Over) -> Option<Self> {
        if system.flexible.is_some() {
            return None;
        }
        solver.factor(design, order, speed_rpm).ok()?;
        if solver.is_stiff() {
            // differences of angles lose the torque of the shaft
            return None;
        }
        let (omega, n) = (solver.omega, system.chain.len());
        let at = Operating { omega, shaft_speed: speed_rpm * RAD_PER_S_PER_RPM };
        let mut masses = system.chain.inertias();
        let (mut rings, mut places, mut passed) = (Vec::new(), Vec::new(), Vec::new());
        for m in design {
            let Host::Station(station) = m.on else { return None };
            masses[station] += m.hub();
            let law = match &m.absorber {
                Absorber::Locked { ring_inertia } => {
                    masses[station] += ring_inertia;
                    places.push(None);
                    continue;
                }
                Absorber::Ring(law) => law,
            };
            let (s, inertia) = (law.dynamic_stiffness(at), law.ring_inertia());
            let own = 1.0 / (s - omega * omega * inertia);
            passed.push((s * own, own));
            places.push(Some(rings.len()));
            rings.push(Ring { station, inertia, stiffness: Taylor::constant(s) });
        }
        masses.extend(rings.iter().map(|r| r.inertia));
        // a ring follows its station by S/(S - omega² J), and passes as much of a torque on it on
        let all = masses.len();
        let mut inverse: Vec<C64> = Vec::with_capacity(all * all);
        let mut x = Vec::new();
        for station in 0..n {
            solver.put_under_unit(station, &mut x);
            inverse.extend((0..n).map(|i| solver.angle(i, &x)));
            let own = station * all;
            for (r, p) in rings.iter().zip(&passed) {
                inverse.push(inverse[own + r.station] * p.0);
            }
        }
        for (i, (r, p)) in rings.iter().zip(&passed).enumerate() {
            let own = r.station * all;
            inverse.extend_from_within(own..own + all);
            let column = &mut inverse[(n + i) * all..];
            column.iter_mut().for_each(|x| *x *= p.0);
            column[n + i] += p.1;
        }
        let square = |(column, m): (&[C64], &f64)| m * column.iter().zip(&masses).map(|(x, m)| m * x.norm_sqr()).sum::<f64>();
        let norm = inverse.chunks(all).zip(&masses).map(square).sum::<f64>().sqrt() * (1.0 + ROUNDED);
        if !norm.is_finite() || masses.iter().any(|m| *m <= 0.0) {
            return None;
        }
        Some(Self { system, omega, radius: 0.0, over, order, speed_rpm, inverse, masses, rings, places, norm })
    }

    /// Finds the radius of a disc; whether there is one.
    fn widen(&mut self, design: &[Mounted]) -> bool {
        let by_damping = self.system.chain.largest_damping(&self.masses);
        // 2 omega R + R² + c R = change/N
        let half = self.omega + 0.5 * by_damping;
        let most = LARGEST_CHANGE / self.norm;
        self.radius = (most / (half + (half * half + most).sqrt())).min(0.5 * self.omega);
        for _ in 0..HALVINGS {
            if self.radius <= 0.0 || !self.enclose_laws(design) {
                return false;
            }
            let change = self.change_of_all(by_damping);
            if self.norm * change <= LARGEST_CHANGE * (1.0 + ROUNDED) {
                self.norm /= 1.0 - self.norm * change;
                return true;
            }
            self.radius *= 0.5;
        }
        false
    }

    /// No less than |M^-1/2 E M^-1/2| in the box.
    fn change_of_all(&self, by_damping: f64) -> f64 {
        let by_laws: f64 = self.rings.iter().map(|r| r.stiffness.reach() * self.by_twist(r)).sum();
        self.by_mass() + self.radius * by_damping + by_laws
    }

    /// By which the weight of the inertias may change in the box: 2 omega R + R².
    fn by_mass(&self) -> f64 {
        self.radius * (2.0 * self.omega + self.radius)
    }

    /// Square of the twist of a ring per square of the norm of the unknowns.
    fn by_twist(&self, ring: &Ring) -> f64 {
        1.0 / self.masses[ring.station] + 1.0 / ring.inertia
    }

    /// The frequency less that in the middle, by variable.
    fn moved(&self) -> [C64; MOST] {
        let mut moved = [ZERO; MOST];
        moved[0] = C64::from(self.radius);
        if let Over::Disc = self.over {
            moved[1] = I * self.radius;
        }
        moved
    }

    /// Where laws are asked in the box.
    pub(crate) fn band(&self) -> OperatingOver {
        let moved = self.moved();
        let over = |centre: f64| Taylor { slopes: moved.map(|m| m * (centre / self.omega)), ..Taylor::constant(C64::from(centre)) };
        OperatingOver { omega: over(self.omega), shaft_speed: over(self.speed_rpm * RAD_PER_S_PER_RPM) }
    }

    /// Puts S of every ring over the box; whether each has an enclosure.
    fn enclose_laws(&mut self, design: &[Mounted]) -> bool {
        let band = self.band();
        for (m, place) in design.iter().zip(&self.places) {
            let (Some(law), Some(place)) = (m.absorber.law(), place) else { continue };
            let Some(mut s) = law.over(&constants(law.as_ref()), &band) else { return false };
            let ring = &mut self.rings[*place];
            s.rest += (s.centre - ring.stiffness.centre).norm();
            s.centre = ring.stiffness.centre;
            if let Over::Disc = self.over {
                // the law is analytic: its slope along the imaginary axis is i times that along the real one, but for rounding
                s.rest += (s.slopes[1] - s.slopes[0] * I).norm();
                s.slopes[1] = s.slopes[0] * I;
            }
            ring.stiffness = s;
        }
        true
    }

    fn twist(&self, ring: usize, x: &[C64]) -> C64 {
        x[self.system.chain.len() + ring] - x[self.rings[ring].station]
    }

    fn solved(&self, on: impl Iterator<Item = (usize, C64)>) -> Solved {
        let mut x = vec![ZERO; self.masses.len()];
        for (i, a) in on.filter(|(_, a)| *a != ZERO) {
            let column = &self.inverse[i * x.len()..(i + 1) * x.len()];
            x.iter_mut().zip(column).for_each(|(x, y)| *x += y * a);
        }
        let damped = self.system.chain.damped(&x);
        let own = x.iter().zip(&self.masses).map(|(x, m)| m * x.norm_sqr()).sum::<f64>().sqrt();
        let by_damping = damped.iter().zip(&self.masses).map(|(x, m)| x.norm_sqr() / m).sum::<f64>().sqrt();
        let by_ring = |(i, r): (usize, &Ring)| r.stiffness.reach() * self.twist(i, &x).norm() * self.by_twist(r).sqrt();
        let by_laws: f64 = self.rings.iter().enumerate().map(by_ring).sum();
        Solved { changed: self.by_mass() * own + self.radius * by_damping + by_laws, x, damped }
    }

    /// Of a^T E x the slopes, how far the rest may be from them in the box, and the size of all.
    fn change(&self, a: &Solved, x: &Solved) -> ([C64; MOST], f64, f64) {
        let by_mass: C64 = a.x.iter().zip(&x.x).zip(&self.masses).map(|((a, x), m)| a * x * *m).sum();
        let by_damping: C64 = a.x.iter().zip(&x.damped).map(|(a, x)| a * x).sum();
        let by_frequency = I * by_damping - by_mass * (2.0 * self.omega);
        let mut slopes = self.moved().map(|m| m * by_frequency);
        let mut size = self.by_mass() * by_mass.norm() + self.radius * by_damping.norm();
        let mut rest = self.radius * self.radius * by_mass.norm();
        for (i, r) in self.rings.iter().enumerate() {
            let by = self.twist(i, &a.x) * self.twist(i, &x.x);
            slopes.iter_mut().zip(&r.stiffness.slopes).for_each(|(slope, g)| *slope += g * by);
            rest += r.stiffness.rest * by.norm();
            size += r.stiffness.reach() * by.norm();
        }
        (slopes, rest, size)
    }

    /// Some outputs under the torque, in a disc.
    pub fn outputs(&self, quantities: &[Quantity], torque: &Parabola) -> Vec<Tangent> {
        let square = self.radius * self.radius;
        let as_tangent = |y: &Taylor| Tangent::new(y.centre, y.slopes[0] / self.radius, y.rest / square);
        let factor = |q: &Quantity, y: Tangent| self.factor(*q).map_or(y, |factor| y.times(&factor, self.radius));
        quantities.iter().zip(self.angles(quantities, torque)).map(|(q, y)| factor(q, as_tangent(&y))).collect()
    }

    fn angles(&self, quantities: &[Quantity], torque: &Parabola) -> Vec<Taylor> {
        let loads = torque.about(self.order, self.speed_rpm, self.omega / self.speed_rpm);
        let under = loads.each_ref().map(|t| self.solved(t.iter().copied().enumerate()));
        quantities.iter().map(|q| self.angle(&self.solved(self.made_of(*q).into_iter()), &loads, &under)).collect()
    }

    /// The unknowns that a quantity is made of, each with what it counts.
    fn made_of(&self, quantity: Quantity) -> Vec<(usize, C64)> {
        let (chain, n) = (&self.system.chain, self.system.chain.len());
        match (quantity, quantity.difference(chain)) {
            (Quantity::RingTwist(i), _) => match self.places.get(i).copied().flatten() {
                Some(ring) => vec![(n + ring, C64::from(1.0)), (self.rings[ring].station, C64::from(-1.0))],
                None => Vec::new(),
            },
            (_, Some(Difference { from, to, scale })) => {
                let to = to.map(|(to, gear)| (to, C64::from(-scale * gear)));
                std::iter::once((from, C64::from(scale))).chain(to).collect()
            }
            (_, None) => Vec::new(),
        }
    }

    /// Quantities over an interval, where rings have other laws and inertias than those of the design, with what they may be off without these changes, in sum; `None` where the response may not be finite.
    pub(crate) fn changed(&self, quantities: &[Quantity], torque: &Parabola, changes: &[Change]) -> Option<(Vec<Taylor>, f64)> {
        let loads = torque.about(self.order, self.speed_rpm, self.omega / self.speed_rpm);
        let under = loads.each_ref().map(|t| self.solved(t.iter().copied().enumerate()));
        let all = self.masses.len();
        let changed: Vec<(Vec<(usize, C64)>, Taylor)> = changes
            .iter()
            .filter_map(|change| match *change {
                Change::Law(i, s) => Some((self.made_of(Quantity::RingTwist(i)), s)),
                Change::Inertia(i, m) => {
                    let ring = self.places.get(i).copied().flatten()?;
                    Some((vec![(self.system.chain.len() + ring, C64::from(1.0))], m))
                }
            })
            .collect();
        let on: Vec<Vec<(usize, C64)>> = changed.iter().map(|c| c.0.clone()).chain(quantities.iter().map(|q| self.made_of(*q))).collect();
        let solved: Vec<Solved> = on.iter().map(|of| self.solved(of.iter().copied())).collect();
        let none = || self.solved(std::iter::empty());
        // by column: the torque, then a unit of each change
        let mut table: Vec<Vec<Taylor>> = vec![solved.iter().map(|a| self.angle(a, &loads, &under)).collect()];
        for (of, _) in &changed {
            let mut unit = vec![ZERO; all];
            of.iter().for_each(|(i, a)| unit[*i] += a);
            let (loads, under) = ([unit, Vec::new(), Vec::new()], [self.solved(of.iter().copied()), none(), none()]);
            table.push(solved.iter().map(|a| self.angle(a, &loads, &under)).collect());
        }
        let before = table[0][changed.len()..].iter().map(|y| y.rest).sum();
        for (k, (_, more)) in changed.iter().enumerate() {
            let share = more.times(&more.times(&table[k + 1][k]).plus_number(C64::from(1.0)).inverse()?);
            let by_unit: Vec<Taylor> = table[k + 1].iter().map(|y| share.times(y)).collect();
            for column in &mut table {
                let own = column[k];
                column.iter_mut().zip(&by_unit).for_each(|(y, by)| *y = y.minus(&own.times(by)));
            }
        }
        let moved = self.moved();
        let model = |f: Tangent| {
            let slopes = moved.map(|m| m * f.slope);
            Taylor { slopes, rest: f.bend * self.radius * self.radius, ..Taylor::constant(f.value) }
        };
        let outputs = quantities.iter().zip(&table[0][changed.len()..]);
        Some((outputs.map(|(q, y)| self.factor(*q).map_or(*y, |f| y.times(&model(f)))).collect(), before))
    }

    /// What a quantity is beside the difference of angles: the stiffness and damping of a shaft, powers of the frequency.
    fn factor(&self, quantity: Quantity) -> Option<Tangent> {
        let chain = &self.system.chain;
        match quantity {
            Quantity::ShaftTorque(shaft) => {
                let slope = I * chain.stations[shaft].damping_to_next;
                Some(Tangent::new(chain.shaft_stiffness(shaft, self.omega), slope, 0.0))
            }
            Quantity::Motion(_, Rate::Velocity) => Some(Tangent::new(I * self.omega, I, 0.0)),
            Quantity::Motion(_, Rate::Acceleration) => {
                Some(Tangent::new(C64::from(-self.omega * self.omega), C64::from(-2.0 * self.omega), 1.0))
            }
            Quantity::Twist { .. } | Quantity::RingTwist(_) => None,
        }
    }

    /// A sum of angles under a torque T0 + d T1 + d² T2.
    fn angle(&self, a: &Solved, loads: &[Vec<C64>; 3], [x, by_slope, by_square]: &[Solved; 3]) -> Taylor {
        let dot = |t: &[C64]| -> C64 { a.x.iter().zip(t).map(|(a, t)| a * t).sum() };
        let (changes, rest, _) = self.change(a, x);
        let (radius, square) = (self.radius, self.radius * self.radius);
        let beside = radius * self.change(a, by_slope).2 + square * self.change(a, by_square).2;
        let changed = x.changed + radius * by_slope.changed + square * by_square.changed;
        let rest = square * dot(&loads[2]).norm() + rest + beside + a.changed * self.norm * changed;
        let mut slopes = self.moved().map(|m| m * dot(&loads[1]));
        slopes.iter_mut().zip(&changes).for_each(|(slope, change)| *slope -= change);
        Taylor { centre: dot(&loads[0]), slopes, rest: rest * (1.0 + ROUNDED) }
    }

    /// S of an absorber in a disc; `None` where its ring does not move.
    pub fn stiffness(&self, absorber: usize) -> Option<Tangent> {
        let ring = self.places.get(absorber).copied().flatten()?;
        let s = &self.rings[ring].stiffness;
        Some(Tangent::new(s.centre, s.slopes[0] / self.radius, s.rest / (self.radius * self.radius)))
    }
}

/// Values of the parameters of a law as they are.
fn constants(law: &dyn Law) -> Vec<Taylor> {
    law.values().into_iter().map(|x| Taylor::constant(C64::from(x))).collect()
}
