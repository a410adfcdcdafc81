//! The calculation that a classification society asks for: Holzer's tables, sums of phase vectors, critical speeds, torque of the shafts.

use super::Results;
use super::curves::{HolzerRow, holzer};
use super::sweeps::Swept;
use crate::drivetrain::System;
use crate::engine::Order;
use crate::input::Study;
use crate::numerics::C64;
use crate::objective::Condition;
use crate::units::HZ_PER_RAD_PER_S;

/// By how much an order drives a mode of the chain without absorber.
#[derive(Debug, Clone, PartialEq)]
#[doc(hidden)]
pub struct VectorSum {
    /// Elastic mode, from 1.
    pub mode: usize,
    /// Hz.
    pub frequency_hz: f64,
    /// The order.
    pub order: Order,
    /// |sum over throws of Theta e^{-i n phi}|, Theta one at the largest station.
    pub sum: f64,
    /// Speed at which they meet, rpm.
    pub speed_rpm: f64,
    /// Equilibrium amplitude of the largest station, |sum| / (omega² sum of J Theta²), rad per N m of a throw.
    pub equilibrium: f64,
}

/// An order that meets a mode up to [`ABOVE`] of the highest speed.
#[derive(Debug, Clone, PartialEq)]
#[doc(hidden)]
pub struct Critical {
    /// By how much it drives it.
    pub of: VectorSum,
    /// Within the speeds of the study.
    pub in_range: Option<InRange>,
}

/// What the torque at a critical speed does.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(hidden)]
pub struct InRange {
    /// Amplitude of the order of a throw's torque, N m.
    pub torque: f64,
    /// Equilibrium amplitude of the largest station, rad.
    pub equilibrium: f64,
    /// Share of critical damping of the mode.
    pub damping_ratio: f64,
    /// Amplitude in resonance of the mode by itself, equilibrium / (2 zeta), rad; nothing where nothing damps it.
    pub resonance: Option<f64>,
}

/// The largest vibratory torque of a shaft length.
#[derive(Debug, Clone, PartialEq)]
#[doc(hidden)]
pub struct ShaftTorque {
    /// Name of the design.
    pub design: String,
    /// The condition; of misfires the largest of all cylinders.
    pub condition: Condition,
    /// The stations it joins.
    pub shaft: String,
    /// All orders together, half peak-to-peak, at the speeds of the study, N m.
    pub torque: f64,
    /// rpm.
    pub speed_rpm: f64,
}

/// All of it.
#[derive(Debug, Clone, PartialEq)]
#[doc(hidden)]
pub struct Classification {
    /// Of the first modes.
    pub holzer: Vec<HolzerRow>,
    /// Of the same modes with every order.
    pub sums: Vec<VectorSum>,
    /// By ascending speed.
    pub criticals: Vec<Critical>,
    /// Of every design and shaft.
    pub shafts: Vec<ShaftTorque>,
}

/// Criticals are looked for up to this share of the highest speed.
#[doc(hidden)]
pub const ABOVE: f64 = 1.2;

/// What follows from a run of the designs of a study.
#[doc(hidden)]
pub fn classification(study: &Study, results: &Results) -> Classification {
    let system = &results.system;
    let holzer = holzer(study);
    let modes = holzer.iter().map(|r| r.mode).max().unwrap_or(0);
    let sums: Vec<VectorSum> =
        study.modes.elastic().take(modes).enumerate().flat_map(|(i, mode)| vector_sums(study, system, (i + 1, mode))).collect();
    let highest = study.speeds_rpm.iter().copied().fold(0.0, f64::max);
    let met = sums.iter().filter(|s| s.sum > 0.0 && s.speed_rpm <= ABOVE * highest);
    let mut criticals: Vec<Critical> = met.map(|s| Critical { of: s.clone(), in_range: in_range(study, system, s) }).collect();
    criticals.sort_by(|a, b| a.of.speed_rpm.total_cmp(&b.of.speed_rpm));
    Classification { holzer, sums, criticals, shafts: shafts(study, results) }
}

fn vector_sums<'a>(study: &'a Study, system: &'a System, (number, mode): (usize, usize)) -> impl Iterator<Item = VectorSum> + 'a {
    let shape = study.modes.shapes.column(mode);
    let largest = shape.amax();
    let omega = study.modes.omega[mode];
    (0..system.orders()).map(move |n| {
        let sum = system.phases(n).iter().zip(shape.iter()).map(|(p, phi)| p * (phi / largest)).sum::<C64>().norm();
        let order = system.excitation.orders[n];
        VectorSum {
            mode: number,
            frequency_hz: omega * HZ_PER_RAD_PER_S,
            order,
            sum,
            speed_rpm: study.modes.critical_speed_rpm(mode, order),
            // shapes are scaled to phi' J phi = 1
            equilibrium: sum * largest * largest / (omega * omega),
        }
    })
}

fn in_range(study: &Study, system: &System, s: &VectorSum) -> Option<InRange> {
    let (low, high) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    if !(low..=high).contains(&s.speed_rpm) {
        return None;
    }
    let n = system.excitation.orders.iter().position(|o| *o == s.order)?;
    let torque = system.excitation.unit_torque(n, s.speed_rpm).norm();
    let damping_ratio = study.modes.damping_ratio(study.modes.elastic().nth(s.mode - 1)?);
    let equilibrium = s.equilibrium * torque;
    let resonance = Some(equilibrium / (2.0 * damping_ratio)).filter(|r| r.is_finite());
    Some(InRange { torque, equilibrium, damping_ratio, resonance })
}

fn shafts(study: &Study, results: &Results) -> Vec<ShaftTorque> {
    let mut list = Vec::new();
    for sweep in &results.sweeps {
        for q in sweep.quantities.iter().filter(|q| q.of == Swept::Torque) {
            let worst = study.speeds_rpm.iter().zip(&q.total).max_by(|a, b| a.1.total_cmp(b.1));
            list.extend(worst.map(|(speed_rpm, torque)| ShaftTorque {
                design: sweep.design.clone(),
                condition: q.condition,
                shaft: q.place.clone(),
                torque: *torque,
                speed_rpm: *speed_rpm,
            }));
        }
    }
    list
}
