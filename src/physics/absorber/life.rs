//! Life of what an absorber shears, by a power of its strain: N = N_ref (g_ref/g)^m cycles of amplitude g, damage adds up by Miner's rule.
//!
//! Of rubber whose cracks grow by dc/dn proportional to (tearing energy)^q the tearing energy goes with the square of the strain, and m = 2 q: q about 2 (natural rubber) to 4 (unfilled SBR)
//! \[Lake & Lindley 1964\]. No better than a factor of three; mean strain, heat and ageing are left out.

use crate::numerics::elementary::Elementary;

/// Cycles that a material bears.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrainLife {
    /// g_ref, amplitude of shear strain, zero to peak.
    pub strain: f64,
    /// N_ref.
    pub cycles: f64,
    /// m.
    pub exponent: f64,
}

impl StrainLife {
    /// Share of the life that one cycle of an amplitude takes.
    pub fn damage(&self, strain: f64) -> f64 {
        (strain / self.strain).power(self.exponent) / self.cycles
    }
}
