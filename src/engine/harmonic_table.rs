//! Torque given as harmonics.

use super::order::Order;
use crate::numerics::C64;

/// Torque harmonics of a whole throw, at every speed the same.
#[derive(Debug, Clone, PartialEq)]
pub struct HarmonicTable {
    /// Orders with their complex amplitudes, N m; phase zero is a maximum when the throw's first cylinder fires.
    pub harmonics: Vec<(Order, C64)>,
}
