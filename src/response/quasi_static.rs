//! Response without any resonance.

use super::quantity::Quantity;
use crate::drivetrain::System;

/// A quantity per unit torque at each station if every elastic mode followed as if static (no amplification): what is left of it when
/// nothing resonates. Zero for rings.
pub(crate) fn quasi_static(system: &System, quantity: Quantity) -> Vec<f64> {
    let modes = &system.modes;
    let at = |mode: usize, station: usize| modes.shapes[(station, mode)];
    let output = |mode: usize| match quantity {
        Quantity::ShaftTorque(s) => system.chain.stations[s].stiffness_to_next * system.chain.link(s).of(|i| at(mode, i)),
        other => other.difference(&system.chain).map_or(0.0, |twist| twist.of(|i| at(mode, i))),
    };
    let share = |station: usize, mode: usize| at(mode, station) * output(mode) / (modes.omega[mode] * modes.omega[mode]);
    (0..system.chain.len()).map(|station| modes.elastic().map(|mode| share(station, mode)).sum()).collect()
}
