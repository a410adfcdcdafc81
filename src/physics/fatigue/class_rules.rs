//! The classification societies' rule for crankshafts \[IACS UR M53\]: amplitudes of stress against a fatigue strength that already contains their mean.
//!
//! For solid forged and cast steel cranks with one throw between main bearings. Surface hardening is outside the rule's own formulas: a hardened fillet bears
//! more than they say.

use crate::numerics::elementary::Elementary;
use crate::units::{M_PER_MM, PA_PER_MPA};

/// How the crank is made: factor K of section 6.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Manufacture {
    /// Forged with continuous grain flow, or drop-forged.
    GrainFlow,
    /// Free-form forged.
    FreeForged,
    /// Cast, its fillets cold-rolled by an approved process.
    CastColdRolled,
}

/// The rule for one crank.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClassRule {
    /// How it is made.
    pub manufacture: Manufacture,
    /// Minimum tensile strength, Pa.
    pub tensile: f64,
    /// sigma_add of section 4: by misaligned bearings and bending vibration, Pa.
    pub additional_bending: f64,
}

/// sigma_add of trunk piston engines, Pa; crosshead engines have three times as much.
#[doc(hidden)]
pub const ADDITIONAL_BENDING: f64 = 10.0 * PA_PER_MPA;
/// Tensile strengths for which sigma_DW rises with strength as its formula was made to, Pa. Steels of the rule lie well inside.
#[doc(hidden)]
pub const STRENGTHS: (f64, f64) = (400.0 * PA_PER_MPA, 1700.0 * PA_PER_MPA);
/// Least acceptability factor, section 7.
pub(crate) const ACCEPTABLE: f64 = 1.15;
/// A fillet radius, or half the diameter of an oil bore, below this counts as it, m \[IACS UR M53\] section 6.
const LEAST_RADIUS: f64 = 2.0 * M_PER_MM;

impl ClassRule {
    /// Allowable alternating stress sigma_DW, Pa, section 6: K (0.42 s + 39.3)(0.264 + 1.073 D^-0.2 + (785 - s)/4900 + 196/s sqrt(1/R)) in N and mm.
    /// `diameter` of pin or journal; `radius` of the fillet, or half the diameter of an oil bore, m, both taken as no less than 2 mm.
    pub fn fatigue_strength(&self, diameter: f64, radius: f64, is_bore: bool) -> f64 {
        let k = match self.manufacture {
            // more than one is for fillets only
            Manufacture::GrainFlow if is_bore => 1.0,
            Manufacture::GrainFlow => 1.05,
            Manufacture::FreeForged => 1.0,
            Manufacture::CastColdRolled => 0.93,
        };
        let (s, d, r) = (self.tensile / PA_PER_MPA, diameter / M_PER_MM, radius.max(LEAST_RADIUS) / M_PER_MM);
        let shape = 0.264 + 1.073 * d.power(-0.2) + (785.0 - s) / 4900.0 + 196.0 / s * (1.0 / r).sqrt();
        k * (0.42 * s + 39.3) * shape * PA_PER_MPA
    }

    /// Equivalent alternating stress in a fillet, Pa, section 5: bending with sigma_add, and torsion.
    pub fn fillet_stress(&self, bending: f64, torsion: f64) -> f64 {
        ((bending + self.additional_bending).powi(2) + 3.0 * torsion * torsion).sqrt()
    }
}

/// Equivalent stress at the outlet of an oil bore, Pa, section 5: (s + 2 sqrt(s² + 9/4 t²))/3, the largest stress along its edge.
pub fn bore_stress(bending: f64, torsion: f64) -> f64 {
    (bending.abs() + 2.0 * (bending * bending + 2.25 * torsion * torsion).sqrt()) / 3.0
}
