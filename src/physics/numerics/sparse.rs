//! Systems whose graph is a row or a tree.

use super::C64;
use super::tree::Tree;
use super::tridiagonal::{Singular, Tridiagonal};

/// A complex matrix whose off-diagonal elements join each row but the last to one after it; after [`Sparse::factor`], its factors.
#[derive(Debug, Clone)]
pub(crate) enum Sparse {
    /// To the following one.
    Row(Tridiagonal),
    /// To any later one.
    Tree(Tree),
}

impl Sparse {
    /// A zero matrix of order `n` whose rows follow each other.
    pub(crate) fn row(n: usize) -> Self {
        Self::Row(Tridiagonal::zeros(n))
    }

    /// A zero matrix whose row i is joined to row `parent[i]`, for each row but the last.
    pub(crate) fn tree(parent: Vec<usize>) -> Self {
        Self::Tree(Tree::zeros(parent))
    }

    /// The diagonal.
    pub(crate) fn diagonal(&mut self) -> &mut [C64] {
        match self {
            Self::Row(m) => &mut m.diagonal,
            Self::Tree(m) => &mut m.diagonal,
        }
    }

    /// Both elements between row i and the one it is joined to.
    pub(crate) fn set_link(&mut self, i: usize, value: C64) {
        match self {
            Self::Row(m) => (m.upper[i], m.lower[i]) = (value, value),
            Self::Tree(m) => (m.upper[i], m.lower[i]) = (value, value),
        }
    }

    /// Multiplies a column.
    pub(crate) fn scale_column(&mut self, column: usize, by: C64) {
        match self {
            Self::Row(m) => {
                m.diagonal[column] *= by;
                if column > 0 {
                    m.upper[column - 1] *= by;
                }
                if column + 1 < m.order() {
                    m.lower[column] *= by;
                }
            }
            Self::Tree(m) => m.scale_column(column, by),
        }
    }

    /// Replaces the matrix by its factors.
    ///
    /// # Errors
    /// [`Singular`] where there is no unique solution.
    pub(crate) fn factor(&mut self) -> Result<(), Singular> {
        match self {
            Self::Row(m) => m.factor(),
            Self::Tree(m) => m.factor(),
        }
    }

    /// Solves for one right-hand side in place, after [`Self::factor`].
    pub(crate) fn solve(&self, x: &mut [C64]) {
        match self {
            Self::Row(m) => m.solve(x),
            Self::Tree(m) => m.solve(x),
        }
    }
}
