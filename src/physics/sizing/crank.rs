//! Moments at the sections of a crank.
//!
//! A throw on a bearing at each side \[Bhandari 2010\] section 25.18: with the reactions R1 = F b2/(b1 + b2) before and R2 = F b1/(b1 + b2) after it, radial and
//! tangential, and T0 the torque that comes from the throws before, the middle of the crankpin has the bending R1 b1 in both planes and the torsion T0 + R1t r; the
//! journals at their webs R1 (b1 - s) and T0, and R2 (b2 - s) and T0 + F_t r, with s = l_c/2 + t/2. Bhandari leaves out the bending of the crankpin by the tangential force; here it counts.
//!
//! Or the whole crank as a beam of one section on all its bearings, where every throw bends the others.

use super::cycle::{Cycle, delayed};
use super::section::{Moments, Swing};
use super::specification::{Bearings, Bending, Sizes, TorqueCase};
use crate::crankshaft::beam::{Beam, Support};
use crate::crankshaft::elements::reactions;
use crate::numerics::C64;
use crate::numerics::elementary::{Elementary, turn};
use crate::numerics::harmonics::Analyser;
use std::f64::consts::TAU;

/// Loads of a throw over the cycle.
#[derive(Debug, Clone, PartialEq)]
pub struct ThrowLoads {
    /// When its cylinder fires, degrees: its crankpin is so far behind that of a cylinder which fires at 0°.
    pub firing_deg: f64,
    /// On the crankpin away from the axis, N.
    pub radial: Vec<f64>,
    /// On the crankpin in the direction of rotation, N.
    pub tangential: Vec<f64>,
    /// From the throws before, N m.
    pub torque_before: Vec<f64>,
    /// To what follows, N m.
    pub torque_after: Vec<f64>,
}

impl ThrowLoads {
    /// Of a cylinder that fires at an angle, without torque.
    fn of(cycle: &Cycle, firing_deg: f64, cycle_deg: f64) -> Self {
        Self {
            firing_deg,
            radial: delayed(&cycle.radial, firing_deg, cycle_deg),
            tangential: delayed(&cycle.tangential, firing_deg, cycle_deg),
            torque_before: Vec::new(),
            torque_after: Vec::new(),
        }
    }
}

/// Loads of all throws of a crank that is rigid in torsion: torques add up from the free end on.
pub(super) fn rigid_throws(cycle: &Cycle, firing_deg: &[f64], crank_radius: f64, cycle_deg: f64) -> Vec<ThrowLoads> {
    let torque = cycle.torque(crank_radius);
    let mut sum = vec![0.0; torque.len()];
    let throw = |deg: &f64| {
        let torque_before = sum.clone();
        sum.iter_mut().zip(delayed(&torque, *deg, cycle_deg)).for_each(|(s, t)| *s += t);
        ThrowLoads { torque_before, torque_after: sum.clone(), ..ThrowLoads::of(cycle, *deg, cycle_deg) }
    };
    firing_deg.iter().map(throw).collect()
}

/// Orders of a history, and their turns at every sample.
pub(super) struct Orders<'a> {
    analyser: Analyser<'a>,
    turns: Vec<Vec<C64>>,
}

impl<'a> Orders<'a> {
    /// Of histories of `n` samples.
    pub(super) fn new(harmonics: &'a [u32], n: usize) -> Self {
        let turn = |harmonic: u32, j: usize| turn(TAU * f64::from(harmonic) * j as f64 / n as f64);
        Self { analyser: Analyser::new(n, harmonics), turns: harmonics.iter().map(|h| (0..n).map(|j| turn(*h, j)).collect()).collect() }
    }

    /// A history without these orders: its mean and the others.
    fn without(&self, history: &[f64]) -> Vec<f64> {
        let mut rest = history.to_vec();
        for (c, turns) in self.analyser.analyse(history).iter().zip(&self.turns) {
            rest.iter_mut().zip(turns).for_each(|(t, turn)| *t -= (c * turn).re);
        }
        rest
    }
}

