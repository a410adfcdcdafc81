//! Speeds at which a design is evaluated: those of the study, and more where a resonance is too narrow for them.

use super::measure::with_its_ends;
use crate::absorber::Mounted;
use crate::drivetrain::System;
use crate::drivetrain::natural::{Basis, depends_on_speed, is_constant};
use crate::engine::Order;
use crate::numerics::C64;
use crate::numerics::elementary::Elementary;
use crate::response::Grid;
use crate::response::grid::is_same_speed;
use crate::units::{HZ_PER_RAD_PER_S, HZ_PER_RPM, RAD_PER_S_PER_RPM};

/// A resonance whose half-width is less than this many grid steps is narrow: grid values alone might miss it.
const STEPS: f64 = 2.0;
/// A mode that no absorber moves is told by speeds that are less than its half-width over this apart.
const SHOWN: f64 = 0.5;
/// Damping ratios below this are taken for it when speeds are laid round a resonance.
const LEAST_DAMPING: f64 = 1e-6;
/// Speeds are laid round a narrow resonance at its half-width times the powers of this, so that the true peak has close neighbours on both
/// sides even where the resonance is known to a few digits only.
const LADDER: f64 = 3.0;
/// Modes up to this multiple of the highest excited frequency describe the chain well enough to say where it resonates.
const REACH: f64 = 2.0;
/// But no more than this.
const MOST_MODES: usize = 24;
/// Modes of the full basis.
const FULL_MODES: usize = 64;
/// Damping ratios below this are rounding of zero.
const UNDAMPED: f64 = 1e-10;
/// What is this many times as far from its nearest resonance as speeds are from each other (its half-width counts) is smooth between them: of amplitudes and half ranges,
pub(super) const SMOOTH: f64 = 4.0;
/// and of margins, which follow bending besides.
pub(super) const SMOOTH_OF_MARGINS: f64 = 8.0;
/// Parts that one distance between speeds is cut into, at most.
const MOST_PARTS: usize = 16;

/// The chain as far as narrow resonances need it.
#[derive(Debug)]
pub(crate) struct Resonances {
    basis: Basis,
    /// As many modes as can be afforded: a heavy hub bends the low modes of the chain.
    full: Basis,
    /// Eigenvalues that no absorber moves: of a flexible crank's modes that do not turn about the axis.
    alone: Vec<C64>,
}

/// A resonance that nothing damps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pole {
    /// Index of the order that meets it.
    pub order: usize,
    /// rpm.
    pub speed_rpm: f64,
}

/// A resonance that is not wide for the distance of the speeds beside it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sharp {
    /// Index of the order that meets it.
    pub order: usize,
    speed_rpm: f64,
    /// rpm.
    half_width: f64,
}

impl Sharp {
    /// How far it is from an interval of speeds: the distance of its pole in the plane of complex speeds, rpm.
    fn distance(&self, (low, high): (f64, f64)) -> f64 {
        (self.speed_rpm - self.speed_rpm.clamp(low, high)).hypotenuse(self.half_width)
    }
}

/// Speeds of one design.
#[derive(Debug, Clone)]
pub struct Speeds {
    /// Ascending, rpm.
    pub rpm: Vec<f64>,
    /// Whether the torque has a kink there.
    pub kink: Vec<bool>,
    /// Indices of the speeds that are not in the grid.
    pub added: Vec<usize>,
    /// Resonances in the range that nothing damps, as far as eigenvalues tell.
    pub poles: Vec<Pole>,
    /// Resonances in the range or beside it that values at these speeds may not show, by speed.
    pub(super) sharp: Vec<Sharp>,
}

