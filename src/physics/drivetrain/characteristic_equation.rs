//! Hardly damped motions of chain and absorbers by Newton's method on their characteristic equation: laws are taken at the frequency of each motion without an eigenvalue solver a round.

use super::natural::{Basis, at_frequency, is_constant, typical};
use crate::absorber::{Absorber, Host, Law, Mounted, Operating, SpringAndDamper};
use crate::numerics::eigen::of_rank_one;
use crate::numerics::{C64, I};
use nalgebra::DMatrix;
use std::ops::Add;

/// Rounds of Newton's method.
const MOST_ROUNDS: usize = 30;
/// Relative change at which it ends, which leaves far less, and steps of its differences.
const SCREENED: f64 = 1e-6;
const DIFFERENCE: f64 = 1e-5;
/// Relative width of the interval that the square of a frequency without damping is found to: a start.
const START: f64 = 1e-6;
/// Rounds and relative change at which a start is good enough.
const ROUGHLY: (usize, f64) = (6, 1e-4);
/// Frequencies between two of the chain that are looked at, and every how many of them a law is computed.
const SCAN: usize = 24;
const EVERY: usize = 4;
/// Eigenvalues closer than this are one.
const SAME_MOTION: f64 = 1e-6;
/// Newton's method leads to a motion that is known once it is this close to it.
const KNOWN: f64 = 1e-3;
/// A frequency of the chain this close to that of a motion is a start that leads there.
const NEAR: f64 = 0.01;
/// Starts are looked for this many times below and above the frequencies that are asked for.
const BEYOND: f64 = 2.0;

/// What absorbers do to what carries them, moment over angle: a fraction, so that it has no poles at the frequencies of the rings.
#[derive(Clone, Copy)]
struct Load {
    above: C64,
    below: C64,
}

impl Load {
    const NONE: Self = Self { above: C64 { re: 0.0, im: 0.0 }, below: C64 { re: 1.0, im: 0.0 } };

    fn inertia(inertia: f64, s: C64) -> Self {
        Self { above: s * s * inertia, ..Self::NONE }
    }

    /// Behind a link.
    fn behind(self, link: C64) -> Self {
        Self { above: link * self.above, below: link * self.below + self.above }
    }
}

impl Add for Load {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        if other.below == C64::ONE {
            return Self { above: self.above + other.above * self.below, ..self };
        }
        Self { above: self.above * other.below + other.above * self.below, below: self.below * other.below }
    }
}

/// The characteristic equation of a chain with absorbers: det(I + H Z) = 0 with the receptances H between the stations that carry absorbers and the loads Z of these, times the denominators of the loads and of
/// one mode, so that it has no pole near that mode. Damping between different modes of the chain is left out.
struct Characteristic<'a> {
    basis: &'a Basis,
    design: &'a [Mounted],
    /// Stations that carry absorbers, each once.
    stations: Vec<usize>,
    /// Whether a ring carries another.
    stacked: bool,
    order: f64,
    /// Frequencies in which motions are asked for, rad/s.
    within: (f64, f64),
    /// Stiffness, damping and square of the shape at the first of the stations of each mode.
    modes: Vec<[f64; 3]>,
}

/// A value with its derivatives by s, laws held, and by the frequency at which laws are taken.
#[derive(Clone, Copy)]
struct Slope {
    value: C64,
    by_s: C64,
    by_law: C64,
}

/// What absorbers are at a frequency, and at the last one or a nearby one.
#[derive(Default)]
struct Laws {
    omega: f64,
    now: Vec<SpringAndDamper>,
    omega_before: f64,
    before: Vec<SpringAndDamper>,
}

impl Laws {
    /// Goes to a frequency, by `put`, which computes laws.
    fn at(&mut self, omega: f64, put: impl Fn(f64, &mut Vec<SpringAndDamper>)) {
        std::mem::swap(&mut self.now, &mut self.before);
        self.omega_before = self.omega;
        if self.before.is_empty() || self.omega_before == omega {
            self.omega_before = omega * (1.0 + DIFFERENCE);
            self.before.clear();
            put(self.omega_before, &mut self.before);
        }
        self.omega = omega;
        self.now.clear();
        put(omega, &mut self.now);
    }
}

