//! A journal in a bearing that stiffens with its displacement.

use crate::numerics::elementary::Elementary;

/// A point of a bearing: with r = |z|/x_f the force on what stands still is k(r) z + c(r) z', k(r) = k_0 (k_f/k_0)^r and c(r) likewise, z across the axis \[Villalva 2014, (8.11) to (8.13)\]. The thesis does
/// not say whether by component or radially; it is taken radially here, so that a bearing is alike in all directions. Beyond x_f the law goes on as it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExponentialJoint {
    /// x_f, m.
    pub reach: f64,
    /// k_0 and k_f, N/m.
    pub stiffness: [f64; 2],
    /// c_0 and c_f, N s/m.
    pub damping: [f64; 2],
}

/// Force, N, and its derivatives by displacement and velocity: a row each for the first and the second component.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointForce {
    /// N.
    pub force: [f64; 2],
    /// N/m.
    pub by_displacement: [[f64; 2]; 2],
    /// N s/m, alike for both components.
    pub by_velocity: f64,
}

impl ExponentialJoint {
    /// k_f = p D L/(x_f N), k_0, c_f and c_0 in their ratios to it \[Villalva 2014, (8.14) and (8.15)\]: `pressure` p in Pa, `size` diameter and length of the journal in m, `reach` x_f, `points` N of a bearing;
    /// `loose`: k_0/k_f and c_0/c_f; `time`: c_f/k_f, s.
    pub fn of_journal(pressure: f64, size: [f64; 2], reach: f64, points: usize, (loose, time): ([f64; 2], f64)) -> Self {
        let firm = pressure * size[0] * size[1] / (reach * points as f64);
        Self { reach, stiffness: [loose[0] * firm, firm], damping: [loose[1] * time * firm, time * firm] }
    }

    /// The same with all stiffness and damping times factors.
    pub fn scaled(&self, stiffness: f64, damping: f64) -> Self {
        Self { stiffness: self.stiffness.map(|k| k * stiffness), damping: self.damping.map(|c| c * damping), ..*self }
    }

    /// At a displacement and a velocity, m and m/s, both in the same axes.
    pub fn at(&self, [x, y]: [f64; 2], [dx, dy]: [f64; 2]) -> JointForce {
        let size = x.hypotenuse(y);
        let (k, of_k) = self.part(self.stiffness, size);
        let (c, of_c) = self.part(self.damping, size);
        // slope of |z| in both directions; none in the middle, where the law is smooth but for |z| itself
        let towards = if size > 0.0 { [x / size, y / size] } else { [0.0; 2] };
        let rise = [x * of_k + dx * of_c, y * of_k + dy * of_c];
        JointForce {
            force: [k * x + c * dx, k * y + c * dy],
            by_displacement: [[k + rise[0] * towards[0], rise[0] * towards[1]], [rise[1] * towards[0], k + rise[1] * towards[1]]],
            by_velocity: c,
        }
    }

    /// A value at a displacement's size, and its derivative.
    fn part(&self, [loose, firm]: [f64; 2], size: f64) -> (f64, f64) {
        let rate = (firm / loose).logarithm() / self.reach;
        let value = loose * (rate * size).exponential();
        (value, value * rate)
    }
}
