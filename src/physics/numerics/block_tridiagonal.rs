//! Block tridiagonal systems of blocks of six.

use super::C64;
use super::tridiagonal::Singular;
use nalgebra::{Const, Dyn, LU, OMatrix, SMatrix};

/// A block.
pub(crate) type Block = SMatrix<C64, 6, 6>;
/// Right sides at one node, a column each.
pub(crate) type Columns = OMatrix<C64, Const<6>, Dyn>;

/// A matrix of n diagonal blocks, factored: L U with exchange of rows within blocks.
#[derive(Debug)]
pub(crate) struct Factored {
    /// Of the diagonal blocks that elimination leaves.
    pivots: Vec<LU<C64, Const<6>, Const<6>>>,
    /// Inverses of these times the blocks to their right.
    after: Vec<Block>,
    lower: Vec<Block>,
}

/// Factors a matrix of diagonal blocks, of those to their right and of those below them (one fewer of each).
///
/// # Errors
/// [`Singular`] where a diagonal block that elimination leaves is.
pub(crate) fn factor(diagonal: Vec<Block>, upper: &[Block], lower: Vec<Block>) -> Result<Factored, Singular> {
    let mut found = Factored { pivots: Vec::with_capacity(diagonal.len()), after: Vec::with_capacity(upper.len()), lower };
    for (i, mut block) in diagonal.into_iter().enumerate() {
        if i > 0 {
            block -= found.lower[i - 1] * found.after[i - 1];
        }
        let pivot = block.lu();
        if let Some(right) = upper.get(i) {
            found.after.push(pivot.solve(right).ok_or(Singular { row: 6 * i })?);
        } else if !pivot.is_invertible() {
            return Err(Singular { row: 6 * i });
        }
        found.pivots.push(pivot);
    }
    Ok(found)
}

impl Factored {
    /// Solves in place for right sides of the nodes.
    ///
    /// # Errors
    /// [`Singular`] where the matrix is.
    pub(crate) fn solve(&self, x: &mut [Columns]) -> Result<(), Singular> {
        for i in 0..x.len() {
            if i > 0 {
                let (before, own) = x.split_at_mut(i);
                own[0] -= self.lower[i - 1] * &before[i - 1];
            }
            if !self.pivots[i].solve_mut(&mut x[i]) {
                return Err(Singular { row: 6 * i });
            }
        }
        for i in (0..x.len() - 1).rev() {
            let (own, after) = x.split_at_mut(i + 1);
            own[i] -= self.after[i] * &after[0];
        }
        Ok(())
    }
}
