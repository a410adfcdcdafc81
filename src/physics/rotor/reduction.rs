//! A structure seen from a few of its unknowns: Guyan's reduction, and that of Craig and Bampton with modes.
//!
//! With interface unknowns b and the others i, x = T (x_b, q): T = [1 0; -K_ii⁻¹ K_ib Phi], Phi the lowest modes with the interface held, of unit modal mass. Every matrix X becomes T' X T. Without modes that is Guyan's
//! reduction \[Guyan 1965\]; with all of them nothing is lost \[Craig & Bampton 1968\].

use crate::numerics::eigen::of_full_mass;
use nalgebra::DMatrix;

/// A reduction.
#[derive(Debug, Clone)]
pub struct Reduction {
    /// T: a row an unknown, a column an interface unknown, then a mode.
    pub basis: DMatrix<f64>,
    /// Of the modes with the interface held, rad/s.
    pub omega: Vec<f64>,
}

impl Reduction {
    /// Onto interface unknowns, with so many modes; `None` where the rest has a motion of its own with the interface held, or no positive mass.
    pub fn new(stiffness: &DMatrix<f64>, mass: &DMatrix<f64>, interface: &[usize], modes: usize) -> Option<Self> {
        let n = stiffness.nrows();
        let rest: Vec<usize> = (0..n).filter(|i| !interface.contains(i)).collect();
        let part = |x: &DMatrix<f64>, rows: &[usize], columns: &[usize]| {
            DMatrix::from_fn(rows.len(), columns.len(), |i, j| x[(rows[i], columns[j])])
        };
        let mut basis = DMatrix::zeros(n, interface.len() + modes.min(rest.len()));
        interface.iter().enumerate().for_each(|(j, b)| basis[(*b, j)] = 1.0);
        if rest.is_empty() {
            return Some(Self { basis, omega: Vec::new() });
        }
        let inner = part(stiffness, &rest, &rest).cholesky()?;
        let statics = inner.solve(&part(stiffness, &rest, interface));
        for (i, row) in rest.iter().enumerate() {
            (0..interface.len()).for_each(|j| basis[(*row, j)] = -statics[(i, j)]);
        }
        if modes == 0 {
            return Some(Self { basis, omega: Vec::new() });
        }
        let (square, shapes) = of_full_mass(&part(stiffness, &rest, &rest), &part(mass, &rest, &rest))?;
        let omega: Vec<f64> = square.iter().take(modes).map(|s| s.max(0.0).sqrt()).collect();
        for k in 0..omega.len() {
            rest.iter().enumerate().for_each(|(i, row)| basis[(*row, interface.len() + k)] = shapes[(i, k)]);
        }
        Some(Self { basis, omega })
    }

    /// T' X T.
    pub fn of(&self, x: &DMatrix<f64>) -> DMatrix<f64> {
        self.basis.transpose() * x * &self.basis
    }
}