/// The same with vibratory torques before, between and after the throws from elsewhere in place of their own of these orders; the mean and all other orders stay.
pub(super) fn with_response(
    mut throws: Vec<ThrowLoads>,
    (cycle, firing_deg): (&Cycle, &[f64]),
    (case, orders): (&TorqueCase, &Orders),
    (crank_radius, cycle_deg): (f64, f64),
) -> Vec<ThrowLoads> {
    let rest = orders.without(&cycle.torque(crank_radius));
    let mut sum = vec![0.0; rest.len()];
    let mixed = |rigid: &mut [f64], rest: &[f64], response: &[f64]| {
        rigid.iter_mut().zip(rest).zip(response).for_each(|((t, rest), v)| *t += case.share * (rest + v - *t));
    };
    for (i, (throw, deg)) in throws.iter_mut().zip(firing_deg).enumerate() {
        mixed(&mut throw.torque_before, &sum, &case.vibratory[i]);
        sum.iter_mut().zip(delayed(&rest, *deg, cycle_deg)).for_each(|(s, t)| *s += t);
        mixed(&mut throw.torque_after, &sum, &case.vibratory[i + 1]);
    }
    throws
}

/// Shares of the force on a crankpin that the bearings before and after it bear, where they bear nothing else.
pub fn shares(bearings: &Bearings) -> (f64, f64) {
    let span = bearings.before + bearings.after;
    (bearings.after / span, bearings.before / span)
}

/// Bending per force on every throw at a place of a throw, m: `at` from the bearing before it.
fn influence(throws: usize, throw: usize, at: f64, bearings: &Bearings, bending: Bending) -> Vec<f64> {
    let span = bearings.before + bearings.after;
    let determinate_influence = || {
        let mut own = vec![0.0; throws];
        own[throw] = shares(bearings).0 * at - (at - bearings.before).max(0.0);
        own
    };
    if bending == Bending::OwnBearings || throws == 1 {
        return determinate_influence();
    }
    let supports = (0..=throws).map(|i| Support { at: span * i as f64, stiffness: None }).collect();
    let loads_at = (0..throws).map(|i| span * i as f64 + bearings.before).collect();
    // on rigid bearings the reactions do not depend on the rigidity
    let beam = Beam { supports, loads_at, rigidity: span * span };
    reactions(&beam).map_or_else(determinate_influence, |r| beam.moment_at(&r, span * throw as f64 + at).into_iter().map(|m| -m).collect())
}

/// Bending at a place of a throw over the cycle, in the plane of the throw and across it, N m.
pub(super) fn bending(throws: &[ThrowLoads], throw: usize, at: f64, (bearings, bending): (&Bearings, Bending)) -> [Vec<f64>; 2] {
    let influence = influence(throws.len(), throw, at, bearings, bending);
    let own = &throws[throw];
    let mut found = [vec![0.0; own.radial.len()], vec![0.0; own.radial.len()]];
    let [radial, tangential] = &mut found;
    for (i, (other, arm)) in throws.iter().zip(&influence).enumerate().filter(|o| *o.1.1 != 0.0) {
        if i == throw {
            radial.iter_mut().zip(&own.radial).for_each(|(sum, r)| *sum += arm * r);
            tangential.iter_mut().zip(&own.tangential).for_each(|(sum, t)| *sum += arm * t);
            continue;
        }
        // turned from the axes of the other throw to its own, by what lies between their crankpins
        let (sine, cosine) = (own.firing_deg - other.firing_deg).to_radians().sine_cosine();
        let sums = radial.iter_mut().zip(tangential.iter_mut());
        for ((in_plane, across), (r, t)) in sums.zip(other.radial.iter().zip(&other.tangential)) {
            *in_plane += arm * (r * cosine - t * sine);
            *across += arm * (r * sine + t * cosine);
        }
    }
    found
}

/// Moments of two bending planes and a torque over the cycle.
fn moments(bending: [Vec<f64>; 2], torsion: Vec<f64>) -> Moments {
    let [a, b] = &bending;
    let largest = a.iter().zip(b).zip(&torsion).map(|((a, b), t)| (a * a + b * b + t * t).sqrt()).fold(0.0, f64::max);
    Moments { bending: bending.map(Swing::of), rotating: 0.0, torsion: Swing::of(torsion), largest }
}

