//! Moments at the sections of a crank whose throws are carried by a bearing on each side \[Bhandari 2010\] section 25.18.
//!
//! With the reactions R1 = F b2/(b1 + b2) before and R2 = F b1/(b1 + b2) after a throw, radial and tangential, and T0 the torque that comes from the throws
//! before it: the middle of the crankpin has the bending R1 b1 in both planes and the torsion T0 + R1t r; the journal at its web has what is left of R1 (b1 + s) - F s
//! with s = l_c/2 + t/2, and T0 + F_t r. Bhandari leaves out the bending of the crankpin by the tangential force; here it counts.

use super::cycle::{Cycle, delayed};
use super::section::{Moments, Swing};
use super::specification::{Bearings, Sizes};

/// Loads of a throw over the cycle.
#[derive(Debug, Clone, PartialEq)]
pub struct ThrowLoads {
    /// On the crankpin away from the axis, N.
    pub radial: Vec<f64>,
    /// On the crankpin in the direction of rotation, N.
    pub tangential: Vec<f64>,
    /// From the throws before, N m.
    pub torque_before: Vec<f64>,
    /// To what follows, N m.
    pub torque_after: Vec<f64>,
}

/// Loads of all throws of a crank that is rigid in torsion: torques add up from the free end on.
pub(super) fn rigid_throws(cycle: &Cycle, firing_deg: &[f64], crank_radius: f64, cycle_deg: f64) -> Vec<ThrowLoads> {
    let torque = cycle.torque(crank_radius);
    let mut sum = vec![0.0; torque.len()];
    firing_deg
        .iter()
        .map(|deg| {
            let before = sum.clone();
            sum.iter_mut().zip(delayed(&torque, *deg, cycle_deg)).for_each(|(s, t)| *s += t);
            ThrowLoads {
                radial: delayed(&cycle.radial, *deg, cycle_deg),
                tangential: delayed(&cycle.tangential, *deg, cycle_deg),
                torque_before: before,
                torque_after: sum.clone(),
            }
        })
        .collect()
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
        radial: delayed(&cycle.radial, *deg, cycle_deg),
        tangential: delayed(&cycle.tangential, *deg, cycle_deg),
        torque_before: with_mean(i),
        torque_after: with_mean(i + 1),
    };
    firing_deg.iter().enumerate().map(throw).collect()
}

/// Moments of two bending planes and a torque over the cycle.
fn moments(bending: [Vec<f64>; 2], torsion: Vec<f64>) -> Moments {
    let [a, b] = &bending;
    let largest = a.iter().zip(b).zip(&torsion).map(|((a, b), t)| (a * a + b * b + t * t).sqrt()).fold(0.0, f64::max);
    Moments { bending: bending.map(Swing::of), rotating: 0.0, torsion: Swing::of(torsion), largest }
}

fn scaled(history: &[f64], factor: f64) -> Vec<f64> {
    history.iter().map(|x| x * factor).collect()
}

/// Shares of the force on a crankpin that the bearings before and after it bear.
pub fn shares(bearings: &Bearings) -> (f64, f64) {
    let span = bearings.before + bearings.after;
    (bearings.after / span, bearings.before / span)
}

/// In the middle of the crankpin.
pub fn crankpin(loads: &ThrowLoads, bearings: &Bearings, crank_radius: f64) -> Moments {
    let share = shares(bearings).0;
    let bending = [&loads.radial, &loads.tangential].map(|f| scaled(f, share * bearings.before));
    let torsion = loads.torque_before.iter().zip(&loads.tangential).map(|(t, f)| t + share * f * crank_radius).collect();
    moments(bending, torsion)
}

/// At the web of the journal after a throw.
pub fn journal(loads: &ThrowLoads, bearings: &Bearings, sizes: &Sizes) -> Moments {
    let share = shares(bearings).0;
    let s = 0.5 * (sizes.crankpin_length + sizes.web_thickness);
    let arm = share * (bearings.before + s) - s;
    moments([&loads.radial, &loads.tangential].map(|f| scaled(f, arm)), loads.torque_after.clone())
}

/// At the flywheel's seat: its weight and the belt bend the shaft while it turns.
pub fn seat(torque: &[f64], bearings: &Bearings) -> Moments {
    let span = bearings.before_flywheel + bearings.after_flywheel;
    let force = bearings.flywheel_weight.hypot(bearings.belt_tension) * bearings.before_flywheel / span;
    let rotating = force * bearings.after_flywheel;
    let largest = torque.iter().map(|t| t.hypot(rotating)).fold(0.0, f64::max);
    Moments { bending: [Swing::default(); 2], rotating, torsion: Swing::of(torque.iter().copied()), largest }
}
