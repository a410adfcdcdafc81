//! Linear systems of which only the product with a vector is known.

use super::elementary::Elementary;
use nalgebra::{DMatrix, DVector};

/// Solves A x = b by the generalised minimum residual method \[Saad & Schultz 1986\], from zero, until the residual is `share` of b or `most` products were made; x and how many.
pub(crate) fn gmres(product: impl Fn(&DVector<f64>) -> DVector<f64>, b: &DVector<f64>, share: f64, most: usize) -> (DVector<f64>, usize) {
    let size = b.norm();
    if size == 0.0 || !size.is_finite() {
        return (DVector::zeros(b.len()), 0);
    }
    let mut basis = vec![b / size];
    // columns of the Hessenberg matrix, made triangular by rotations as they come
    let mut columns: Vec<Vec<f64>> = Vec::new();
    let mut rotations: Vec<(f64, f64)> = Vec::new();
    let mut right = vec![size];
    for k in 0..most {
        let mut next = product(&basis[k]);
        let mut column: Vec<f64> = Vec::with_capacity(k + 2);
        for v in &basis {
            let part = v.dot(&next);
            next.axpy(-part, v, 1.0);
            column.push(part);
        }
        let rest = next.norm();
        for (i, (c, s)) in rotations.iter().enumerate() {
            (column[i], column[i + 1]) = (c * column[i] + s * column[i + 1], c * column[i + 1] - s * column[i]);
        }
        let length = column[k].hypotenuse(rest);
        if length == 0.0 {
            break;
        }
        let (c, s) = (column[k] / length, rest / length);
        column[k] = length;
        rotations.push((c, s));
        right.push(-s * right[k]);
        right[k] *= c;
        columns.push(column);
        if right[k + 1].abs() <= share * size || rest == 0.0 {
            break;
        }
        basis.push(next / rest);
    }
    let n = columns.len();
    let triangle = DMatrix::from_fn(n, n, |i, j| if i <= j { columns[j][i] } else { 0.0 });
    let y = triangle.solve_upper_triangular(&DVector::from_column_slice(&right[..n])).unwrap_or_else(|| DVector::zeros(n));
    let mut x = DVector::zeros(b.len());
    y.iter().zip(&basis).for_each(|(part, v)| x.axpy(*part, v, 1.0));
    (x, n)
}
