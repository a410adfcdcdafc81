//! Natural motions of chain and absorbers together.
//!
//! A law that is no constant spring and damper is taken as the spring and damper it is at the frequency of each motion, found by iteration.

use super::chain::Chain;
use super::modes::Modes;
use crate::absorber::{Absorber, Host, Law, Mounted, Operating, SpringAndDamper};
use crate::numerics::{C64, eigen};
use crate::units::HZ_PER_RAD_PER_S;
use nalgebra::{DMatrix, DVector};
use std::sync::OnceLock;

/// Chains longer than this are represented by as many of their lowest modes.
const LARGEST_DENSE: usize = 64;
/// Motions of a ring on a ring that are faster than this many times the highest mode count as rigid links.
const FASTEST: f64 = 1e4;
/// Rounds of the iteration for laws that depend on frequency, and the change at which it ends.
const MOST_ROUNDS: usize = 30;
const SETTLED: f64 = 1e-12;
/// Relative change of an own frequency that is good enough where the iteration is slow.
const NEARLY: f64 = 1e-3;
/// Modes that are faster than the lowest elastic one by more than this factor are slowed down to it, their compliance kept: an eigenvalue solver would lose the others in the rounding of theirs. The motions
/// that matter change by less than the compliance of a stiff shaft times the square of their frequency over this.
const TOO_FAST: f64 = 3e4;
/// Share of that frequency above which a motion is one of those modes.
const SLOWED: f64 = 0.99;
/// Frequencies closer than this are one.
const SAME: f64 = 1e-9;
/// Rounds after which an iteration is given up that changes no less than this share of its last change.
const PATIENCE: usize = 4;
const SLOW: f64 = 0.9;

/// Mass, damping and stiffness in the coordinates of the lowest modes of a chain.
#[derive(Debug, Clone)]
pub(crate) struct Basis {
    /// Mode shapes: a row a station, a column a mode.
    shapes: DMatrix<f64>,
    stiffness: Vec<f64>,
    damping: DMatrix<f64>,
    /// By station what scans of it find, once.
    scans: Vec<OnceLock<Vec<f64>>>,
}

/// Whether every ring of a design is on a constant spring and damper.
pub(crate) fn is_constant(design: &[Mounted]) -> bool {
    design.iter().filter_map(|m| m.absorber.law()).all(|law| law.spring_and_damper().is_some())
}

/// Whether a law of a design depends on the speed of the shaft.
pub fn depends_on_speed(design: &[Mounted]) -> bool {
    design.iter().filter_map(|m| m.absorber.law()).any(|law| law.depends_on_speed())
}

/// The spring and damper that a law is at a frequency (rad/s), the shaft turning at that frequency over `order`.
pub(super) fn at_frequency(law: &dyn Law, omega: f64, order: f64) -> SpringAndDamper {
    law.spring_and_damper().unwrap_or_else(|| {
        let s = law.dynamic_stiffness(Operating { omega, shaft_speed: omega / order });
        SpringAndDamper { stiffness: s.re, damping: s.im / omega }
    })
}

/// Frequency above which modes count as too fast, rad/s.
fn fastest(modes: &Modes) -> f64 {
    modes.elastic().next().map_or(f64::INFINITY, |lowest| TOO_FAST * modes.omega[lowest])
}

impl Basis {
    /// The lowest `count` modes; `damped`: whether the engine's own damping counts.
    pub fn new(chain: &Chain, modes: &Modes, count: usize, damped: bool) -> Self {
        let kept: Vec<usize> = (0..count.min(modes.omega.len())).collect();
        Self::of(chain, modes, &kept, damped)
    }

    /// Some of the modes.
    pub fn of(chain: &Chain, modes: &Modes, which: &[usize], damped: bool) -> Self {
        let (kept, omega) = (which.len(), |i: usize| modes.omega[which[i]]);
        let slowed: Vec<f64> = (0..kept).map(|i| (fastest(modes) / omega(i)).min(1.0)).collect();
        let between = |i: usize, j: usize| modes.damping_between(chain, which[i], which[j], 0.5 * (omega(i) + omega(j)));
        let c = |i: usize, j: usize| between(i, j) * slowed[i] * slowed[j];
        let mut shapes = modes.shapes.select_columns(which);
        shapes.column_iter_mut().zip(&slowed).for_each(|(mut shape, slowed)| shape *= *slowed);
        Self {
            shapes,
            stiffness: (0..kept).zip(&slowed).map(|(i, slowed)| (omega(i) * slowed).powi(2)).collect(),
            damping: if damped { DMatrix::from_fn(kept, kept, c) } else { DMatrix::zeros(kept, kept) },
            scans: vec![OnceLock::new(); modes.shapes.nrows()],
        }
    }

