//! Torque given as harmonics.

use super::geometry::Geometry;
use super::order::Order;
use crate::numerics::C64;

/// Torque harmonics: of a whole throw, or of the gas on one cylinder.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HarmonicTable {
    /// Orders with their complex amplitudes, N m; phase zero is a maximum when the (first) cylinder of the throw fires. At the lowest speed where they
    /// vary.
    pub harmonics: Vec<(Order, C64)>,
    /// Where they vary, each speed, rpm, ascending, with the amplitudes of the same orders.
    pub over_speed: Vec<(f64, Vec<C64>)>,
    /// Masses of a cylinder where the table holds the torque of its gas only: their torque is added.
    pub masses: Option<Geometry>,
}

impl HarmonicTable {
    /// Speeds of the table, rpm; empty where it is the same at every speed.
    pub fn speeds_rpm(&self) -> Vec<f64> {
        self.over_speed.iter().map(|row| row.0).collect()
    }

    /// Amplitude of an order at each speed (once where it is the same at every speed), N m.
    pub(super) fn amplitudes(&self, order: Order) -> Vec<C64> {
        let Some(i) = self.harmonics.iter().position(|h| h.0 == order) else { return vec![C64::ZERO; self.over_speed.len().max(1)] };
        if self.over_speed.is_empty() { vec![self.harmonics[i].1] } else { self.over_speed.iter().map(|row| row.1[i]).collect() }
    }
}
