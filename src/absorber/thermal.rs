//! The temperature of an absorber: how its material follows it, and what cools it.

use super::cooling::Cooling;
use super::temperature::TemperatureLaw;

/// What decides the temperature of an absorber.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thermal {
    /// How the material follows it.
    pub law: TemperatureLaw,
    /// What cools it.
    pub cooling: Cooling,
}