    /// How many modes.
    pub(crate) fn len(&self) -> usize {
        self.stiffness.len()
    }

    /// Eigenvalues s (1/s) of chain and absorbers, those with positive imaginary part; nothing where they cannot be computed. Laws that depend on the
    /// speed of the shaft are taken at the speed at which `order` has the frequency of the motion.
    pub fn eigenvalues(&self, design: &[Mounted], order: f64) -> Option<Vec<C64>> {
        let design = &self.with_rigid_links(design)[..];
        if is_constant(design) {
            return self.with(design, |law| at_frequency(law, 1.0, order));
        }
        let start = self.with(design, |law| at_frequency(law, typical(self, law, order, (MOST_ROUNDS, SETTLED)), order))?;
        start.into_iter().map(|s| self.settled(design, s, order, MOST_ROUNDS)).collect()
    }

    /// Circular frequencies of the modes, rad/s.
    pub(super) fn omegas(&self) -> impl Iterator<Item = f64> {
        self.stiffness.iter().map(|k| k.max(0.0).sqrt())
    }

    /// The mode whose frequency is nearest.
    pub(super) fn nearest(&self, omega: f64) -> Option<usize> {
        let apart = |i: usize| (self.stiffness[i].sqrt() - omega).abs();
        (0..self.stiffness.len()).min_by(|a, b| apart(*a).total_cmp(&apart(*b)))
    }

    /// s² + s c + k of a mode of unit modal mass.
    pub(super) fn modal(&self, mode: usize, s: C64, damped: bool) -> C64 {
        s * s + self.stiffness[mode] + if damped { s * self.damping[(mode, mode)] } else { C64::ZERO }
    }

    /// What a scan of a station finds, as `scan` does the first time.
    pub(super) fn scanned(&self, station: usize, scan: impl FnOnce() -> Vec<f64>) -> &[f64] {
        self.scans[station].get_or_init(scan)
    }

    /// Of a mode of unit modal mass, 1/s².
    pub(super) fn stiffness(&self, mode: usize) -> f64 {
        self.stiffness[mode]
    }

    /// Of a mode of unit modal mass by its own motion, 1/s.
    pub(super) fn own_damping(&self, mode: usize) -> f64 {
        self.damping[(mode, mode)]
    }

    /// Motion of a station in a mode.
    pub(super) fn shape(&self, station: usize, mode: usize) -> f64 {
        self.shapes[(station, mode)]
    }

    /// Eigenvalues with these springs and no damping.
    pub(super) fn undamped(&self, design: &[Mounted], spring: &impl Fn(&dyn Law) -> SpringAndDamper) -> Option<Vec<C64>> {
        let [m, _, k] = self.matrices(design, spring);
        let squares = eigen::undamped(&m, &k)?;
        let largest = squares.last().copied().unwrap_or(0.0).sqrt();
        Some(squares.into_iter().map(|s| s.max(0.0).sqrt()).filter(|w| *w > 1e-6 * largest).map(|w| C64::new(0.0, w)).collect())
    }

    /// The design with rings on rings locked where their own motion is this many times faster than the highest mode: it is lost in the rounding of an
    /// eigenvalue solver, and with it everything else. The frequencies of the rest change by less than the square of its inverse.
    pub(super) fn with_rigid_links(&self, design: &[Mounted]) -> Vec<Mounted> {
        let fast = FASTEST * self.stiffness.iter().fold(0.0, |m: f64, k| m.max(k.sqrt()));
        let is_rigid = |m: &Mounted| {
            let on_ring = m.absorber.law().filter(|_| matches!(m.on, Host::Ring(_)));
            let spring = on_ring.map(|law| at_frequency(law.as_ref(), fast / FASTEST, 1.0));
            let inertia = m.absorber.ring_inertia();
            spring.is_some_and(|s| s.damping / inertia > fast || (s.stiffness / inertia).sqrt() > fast)
        };
        design.iter().map(|m| if fast > 0.0 && is_rigid(m) { m.locked(m.absorber.ring_inertia()) } else { m.clone() }).collect()
    }

