//! The systems of a study: its engine firing, and misfiring.

use crate::drivetrain::System;
use crate::engine::{Excitation, Order};
use crate::input::Study;
use crate::numerics::C64;
use crate::objective::Condition;

/// A sum of torques below this share of one of them is rounding.
const SILENT: f64 = 1e-9;
/// An order appears where it is at least this share.
const LOUD: f64 = 1e-6;

/// The engine as it should be, then with each cylinder misfiring where the study asks for it.
pub(crate) fn systems(study: &Study, excitation: Excitation) -> Vec<System> {
    let with = |excitation| System::with_modes(study.chain.clone(), study.modes.clone(), excitation);
    let misfires = study.conditions.contains(&Condition::Misfire);
    let change = misfires.then(|| excitation.motored_change(&study.engine)).flatten();
    let cylinders = 0..change.as_ref().map_or(0, |_| study.engine.layout.firing_deg.len());
    let misfiring = cylinders
        .zip(std::iter::repeat(&change))
        .filter_map(|(c, change)| change.as_ref().map(|change| with(excitation.misfiring(&study.engine, c, change))));
    let misfiring: Vec<System> = misfiring.collect();
    std::iter::once(with(excitation)).chain(misfiring).collect()
}

/// Orders whose torques of all throws together cancel while every cylinder fires, and do not with one that misfires.
pub fn appearing(firing: &Excitation, misfiring: &Excitation) -> Vec<Order> {
    let speed = firing.tabulated_rpm.first().copied().unwrap_or(1.0);
    let whole = |e: &Excitation, n: usize| (0..e.throws()).map(|t| e.throw_torque(t, n, speed)).sum::<C64>().norm();
    let unit = (0..firing.orders.len()).map(|n| firing.unit_torque(n, speed).norm()).fold(0.0, f64::max);
    let silent = |n: &usize| whole(firing, *n) < SILENT * unit && whole(misfiring, *n) > LOUD * unit;
    (0..firing.orders.len()).filter(silent).map(|n| firing.orders[n]).collect()
}