impl Resonances {
    /// Of the chain of a system, for speeds up to those of `grid`.
    pub fn new(system: &System, grid: &Grid) -> Self {
        let highest = system.excitation.orders.last().map_or(0.0, |o| o.value()) * grid.speed_rpm[grid.len() - 1] * RAD_PER_S_PER_RPM;
        let reached = system.modes.omega.iter().filter(|w| **w <= REACH * highest).count();
        let count = reached.max(system.modes.rigid + 3).min(MOST_MODES.max(system.modes.rigid + 3));
        if system.flexible.is_some() {
            let (coupled, modes) = (system.modes.coupled(), &system.modes);
            let alone = modes.elastic().filter(|i| !coupled.contains(i)).map(|i| {
                let ratio = modes.damping_ratio(i);
                C64::new(-ratio, (1.0 - ratio * ratio).max(0.0).sqrt()) * modes.omega[i]
            });
            let near: Vec<usize> = coupled.iter().copied().filter(|i| modes.omega[*i] <= REACH * highest).collect();
            let basis = Basis::of(&system.chain, modes, &near, true);
            return Self { full: basis.clone(), basis, alone: alone.collect() };
        }
        let basis = |count| Basis::new(&system.chain, &system.modes, count, true);
        Self { basis: basis(count), full: basis(count.max(FULL_MODES)), alone: Vec::new() }
    }

    /// The grid's speeds with those that the narrow resonances of a design need.
    pub fn speeds(&self, system: &System, grid: &Grid, design: &[Mounted]) -> Speeds {
        let (low, high) = (grid.speed_rpm[0], grid.speed_rpm[grid.len() - 1]);
        let mut more: Vec<f64> = Vec::new();
        let (mut poles, mut sharp) = (Vec::new(), Vec::new());
        let mut consider = |s: C64, n: usize, order: Order| {
            let own_damping = damping_ratio(s);
            let damping = own_damping.max(LEAST_DAMPING);
            let speed = s.im * HZ_PER_RAD_PER_S / (order.value() * HZ_PER_RPM);
            let step = step_at(&grid.speed_rpm, speed);
            let half_width = damping * speed;
            let near = SMOOTH_OF_MARGINS * step;
            if half_width < near && (low - near..=high + near).contains(&speed) {
                sharp.push(Sharp { order: n, speed_rpm: speed, half_width });
            }
            if half_width > STEPS * step || speed < low - step || speed > high + step {
                return;
            }
            // at an undamped resonance itself there is nothing but rounding
            if own_damping >= LEAST_DAMPING {
                more.push(speed);
            }
            if own_damping < UNDAMPED && (low..=high).contains(&speed) {
                poles.push(Pole { order: n, speed_rpm: speed });
            }
            let mut distance = half_width;
            while distance < 1.5 * step {
                more.extend([speed - distance, speed + distance]);
                distance *= LADDER;
            }
        };
        let orders = || system.excitation.orders.iter().copied().enumerate();
        if depends_on_speed(design) {
            // every order has natural motions of its own
            for (n, order) in orders() {
                let within = (order.omega(low), order.omega(high));
                self.eigenvalues((system, grid), design, order.value(), within).into_iter().for_each(|s| consider(s, n, order));
            }
        } else {
            for s in self.eigenvalues((system, grid), design, 1.0, (0.0, f64::INFINITY)) {
                orders().for_each(|(n, order)| consider(s, n, order));
            }
        }
        for s in &self.alone {
            // what such a mode puts into a twist is small: its peak is met where speeds show it at all
            let shown = |order: &Order| {
                let speed = s.im * HZ_PER_RAD_PER_S / (order.value() * HZ_PER_RPM);
                damping_ratio(*s) * speed > SHOWN * step_at(&grid.speed_rpm, speed)
            };
            orders().filter(|(_, order)| !shown(order)).for_each(|(n, order)| consider(*s, n, order));
        }
        more.retain(|s| (low..=high).contains(s));
        sharp.sort_by(|a: &Sharp, b: &Sharp| a.speed_rpm.total_cmp(&b.speed_rpm));
        if more.is_empty() {
            return Speeds { poles, sharp, ..Speeds::of(grid) };
        }
        let own = grid.speed_rpm.iter().zip(&grid.kink).map(|(s, k)| (*s, *k, false));
        let mut all: Vec<(f64, bool, bool)> = own.chain(more.into_iter().map(|s| (s, false, true))).collect();
        each_once(&mut all);
        let added = all.iter().enumerate().filter(|(_, s)| s.2).map(|(i, _)| i).collect();
        Speeds { rpm: all.iter().map(|s| s.0).collect(), kink: all.iter().map(|s| s.1).collect(), added, poles, sharp }
    }
}

