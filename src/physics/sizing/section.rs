//! A round section in bending and torsion: static by the largest shear, for infinite life by Goodman's line.

use crate::numerics::elementary::Elementary;
use std::f64::consts::PI;

/// Mean and amplitude of a load over the cycle.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize)]
pub struct Swing {
    /// Half the sum of largest and smallest.
    pub mean: f64,
    /// Half their difference.
    pub amplitude: f64,
}

impl Swing {
    /// Of a history.
    pub fn of(history: impl IntoIterator<Item = f64>) -> Self {
        let (low, high) = history.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        Self { mean: 0.5 * (high + low), amplitude: 0.5 * (high - low) }
    }
}

/// Strengths at a section, Pa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strength {
    /// With all factors of the part.
    pub fatigue_limit: f64,
    /// Tensile strength.
    pub tensile: f64,
    /// In shear.
    pub shear_yield: f64,
}

/// Moments at a round section over the cycle, N m.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize)]
pub struct Moments {
    /// Bending in two planes at right angles. Their amplitudes are added as vectors, and their means, as if they were largest together.
    pub bending: [Swing; 2],
    /// Bending fixed in space while the section turns: all of it alternates.
    pub rotating: f64,
    /// Torsion.
    pub torsion: Swing,
    /// Largest sqrt(M² + T²) at one moment of the cycle.
    pub largest: f64,
}

/// Notch factors of fatigue in bending and torsion.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Notch {
    /// In bending.
    pub bending: f64,
    /// In torsion.
    pub torsion: f64,
}

impl Notch {
    /// No notch.
    pub const NONE: Self = Self { bending: 1.0, torsion: 1.0 };
}

impl Moments {
    /// Equivalent moments for amplitude and mean, N m: sqrt((K M)² + 3/4 (K_s T)²), by von Mises.
    pub(super) fn equivalent(&self, notch: Notch) -> [f64; 2] {
        let [a, b] = self.bending;
        let combine = |m: f64, t: f64| (notch.bending * m).hypotenuse(0.75f64.sqrt() * notch.torsion * t);
        let amplitude = a.amplitude.hypotenuse(b.amplitude) + self.rotating.abs();
        [combine(amplitude, self.torsion.amplitude), combine(a.mean.hypotenuse(b.mean), self.torsion.mean)]
    }

    /// Diameter for infinite life, m: d³ = 32 n/pi (M_a/S_e + M_m/S_ut) of the equivalent moments \[Norton 2013\] eq. (10.8).
    pub fn fatigue_diameter(&self, strength: &Strength, notch: Notch, factor: f64) -> f64 {
        let [amplitude, mean] = self.equivalent(notch);
        (32.0 * factor / PI * (amplitude / strength.fatigue_limit + mean / strength.tensile)).cube_root()
    }

    /// Diameter that does not yield, m: d³ = 16 n sqrt(M² + T²)/(pi S_sy), by the largest shear \[Bhandari 2010\] chapter 25.
    pub fn static_diameter(&self, strength: &Strength, factor: f64) -> f64 {
        (16.0 * factor * self.largest / (PI * strength.shear_yield)).cube_root()
    }

    /// Margins of a diameter: static, and for infinite life.
    pub fn margins(&self, strength: &Strength, notch: Notch, diameter: f64) -> [f64; 2] {
        let needed = [self.static_diameter(strength, 1.0), self.fatigue_diameter(strength, notch, 1.0)];
        needed.map(|d| (diameter / d).powi(3))
    }
}

/// The least diameter that is at least what `needed` asks of it. `needed` does not fall with the diameter (a larger section endures less), so steps from
/// a `first` below end at the least of them, wherever its size factor jumps; steps from above end at the largest below it.
pub fn least(needed: impl Fn(f64) -> f64, first: f64) -> f64 {
    const STEPS: usize = 200;
    const CLOSE: f64 = 1e-14;
    let mut d = needed(first);
    for _ in 0..STEPS {
        let next = needed(d);
        if next.is_nan() || (next - d).abs() <= CLOSE * d {
            return next;
        }
        d = next;
    }
    d
}