impl<'a> Characteristic<'a> {
    /// With laws that depend on the speed of the shaft taken at the speed at which `order` has the frequency of the motion.
    fn new(basis: &'a Basis, design: &'a [Mounted], order: f64, within: (f64, f64)) -> Self {
        let mut stations: Vec<usize> = design
            .iter()
            .filter_map(|m| match m.on {
                Host::Station(station) => Some(station),
                Host::Ring(_) => None,
            })
            .collect();
        stations.sort_unstable();
        stations.dedup();
        let square = |mode: usize| stations.first().map_or(0.0, |station| basis.shape(*station, mode).powi(2));
        let modes = (0..basis.len()).map(|i| [basis.stiffness(i), basis.own_damping(i), square(i)]).collect();
        let stacked = design.iter().any(|m| matches!(m.on, Host::Ring(_)));
        Self { basis, design, stations, stacked, order, within, modes }
    }

    /// Whether a motion may be of those that are asked for.
    fn matters(&self, omega: f64) -> bool {
        (self.within.0 / BEYOND..=BEYOND * self.within.1).contains(&omega)
    }

    /// Eigenvalues near the motions without damping, each once, and whether they are all; good enough to tell which motions are hardly damped.
    fn motions(&self) -> Option<(Vec<C64>, bool)> {
        let mut undamped = self.undamped()?;
        undamped.retain(|s| self.matters(s.im));
        let first = different(undamped.iter().filter_map(|s| self.near(*s, &[])).collect());
        if first.len() == undamped.len() {
            return Some((first, true));
        }
        // a law that is far from its typical spring: where it crosses the chain at its own frequency, and the chain alone
        let is_new = |omega: &f64| first.iter().all(|s| (s.im / omega - 1.0).abs() > NEAR);
        let alone = self.basis.omegas().filter(|w| *w > 0.0 && self.matters(*w)).filter(is_new).map(|w| C64::new(0.0, w));
        let starts: Vec<C64> = self.crossings(&first).into_iter().chain(alone).collect();
        let more: Vec<C64> = starts.into_iter().filter_map(|s| self.near(s, &first)).collect();
        let all = different(first.into_iter().chain(more).collect());
        // laws may leave their rings no motion of their own, but take away no other; a pendulum tuned to the order holds its station, and leaves fewer
        let laws = || self.design.iter().filter_map(|m| m.absorber.law());
        let complete = laws().any(|law| law.depends_on_speed()) || all.len() + laws().count() >= undamped.len();
        Some((all, complete))
    }

    /// Eigenvalues without damping, each law at a frequency that is typical of it: starts.
    fn undamped(&self) -> Option<Vec<C64>> {
        let spring_of = |law: &dyn Law| at_frequency(law, typical(self.basis, law, self.order, ROUGHLY), self.order);
        if let [own @ Mounted { on: Host::Station(_), absorber: Absorber::Ring(law), .. }] = self.design
            && own.hub() == 0.0
        {
            let k = spring_of(law.as_ref()).stiffness;
            if k > 0.0 && k.is_finite() {
                // a ring of coordinate sqrt(J) angle has no stiffness of its own, the modes theirs, and the spring is k v v'
                let d: Vec<f64> = std::iter::once(0.0).chain(self.modes.iter().map(|mode| mode[0])).collect();
                let squares: Vec<f64> = std::iter::once(k / law.ring_inertia()).chain(self.modes.iter().map(|mode| k * mode[2])).collect();
                let omegas: Vec<f64> = of_rank_one(&d, &squares, START).into_iter().map(f64::sqrt).collect();
                let largest = omegas.last().copied().unwrap_or(0.0);
                return Some(omegas.into_iter().filter(|w| *w > 1e-6 * largest).map(|w| C64::new(0.0, w)).collect());
            }
        }
        self.basis.undamped(self.design, &spring_of)
    }

