//! Linear equations of motion in time: chain and other absorbers, then the twist of the one absorber.

use crate::absorber::{Mounted, Reaction};
use crate::drivetrain::System;
use crate::response::bodies::Bodies;
use nalgebra::DMatrix;

/// Matrices of chain and other absorbers.
pub(super) struct InTime {
    inertia: Vec<f64>,
    stiffness: DMatrix<f64>,
    damping: DMatrix<f64>,
    /// Station of the absorber.
    pub hub: usize,
    /// Whether nothing holds the chain to the ground.
    pub free: bool,
}

/// Rows of the state's matrix for the accelerations of hub and twist, by all angles, then all rates.
pub(super) type Rows = [Vec<f64>; 2];

impl InTime {
    /// Nothing where the chain or another absorber has a law that is known by frequency only.
    pub fn new(system: &System, others: &[Mounted], hub: usize) -> Option<Self> {
        let bodies = Bodies::new(system, others);
        if !bodies.laws.is_empty() || bodies.hysteresis.iter().any(|h| *h != 0.0) {
            return None;
        }
        let free = bodies.stiffness.column_sum().amax() <= 1e-12 * bodies.stiffness.amax();
        Some(Self { inertia: bodies.inertia, stiffness: bodies.stiffness, damping: bodies.damping, hub, free })
    }

    /// Angles, the twist among them.
    pub fn angles(&self) -> usize {
        self.inertia.len() + 1
    }

    /// The accelerations of hub and twist under reactions (own equation, torque) that change by their slopes.
    pub fn rows(&self, (own, torque): (&[f64; 5], &[f64; 5])) -> Rows {
        let (n, m, h) = (self.inertia.len(), self.angles(), self.hub);
        let mut rows = [vec![0.0; 2 * m], vec![0.0; 2 * m]];
        // hub: J h'' + T2 q'' + T4 h'' = -K - C - T0 q - T1 q' - T3 h'; own: r2 q'' + r4 h'' = -r0 q - r1 q' - r3 h'
        for j in 0..n {
            rows[0][j] -= self.stiffness[(h, j)];
            rows[0][m + j] -= self.damping[(h, j)];
        }
        for (row, by) in rows.iter_mut().zip([torque, own]) {
            row[n] -= by[0];
            row[2 * n + 1] -= by[1];
            row[m + h] -= by[3];
        }
        let (a, b, c, d) = (self.inertia[h] + torque[4], torque[2], own[4], own[2]);
        let determinant = a * d - b * c;
        let [hub, twist] = &mut rows;
        for (x, y) in hub.iter_mut().zip(twist) {
            (*x, *y) = ((d * *x - b * *y) / determinant, (a * *y - c * *x) / determinant);
        }
        rows
    }

    /// The matrix of the whole state: angles and twist, then their rates.
    pub fn whole(&self, rows: &Rows) -> DMatrix<f64> {
        let (n, m) = (self.inertia.len(), self.angles());
        let mut whole = DMatrix::zeros(2 * m, 2 * m);
        (0..m).for_each(|i| whole[(i, m + i)] = 1.0);
        for i in (0..n).filter(|i| *i != self.hub) {
            for j in 0..n {
                whole[(m + i, j)] = -self.stiffness[(i, j)] / self.inertia[i];
                whole[(m + i, m + j)] = -self.damping[(i, j)] / self.inertia[i];
            }
        }
        for (row, values) in [m + self.hub, m + n].into_iter().zip(rows) {
            values.iter().enumerate().for_each(|(j, v)| whole[(row, j)] = *v);
        }
        whole
    }
}

/// Mean slopes of reactions over a cycle.
pub(super) fn mean_slopes(reactions: &[(Reaction, Reaction)]) -> ([f64; 5], [f64; 5]) {
    let share = 1.0 / reactions.len() as f64;
    let mean = |of: &dyn Fn(&(Reaction, Reaction)) -> [f64; 5]| {
        // from the first on, so that the mean of a constant is that constant
        let first = reactions.first().map_or([0.0; 5], of);
        let mut sum = first;
        for r in reactions {
            sum.iter_mut().zip(of(r)).zip(first).for_each(|((s, x), first)| *s += (x - first) * share);
        }
        sum
    };
    (mean(&|r| r.0.by), mean(&|r| r.1.by))
}
