//! What an engine file means: modes, critical speeds and a check of the pressure against the brake torque.

use crate::drivetrain::System;
use crate::engine::Order;
use crate::input::Study;
use crate::numerics::C64;
use crate::units::{HZ_PER_RPM, RAD_PER_S_PER_RPM};

/// Damping below which modes count as equally damped.
const LEAST_DAMPING: f64 = 1e-6;

/// A resonance in the speed range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Critical {
    /// Elastic mode, from 1.
    pub mode: usize,
    /// The order.
    pub order: Order,
    /// rpm.
    pub speed_rpm: f64,
}

/// Speeds within the range at which an order of the torque meets an elastic mode, by mode and order.
#[doc(hidden)]
pub fn critical_speeds(study: &Study, orders: &[Order]) -> Vec<Critical> {
    let (low, high) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    let modes = study.modes.elastic().enumerate();
    modes
        .flat_map(|(m, mode)| {
            orders.iter().map(move |&order| Critical { mode: m + 1, order, speed_rpm: study.modes.critical_speed_rpm(mode, order) })
        })
        .filter(|c| (low..=high).contains(&c.speed_rpm))
        .collect()
}

/// A resonance above the range by no more than this factor raises what is at its end.
const BESIDE: f64 = 1.15;

/// The same just above the range, in no sequence.
#[doc(hidden)]
pub fn critical_speeds_above(study: &Study, orders: &[Order]) -> Vec<Critical> {
    let high = study.speeds_rpm[study.speeds_rpm.len() - 1];
    let critical_speed =
        |mode: usize, m: usize, order: Order| Critical { mode: m + 1, order, speed_rpm: study.modes.critical_speed_rpm(mode, order) };
    let all = study.modes.elastic().enumerate().flat_map(|(m, mode)| orders.iter().map(move |order| critical_speed(mode, m, *order)));
    all.filter(|c| c.speed_rpm > high && c.speed_rpm <= BESIDE * high).collect()
}

/// Largest resonance of an order (by its index) with one of the first elastic modes: the coordinate of the mode at the speed where they meet, if that
/// is in the range, with the damping of the chain alone; zero for an order that meets none.
pub(crate) fn largest_resonance(study: &Study, system: &System, order: usize) -> f64 {
    largest_up_to(1.0, study, system, order)
}

/// The same for a range that ends at `reach` times the highest speed.
fn largest_up_to(reach: f64, study: &Study, system: &System, order: usize) -> f64 {
    let (low, high) = (study.speeds_rpm[0], reach * study.speeds_rpm[study.speeds_rpm.len() - 1]);
    let response_of = |m: usize| {
        let speed = study.modes.critical_speed_rpm(m, system.excitation.orders[order]);
        if !(low..=high).contains(&speed) {
            return 0.0;
        }
        let unit = system.excitation.unit_torque(order, speed).norm();
        let force = system.phases(order).iter().enumerate().map(|(i, p)| p * study.modes.shapes[(i, m)]).sum::<C64>().norm() * unit;
        // an undamped mode has no finite resonance: modes are then compared by their torque
        force / (study.modes.damping_ratio(m).max(LEAST_DAMPING) * study.modes.omega[m].powi(2))
    };
    study.modes.elastic().take(3).map(response_of).fold(0.0, f64::max)
}

/// Order lines of a Campbell diagram: those with the largest resonances.
#[doc(hidden)]
pub const DRAWN_ORDERS: usize = 12;

/// Indices of the orders with the largest resonances in the range or just above it, at most so many, ascending.
#[doc(hidden)]
pub fn strongest_orders(study: &Study, system: &System, most: usize) -> Vec<usize> {
    let mut orders: Vec<usize> = (0..system.orders()).collect();
    let largest = |order: &usize| largest_up_to(BESIDE, study, system, *order);
    orders.sort_by(|a, b| largest(b).total_cmp(&largest(a)));
    orders.truncate(most);
    orders.sort_unstable();
    orders
}

/// Highest frequency the torque reaches, Hz.
pub fn highest_frequency_hz(study: &Study, orders: &[Order]) -> f64 {
    let speed = study.speeds_rpm[study.speeds_rpm.len() - 1];
    orders.last().map_or(0.0, |o| o.value() * speed * HZ_PER_RPM)
}

/// Friction torque implied by the pressure model: order-zero torque less brake torque, N m, and as mean pressure, Pa.
#[doc(hidden)]
pub fn implied_friction(study: &Study, audit: &crate::engine::excitation::Audit) -> Option<(f64, f64)> {
    let crate::engine::Source::Cylinder { geometry, .. } = &study.engine.source else { return None };
    let torque = audit.mean_torque - audit.brake_torque?;
    let cycle = study.engine.cycle_deg() * crate::units::RAD_PER_DEG;
    Some((torque, torque * cycle / (study.engine.layout.firing_deg.len() as f64 * geometry.displacement())))
}

/// Power of a torque at a speed, W.
pub fn power(torque: f64, speed_rpm: f64) -> f64 {
    torque * speed_rpm * RAD_PER_S_PER_RPM
}
