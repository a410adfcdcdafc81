//! Solution of dense systems by Gauss elimination with exchange of rows \[Golub & Van Loan 2013, algorithm 3.4.1\], a column at a time along the memory: the library's own takes many times as long for fifty
//! unknowns.

use hartog_kernel::kernel;
use nalgebra::{DMatrix, DVector};

/// Rows that are computed together: columns are filled up with zeros to a multiple of it, so that no loop has a rest.
const ROWS: usize = 8;

/// Rows of so many, filled up.
pub(crate) fn height(n: usize) -> usize {
    n.next_multiple_of(ROWS)
}

/// Factors of a square matrix, column by column.
#[derive(Debug, Clone)]
pub(crate) struct Lu {
    n: usize,
    /// Below the diagonal, which is one; zero elsewhere.
    lower: Vec<f64>,
    /// On the diagonal and above; zero elsewhere.
    upper: Vec<f64>,
    /// Row that each step took for its pivot.
    pivots: Vec<usize>,
}

impl Lu {
    /// Of a square matrix.
    pub fn new(matrix: &DMatrix<f64>) -> Self {
        Self::filled_up(matrix.clone().resize_vertically(height(matrix.nrows()), 0.0))
    }

    /// Of a square matrix whose columns are filled up with zeros to [`height`].
    pub(crate) fn filled_up(matrix: DMatrix<f64>) -> Self {
        let n = matrix.ncols();
        let mut lower = vec![0.0; n * height(n)];
        let mut upper: Vec<f64> = matrix.data.into();
        let pivots = factor(&mut upper, &mut lower, n);
        Self { n, lower, upper, pivots }
    }

    /// x of A x = b; nothing where the matrix is singular.
    pub fn solve(&self, b: &DVector<f64>) -> Option<DVector<f64>> {
        let n = self.n;
        let mut x = vec![0.0; height(n)];
        x[..n].copy_from_slice(b.as_slice());
        for (k, pivot) in self.pivots.iter().enumerate() {
            x.swap(k, *pivot);
        }
        substitute(&self.lower, &self.upper, n, &mut x).then(|| DVector::from_column_slice(&x[..n]))
    }

    /// X of A X = B, column by column; nothing where the matrix is singular.
    pub(crate) fn solve_all(&self, b: &DMatrix<f64>) -> Option<DMatrix<f64>> {
        let columns = b.column_iter().map(|column| self.solve(&column.into_owned())).collect::<Option<Vec<_>>>()?;
        Some(DMatrix::from_columns(&columns))
    }

    /// Whether the determinant is above zero, by the signs alone: the product of many may leave the range of numbers.
    pub(crate) fn is_positive(&self) -> bool {
        let height = height(self.n);
        let negative = (0..self.n).filter(|k| self.upper[k * height + k] < 0.0).count();
        let exchanged = self.pivots.iter().enumerate().filter(|(k, pivot)| *k != **pivot).count();
        (negative + exchanged).is_multiple_of(2)
    }
}

/// Takes a multiple of a column from another one.
#[inline(always)]
fn subtract(from: &mut [f64], factor: f64, column: &[f64]) {
    from.iter_mut().zip(column).for_each(|(x, y)| *x -= factor * y);
}

/// Exchanges rows for the largest element of column k below the diagonal, and divides what is there by it; the row that was taken.
#[inline(always)]
fn eliminate(upper: &mut [f64], lower: &mut [f64], (n, k): (usize, usize)) -> usize {
    let height = height(n);
    let own = &upper[k * height..][..n];
    let pivot = (k..n).fold(k, |p, i| if own[i].abs() > own[p].abs() { i } else { p });
    if pivot != k {
        for each in [&mut *upper, &mut *lower] {
            each.chunks_exact_mut(height).for_each(|column| column.swap(k, pivot));
        }
    }
    let (own, below) = (&mut upper[k * height..][..height], &mut lower[k * height..][..height]);
    if own[k] != 0.0 {
        let scale = 1.0 / own[k];
        for (below, own) in below[k + 1..].iter_mut().zip(&mut own[k + 1..]) {
            *below = *own * scale;
            *own = 0.0;
        }
    }
    pivot
}

/// Two columns at a time: what is below and to the right of them is then read and written half as often.
#[kernel]
fn factor(upper: &mut [f64], lower: &mut [f64], n: usize) -> Vec<usize> {
    let height = height(n);
    let (mut pivots, mut factors) = (Vec::with_capacity(n), vec![[0.0; 2]; n]);
    for k in (0..n).step_by(2) {
        pivots.push(eliminate(upper, lower, (n, k)));
        if k + 1 == n {
            break;
        }
        let next = &mut upper[(k + 1) * height..][..height];
        subtract(next, next[k], &lower[k * height..][..height]);
        pivots.push(eliminate(upper, lower, (n, k + 1)));
        let ([first, second], rest) =
            ([k, k + 1].map(|k| lower[k * height..][..height].as_chunks::<ROWS>().0), &mut upper[(k + 2) * height..]);
        let by_first = lower[k * height + k + 1];
        let factors = &mut factors[k + 2..];
        for (factors, column) in factors.iter_mut().zip(rest.chunks_exact(height)) {
            *factors = [column[k], column[k + 1] - column[k] * by_first];
        }
        // group of rows by group: those above the pivots' are zero in the columns
        for (group, (first, second)) in first.iter().zip(second).enumerate().skip((k + 1) / ROWS) {
            for (column, [a, b]) in rest.chunks_exact_mut(height).zip(&*factors) {
                let x = &mut column.as_chunks_mut::<ROWS>().0[group];
                *x = std::array::from_fn(|i| x[i] - a * first[i] - b * second[i]);
            }
        }
    }
    pivots
}

/// Both triangles; whether the matrix is regular.
#[kernel]
fn substitute(lower: &[f64], upper: &[f64], n: usize, x: &mut [f64]) -> bool {
    let height = height(n);
    for k in 0..n {
        let (known, first) = (x[k], (k + 1) / ROWS * ROWS);
        subtract(&mut x[first..], known, &lower[k * height..][first..height]);
    }
    for k in (0..n).rev() {
        let column = &upper[k * height..][..height];
        if column[k] == 0.0 {
            return false;
        }
        let known = x[k] / column[k];
        let last = (k + 1).next_multiple_of(ROWS);
        subtract(&mut x[..last], known, &column[..last]);
        x[k] = known;
    }
    true
}
