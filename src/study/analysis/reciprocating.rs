//! What a linear chain leaves out of the reciprocating masses: the part of their inertia that varies with twice the crank angle.
//!
//! A motion of order n asks for torques of the orders n + 2 and n - 2 (see `engine::varying_inertia`), turned by e^{∓2 i psi} where psi is the crank angle
//! of a cylinder's dead centre: where such an order resonates while order n is large, a secondary resonance \[Pasricha & Carnegie 1976\]. The estimate
//! takes the motion from the linear model, and the resonance as one mode with its own damping.

use crate::drivetrain::{Modes, System};
use crate::engine::{Order, varying_inertia};
use crate::input::Study;
use crate::numerics::C64;
use crate::numerics::elementary::turn;
use crate::response::{Dense, Grid, Quantity};
use crate::units::{RAD_PER_DEG, RAD_PER_S_PER_RPM};

/// Elastic modes that are looked at.
const MODES: usize = 2;

/// Modes that are told of.
const TOLD: usize = 3;

/// Natural frequencies with the mean inertia of the reciprocating masses and without it.
#[derive(Debug, Clone, PartialEq)]
#[doc(hidden)]
pub struct Frequencies {
    /// Half of m r² of a cylinder, kg m².
    pub each: f64,
    /// Of each of the lowest elastic modes, Hz.
    pub with: Vec<f64>,
    /// The same.
    pub without: Vec<f64>,
}

/// Nothing where the torque comes from a table or the chain has no elastic mode.
#[doc(hidden)]
pub fn frequencies(study: &Study) -> Option<Frequencies> {
    let each = study.engine.reciprocating_inertia()?;
    let mut chain = study.chain.clone();
    let sign = if study.reciprocating.mean { -1.0 } else { 1.0 };
    let per_throw = sign * each * study.engine.layout.rods_per_throw as f64;
    chain.stations.iter_mut().for_each(|s| s.inertia += per_throw * s.throws.len() as f64);
    let lowest = |modes: &Modes| modes.frequencies_hz().into_iter().take(TOLD).collect::<Vec<f64>>();
    let (own, other) = (lowest(&study.modes), lowest(&Modes::new(&chain)));
    if own.is_empty() || other.is_empty() {
        return None;
    }
    let (with, without) = if study.reciprocating.mean { (own, other) } else { (other, own) };
    Some(Frequencies { each, with, without })
}

/// The largest secondary resonance, estimated.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(hidden)]
pub struct Secondary {
    /// Order that resonates.
    pub order: Order,
    /// Order whose motion drives it.
    pub driven_by: Order,
    /// rpm.
    pub speed_rpm: f64,
    /// Twist of the reported stations that it adds, rad.
    pub twist: f64,
    /// The largest twist of one order at a resonance by its own torque, rad: both as one mode.
    pub primary: f64,
}

/// The estimate for the engine without absorber; nothing where no order resonates in the range.
#[doc(hidden)]
pub fn secondary(study: &Study, system: &System) -> Option<Secondary> {
    let variation = study.engine.reciprocating_inertia()?;
    let mut worst: Option<Secondary> = None;
    let mut primary: f64 = 0.0;
    for critical in super::model_check::critical_speeds(study, &system.excitation.orders).iter().filter(|c| c.mode <= MODES) {
        let mode = study.modes.rigid + critical.mode - 1;
        let omega = study.modes.omega[mode];
        // twist per modal torque
        let gain = shape_twist(study, mode) / (2.0 * study.modes.damping_ratio(mode) * omega * omega);
        if !gain.is_finite() {
            continue;
        }
        let modal = |torque: &[C64]| torque.iter().enumerate().map(|(i, t)| t * study.modes.shapes[(i, mode)]).sum::<C64>().norm();
        let index = system.excitation.orders.iter().position(|o| *o == critical.order)?;
        let mut torque = vec![C64::ZERO; system.chain.len()];
        system.torque(index, critical.speed_rpm, &mut torque);
        primary = primary.max(gain * modal(&torque));
        for from in partners(system, critical.order) {
            let torque = secondary_torque(study, system, (from, critical.order), critical.speed_rpm, variation)?;
            let twist = gain * modal(&torque);
            if worst.is_none_or(|w| twist > w.twist) {
                let driven_by = system.excitation.orders[from];
                worst = Some(Secondary { order: critical.order, driven_by, speed_rpm: critical.speed_rpm, twist, primary: 0.0 });
            }
        }
    }
    worst.map(|w| Secondary { primary, ..w })
}

/// Twist of the reported stations in a mode shape.
fn shape_twist(study: &Study, mode: usize) -> f64 {
    let shape = |station: usize| study.modes.shapes[(station, mode)];
    match study.twist {
        Quantity::Twist { from, to } => (shape(from) - to.map_or(0.0, shape)).abs(),
        _ => 0.0,
    }
}

/// Orders two below and two above, by their index.
fn partners(system: &System, order: Order) -> Vec<usize> {
    let apart = |o: &Order| (o.value() - order.value()).abs() == 2.0;
    (0..system.orders()).filter(|n| apart(&system.excitation.orders[*n])).collect()
}

/// Torque of an order on the stations by the motion of another one; nothing where that is unbounded.
fn secondary_torque(study: &Study, system: &System, (from, to): (usize, Order), speed_rpm: f64, variation: f64) -> Option<Vec<C64>> {
    let shaft_speed = speed_rpm * RAD_PER_S_PER_RPM;
    let n = system.excitation.orders[from].value();
    let up = to.value() > n;
    // on the right of the equation of motion
    let size = -varying_inertia::secondary_torque(variation, shaft_speed, n, up);
    let twice = if up { -2.0 } else { 2.0 };
    let (_, theta) = Dense::new(system, &Grid::new(&[speed_rpm], &[])).angles(&[], from, speed_rpm).ok()?;
    let on = |i: usize| {
        let cylinders = system.chain.stations[i].throws.iter().flat_map(|t| study.engine.layout.firing_on_throw(*t));
        let turned: C64 = cylinders.map(|deg| turn(twice * deg * RAD_PER_DEG)).sum();
        turned * theta[i] * size
    };
    Some((0..system.chain.len()).map(on).collect())
}