impl Resonances {
    /// Eigenvalues of a design: a few modes tell whether any resonance is narrow; where one is, it must be known to a fraction of its width, and
    /// all modes are taken.
    fn eigenvalues(&self, (system, grid): (&System, &Grid), design: &[Mounted], order: f64, within: (f64, f64)) -> Vec<C64> {
        let heavy = design.iter().any(|m| m.hub() > 0.0);
        let first = if heavy { &self.full } else { &self.basis }.screened(design, order, within).unwrap_or_default();
        let (low, high) = (grid.speed_rpm[0], grid.speed_rpm[grid.len() - 1]);
        let narrow = |s: &C64| {
            let speeds = system.excitation.orders.iter().map(|o| s.im * HZ_PER_RAD_PER_S / (o.value() * HZ_PER_RPM));
            // what a few modes give may be off by some steps
            let near = |speed: f64| {
                let step = step_at(&grid.speed_rpm, speed);
                (low - 4.0 * step..=high + 4.0 * step).contains(&speed) && damping_ratio(*s) * speed <= STEPS * step
            };
            speeds.into_iter().any(near)
        };
        if !first.iter().any(narrow) || (heavy && is_constant(design)) {
            return first;
        }
        if is_constant(design) {
            return self.full.eigenvalues(design, order).unwrap_or(first);
        }
        let all =
            if heavy || self.full.len() == self.basis.len() { first } else { self.full.screened(design, order, within).unwrap_or(first) };
        all.into_iter().map(|s| if narrow(&s) { self.full.near(design, s, order).unwrap_or(s) } else { s }).collect()
    }
}

/// Puts speeds (each with whether there is a kink, and whether it was added) into ascending order, each once. Two that differ by rounding are one: which of them has the larger value says nothing, and would make a
/// local maximum of a flank. That of the grid stays, where values are known.
fn each_once(all: &mut Vec<(f64, bool, bool)>) {
    all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
    all.dedup_by(|b, a| {
        let is_same = (a.2 || b.2) && is_same_speed(a.0, b.0);
        if is_same {
            a.1 |= b.1;
            if !b.2 {
                (a.0, a.2) = (b.0, false);
            }
        }
        is_same
    });
}

/// Fraction of critical damping of an eigenvalue.
fn damping_ratio(s: C64) -> f64 {
    -s.re / s.norm()
}

impl Speeds {
    /// Those of a grid.
    pub fn of(grid: &Grid) -> Self {
        Self { rpm: grid.speed_rpm.clone(), kink: grid.kink.clone(), added: Vec::new(), poles: Vec::new(), sharp: Vec::new() }
    }

    /// Whether a speed or one of its neighbours was added for a resonance: there, peaks are narrow.
    pub(crate) fn is_narrow(&self, i: usize) -> bool {
        let at = self.added.partition_point(|a| *a + 1 < i);
        self.added[at..].iter().take_while(|a| **a <= i + 1).any(|a| !self.kink[*a])
    }

    /// With more speeds at which a measure has a kink, where they are in the range.
    #[must_use]
    pub(crate) fn with_kinks(self, kinks: impl Iterator<Item = f64>) -> Self {
        let (Some(low), Some(high)) = (self.rpm.first().copied(), self.rpm.last().copied()) else { return self };
        let more: Vec<f64> = kinks.filter(|s| (low..=high).contains(s)).collect();
        if more.is_empty() {
            return self;
        }
        let known = (0..self.rpm.len()).map(|i| (self.rpm[i], self.kink[i], self.added.binary_search(&i).is_ok()));
        let mut all: Vec<(f64, bool, bool)> = known.chain(more.into_iter().map(|s| (s, true, true))).collect();
        each_once(&mut all);
        let added = all.iter().enumerate().filter(|(_, s)| s.2).map(|(i, _)| i).collect();
        Self {
            rpm: all.iter().map(|s| s.0).collect(),
            kink: all.iter().map(|s| s.1).collect(),
            added,
            poles: self.poles,
            sharp: self.sharp,
        }
    }

    /// Those of a part of the range.
    pub(crate) fn part(&self, part: std::ops::Range<usize>) -> Self {
        Self {
            rpm: self.rpm[part.clone()].to_vec(),
            kink: self.kink[part.clone()].to_vec(),
            added: self.added.iter().filter(|i| part.contains(i)).map(|i| i - part.start).collect(),
            poles: Vec::new(),
            sharp: self.sharp.clone(),
        }
    }

