//! The response of a design as a function of frequency: at one frequency its value and slope, and how far from that tangent it may be in a disc of complex frequencies.
//!
//! With A(omega) the dynamic stiffness of chain and rings (each ring an unknown of its own), A0 = A(omega0) and E = A - A0, an output a^T A^-1 T is
//! a'^T T - a'^T E x + a'^T E A^-1 E x, with a' = A0^-1 a and x = A0^-1 T. Each unknown weighed by its inertia M, |M^1/2 A^-1 M^1/2| <= N/(1 - N e): N is the Frobenius norm of M^1/2 A0^-1 M^1/2, and e no
//! less than the norm of M^-1/2 E M^-1/2. What is analytic in a disc and there no larger than g, with value and slope zero in its middle, is at most g (d/R)² at the distance d (Schwarz's lemma).

use super::Quantity;
use super::factored::Factored;
use crate::absorber::{Absorber, Host, Mounted, Operating, OperatingOver};
use crate::drivetrain::{Difference, System};
use crate::numerics::taylor::Taylor;
use crate::numerics::{C64, I, ZERO};
use crate::response::Rate;
use crate::units::RAD_PER_S_PER_RPM;

/// What the change of A in the disc may amount to, N e.
const LARGEST_CHANGE: f64 = 0.6;
/// Halvings of the radius, at most.
const HALVINGS: usize = 60;
/// Share of a rest that rounding may add to it: the solutions behind it are trusted to far more digits.
const ROUNDED: f64 = 1e-6;

/// A function of frequency: value + slope d + rest, d = omega - omega0, with |rest| <= bend |d|² for complex d up to a radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tangent {
    /// At omega0.
    pub value: C64,
    /// Per rad/s.
    pub slope: C64,
    /// Per (rad/s)².
    pub bend: f64,
}

impl Tangent {
    fn new(value: C64, slope: C64, bend: f64) -> Self {
        Self { value, slope, bend }
    }

    /// The product, in discs of this radius.
    #[must_use]
    pub fn times(&self, other: &Self, radius: f64) -> Self {
        let (a, b, c, d) = (self.value.norm(), other.value.norm(), self.slope.norm(), other.slope.norm());
        let (u, v) = (self.bend, other.bend);
        let bend = c * d + a * v + b * u + radius * (c * v + d * u + radius * u * v);
        Self::new(self.value * other.value, self.slope * other.value + self.value * other.slope, bend)
    }

    /// The function whose values at real frequencies are the conjugates.
    #[must_use]
    pub fn conj(&self) -> Self {
        Self::new(self.value.conj(), self.slope.conj(), self.bend)
    }

    /// Imaginary part of its values at real frequencies.
    #[must_use]
    pub fn imaginary(&self) -> Self {
        Self::new(C64::from(self.value.im), C64::from(self.slope.im), self.bend)
    }

    /// How far it may be from its chord over a distance (rad/s), no end of which is farther than this share of the radius from the middle: Cauchy's bound of the second derivative of the rest, in discs that reach the rim.
    pub fn off_chord(&self, distance: f64, farthest: f64) -> f64 {
        let to_rim = 1.0 - farthest;
        0.25 * distance * distance * self.bend / (to_rim * to_rim)
    }
}

/// Torque on the stations as a function of frequency: parabolas between kinks.
#[derive(Debug, Clone)]
pub struct Parabola {
    /// rpm.
    speeds: [f64; 3],
    /// N m, an order after the other.
    torques: [Vec<Vec<C64>>; 3],
}

impl Parabola {
    /// Between two speeds (rpm) without a kink between them.
    pub fn between(system: &System, (low, high): (f64, f64)) -> Self {
        let speeds = [low, 0.5 * (low + high), high];
        let torque_at = |order: usize, speed: f64| {
            let mut torque = vec![ZERO; system.chain.len()];
            system.torque(order, speed, &mut torque);
            torque
        };
        Self { speeds, torques: speeds.map(|speed| (0..system.orders()).map(|n| torque_at(n, speed)).collect()) }
    }

    /// Whether an order acts at any of these speeds.
    pub fn acts(&self, order: usize) -> bool {
        self.torques.iter().any(|t| t[order].iter().any(|t| *t != ZERO))
    }

