//! Complex systems whose graph is a tree: elimination from the leaves to the root fills nothing in.

use super::tridiagonal::Singular;
use super::{C64, ZERO};
use nalgebra::{DMatrix, DVector, Dyn, FullPivLU};

/// A pivot that is smaller than the terms it came from by this factor has lost as many digits: the whole system is then solved densely with full
/// pivoting.
const LARGEST_CANCELLATION: f64 = 1e4;

/// A complex matrix of order n whose row i is joined to row `parent[i]` > i, and after [`Tree::factor`] its factors.
#[derive(Debug, Clone)]
pub(crate) struct Tree {
    parent: Vec<usize>,
    /// Row i, column `parent[i]`.
    pub upper: Vec<C64>,
    /// Row `parent[i]`, column i.
    pub lower: Vec<C64>,
    /// The diagonal; factored, the inverse pivots.
    pub diagonal: Vec<C64>,
    dense: Option<FullPivLU<C64, Dyn, Dyn>>,
}

impl Tree {
    /// A zero matrix.
    pub(crate) fn zeros(parent: Vec<usize>) -> Self {
        let n = parent.len() + 1;
        Self { upper: vec![ZERO; n - 1], lower: vec![ZERO; n - 1], diagonal: vec![ZERO; n], parent, dense: None }
    }

    /// Multiplies a column.
    pub(crate) fn scale_column(&mut self, column: usize, by: C64) {
        self.diagonal[column] *= by;
        if column < self.parent.len() {
            self.lower[column] *= by;
        }
        for (upper, parent) in self.upper.iter_mut().zip(&self.parent) {
            if *parent == column {
                *upper *= by;
            }
        }
    }

    /// Replaces the matrix by its factors: row i is eliminated from its parent. Where that loses digits, dense with full pivoting.
    ///
    /// # Errors
    /// [`Singular`] where there is no unique solution.
    pub(crate) fn factor(&mut self) -> Result<(), Singular> {
        self.dense = None;
        let given = self.diagonal.clone();
        let mut terms: Vec<f64> = given.iter().map(|d| d.norm()).collect();
        for i in 0..self.diagonal.len() {
            let pivot = self.diagonal[i];
            // written so that an undefined pivot is dense, too
            let is_safe = pivot.norm() * LARGEST_CANCELLATION >= terms[i] && pivot.norm() > 0.0;
            if !is_safe {
                self.diagonal = given;
                return self.factor_densely(i);
            }
            let inverse = pivot.inv();
            self.diagonal[i] = inverse;
            if let Some(&parent) = self.parent.get(i) {
                let eliminated = self.lower[i] * inverse * self.upper[i];
                terms[parent] = terms[parent].max(eliminated.norm());
                self.diagonal[parent] -= eliminated;
            }
        }
        Ok(())
    }

    fn factor_densely(&mut self, row: usize) -> Result<(), Singular> {
        let n = self.diagonal.len();
        let mut matrix = DMatrix::from_diagonal(&DVector::from_column_slice(&self.diagonal));
        for (i, &parent) in self.parent.iter().enumerate() {
            matrix[(i, parent)] = self.upper[i];
            matrix[(parent, i)] = self.lower[i];
        }
        let factors = matrix.full_piv_lu();
        let last = factors.lu_internal()[(n - 1, n - 1)];
        let is_regular = factors.is_invertible() && last.is_finite();
        self.dense = Some(factors);
        if is_regular { Ok(()) } else { Err(Singular { row }) }
    }

    /// Solves for one right-hand side in place, after [`Self::factor`].
    pub(crate) fn solve(&self, x: &mut [C64]) {
        if let Some(dense) = &self.dense {
            match dense.solve(&DVector::from_column_slice(x)) {
                Some(found) => x.copy_from_slice(found.as_slice()),
                None => x.fill(C64::new(f64::NAN, f64::NAN)),
            }
            return;
        }
        for (i, &parent) in self.parent.iter().enumerate() {
            let carried = self.lower[i] * self.diagonal[i] * x[i];
            x[parent] -= carried;
        }
        let last = x.len() - 1;
        x[last] *= self.diagonal[last];
        for i in (0..last).rev() {
            x[i] = (x[i] - self.upper[i] * x[self.parent[i]]) * self.diagonal[i];
        }
    }
}
