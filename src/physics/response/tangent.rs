//! Functions of frequency by their tangent, with a bound of the rest in a disc of complex frequencies.

use crate::drivetrain::System;
use crate::numerics::{C64, ZERO};

/// A function of frequency: value + slope d + rest, d = omega - omega0, with |rest| <= bend R² for complex d up to a radius R. Where value and slope are those of the function, it is at most bend |d|² (Schwarz's lemma).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tangent {
    /// At omega0.
    pub value: C64,
    /// Per rad/s.
    pub slope: C64,
    /// Per (rad/s)².
    pub bend: f64,
}

impl Tangent {
    pub(super) fn new(value: C64, slope: C64, bend: f64) -> Self {
        Self { value, slope, bend }
    }

    /// The product, in discs of this radius.
    #[must_use]
    pub fn times(&self, other: &Self, radius: f64) -> Self {
        let (a, b, c, d) = (self.value.norm(), other.value.norm(), self.slope.norm(), other.slope.norm());
        let (u, v) = (self.bend, other.bend);
        let bend = c * d + a * v + b * u + radius * (c * v + d * u + radius * u * v);
        Self::new(self.value * other.value, self.slope * other.value + self.value * other.slope, bend)
    }

    /// The function whose values at real frequencies are the conjugates.
    #[must_use]
    pub fn conj(&self) -> Self {
        Self::new(self.value.conj(), self.slope.conj(), self.bend)
    }

    /// Imaginary part of its values at real frequencies.
    #[must_use]
    pub fn imaginary(&self) -> Self {
        Self::new(C64::from(self.value.im), C64::from(self.slope.im), self.bend)
    }

    /// How far it may be from its chord over a distance (rad/s), no end of which is farther than this share of the radius from the middle: Cauchy's bound of the second derivative of the rest, in discs that reach the rim.
    pub fn off_chord(&self, distance: f64, farthest: f64) -> f64 {
        let to_rim = 1.0 - farthest;
        0.25 * distance * distance * self.bend / (to_rim * to_rim)
    }
}

/// Torque on the stations as a function of frequency: parabolas between kinks.
#[derive(Debug, Clone)]
pub struct Parabola {
    /// rpm.
    speeds: [f64; 3],
    /// N m, an order after the other.
    torques: [Vec<Vec<C64>>; 3],
}

impl Parabola {
    /// Between two speeds (rpm) without a kink between them.
    pub fn between(system: &System, (low, high): (f64, f64)) -> Self {
        let speeds = [low, 0.5 * (low + high), high];
        let torque_at = |order: usize, speed: f64| {
            let mut torque = vec![ZERO; system.chain.len()];
            system.torque(order, speed, &mut torque);
            torque
        };
        Self { speeds, torques: speeds.map(|speed| (0..system.orders()).map(|n| torque_at(n, speed)).collect()) }
    }

    /// Whether an order acts at any of these speeds.
    pub fn acts(&self, order: usize) -> bool {
        self.torques.iter().any(|t| t[order].iter().any(|t| *t != ZERO))
    }

    /// Coefficients of 1, d and d² about a speed, d in rad/s of an order of this value.
    pub(super) fn about(&self, order: usize, speed_rpm: f64, omega_per_rpm: f64) -> [Vec<C64>; 3] {
        let [a, b, c] = self.speeds;
        if a == c {
            let none = vec![ZERO; self.torques[0][order].len()];
            return [self.torques[0][order].clone(), none.clone(), none];
        }
        let of_station = |i: usize| {
            let [ta, tb, tc] = [0, 1, 2].map(|k| self.torques[k][order][i]);
            // Newton's divided differences
            let (first, next) = ((tb - ta) / (b - a), (tc - tb) / (c - b));
            let second = (next - first) / (c - a);
            let at = speed_rpm - a;
            let value = ta + first * at + second * (at * (speed_rpm - b));
            let slope = first + second * (2.0 * speed_rpm - a - b);
            [value, slope / omega_per_rpm, second / (omega_per_rpm * omega_per_rpm)]
        };
        let all: Vec<[C64; 3]> = (0..self.torques[0][order].len()).map(of_station).collect();
        [0, 1, 2].map(|k| all.iter().map(|t| t[k]).collect())
    }
}
