//! The systems of a study: its engine firing, misfiring, with cylinders that burn unequally, and with none that burns.

use super::Progress;
use crate::crankshaft::Margin;
use crate::drivetrain::System;
use crate::engine::excitation::MotoredChange;
use crate::engine::{Excitation, Order};
use crate::input::Study;
use crate::numerics::C64;
use crate::objective::condition::Burning;
use crate::objective::{Condition, DutyLoad, PeakFinder};
use crate::optimise::LoadCase;
use crate::response::{Grid, Method};

/// A sum of torques below this share of one of them is rounding.
const SILENT: f64 = 1e-9;
/// An order appears where it is at least this share.
const LOUD: f64 = 1e-6;

/// The engine as it should be, then, where the study asks for it, with each cylinder misfiring and with its scatter of combustion.
pub(crate) fn systems(study: &Study, excitation: Excitation, progress: &dyn Progress) -> Vec<System> {
    if study.on_flexible().is_some() {
        progress.stage("tables of the flexible crank", 1);
    }
    let engine = &study.engine;
    let asked = |burning: &Burning| study.conditions.iter().any(|c| c.burning() == *burning);
    let burnings: Vec<Burning> = [Burning::AllButOne, Burning::Unequally, Burning::NotAtAll].into_iter().filter(asked).collect();
    let change = if burnings.is_empty() { None } else { excitation.motored_change(engine) };
    let excitations_of = |(burning, change): (Burning, &MotoredChange)| match (burning, &study.scatter) {
        (Burning::AllButOne, _) => {
            (0..engine.layout.firing_deg.len()).map(|cylinder| excitation.misfiring(engine, cylinder, change)).collect()
        }
        (Burning::Unequally, Some(scatter)) => vec![excitation.unequal(engine, scatter, change)],
        (Burning::NotAtAll, _) => vec![excitation.motored(engine, change)],
        (Burning::Alike, _) | (Burning::Unequally, None) => Vec::new(),
    };
    let unlike: Vec<Excitation> = burnings.into_iter().filter_map(|b| Some((b, change.as_ref()?))).flat_map(excitations_of).collect();
    let with = |excitation| study.system(excitation);
    std::iter::once(excitation).chain(unlike).map(with).collect()
}

/// What finds the peaks of each system.
pub(super) fn finders<'a>(
    study: &Study,
    (systems, methods): (&'a [System], &'a [Method<'a>]),
    grid: &'a Grid,
    (margin, duty): (Option<&'a Margin>, &'a [DutyLoad]),
) -> Vec<PeakFinder<'a>> {
    let finder = |(i, (system, method))| {
        let finder = PeakFinder::new(system, grid, method, study.refine_peaks).with_margin(margin);
        // a duty is of the engine as it should be
        if i == 0 { finder.with_duty(duty) } else { finder }
    };
    systems.iter().zip(methods).enumerate().map(finder).collect()
}

/// The engines of a condition among all of a study.
pub(crate) fn engines_in<'a, 'f>(condition: Condition, finders: &'f [PeakFinder<'a>]) -> impl Iterator<Item = &'f PeakFinder<'a>> {
    finders.iter().filter(move |f| condition.is_with(f.system.excitation.units))
}

/// A condition as load cases of a design problem: one for each cylinder that may misfire.
pub(super) fn load_cases<'a>(condition: Condition, finders: &'a [PeakFinder<'a>]) -> Vec<LoadCase<'a>> {
    engines_in(condition, finders).map(|finder| LoadCase::new(condition, finder)).collect()
}

/// Orders whose torques of all throws together cancel while every cylinder fires, and do not with the first one that misfires.
pub(crate) fn appearing(systems: &[System]) -> Vec<Order> {
    let firing = &systems[0].excitation;
    let Some(misfiring) = systems.iter().map(|s| &s.excitation).find(|e| e.units.misfiring().is_some()) else { return Vec::new() };
    let speed = firing.tabulated_rpm.first().copied().unwrap_or(1.0);
    let whole = |e: &Excitation, n: usize| (0..e.throws()).map(|t| e.throw_torque(t, n, speed)).sum::<C64>().norm();
    let unit = (0..firing.orders.len()).map(|n| firing.unit_torque(n, speed).norm()).fold(0.0, f64::max);
    let silent = |n: &usize| whole(firing, *n) < SILENT * unit && whole(misfiring, *n) > LOUD * unit;
    (0..firing.orders.len()).filter(silent).map(|n| firing.orders[n]).collect()
}
