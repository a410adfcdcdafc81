//! Criteria of mean stress: a cycle of stress against strengths.
//!
//! The safety factor n is what amplitude and mean may both be multiplied by; u = 1/n is the share of the strength that is used. With a = amplitude/fatigue
//! limit, m = mean/tensile strength and y = mean/yield strength \[Shigley 2004\] section 6-12:
//!
//! - Goodman: u = a + m, \[Villalva 2014\] eq. (7.31);
//! - Soderberg: u = a + y, the safest: no stress above yield;
//! - Gerber: n a + (n m)² = 1, nearest to tests of ductile steel;
//! - ASME-elliptic: u² = a² + y²;
//! - Langer: u = (amplitude + mean)/yield strength: yield in the first cycle, no fatigue.
//!
//! All hold for means from zero to the tensile (or yield) strength. A mean below zero does not help: it counts as none, which is on the safe side.

use crate::numerics::elementary::Elementary;

/// A cycle of (equivalent) stress, Pa.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Cycle {
    /// Half the range; not negative.
    pub amplitude: f64,
    /// Middle of the range.
    pub mean: f64,
}

/// Strengths of a material, Pa; positive, the fatigue limit not above the tensile strength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strength {
    /// Tensile strength.
    pub tensile: f64,
    /// Yield strength, not above the tensile strength; `None` where no criterion asks for it.
    pub yielding: Option<f64>,
    /// Fatigue limit in reversed bending.
    pub fatigue_limit: f64,
}

/// A line between endurance and failure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Criterion {
    /// A straight line from the fatigue limit to the tensile strength.
    Goodman,
    /// A straight line from the fatigue limit to the yield strength.
    Soderberg,
    /// A parabola from the fatigue limit to the tensile strength.
    Gerber,
    /// An ellipse from the fatigue limit to the yield strength.
    AsmeElliptic,
    /// Yield in the first cycle.
    Langer,
}

impl Criterion {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Goodman, Self::Soderberg, Self::Gerber, Self::AsmeElliptic, Self::Langer];

    /// The word used in studies and tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Goodman => "goodman",
            Self::Soderberg => "soderberg",
            Self::Gerber => "gerber",
            Self::AsmeElliptic => "asme_elliptic",
            Self::Langer => "langer",
        }
    }

    /// Whether the yield strength enters.
    #[doc(hidden)]
    pub fn needs_yield(self) -> bool {
        matches!(self, Self::Soderberg | Self::AsmeElliptic | Self::Langer)
    }

    /// Share of the strength that is used, with its derivatives by amplitude and mean, 1/Pa. A yield strength that is not known counts as the fatigue
    /// limit.
    #[inline]
    pub fn utilisation(self, cycle: Cycle, strength: Strength) -> (f64, f64, f64) {
        let (limit, tensile) = (strength.fatigue_limit, strength.tensile);
        let yielding = strength.yielding.unwrap_or(limit);
        let (a, mean) = (cycle.amplitude / limit, cycle.mean.max(0.0));
        let pulling = if cycle.mean > 0.0 { 1.0 } else { 0.0 };
        match self {
            Self::Goodman => (a + mean / tensile, 1.0 / limit, pulling / tensile),
            Self::Soderberg => (a + mean / yielding, 1.0 / limit, pulling / yielding),
            Self::Gerber => {
                let m = mean / tensile;
                let root = (a * a + 4.0 * m * m).sqrt();
                let u = 0.5 * (a + root);
                if root == 0.0 {
                    return (u, 1.0 / limit, pulling / tensile);
                }
                (u, u / (root * limit), 2.0 * m / (root * tensile))
            }
            Self::AsmeElliptic => {
                let y = mean / yielding;
                let u = a.hypotenuse(y);
                if u == 0.0 { (u, 1.0 / limit, pulling / yielding) } else { (u, a / (u * limit), y / (u * yielding)) }
            }
            Self::Langer => ((cycle.amplitude + mean) / yielding, 1.0 / yielding, pulling / yielding),
        }
    }

    /// Safety factor; infinite without stress.
    pub fn safety_factor(self, cycle: Cycle, strength: Strength) -> f64 {
        1.0 / self.utilisation(cycle, strength).0
    }
}

/// The fatigue limit at which Goodman's line gives a safety factor, Pa; nothing where the mean alone exceeds it.
pub fn goodman_limit(cycle: Cycle, tensile: f64, safety_factor: f64) -> Option<f64> {
    let left = 1.0 / safety_factor - cycle.mean.max(0.0) / tensile;
    (left > 0.0 && cycle.amplitude > 0.0).then(|| cycle.amplitude / left)
}
