//! What a response is of: a chain and the torque on its stations.

use super::{Chain, FlexibleCrank, Modes};
use crate::engine::Excitation;
use crate::numerics::C64;
use std::sync::Arc;

/// A chain and the torque on it.
#[derive(Debug, Clone)]
pub struct System {
    /// Stations and shafts.
    pub chain: Chain,
    /// Undamped modes of the chain.
    pub modes: Modes,
    /// Torque of each throw.
    pub excitation: Excitation,
    /// In the place of the chain's shafts; `None`: the chain.
    pub flexible: Option<Arc<FlexibleCrank>>,
    /// Sum of firing phases at each station: one row an order.
    phases: Vec<Vec<C64>>,
    /// Stations with throws.
    pub(crate) loaded: Vec<usize>,
}

impl System {
    /// Puts the throws on their stations.
    pub fn new(chain: Chain, excitation: Excitation) -> Self {
        let modes = Modes::new(&chain);
        Self::with_modes(chain, modes, excitation)
    }

    /// The same where the modes are known.
    #[doc(hidden)]
    pub fn with_modes(chain: Chain, modes: Modes, excitation: Excitation) -> Self {
        let phases = (0..excitation.orders.len())
            .map(|n| chain.stations.iter().map(|s| s.throws.iter().map(|&t| excitation.phase(t, n)).sum()).collect())
            .collect();
        let loaded = (0..chain.len()).filter(|i| !chain.stations[*i].throws.is_empty()).collect();
        Self { chain, modes, excitation, flexible: None, phases, loaded }
    }

    /// The same with a flexible crank, whose modes at rest `modes` are.
    #[doc(hidden)]
    pub fn on_flexible(self, crank: Arc<FlexibleCrank>, modes: Modes) -> Self {
        Self { flexible: Some(crank), modes, ..self }
    }

    /// Number of orders.
    pub fn orders(&self) -> usize {
        self.excitation.orders.len()
    }

    /// Torque phasor at every station, N m.
    pub fn torque(&self, order: usize, speed_rpm: f64, out: &mut [C64]) {
        let unit = self.excitation.unit_torque(order, speed_rpm);
        for (out, phase) in out.iter_mut().zip(&self.phases[order]) {
            *out = unit * phase;
        }
        for (throw, change) in self.excitation.changes(order, speed_rpm) {
            if let Some(station) = self.station_of(throw) {
                out[station] += change;
            }
        }
    }

    /// Torques at one speed.
    pub(crate) fn torques(&self, speed_rpm: f64) -> Torques<'_> {
        let units = self.excitation.unit_torques(speed_rpm);
        let mut changes: Vec<(usize, Vec<C64>)> = Vec::new();
        for order in 0..self.orders() {
            for (index, (throw, change)) in self.excitation.changes(order, speed_rpm).enumerate() {
                if order == 0 {
                    changes.push((self.station_of(throw).unwrap_or(usize::MAX), Vec::new()));
                }
                changes[index].1.push(change);
            }
        }
        Torques { system: self, units, changes }
    }

    fn station_of(&self, throw: usize) -> Option<usize> {
        self.chain.stations.iter().position(|s| s.throws.contains(&throw))
    }

    /// Firing phases summed at every station: the torque per unit torque, where every unit fires.
    pub fn phases(&self, order: usize) -> &[C64] {
        &self.phases[order]
    }
}

/// Torques of all orders at one speed.
pub(crate) struct Torques<'a> {
    system: &'a System,
    /// Of one firing unit, N m.
    units: Vec<C64>,
    /// Stations of units that differ, and what they add there, N m.
    changes: Vec<(usize, Vec<C64>)>,
}

impl Torques<'_> {
    /// Torque phasor of an order at every station that carries a throw, N m.
    pub fn each(&self, order: usize, mut put: impl FnMut(usize, C64)) {
        for &station in &self.system.loaded {
            let phase = self.system.phases[order][station];
            let change: C64 = self.changes.iter().filter(|c| c.0 == station).map(|c| c.1[order]).sum();
            put(station, self.units[order] * phase + change);
        }
    }
}
