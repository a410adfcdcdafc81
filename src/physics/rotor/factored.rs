//! The dynamic stiffness of a shaft, factored: in blocks along its nodes, or whole where a superelement joins any of them.

use crate::numerics::C64;
use crate::numerics::block_tridiagonal::{Columns, Factored as Blocks};
use crate::numerics::tridiagonal::Singular;
use nalgebra::{DMatrix, Dyn, LU};

/// Factors of the dynamic stiffness.
#[derive(Debug)]
pub(crate) enum Factored {
    /// Of a row of nodes.
    Blocks(Blocks),
    /// Of all unknowns that move.
    Whole(Vec<usize>, Box<LU<C64, Dyn, Dyn>>),
}

impl Factored {
    /// Of a matrix over the unknowns that move, by its entries.
    pub(super) fn whole(free: Vec<usize>, entry: impl Fn((usize, usize)) -> C64) -> Result<Self, Singular> {
        let matrix = DMatrix::from_fn(free.len(), free.len(), |i, j| entry((free[i], free[j])));
        let factors = matrix.lu();
        if !factors.is_invertible() {
            return Err(Singular { row: 0 });
        }
        Ok(Self::Whole(free, Box::new(factors)))
    }

    /// Solves in place for right sides of the nodes.
    ///
    /// # Errors
    /// [`Singular`] where the matrix is.
    pub(crate) fn solve(&self, x: &mut [Columns]) -> Result<(), Singular> {
        let (free, factors) = match self {
            Self::Blocks(blocks) => return blocks.solve(x),
            Self::Whole(free, factors) => (free, factors),
        };
        let columns = x.first().map_or(0, Columns::ncols);
        let mut all = DMatrix::from_fn(free.len(), columns, |i, j| x[free[i] / 6][(free[i] % 6, j)]);
        if !factors.solve_mut(&mut all) {
            return Err(Singular { row: 0 });
        }
        // what is held stays where it is
        x.iter_mut().for_each(|own| own.fill(C64::ZERO));
        for (i, unknown) in free.iter().enumerate() {
            (0..columns).for_each(|j| x[unknown / 6][(unknown % 6, j)] = all[(i, j)]);
        }
        Ok(())
    }
}
