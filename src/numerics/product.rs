//! Products of square matrices, column by column: the library's own goes one element at a time without its platform's kernels, which round differently from machine to machine.

use nalgebra::DMatrix;

/// `out` = `a` `b`, all square and of one size.
pub(crate) fn multiply(a: &DMatrix<f64>, b: &DMatrix<f64>, out: &mut DMatrix<f64>) {
    columns(a.as_slice(), b.as_slice(), out.as_mut_slice(), a.nrows());
}

#[cfg_attr(not(feature = "baseline"), multiversion::multiversion(targets("x86_64+avx512f", "x86_64+avx2", "x86_64+avx", "aarch64+neon")))]
fn columns(a: &[f64], b: &[f64], out: &mut [f64], n: usize) {
    for (b, out) in b.chunks_exact(n).zip(out.chunks_exact_mut(n)) {
        out.fill(0.0);
        for (factor, a) in b.iter().zip(a.chunks_exact(n)) {
            out.iter_mut().zip(a).for_each(|(out, a)| *out += factor * a);
        }
    }
}