    /// The eigenvalue near a screened one with laws taken at its frequency, all damping counted: what screening leaves out is of the order of the square of the damping.
    pub(crate) fn near(&self, design: &[Mounted], s: C64, order: f64) -> Option<C64> {
        let [m, c, k] = self.matrices(design, &|law: &dyn Law| at_frequency(law, s.im, order));
        eigen::near(&m, &c, &k, s).or_else(|| self.settled(design, s, order, 1))
    }

    /// The eigenvalue near `s` with laws taken at its own frequency, by iteration.
    fn settled(&self, design: &[Mounted], mut s: C64, order: f64, rounds: usize) -> Option<C64> {
        let mut last = f64::INFINITY;
        for round in 0..rounds {
            let omega = s.im;
            let all = self.with(design, |law| at_frequency(law, omega, order))?;
            let near = all.into_iter().min_by(|a, b| (a - s).norm().total_cmp(&(b - s).norm()))?;
            let change = (near - s).norm();
            s = near;
            if change <= SETTLED * s.norm() || (round >= PATIENCE && change > SLOW * last) {
                break;
            }
            last = change;
        }
        Some(s)
    }

    /// Eigenvalues with these springs and dampers.
    fn with(&self, design: &[Mounted], spring: impl Fn(&dyn Law) -> SpringAndDamper) -> Option<Vec<C64>> {
        let [m, c, k] = self.matrices(design, &spring);
        let mut s = eigen::quadratic(&m, &c, &k)?;
        // a double zero eigenvalue is split by rounding: to about the square root of the rounding of the largest
        let largest = s.iter().map(|s| s.im).fold(0.0, f64::max);
        s.retain(|s| s.im > 1e-6 * largest);
        Some(s)
    }

    /// Mass, damping and stiffness with these springs and dampers: the modes first, then the rings.
    fn matrices(&self, design: &[Mounted], spring: &impl Fn(&dyn Law) -> SpringAndDamper) -> [DMatrix<f64>; 3] {
        let kept = self.stiffness.len();
        let moving = design.iter().filter(|m| m.absorber.law().is_some()).count();
        let n = kept + moving;
        let mut m = DMatrix::from_fn(n, n, |i, j| if i == j && i < kept { 1.0 } else { 0.0 });
        let mut k = DMatrix::zeros(n, n);
        let mut c = DMatrix::zeros(n, n);
        c.view_mut((0, 0), (kept, kept)).copy_from(&self.damping);
        for (i, stiffness) in self.stiffness.iter().enumerate() {
            k[(i, i)] = *stiffness;
        }
        for (index, mounted) in design.iter().enumerate() {
            let hub = self.motion(design, mounted.on, n);
            let Absorber::Ring(law) = &mounted.absorber else {
                m.ger(mounted.hub() + mounted.absorber.ring_inertia(), &hub, &hub, 1.0);
                continue;
            };
            let ring = kept + coordinate(design, index);
            let mut twist = -&hub;
            twist[ring] = 1.0;
            m[(ring, ring)] += law.ring_inertia();
            m.ger(mounted.hub(), &hub, &hub, 1.0);
            let spring = spring(law.as_ref());
            k.ger(spring.stiffness, &twist, &twist, 1.0);
            c.ger(spring.damping, &twist, &twist, 1.0);
        }
        [m, c, k]
    }

    /// Motion of what carries a hub, in the coordinates: a row of the modes, or that of a ring.
    fn motion(&self, design: &[Mounted], on: Host, n: usize) -> DVector<f64> {
        let kept = self.stiffness.len();
        match on {
            Host::Station(station) => DVector::from_fn(n, |i, _| if i < kept { self.shapes[(station, i)] } else { 0.0 }),
            Host::Ring(inner) if design[inner].absorber.law().is_none() => self.motion(design, design[inner].on, n),
            Host::Ring(inner) => {
                let ring = kept + coordinate(design, inner);
                DVector::from_fn(n, |i, _| f64::from(u8::from(i == ring)))
            }
        }
    }
}

