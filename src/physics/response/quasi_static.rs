//! Response without any resonance.

use super::quantity::Quantity;
use crate::drivetrain::System;
use crate::numerics::C64;

/// A quantity of a mode of unit amplitude; zero of a ring.
fn of_mode(system: &System, quantity: Quantity, mode: usize) -> f64 {
    let (chain, at) = (&system.chain, |station: usize| system.modes.shapes[(station, mode)]);
    match quantity {
        Quantity::ShaftTorque(s) => chain.stations[s].stiffness_to_next * chain.link(s).of(at),
        other => other.difference(chain).map_or(0.0, |twist| twist.of(at)),
    }
}

/// A quantity per unit torque at each station if every elastic mode followed as if static (no amplification): what is left of it when
/// nothing resonates. Zero for rings.
#[doc(hidden)]
pub fn quasi_static(system: &System, quantity: Quantity) -> Vec<f64> {
    let modes = &system.modes;
    let share = |station: usize, mode: usize| {
        modes.shapes[(station, mode)] * of_mode(system, quantity, mode) / (modes.omega[mode] * modes.omega[mode])
    };
    (0..system.chain.len()).map(|station| modes.elastic().map(|mode| share(station, mode)).sum()).collect()
}

/// Modes as a quantity sees them, for what is left where none is amplified.
#[derive(Debug, Clone)]
#[doc(hidden)]
pub struct Unamplified {
    /// Square of the circular frequency, what the quantity is of the mode, and the mode at each station that bears torque.
    modes: Vec<(f64, f64, Vec<f64>)>,
    stations: Vec<usize>,
}

impl Unamplified {
    /// Of a quantity of stations and shafts; nothing of a ring.
    pub fn new(system: &System, quantity: Quantity) -> Self {
        let (modes, chain) = (&system.modes, &system.chain);
        let stations: Vec<usize> = (0..chain.len()).filter(|i| !chain.stations[*i].throws.is_empty()).collect();
        let mode =
            |m: usize| (modes.omega[m].powi(2), of_mode(system, quantity, m), stations.iter().map(|s| modes.shapes[(*s, m)]).collect());
        Self { modes: (0..modes.omega.len()).map(mode).collect(), stations }
    }

    /// The quantity if no mode were amplified: each follows the torque as if static below its own frequency, and as if only its inertia held it above, the asymptotes of
    /// 1/(omega_m² - omega²).
    pub fn phasor(&self, torque: &[C64], omega: f64) -> C64 {
        let asymptote = |omega2: f64| if omega * omega <= omega2 { 1.0 / omega2 } else { -1.0 / (omega * omega) };
        let force = |shape: &[f64]| self.stations.iter().zip(shape).map(|(s, x)| torque[*s] * *x).sum::<C64>();
        self.modes.iter().map(|(omega2, output, shape)| force(shape) * (output * asymptote(*omega2))).sum()
    }
}