    /// Sharp resonances that are near the speeds from index `i` to the next, by what is smooth.
    pub(super) fn sharp_near(&self, i: usize, smooth: f64) -> impl Iterator<Item = &Sharp> {
        let (low, high) = (self.rpm[i], self.rpm[i + 1]);
        let near = smooth * (high - low);
        let first = self.sharp.partition_point(|s| s.speed_rpm < low - near);
        let within = self.sharp[first..].iter().take_while(move |s| s.speed_rpm <= high + near);
        within.filter(move |s| s.distance((low, high)) < near)
    }

    /// Into how many parts the speeds from index `i` to the next must be cut for these resonances to be smooth in each.
    pub(super) fn parts_for<'s>(&self, i: usize, smooth: f64, resonances: impl Iterator<Item = &'s Sharp>) -> usize {
        let interval = (self.rpm[i], self.rpm[i + 1]);
        let nearest = resonances.map(|s| s.distance(interval)).fold(f64::INFINITY, f64::min);
        (smooth * (interval.1 - interval.0) / nearest).ceil().min(MOST_PARTS as f64) as usize
    }

    /// Speeds with those after each index cut into so many equal parts (zero or one: as they are), and the speeds that come in, rpm; no resonance counts as sharp any more.
    pub(super) fn cut(&self, parts: &[usize]) -> (Self, Vec<f64>) {
        let (mut finer, mut more) =
            (Self { rpm: Vec::new(), kink: Vec::new(), added: Vec::new(), poles: Vec::new(), sharp: Vec::new() }, Vec::new());
        for (i, (&rpm, &kink)) in self.rpm.iter().zip(&self.kink).enumerate() {
            if self.added.binary_search(&i).is_ok() {
                finer.added.push(finer.rpm.len());
            }
            finer.rpm.push(rpm);
            finer.kink.push(kink);
            let parts = parts.get(i).copied().unwrap_or_default();
            for part in 1..parts {
                let between = rpm + (self.rpm[i + 1] - rpm) * part as f64 / parts as f64;
                finer.rpm.push(between);
                finer.kink.push(false);
                more.push(between);
            }
        }
        (finer, more)
    }

    /// The parts that lie in some ranges of speed; the whole where there are none.
    pub(crate) fn parts(&self, ranges: &[(f64, f64)]) -> Vec<std::ops::Range<usize>> {
        let whole = [(f64::NEG_INFINITY, f64::INFINITY)];
        let part_in = |r: (f64, f64)| self.rpm.partition_point(|s| *s < r.0)..self.rpm.partition_point(|s| *s <= r.1);
        if ranges.is_empty() { &whole } else { ranges }.iter().map(|r| part_in(with_its_ends(*r))).filter(|p| !p.is_empty()).collect()
    }

    /// Puts values of the added speeds between those of the grid; `per_speed` values belong to each speed.
    pub(crate) fn merge<T: Copy>(&self, grid: Vec<T>, added: &[T], per_speed: usize) -> Vec<T> {
        if self.added.is_empty() {
            return grid;
        }
        let mut all = Vec::with_capacity(self.rpm.len() * per_speed);
        let (mut own, mut more) = (grid.chunks(per_speed), added.chunks(per_speed));
        let mut next = self.added.iter().peekable();
        for i in 0..self.rpm.len() {
            let from_added = next.next_if(|a| **a == i).is_some();
            all.extend_from_slice(if from_added { more.next() } else { own.next() }.unwrap_or_default());
        }
        all
    }

    /// The added speeds, rpm.
    pub(crate) fn added_rpm(&self) -> Vec<f64> {
        self.added.iter().map(|i| self.rpm[*i]).collect()
    }
}

/// Distance between grid speeds round a speed.
fn step_at(grid: &[f64], speed: f64) -> f64 {
    if grid.len() < 2 {
        return 0.0;
    }
    let i = grid.partition_point(|s| *s <= speed).clamp(1, grid.len() - 1);
    grid[i] - grid[i - 1]
}