/// A side of a throw, seen from the free end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// Towards the free end.
    Before,
    /// Towards the flywheel.
    After,
}

impl Side {
    /// Both of them.
    pub(super) const BOTH: [Self; 2] = [Self::Before, Self::After];

    /// Distance along the crank from the bearing before a throw, for one from the middle of its crankpin to this side, m.
    fn place(self, bearings: &Bearings, from_pin: f64) -> f64 {
        match self {
            Self::Before => bearings.before - from_pin,
            Self::After => bearings.before + from_pin,
        }
    }

    /// Torque in the crank at this side, N m.
    pub(super) fn torque(self, loads: &ThrowLoads) -> &[f64] {
        match self {
            Self::Before => &loads.torque_before,
            Self::After => &loads.torque_after,
        }
    }
}

/// What a side of a throw bears at a place between web and bearing.
pub(super) struct AtSide {
    /// Bending there in the plane of the throw and across it, N m.
    pub bending: [Vec<f64>; 2],
    /// Force on the part of the crank beyond, in the same directions: the reaction of the bearing, and of what follows it, N.
    pub reaction: [Vec<f64>; 2],
}

/// At `from_pin` from the middle of a crankpin.
pub(super) fn at_side(throws: &[ThrowLoads], throw: usize, side: Side, from_pin: f64, supported: (&Bearings, Bending)) -> AtSide {
    let there = bending(throws, throw, side.place(supported.0, from_pin), supported);
    let pin = bending(throws, throw, supported.0.before, supported);
    // between crankpin and bearing the moment falls by the reaction times the distance
    let slope = |pin: &[f64], there: &[f64]| pin.iter().zip(there).map(|(p, m)| (p - m) / from_pin).collect();
    AtSide { reaction: [slope(&pin[0], &there[0]), slope(&pin[1], &there[1])], bending: there }
}

/// Torsion of the bar from the axis to the crankpin at a radius, about the direction of the crank: T0 + R1t rho before the pin, T_after - R2t rho after it, N m.
pub(super) fn torsion_at_radius(loads: &ThrowLoads, side: Side, reaction_across: &[f64], radius: f64) -> Vec<f64> {
    let sign = if side == Side::Before { 1.0 } else { -1.0 };
    side.torque(loads).iter().zip(reaction_across).map(|(t, r)| t + sign * r * radius).collect()
}

/// In the middle of a crankpin: the larger torsion of both sides counts, which are one where the crank is rigid.
pub fn crankpin(throws: &[ThrowLoads], throw: usize, supported: (&Bearings, Bending), crank_radius: f64) -> [Moments; 2] {
    let in_middle = bending(throws, throw, supported.0.before, supported);
    Side::BOTH.map(|side| {
        let reach = if side == Side::Before { supported.0.before } else { supported.0.after };
        let [_, across] = at_side(throws, throw, side, reach, supported).reaction;
        moments(in_middle.clone(), torsion_at_radius(&throws[throw], side, &across, crank_radius))
    })
}

/// At the webs of the journals before and after a throw.
pub fn journals(throws: &[ThrowLoads], throw: usize, supported: (&Bearings, Bending), sizes: &Sizes) -> [Moments; 2] {
    let s = 0.5 * (sizes.crankpin_length + sizes.web_thickness);
    Side::BOTH.map(|side| moments(bending(throws, throw, side.place(supported.0, s), supported), side.torque(&throws[throw]).to_vec()))
}

/// At the flywheel's seat: its weight and the belt bend the shaft while it turns.
pub fn seat(torque: &[f64], bearings: &Bearings) -> Moments {
    let span = bearings.before_flywheel + bearings.after_flywheel;
    let force = bearings.flywheel_weight.hypotenuse(bearings.belt_tension) * bearings.before_flywheel / span;
    let rotating = force * bearings.after_flywheel;
    let largest = torque.iter().map(|t| t.hypotenuse(rotating)).fold(0.0, f64::max);
    Moments { bending: [Swing::default(); 2], rotating, torsion: Swing::of(torque.iter().copied()), largest }
}
