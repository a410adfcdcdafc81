//! Moments at the sections of a crank.
//!
//! A throw on a bearing at each side \[Bhandari 2010\] section 25.18: with the reactions R1 = F b2/(b1 + b2) before and R2 = F b1/(b1 + b2) after it, radial and
//! tangential, and T0 the torque that comes from the throws before, the middle of the crankpin has the bending R1 b1 in both planes and the torsion T0 + R1t r; the
//! journal at its web R1 (b1 + s) - F s with s = l_c/2 + t/2, and T0 + F_t r. Bhandari leaves out the bending of the crankpin by the tangential force; here it counts.
//!
//! Or the whole crank as a beam of one section on all its bearings, where every throw bends the others.

use super::cycle::{Cycle, delayed};
use super::section::{Moments, Swing};
use super::specification::{Bearings, Bending, Sizes};
use crate::crankshaft::beam::{Beam, Support};
use crate::crankshaft::elements::reactions;

/// Loads of a throw over the cycle.
#[derive(Debug, Clone, PartialEq)]
pub struct ThrowLoads {
    /// Angle of its crankpin from the axis of the cylinders, rad.
    pub angle: Vec<f64>,
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
            angle: cycle.crank_deg.iter().map(|deg| (deg - firing_deg).to_radians()).collect(),
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

/// Loads of all throws with vibratory torques before, between and after them from elsewhere, N m; the mean adds up from throw to throw.
pub(super) fn throws_with_torque(
    cycle: &Cycle,
    firing_deg: &[f64],
    vibratory: &[Vec<f64>],
    crank_radius: f64,
    cycle_deg: f64,
) -> Vec<ThrowLoads> {
    let mean = cycle.torque(crank_radius).iter().sum::<f64>() / cycle.tangential.len() as f64;
    let with_mean = |i: usize| vibratory[i].iter().map(|t| t + mean * i as f64).collect();
    let throw = |(i, deg): (usize, &f64)| ThrowLoads {
        torque_before: with_mean(i),
        torque_after: with_mean(i + 1),
        ..ThrowLoads::of(cycle, *deg, cycle_deg)
    };
    firing_deg.iter().enumerate().map(throw).collect()
}

/// Shares of the force on a crankpin that the bearings before and after it bear, where they bear nothing else.
pub fn shares(bearings: &Bearings) -> (f64, f64) {
    let span = bearings.before + bearings.after;
    (bearings.after / span, bearings.before / span)
}

/// Bending per force on every throw at a place of a throw, m: `at` from the bearing before it.
fn influence(throws: usize, throw: usize, at: f64, bearings: &Bearings, bending: Bending) -> Vec<f64> {
    let span = bearings.before + bearings.after;
    let own = || {
        let mut own = vec![0.0; throws];
        own[throw] = shares(bearings).0 * at - (at - bearings.before).max(0.0);
        own
    };
    if bending == Bending::OwnBearings || throws == 1 {
        return own();
    }
    let supports = (0..=throws).map(|i| Support { at: span * i as f64, stiffness: None }).collect();
    let loads_at = (0..throws).map(|i| span * i as f64 + bearings.before).collect();
    // on rigid bearings the reactions do not depend on the rigidity
    let beam = Beam { supports, loads_at, rigidity: span * span };
    reactions(&beam).map_or_else(own, |r| beam.moment_at(&r, span * throw as f64 + at).into_iter().map(|m| -m).collect())
}

/// Bending at a place of a throw over the cycle, in the plane of the throw and across it, N m.
pub(super) fn bending(throws: &[ThrowLoads], throw: usize, at: f64, (bearings, bending): (&Bearings, Bending)) -> [Vec<f64>; 2] {
    let influence = influence(throws.len(), throw, at, bearings, bending);
    let own = &throws[throw];
    let mut found = [vec![0.0; own.radial.len()], vec![0.0; own.radial.len()]];
    let [radial, tangential] = &mut found;
    for (other, arm) in throws.iter().zip(&influence).filter(|o| *o.1 != 0.0) {
        let sums = radial.iter_mut().zip(tangential.iter_mut());
        let forces = other.radial.iter().zip(&other.tangential).zip(other.angle.iter().zip(&own.angle));
        for ((in_plane, across), ((r, t), (angle, own))) in sums.zip(forces) {
            // turned from the axes of the other throw to its own
            let (sine, cosine) = (angle - own).sin_cos();
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

/// In the middle of a crankpin.
pub fn crankpin(throws: &[ThrowLoads], throw: usize, supported: (&Bearings, Bending), crank_radius: f64) -> Moments {
    let (loads, share) = (&throws[throw], shares(supported.0).0);
    let torsion = loads.torque_before.iter().zip(&loads.tangential).map(|(t, f)| t + share * f * crank_radius).collect();
    moments(bending(throws, throw, supported.0.before, supported), torsion)
}

/// At the web of the journal after a throw.
pub fn journal(throws: &[ThrowLoads], throw: usize, supported: (&Bearings, Bending), sizes: &Sizes) -> Moments {
    let s = 0.5 * (sizes.crankpin_length + sizes.web_thickness);
    moments(bending(throws, throw, supported.0.before + s, supported), throws[throw].torque_after.clone())
}

/// At the flywheel's seat: its weight and the belt bend the shaft while it turns.
pub fn seat(torque: &[f64], bearings: &Bearings) -> Moments {
    let span = bearings.before_flywheel + bearings.after_flywheel;
    let force = bearings.flywheel_weight.hypot(bearings.belt_tension) * bearings.before_flywheel / span;
    let rotating = force * bearings.after_flywheel;
    let largest = torque.iter().map(|t| t.hypot(rotating)).fold(0.0, f64::max);
    Moments { bending: [Swing::default(); 2], rotating, torsion: Swing::of(torque.iter().copied()), largest }
}
