//! Load cases of a slider-crank: cycles and the loads of all throws.

use super::bodies::Body;
use super::crank::{self, Orders, ThrowLoads};
use super::cycle::{Cycle, Gas, samples_of_cycle};
use super::specification::{Specification, TorqueCase};
use rayon::prelude::*;

/// Cycles, and the loads of all throws in each of them.
pub(super) type Loads = (Vec<Cycle>, Vec<Vec<ThrowLoads>>);

/// Loads of the engine firing at each speed, and at the highest one driven with nothing in its cylinders. Loads are sums of a part that goes with the pressure and one that
/// goes with the square of the speed, and what a section needs is convex in both: where the pressure does not depend on the speed, what holds at these corners holds between them, at any
/// load and speed; where it does, every speed of the study is a load case. The driven crank is rigid in torsion.
pub(super) fn loads(spec: &Specification, rod: &Body, torque: Option<&[TorqueCase]>) -> Loads {
    let geometry = spec.geometry(rod.mass, rod.centre, rod.inertia());
    let (cycle_deg, radius) = (180.0 * f64::from(spec.strokes), spec.crank_radius());
    let cycle = |speed: f64, filling: Gas| Cycle::new(&geometry, &spec.pressure, (spec.strokes, spec.firing_deg.len()), (speed, filling));
    let highest = spec.speeds_rpm[spec.speeds_rpm.len() - 1];
    let rigid = |c: &Cycle| crank::rigid_throws(c, &spec.firing_deg, radius, cycle_deg);
    let mut list: Vec<(Cycle, Vec<ThrowLoads>)> = match torque {
        None => {
            let loads_at_speed = |speed: &f64| {
                let c = cycle(*speed, Gas::Fired);
                let throws = rigid(&c);
                (c, throws)
            };
            spec.speeds_rpm.par_iter().map(loads_at_speed).collect()
        }
        Some(cases) => {
            let orders = Orders::new(cases.first().map_or(&[][..], |c| &c.harmonics), samples_of_cycle(spec.strokes));
            let loads_of_case = |case: &TorqueCase| {
                let c = cycle(case.speed_rpm, Gas::Fired);
                let throws = crank::with_response(rigid(&c), (&c, &spec.firing_deg), (case, &orders), (radius, cycle_deg));
                (c, throws)
            };
            cases.par_iter().map(loads_of_case).collect()
        }
    };
    let driven = cycle(highest, Gas::None);
    let throws = rigid(&driven);
    list.push((driven, throws));
    list.into_iter().unzip()
}
