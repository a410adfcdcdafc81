//! Complex tridiagonal systems.

use super::{C64, ZERO};

/// The system has no unique solution: elimination met a column of zeros.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("singular system at row {row}")]
pub struct Singular {
    /// Row where elimination broke down.
    pub row: usize,
}

/// A complex tridiagonal matrix of order n and, after [`Tridiagonal::factor`], its LU factors with row exchanges (fill-in: one more
/// upper diagonal). The buffers are kept for reuse.
#[derive(Debug, Clone, Default)]
pub struct Tridiagonal {
    /// Below the diagonal, `lower[i]` in row i + 1 (n - 1 values).
    pub lower: Vec<C64>,
    /// The diagonal (n values).
    pub diagonal: Vec<C64>,
    /// Above the diagonal, `upper[i]` in row i (n - 1 values).
    pub upper: Vec<C64>,
    second: Vec<C64>,
    exchanged: Vec<bool>,
}

/// |Re| + |Im|: as good as the modulus for choosing a pivot, without a root.
fn size(z: C64) -> f64 {
    z.re.abs() + z.im.abs()
}

impl Tridiagonal {
    /// A zero matrix of order `n`.
    pub fn zeros(n: usize) -> Self {
        let off = n.saturating_sub(1);
        Self {
            lower: vec![ZERO; off],
            diagonal: vec![ZERO; n],
            upper: vec![ZERO; off],
            second: vec![ZERO; off],
            exchanged: vec![false; off],
        }
    }

    /// Order of the matrix.
    pub fn order(&self) -> usize {
        self.diagonal.len()
    }

    /// Replaces the matrix by its factors: Gaussian elimination with partial pivoting \[Golub & Van Loan 2013\] section 3.4, restricted
    /// to the band.
    ///
    /// # Errors
    /// [`Singular`] where a pivot is zero or not finite.
    pub fn factor(&mut self) -> Result<(), Singular> {
        let n = self.order();
        for i in 0..n - 1 {
            self.second[i] = ZERO;
            self.exchanged[i] = size(self.lower[i]) > size(self.diagonal[i]);
            if self.exchanged[i] {
                std::mem::swap(&mut self.diagonal[i], &mut self.lower[i]);
                std::mem::swap(&mut self.upper[i], &mut self.diagonal[i + 1]);
                if i + 2 < n {
                    self.second[i] = self.upper[i + 1];
                    self.upper[i + 1] = ZERO;
                }
            }
            // kept inverted, so that every right-hand side costs products only
            self.diagonal[i] = Self::invert(self.diagonal[i], i)?;
            let factor = self.lower[i] * self.diagonal[i];
            self.lower[i] = factor;
            self.diagonal[i + 1] -= factor * self.upper[i];
            if i + 2 < n {
                self.upper[i + 1] -= factor * self.second[i];
            }
        }
        self.diagonal[n - 1] = Self::invert(self.diagonal[n - 1], n - 1)?;
        Ok(())
    }

    fn invert(pivot: C64, row: usize) -> Result<C64, Singular> {
        let inverse = pivot.inv();
        if inverse.is_finite() { Ok(inverse) } else { Err(Singular { row }) }
    }

    /// Solves for one right-hand side in place, after [`Self::factor`].
    pub fn solve(&self, x: &mut [C64]) {
        let n = self.order();
        for i in 0..n - 1 {
            if self.exchanged[i] {
                x.swap(i, i + 1);
            }
            let xi = x[i];
            x[i + 1] -= self.lower[i] * xi;
        }
        for i in (0..n).rev() {
            let mut sum = x[i];
            if i + 1 < n {
                sum -= self.upper[i] * x[i + 1];
            }
            if i + 2 < n {
                sum -= self.second[i] * x[i + 2];
            }
            x[i] = sum * self.diagonal[i];
        }
    }
}
