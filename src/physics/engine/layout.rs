//! Arrangement of cylinders on throws, and their firing angles.

/// Which cylinder acts on which throw, and when each fires.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// Rods on each crankpin: 1 in line, 2 in a V (cylinders 2t - 1 and 2t on throw t).
    pub rods_per_throw: usize,
    /// Firing angle of each cylinder, degrees of crank rotation, in the order of the cylinder numbers.
    pub firing_deg: Vec<f64>,
    /// Angle between the banks of a V, degrees; 180 with one rod on each crankpin: opposed cylinders, odd ones in one bank.
    pub bank_angle_deg: Option<f64>,
    /// By how much the second pin of a throw trails the first, degrees; zero where both rods share one.
    pub split_pin_deg: f64,
}

impl Layout {
    /// Number of throws.
    pub fn throws(&self) -> usize {
        self.firing_deg.len() / self.rods_per_throw
    }

    /// Firing angles of the cylinders on throw `throw` (from 0), degrees.
    pub fn firing_on_throw(&self, throw: usize) -> &[f64] {
        &self.firing_deg[throw * self.rods_per_throw..(throw + 1) * self.rods_per_throw]
    }

    /// The first throw whose two firing angles cannot belong to its crankpin: they must differ by the bank angle (either way, the same
    /// for all throws) and the angle between split pins, up to whole revolutions.
    pub fn misplaced_throw(&self) -> Option<usize> {
        let bank = self.bank_angle_deg.filter(|_| self.rods_per_throw == 2)?;
        let off = |throw: usize, sign: f64| {
            let pair = self.firing_on_throw(throw);
            let rest = (pair[1] - pair[0] - self.split_pin_deg - sign * bank).rem_euclid(360.0);
            rest.min(360.0 - rest) > 1e-6
        };
        let first = |sign| (0..self.throws()).find(|&t| off(t, sign));
        first(1.0).and_then(|a| first(-1.0).map(|b| a.max(b)))
    }
}