    /// The eigenvalue near `s`; nothing where it is one of those that are `known`.
    fn near(&self, mut s: C64, known: &[C64]) -> Option<C64> {
        let nearest = self.basis.nearest(s.im)?;
        let start = s;
        let mut laws = Laws::default();
        for _ in 0..MOST_ROUNDS {
            let change = self.newton_step(s, nearest, &mut laws);
            s -= change;
            if !(s.im > 0.0 && (s - start).norm_sqr() < 0.25 * start.norm_sqr()) {
                return None;
            }
            if known.iter().any(|known| (s - known).norm_sqr() <= KNOWN * KNOWN * s.norm_sqr()) {
                return None;
            }
            if change.norm_sqr() <= SCREENED * SCREENED * s.norm_sqr() {
                return Some(s);
            }
        }
        None
    }

    /// What Newton's method takes from s.
    fn newton_step(&self, s: C64, nearest: usize, laws: &mut Laws) -> C64 {
        let step = s * DIFFERENCE;
        let [station] = self.stations[..] else {
            let value_at = |s: C64| self.at((s, &self.springs(s.im)), nearest, true);
            return value_at(s) * step * 2.0 / (value_at(s + step) - value_at(s - step));
        };
        laws.at(s.im, |omega, springs| springs.extend(self.design.iter().map(|m| self.spring(m, omega))));
        let load = |s: C64, springs: &[SpringAndDamper]| self.load(Host::Station(station), (s, springs), true);
        // laws follow the frequency alone, all else the whole of s: derivatives by both
        let (here, beyond, earlier) = (load(s, &laws.now), load(s + step, &laws.now), load(s, &laws.before));
        let slope = |part: fn(&Load) -> C64| {
            let value = part(&here);
            Slope { value, by_s: (part(&beyond) - value) / step, by_law: (part(&earlier) - value) / (laws.omega_before - s.im) }
        };
        let (top, bottom) = (slope(|l| l.above), slope(|l| l.below));
        let squared = s * s;
        let modal = |[k, c, _]: &[f64; 3]| (squared + s * *c + *k, s * 2.0 + *c);
        let (own, square) = (modal(&self.modes[nearest]), self.modes[nearest][2]);
        let (mut h, mut h_by_s) = (C64::ZERO, C64::ZERO);
        for mode in self.modes[..nearest].iter().chain(&self.modes[nearest + 1..]) {
            let (value, by_s) = modal(mode);
            let receptance = value.conj() / value.norm_sqr();
            h += receptance * mode[2];
            h_by_s -= receptance * receptance * by_s * mode[2];
        }
        let sum = bottom.value + h * top.value;
        let value = own.0 * sum + top.value * square;
        let by_s = own.1 * sum + own.0 * (bottom.by_s + h_by_s * top.value + h * top.by_s) + top.by_s * square;
        let by_law = own.0 * (bottom.by_law + h * top.by_law) + top.by_law * square;
        // value = by_s (x + i y) + by_law y
        let by_frequency = I * by_s + by_law;
        let determinant = by_s.re * by_frequency.im - by_s.im * by_frequency.re;
        C64::new(value.re * by_frequency.im - value.im * by_frequency.re, by_s.re * value.im - by_s.im * value.re) / determinant
    }

