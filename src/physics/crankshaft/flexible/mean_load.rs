//! What acts on a crank in the mean over a cycle.

use super::Assembled;
use crate::engine::cycle::{Cycle, crank_fixed, pin_angles};
use crate::numerics::C64;
use crate::units::RAD_PER_S_PER_RPM;
use nalgebra::DVector;

/// Forces and moments on all nodes: the means of what the rods do, and the unbalance of all that turns. Order zero of the crank in turning axes, where the flywheel is held against the mean torque.
#[doc(hidden)]
pub fn mean_load(assembled: &Assembled, cycle: &Cycle, speed_rpm: f64) -> DVector<C64> {
    let (engine, geometry) = (cycle.engine(), cycle.geometry());
    let speed = speed_rpm * RAD_PER_S_PER_RPM;
    let loads = cycle.loads(speed_rpm, 1);
    let shaft = &assembled.shaft;
    let mut force = DVector::from_element(6 * shaft.len(), C64::ZERO);
    for (i, own) in shaft.unbalance().iter().enumerate() {
        (0..6).for_each(|k| force[6 * i + k] += own[k] * speed * speed);
    }
    // counterweights that the stations leave no inertia for pull all the same
    for ((balance, webs), [outwards, _]) in assembled.balance.iter().zip(&assembled.webs).zip(&assembled.directions) {
        for node in webs {
            (0..3).for_each(|k| force[6 * node + k] -= 0.5 * balance.left_out * speed * speed * outwards[k]);
        }
    }
    // the forces of the rods hold all of their own masses
    let on_pin = geometry.mass_on_pin();
    let (rods, radius) = (engine.layout.rods_per_throw, geometry.slider_crank.crank_radius);
    for (t, angle) in pin_angles(engine).into_iter().enumerate() {
        for (rod, node) in assembled.rods[t].iter().enumerate() {
            let on = &loads.rod_force[t * rods + rod];
            let each = loads.theta.iter().zip(on).map(|(theta, force)| crank_fixed(*force, theta + angle));
            let sum = each.fold([0.0; 2], |sum, f| [sum[0] + f[0], sum[1] + f[1]]);
            let mean_component = |k: usize| sum[k] / loads.theta.len() as f64;
            let radial = mean_component(0) - on_pin * radius * speed * speed;
            for (direction, value) in assembled.directions[t].iter().zip([radial, mean_component(1)]) {
                (0..3).for_each(|k| force[6 * node + k] += value * direction[k]);
            }
        }
    }
    force
}