/// A frequency at which a law may be taken for constant: that of its ring on a held hub, to a relative change in so many rounds.
pub(super) fn typical(basis: &Basis, law: &dyn Law, order: f64, settled: (usize, f64)) -> f64 {
    let first = basis.stiffness.iter().map(|k| k.sqrt()).find(|w| *w > 0.0).unwrap_or(100.0);
    own_frequency(law, first, order, settled).unwrap_or(first)
}

/// Number of a ring among those that move.
fn coordinate(design: &[Mounted], index: usize) -> usize {
    design[..index].iter().filter(|m| m.absorber.law().is_some()).count()
}

/// Frequency of a ring on its held hub, rad/s, from a first guess: omega² J = Re S(omega). Nothing where there is none.
fn own_frequency(law: &dyn Law, first: f64, order: f64, (rounds, settled): (usize, f64)) -> Option<f64> {
    let mut omega = first;
    for _ in 0..rounds {
        let next = (at_frequency(law, omega, order).stiffness / law.ring_inertia()).max(0.0).sqrt();
        if next <= 0.0 || !next.is_finite() {
            return None;
        }
        let change = (next / omega - 1.0).abs();
        omega = next;
        if change < settled {
            return Some(omega);
        }
    }
    // a stiffness that grows with frequency as fast as inertia does has no frequency of its own; others are close
    let again = (at_frequency(law, omega, order).stiffness / law.ring_inertia()).max(0.0).sqrt();
    ((again / omega - 1.0).abs() < NEARLY).then_some(omega)
}

/// Where the search of a ring's own frequency begins, rad/s.
const FIRST_GUESS: f64 = 1000.0;

/// Frequency of a ring on its held hub, rad/s; nothing where there is none.
#[doc(hidden)]
pub fn own(law: &dyn Law) -> Option<f64> {
    own_frequency(law, FIRST_GUESS, 1.0, (MOST_ROUNDS, SETTLED))
}

/// Loss factor of a law at the ring's own frequency on its held hub, Im S/Re S: twice its damping ratio there. Nothing where there is no such frequency.
#[doc(hidden)]
pub fn own_loss_factor(law: &dyn Law) -> Option<f64> {
    let omega = own(law)?;
    let s = law.dynamic_stiffness(Operating { omega, shaft_speed: omega });
    Some(s.im / s.re)
}

/// Natural frequencies (of the damped motion, the imaginary parts of the eigenvalues), Hz, ascending, without rigid modes. The absorbers'
/// damping counts, the engine's own does not; overdamped motions have no frequency and are left out. A law is the spring and damper that it is at the frequency of the motion: for one that is heavily damped by
/// such a law the frequency is approximate. `modes` are those of the chain alone. Nothing
/// where a law depends on the speed of the shaft: the frequencies then do, too.
///
/// Chains of more than 64 stations enter by their lowest 64 modes; the lowest frequencies then err by about (f/f64)².
pub fn frequencies_hz(chain: &Chain, modes: &Modes, design: &[Mounted]) -> Vec<f64> {
    if design.is_empty() {
        return modes.frequencies_hz();
    }
    if depends_on_speed(design) {
        return Vec::new();
    }
    let eigenvalues = Basis::new(chain, modes, LARGEST_DENSE, false).eigenvalues(design, 1.0).unwrap_or_default();
    let mut frequencies: Vec<f64> = eigenvalues.iter().map(|s| s.im * HZ_PER_RAD_PER_S).collect();
    // of modes that were slowed down the absorbers move none
    let fastest = fastest(modes);
    if modes.omega.iter().take(LARGEST_DENSE).any(|w| *w > fastest) {
        frequencies.retain(|f| *f < SLOWED * fastest * HZ_PER_RAD_PER_S);
        frequencies.extend(modes.omega.iter().take(LARGEST_DENSE).filter(|w| **w > fastest).map(|w| w * HZ_PER_RAD_PER_S));
    }
    frequencies.sort_by(f64::total_cmp);
    // two motions of the constant springs may lead to one of the laws
    if !is_constant(design) {
        frequencies.dedup_by(|b, a| (*b / *a - 1.0).abs() < SAME);
    }
    frequencies
}