    /// Frequencies without damping, as a scan between those of the chain tells; but for those where a motion is `known`.
    fn crossings(&self, known: &[C64]) -> Vec<C64> {
        let mut list = Vec::new();
        let own: Vec<f64> = self.basis.omegas().collect();
        for nearest in 0..own.len() {
            let (low, high) = between(&own, nearest);
            if low >= high || high < self.within.0 / BEYOND || low > BEYOND * self.within.1 {
                continue;
            }
            let place = |i: usize| low + (high - low) * share(i);
            // laws are smooth: straight lines between some values tell where to look
            let places: Vec<f64> = (0..=SCAN / EVERY).map(|k| place(EVERY * k)).collect();
            let laws: Vec<Vec<f64>> = self.design.iter().map(|m| self.stiffnesses(m, &places)).collect();
            let spring = |i: usize, law: usize| {
                let (before, after) = (laws[law][i / EVERY], laws[law][i / EVERY + 1]);
                SpringAndDamper { stiffness: before + (after - before) * (i % EVERY) as f64 / EVERY as f64, damping: 0.0 }
            };
            let values: Vec<f64> = (0..SCAN)
                .map(|i| match self.design.len() {
                    1 => self.undamped_at((place(i), i), nearest, &[spring(i, 0)]),
                    count => self.undamped_at((place(i), i), nearest, &(0..count).map(|law| spring(i, law)).collect::<Vec<_>>()),
                })
                .collect();
            let crossed = |i: &usize| values[*i] * values[*i + 1] <= 0.0;
            let is_known = |i: &usize| known.iter().any(|s| (place(*i)..=place(*i + 1)).contains(&s.im));
            list.extend((0..SCAN - 1).filter(crossed).filter(|i| !is_known(i)).map(|i| C64::new(0.0, 0.5 * (place(i) + place(i + 1)))));
        }
        list
    }

    /// Stiffness of an absorber at some circular frequencies; any where it has no law.
    fn stiffnesses(&self, mounted: &Mounted, omegas: &[f64]) -> Vec<f64> {
        let Some(law) = mounted.absorber.law() else { return vec![0.0; omegas.len()] };
        if let Some(spring) = law.spring_and_damper() {
            return vec![spring.stiffness; omegas.len()];
        }
        let at: Vec<Operating> = omegas.iter().map(|omega| Operating { omega: *omega, shaft_speed: omega / self.order }).collect();
        let mut all = vec![C64::ZERO; at.len()];
        law.dynamic_stiffness_each(&at, &mut all);
        all.into_iter().map(|s| s.re).collect()
    }

    /// What every absorber is at a circular frequency.
    fn springs(&self, omega: f64) -> Vec<SpringAndDamper> {
        self.design.iter().map(|m| self.spring(m, omega)).collect()
    }

    /// What an absorber is; any spring where it has no law.
    fn spring(&self, mounted: &Mounted, omega: f64) -> SpringAndDamper {
        let any = SpringAndDamper { stiffness: 0.0, damping: 0.0 };
        mounted.absorber.law().map_or(any, |law| at_frequency(law.as_ref(), omega, self.order))
    }

    /// Its left side without damping at a circular frequency, one of those of a scan: a real number.
    fn undamped_at(&self, (omega, place): (f64, usize), nearest: usize, springs: &[SpringAndDamper]) -> f64 {
        let s = C64::new(0.0, omega);
        let [station] = self.stations[..] else { return self.at((s, springs), nearest, false).re };
        let load = self.load(Host::Station(station), (s, springs), false);
        let others = self.basis.scanned(station, || self.receptances())[nearest * SCAN + place];
        let [k, _, square] = self.modes[nearest];
        (k - omega * omega) * (load.below.re + others * load.above.re) + load.above.re * square
    }

    /// Receptance of the station, but for the share of the nearest mode, without damping at the places of a scan.
    fn receptances(&self) -> Vec<f64> {
        let own: Vec<f64> = self.basis.omegas().collect();
        let receptance_at = |nearest: usize, i: usize| -> f64 {
            let (low, high) = between(&own, nearest);
            let omega = low + (high - low) * share(i);
            let others = self.modes[..nearest].iter().chain(&self.modes[nearest + 1..]);
            others.map(|[k, _, square]| square / (k - omega * omega)).sum()
        };
        (0..own.len()).flat_map(|nearest| (0..SCAN).map(move |i| (nearest, i))).map(|(nearest, i)| receptance_at(nearest, i)).collect()
    }