    /// Coefficients of 1, d and d² about a speed, d in rad/s of an order of this value.
    fn about(&self, order: usize, speed_rpm: f64, omega_per_rpm: f64) -> [Vec<C64>; 3] {
        let [a, b, c] = self.speeds;
        let of_station = |i: usize| {
            let [ta, tb, tc] = [0, 1, 2].map(|k| self.torques[k][order][i]);
            // Newton's divided differences
            let (first, next) = ((tb - ta) / (b - a), (tc - tb) / (c - b));
            let second = (next - first) / (c - a);
            let at = speed_rpm - a;
            let value = ta + first * at + second * (at * (speed_rpm - b));
            let slope = first + second * (2.0 * speed_rpm - a - b);
            [value, slope / omega_per_rpm, second / (omega_per_rpm * omega_per_rpm)]
        };
        let all: Vec<[C64; 3]> = (0..self.torques[0][order].len()).map(of_station).collect();
        [0, 1, 2].map(|k| all.iter().map(|t| t[k]).collect())
    }
}

/// A ring among the unknowns.
#[derive(Debug)]
struct Ring {
    station: usize,
    inertia: f64,
    /// S about the frequency.
    stiffness: Tangent,
    /// By which S may change in the disc.
    change: f64,
}

/// A system with its absorbers, about one frequency.
#[derive(Debug)]
pub struct AboutFrequency<'a> {
    system: &'a System,
    /// Circular frequency, rad/s.
    pub omega: f64,
    /// Of the disc, rad/s.
    pub radius: f64,
    order: usize,
    speed_rpm: f64,
    /// Columns of A0^-1, one after the other: stations, then rings.
    inverse: Vec<C64>,
    /// Of each unknown, kg m².
    masses: Vec<f64>,
    rings: Vec<Ring>,
    /// Of each absorber, its place among the rings; `None` where it is locked.
    places: Vec<Option<usize>>,
    /// No less than |M^1/2 A^-1 M^1/2| in the disc.
    norm: f64,
}

/// A torque or an output on the unknowns, solved for, with what the change of A makes of it.
struct Solved {
    x: Vec<C64>,
    /// C x.
    damped: Vec<C64>,
    /// No less than |M^-1/2 E x| in the disc.
    changed: f64,
}

impl<'a> AboutFrequency<'a> {
    /// A design at an order (an index) and a speed, in as large a disc as its resonances leave; `None` of a flexible crank, of absorbers on rings or without an enclosure, and where it resonates without damping.
    pub fn new(system: &'a System, design: &[Mounted], order: usize, speed_rpm: f64) -> Option<Self> {
        Self::by(&mut Factored::new(system), (system, design), order, speed_rpm)
    }

