//! What a response is of: a chain and the torque on its stations.

use super::{Chain, Modes};
use crate::engine::Excitation;
use crate::numerics::C64;

/// A chain and the torque on it.
#[derive(Debug, Clone)]
pub struct System {
    /// Stations and shafts.
    pub chain: Chain,
    /// Undamped modes of the chain.
    pub modes: Modes,
    /// Torque of each throw.
    pub excitation: Excitation,
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
    pub(crate) fn with_modes(chain: Chain, modes: Modes, excitation: Excitation) -> Self {
        let phases = (0..excitation.orders.len())
            .map(|n| chain.stations.iter().map(|s| s.throws.iter().map(|&t| excitation.phase(t, n)).sum()).collect())
            .collect();
        let loaded = (0..chain.len()).filter(|i| !chain.stations[*i].throws.is_empty()).collect();
        Self { chain, modes, excitation, phases, loaded }
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
        if let Some((throw, change)) = self.excitation.misfire_torque(order, speed_rpm)
            && let Some(station) = self.chain.stations.iter().position(|s| s.throws.contains(&throw))
        {
            out[station] += change;
        }
    }

    /// Torques at one speed.
    pub(crate) fn torques(&self, speed_rpm: f64) -> Torques<'_> {
        let units = self.excitation.unit_torques(speed_rpm);
        let misfire = (0..self.orders()).filter_map(|n| self.excitation.misfire_torque(n, speed_rpm)).collect::<Vec<_>>();
        let station = misfire.first().and_then(|m| self.chain.stations.iter().position(|s| s.throws.contains(&m.0)));
        Torques { system: self, units, misfire: station.map(|s| (s, misfire.into_iter().map(|m| m.1).collect())) }
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
    /// Station of a misfiring unit, and what it adds there, N m.
    misfire: Option<(usize, Vec<C64>)>,
}

impl Torques<'_> {
    /// Torque phasor of an order at every station that carries a throw, N m.
    pub fn each(&self, order: usize, mut put: impl FnMut(usize, C64)) {
        for &station in &self.system.loaded {
            let phase = self.system.phases[order][station];
            let missing = self.misfire.as_ref().filter(|m| m.0 == station).map_or(C64::ZERO, |m| m.1[order]);
            put(station, self.units[order] * phase + missing);
        }
    }
}
