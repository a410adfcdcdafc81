//! Products of matrices, column by column: the library's own goes one element at a time without its platform's kernels, which round differently from machine to machine.

use hartog_kernel::kernel;
use nalgebra::DMatrix;

/// Rows that are summed together.
pub(crate) const ROWS: usize = 8;

/// `out` = `a` `b`, all square and of one size, a multiple of [`ROWS`].
pub(crate) fn multiply(a: &DMatrix<f64>, b: &DMatrix<f64>, out: &mut DMatrix<f64>) {
    columns(a.as_slice(), b.as_slice(), out.as_mut_slice(), a.nrows());
}

/// `a` `b` in a matrix of its own.
pub(crate) fn product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let mut out = DMatrix::zeros(a.nrows(), a.nrows());
    multiply(a, b, &mut out);
    out
}

#[kernel]
fn columns(a: &[f64], b: &[f64], out: &mut [f64], n: usize) {
    let (a, groups) = (a.as_chunks::<ROWS>().0, n / ROWS);
    for (b, out) in b.chunks_exact(n).zip(out.chunks_exact_mut(n)) {
        for (g, out) in out.as_chunks_mut::<ROWS>().0.iter_mut().enumerate() {
            let mut sum = [0.0; ROWS];
            for (factor, a) in b.iter().zip(a[g..].iter().step_by(groups)) {
                sum = std::array::from_fn(|i| sum[i] + factor * a[i]);
            }
            *out = sum;
        }
    }
}

/// Adds `a` `b` to `out`.
pub(crate) fn add_product(a: &DMatrix<f64>, b: &DMatrix<f64>, out: &mut DMatrix<f64>) {
    if a.nrows() > 0 {
        add_columns((a.as_slice(), a.nrows()), (b.as_slice(), b.nrows()), out.as_mut_slice());
    }
}

#[kernel]
fn add_columns((a, rows): (&[f64], usize), (b, inner): (&[f64], usize), out: &mut [f64]) {
    for (c, out) in out.chunks_exact_mut(rows).enumerate() {
        let factors = &b[c * inner..(c + 1) * inner];
        let (blocks, rest) = out.as_chunks_mut::<ROWS>();
        let first_of_rest = blocks.len() * ROWS;
        for (g, out) in blocks.iter_mut().enumerate() {
            let mut sum = *out;
            for (k, factor) in factors.iter().enumerate() {
                if let Some(a) = a[k * rows + g * ROWS..].first_chunk::<ROWS>() {
                    sum = std::array::from_fn(|i| sum[i] + factor * a[i]);
                }
            }
            *out = sum;
        }
        for (i, out) in rest.iter_mut().enumerate() {
            *out = factors.iter().enumerate().fold(*out, |sum, (k, factor)| sum + factor * a[k * rows + first_of_rest + i]);
        }
    }
}