    /// The same by a solver of the system.
    pub(crate) fn by(solver: &mut Factored, (system, design): (&'a System, &[Mounted]), order: usize, speed_rpm: f64) -> Option<Self> {
        if system.flexible.is_some() {
            return None;
        }
        solver.factor(design, order, speed_rpm).ok()?;
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
            rings.push(Ring { station, inertia, stiffness: Tangent::new(s, ZERO, 0.0), change: 0.0 });
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
        let mut found = Self { system, omega, radius: 0.0, order, speed_rpm, inverse, masses, rings, places, norm };
        found.widen(design, at).then_some(found)
    }

    /// Finds the radius; whether there is one.
    fn widen(&mut self, design: &[Mounted], at: Operating) -> bool {
        let by_damping = self.norm_of_damping();
        // 2 omega R + R² + c R = change/N
        let half = self.omega + 0.5 * by_damping;
        let most = LARGEST_CHANGE / self.norm;
        self.radius = (most / (half + (half * half + most).sqrt())).min(0.5 * self.omega);
        for _ in 0..HALVINGS {
            if !(self.radius > 0.0) || !self.enclose_laws(design, at) {
                return false;
            }
            let by_laws: f64 = self.rings.iter().map(|r| r.change * self.by_twist(r)).sum();
            let change = self.by_mass() + self.radius * by_damping + by_laws;
            if self.norm * change <= LARGEST_CHANGE * (1.0 + ROUNDED) {
                self.norm /= 1.0 - self.norm * change;
                return true;
            }
            self.radius *= 0.5;
        }
        false
    }

    /// By which the weight of the inertias may change in the disc: 2 omega R + R².
    fn by_mass(&self) -> f64 {
        self.radius * (2.0 * self.omega + self.radius)
    }

    /// Square of the twist of a ring per square of the norm of the unknowns.
    fn by_twist(&self, ring: &Ring) -> f64 {
        1.0 / self.masses[ring.station] + 1.0 / ring.inertia
    }

    /// Puts S of every ring over the disc; whether each has an enclosure.
    fn enclose_laws(&mut self, design: &[Mounted], at: Operating) -> bool {
        let radius = self.radius;
        // real and imaginary part of the frequency within a square that holds the disc
        let over = |centre: f64| {
            let mut over = Taylor::constant(C64::from(centre));
            (over.slopes[0], over.slopes[1]) = (C64::from(radius * centre / at.omega), I * (radius * centre / at.omega));
            over
        };
        let band = OperatingOver { omega: over(at.omega), shaft_speed: over(at.shaft_speed) };
        for (m, place) in design.iter().zip(&self.places) {
            let (Some(law), Some(place)) = (m.absorber.law(), place) else { continue };
            let values: Vec<Taylor> = law.values().into_iter().map(|x| Taylor::constant(C64::from(x))).collect();
            let Some(s) = law.over(&values, &band) else { return false };
            let ring = &mut self.rings[*place];
            let off = (s.centre - ring.stiffness.value).norm();
            // the law is analytic: its slope along the imaginary axis is i times that along the real one, but for rounding
            let turned = (s.slopes[1] - s.slopes[0] * I).norm();
            let rest = s.rest + off + turned;
            ring.stiffness = Tangent::new(ring.stiffness.value, s.slopes[0] / radius, rest / (radius * radius));
            ring.change = s.slopes[0].norm() + rest;
        }
        true
    }

    /// No less than |M^-1/2 C M^-1/2|: its largest sum of a row.
    fn norm_of_damping(&self) -> f64 {
        let (chain, n) = (&self.system.chain, self.system.chain.len());
        let mut rows: Vec<f64> = (0..n).map(|i| chain.stations[i].damping_to_ground / self.masses[i]).collect();
        for (i, s) in chain.stations.iter().enumerate().take(n - 1).filter(|s| s.1.damping_to_next != 0.0) {
            let (next, gear) = (chain.next(i), chain.gear(i).abs());
            let across = s.damping_to_next * gear / (self.masses[i] * self.masses[next]).sqrt();
            rows[i] += s.damping_to_next / self.masses[i] + across;
            rows[next] += s.damping_to_next * gear * gear / self.masses[next] + across;
        }
        rows.into_iter().fold(0.0, f64::max)
    }

    /// C times some unknowns.
    fn damped(&self, x: &[C64]) -> Vec<C64> {
        let (chain, n) = (&self.system.chain, self.system.chain.len());
        let mut damped = vec![ZERO; x.len()];
        for (i, s) in chain.stations.iter().enumerate() {
            damped[i] += x[i] * s.damping_to_ground;
            if i + 1 < n {
                let (next, gear) = (chain.next(i), chain.gear(i));
                let torque = (x[i] - x[next] * gear) * s.damping_to_next;
                damped[i] += torque;
                damped[next] -= torque * gear;
            }
        }
        damped
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
        let damped = self.damped(&x);
        let own = x.iter().zip(&self.masses).map(|(x, m)| m * x.norm_sqr()).sum::<f64>().sqrt();
        let by_damping = damped.iter().zip(&self.masses).map(|(x, m)| x.norm_sqr() / m).sum::<f64>().sqrt();
        let by_ring = |(i, r): (usize, &Ring)| r.change * self.twist(i, &x).norm() * self.by_twist(r).sqrt();
        let by_laws: f64 = self.rings.iter().enumerate().map(by_ring).sum();
        Solved { changed: self.by_mass() * own + self.radius * by_damping + by_laws, x, damped }
    }

    /// Of a^T E x the coefficient of d, how far the rest may be from it in the disc, and the size of all.
    fn change(&self, a: &Solved, x: &Solved) -> (C64, f64, f64) {
        let by_mass: C64 = a.x.iter().zip(&x.x).zip(&self.masses).map(|((a, x), m)| a * x * *m).sum();
        let by_damping: C64 = a.x.iter().zip(&x.damped).map(|(a, x)| a * x).sum();
        let mut slope = I * by_damping - by_mass * (2.0 * self.omega);
        let (square, mut size) = (self.radius * self.radius, self.by_mass() * by_mass.norm() + self.radius * by_damping.norm());
        let mut rest = square * by_mass.norm();
        for (i, r) in self.rings.iter().enumerate() {
            let twists = self.twist(i, &a.x) * self.twist(i, &x.x);
            slope += r.stiffness.slope * twists;
            rest += r.stiffness.bend * square * twists.norm();
            size += r.change * twists.norm();
        }
        (slope, rest, size)
    }

    /// Some outputs under the torque; `None` where a ring that does not turn against its hub is asked for. The torque of a shaft is that of its spring and damper.
    pub fn outputs(&self, quantities: &[Quantity], torque: &Parabola) -> Vec<Tangent> {
        let per_rpm = self.omega / self.speed_rpm;
        let loads = torque.about(self.order, self.speed_rpm, per_rpm);
        let under = loads.each_ref().map(|t| self.solved(t.iter().copied().enumerate()));
        quantities.iter().map(|q| self.output(*q, &loads, &under)).collect()
    }

    fn output(&self, quantity: Quantity, loads: &[Vec<C64>; 3], under: &[Solved; 3]) -> Tangent {
        let (chain, n) = (&self.system.chain, self.system.chain.len());
        let of: Vec<(usize, C64)> = match (quantity, quantity.difference(chain)) {
            (Quantity::RingTwist(i), _) => match self.places.get(i).copied().flatten() {
                Some(ring) => vec![(n + ring, C64::from(1.0)), (self.rings[ring].station, C64::from(-1.0))],
                None => Vec::new(),
            },
            (_, Some(Difference { from, to, scale })) => {
                let to = to.map(|(to, gear)| (to, C64::from(-scale * gear)));
                std::iter::once((from, C64::from(scale))).chain(to).collect()
            }
            (_, None) => Vec::new(),
        };
        let angle = self.angle(&self.solved(of.into_iter()), loads, under);
        let factor = match quantity {
            Quantity::ShaftTorque(shaft) => {
                let slope = I * chain.stations[shaft].damping_to_next;
                Tangent::new(chain.shaft_stiffness(shaft, self.omega), slope, 0.0)
            }
            Quantity::Motion(_, Rate::Velocity) => Tangent::new(I * self.omega, I, 0.0),
            Quantity::Motion(_, Rate::Acceleration) => Tangent::new(C64::from(-self.omega * self.omega), C64::from(-2.0 * self.omega), 1.0),
            Quantity::Twist { .. } | Quantity::RingTwist(_) => return angle,
        };
        angle.times(&factor, self.radius)
    }

    /// A sum of angles under a torque T0 + d T1 + d² T2.
    fn angle(&self, a: &Solved, loads: &[Vec<C64>; 3], [x, by_slope, by_square]: &[Solved; 3]) -> Tangent {
        let dot = |t: &[C64]| -> C64 { a.x.iter().zip(t).map(|(a, t)| a * t).sum() };
        let (slope, rest, _) = self.change(a, x);
        let (radius, square) = (self.radius, self.radius * self.radius);
        let beside = radius * self.change(a, by_slope).2 + square * self.change(a, by_square).2;
        let changed = x.changed + radius * by_slope.changed + square * by_square.changed;
        let rest = square * dot(&loads[2]).norm() + rest + beside + a.changed * self.norm * changed;
        Tangent::new(dot(&loads[0]), dot(&loads[1]) - slope, rest * (1.0 + ROUNDED) / square)
    }

    /// S of an absorber; `None` where its ring does not move.
    pub fn stiffness(&self, absorber: usize) -> Option<Tangent> {
        self.places.get(absorber).copied().flatten().map(|ring| self.rings[ring].stiffness)
    }
}
