//! Criteria of mean stress: a cycle of stress against strengths.
//!
//! The safety factor n is what amplitude and mean may both be multiplied by. With a = amplitude/fatigue limit and m = mean/tensile strength:
//!
//! - Goodman: n (a + m) = 1, \[Villalva 2014\] eq. (7.31);
//! - Gerber: n a + (n m)² = 1.
//!
//! A mean below zero does not help: it counts as none, which is on the safe side.

/// A cycle of (equivalent) stress, Pa.
#[derive(Debug, Clone, Copy, PartialEq)]
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
    /// Fatigue limit in reversed bending.
    pub fatigue_limit: f64,
}

/// A line between endurance and failure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Criterion {
    /// A straight line from the fatigue limit to the tensile strength.
    Goodman,
    /// A parabola between them: nearer to tests of ductile steel, less safe.
    Gerber,
}

impl Criterion {
    /// Safety factor; infinite without stress.
    pub fn safety_factor(self, cycle: Cycle, strength: Strength) -> f64 {
        let a = cycle.amplitude / strength.fatigue_limit;
        let m = cycle.mean.max(0.0) / strength.tensile;
        match self {
            Self::Goodman => 1.0 / (a + m),
            // the positive root, written without cancellation
            Self::Gerber => 2.0 / (a + (a * a + 4.0 * m * m).sqrt()),
        }
    }
}

/// The fatigue limit at which Goodman's line gives a safety factor, Pa; nothing where the mean alone exceeds it.
pub fn goodman_limit(cycle: Cycle, tensile: f64, safety_factor: f64) -> Option<f64> {
    let left = 1.0 / safety_factor - cycle.mean.max(0.0) / tensile;
    (left > 0.0 && cycle.amplitude > 0.0).then(|| cycle.amplitude / left)
}