    /// Its left side; `damped`: whether damping counts.
    fn at(&self, (s, springs): (C64, &[SpringAndDamper]), nearest: usize, damped: bool) -> C64 {
        let loads: Vec<Load> = self.stations.iter().map(|p| self.load(Host::Station(*p), (s, springs), damped)).collect();
        let own = self.basis.modal(nearest, s, damped);
        let others = || (0..self.basis.len()).filter(|i| *i != nearest);
        let shape = |mode: usize, p: usize| self.basis.shape(self.stations[p], mode);
        if let [load] = loads[..] {
            let h: C64 = others().map(|i| shape(i, 0) * shape(i, 0) / self.basis.modal(i, s, damped)).sum();
            return own * (load.below + h * load.above) + load.above * (shape(nearest, 0) * shape(nearest, 0));
        }
        // the mode is a row and a column of its own: det(A + u v'/own) own = det [A, -u; v', own]
        let n = loads.len();
        let mut all = DMatrix::zeros(n + 1, n + 1);
        for i in others() {
            let receptance = C64::ONE / self.basis.modal(i, s, damped);
            for (p, q) in (0..n).flat_map(|p| (0..n).map(move |q| (p, q))) {
                all[(p, q)] += receptance * loads[q].above * (shape(i, p) * shape(i, q));
            }
        }
        for (p, load) in loads.iter().enumerate() {
            all[(p, p)] += load.below;
            all[(p, n)] = C64::from(-shape(nearest, p));
            all[(n, p)] = load.above * shape(nearest, p);
        }
        all[(n, n)] = own;
        all.determinant()
    }

    /// All that is carried by a station or a ring; `springs`: what the absorbers are.
    fn load(&self, on: Host, (s, springs): (C64, &[SpringAndDamper]), damped: bool) -> Load {
        let carried = self.design.iter().enumerate().filter(|(_, m)| m.on == on);
        let all = carried.map(|(index, mounted)| {
            let further = if self.stacked { self.load(Host::Ring(index), (s, springs), damped) } else { Load::NONE };
            match &mounted.absorber {
                Absorber::Ring(law) => {
                    let spring = springs[index];
                    let link = if damped { spring.stiffness + s * spring.damping } else { spring.stiffness.into() };
                    (Load::inertia(law.ring_inertia(), s) + further).behind(link) + Load::inertia(mounted.hub(), s)
                }
                Absorber::Locked { ring_inertia } => further + Load::inertia(mounted.hub() + ring_inertia, s),
            }
        });
        all.fold(Load::NONE, Add::add)
    }
}

/// From the frequency of a mode to that of the next, rad/s.
fn between(omegas: &[f64], mode: usize) -> (f64, f64) {
    let beyond = || 1.1 * omegas.iter().copied().fold(0.0, f64::max);
    (omegas[mode], omegas.get(mode + 1).copied().unwrap_or_else(beyond))
}

/// Where between them a place of a scan lies.
fn share(place: usize) -> f64 {
    (place as f64 + 0.5) / SCAN as f64
}

impl Basis {
    /// Eigenvalues good enough to tell which motions are hardly damped: of laws that depend on frequency by the characteristic equation, from motions without damping, which are found in a tenth of the time; of all
    /// others as [`Basis::eigenvalues`] has them.
    /// At least those of frequencies `within` (rad/s) are found.
    pub(crate) fn screened(&self, design: &[Mounted], order: f64, within: (f64, f64)) -> Option<Vec<C64>> {
        let linked = self.with_rigid_links(design);
        if is_constant(&linked) {
            return self.eigenvalues(design, order);
        }
        match Characteristic::new(self, &linked, order, within).motions() {
            Some((all, true)) => Some(all),
            _ => self.eigenvalues(design, order),
        }
    }
}

/// Eigenvalues by frequency, each once.
fn different(mut list: Vec<C64>) -> Vec<C64> {
    list.sort_by(|a, b| a.im.total_cmp(&b.im));
    list.dedup_by(|b, a| (*b - *a).norm() <= SAME_MOTION * b.norm());
    list
}
