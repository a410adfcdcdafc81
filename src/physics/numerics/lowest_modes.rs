//! The lowest eigenpairs of K phi = lambda M phi for symmetric matrices with a narrow band: block Lanczos iteration of the shifted inverse with full orthogonalisation \[Grimes, Lewis & Simon 1994\].

use super::banded::Banded;
use super::eigen::of_full_mass;
use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// Vectors of a block: a shaft has up to six rigid modes, all at zero.
const BLOCK: usize = 6;
/// The shift is this share of the largest quotient of the diagonals, below zero: K need not be definite.
const SHIFT: f64 = 1e-7;
/// Vectors before the first look, over those that are wanted; of no more than twice as many unknowns all pairs are computed at once.
const FIRST: usize = 3;
/// Blocks from one look to the next.
const EVERY: usize = 4;
/// Residual of a pair, over its eigenvalue of the inverse.
const SETTLED: f64 = 1e-11;
/// What is left of a vector that depends on others, over what it was.
const NOTHING: f64 = 1e-10;
/// Eigenvalues are counted up to this share above the last that is wanted.
const ABOVE: f64 = 1e-7;

/// The lowest eigenvalues, ascending, and the columns of their vectors, scaled to phi' M phi = 1. A count of the eigenvalues by the signs of a factored matrix tells that none is left out; where it
/// does not, all are computed. `None` where M is not positive definite.
pub(crate) fn lowest(k: &DMatrix<f64>, m: &DMatrix<f64>, count: usize) -> Option<(DVector<f64>, DMatrix<f64>)> {
    let all = || {
        let (values, shapes) = of_full_mass(k, m)?;
        let count = count.min(values.len());
        Some((values.rows(0, count).into_owned(), shapes.columns(0, count).into_owned()))
    };
    if k.nrows() <= 2 * FIRST * count {
        return all();
    }
    let (stiffness, mass) = (Banded::of(k), Banded::of(m));
    if mass.clone().factored().diagonal().any(|d| d <= 0.0) {
        return None;
    }
    by_iteration(&stiffness, &mass, count).or_else(all)
}

/// Vectors that are orthonormal in M, their products with M, and the inverse in their coordinates.
struct Krylov<'m> {
    mass: &'m Banded,
    vectors: Vec<Vec<f64>>,
    products: Vec<Vec<f64>>,
    /// Of each vector: the inverse of it by all vectors, as far as they are there.
    inverse: Vec<Vec<f64>>,
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl Krylov<'_> {
    /// Takes out of a vector what it has of the others, twice; returns how much that was of each.
    fn orthogonalise(&self, x: &mut [f64]) -> Vec<f64> {
        let mut parts = vec![0.0; self.vectors.len()];
        for _ in 0..2 {
            for ((v, mv), part) in self.vectors.iter().zip(&self.products).zip(&mut parts) {
                let own = dot(mv, x);
                *part += own;
                x.iter_mut().zip(v).for_each(|(x, v)| *x -= own * v);
            }
        }
        parts
    }

    /// Puts in what is left of a vector without the others, or of one that nothing has to do with; returns how much that was of each, of itself last.
    fn put(&mut self, mut x: Vec<f64>) -> Vec<f64> {
        let size = dot(&x, &self.mass.times(&x)).max(0.0).sqrt();
        let mut parts = self.orthogonalise(&mut x);
        let mut left = dot(&x, &self.mass.times(&x)).max(0.0).sqrt();
        parts.push(if left > NOTHING * size { left } else { 0.0 });
        if left <= NOTHING * size {
            x = any(x.len(), self.vectors.len());
            self.orthogonalise(&mut x);
            left = dot(&x, &self.mass.times(&x)).max(0.0).sqrt();
        }
        x.iter_mut().for_each(|x| *x /= left);
        self.products.push(self.mass.times(&x));
        self.vectors.push(x);
        parts
    }
}

/// A vector that no mode is likely to be orthogonal to.
fn any(n: usize, which: usize) -> Vec<f64> {
    (0..n).map(|i| (((i + 1) * (2 * which + 7) * 7919 + which * 104_729) % 1009) as f64 / 504.0 - 1.0).collect()
}

/// `None` where the iteration leaves something out.
fn by_iteration(k: &Banded, m: &Banded, count: usize) -> Option<(DVector<f64>, DMatrix<f64>)> {
    let n = k.len();
    let scale = k.diagonal().zip(m.diagonal()).map(|(k, m)| k / m).fold(0.0, f64::max);
    let shift = -SHIFT * scale;
    let factored = k.less(shift, m).factored();
    if factored.diagonal().any(|d| d <= 0.0) {
        return None;
    }
    let mut own = Krylov { mass: m, vectors: Vec::new(), products: Vec::new(), inverse: Vec::new() };
    (0..BLOCK).for_each(|i| _ = own.put(any(n, i)));
    loop {
        for _ in 0..BLOCK {
            let mut x = own.products[own.inverse.len()].clone();
            factored.solve(&mut x);
            let parts = own.put(x);
            own.inverse.push(parts);
        }
        let done = own.inverse.len();
        if 2 * done > n {
            return None;
        }
        if done < FIRST * count || !(done / BLOCK).is_multiple_of(EVERY) {
            continue;
        }
        let by = |i: usize, j: usize| own.inverse[i.max(j)][i.min(j)];
        let eigen = SymmetricEigen::new(DMatrix::from_fn(done, done, by));
        let mut order: Vec<usize> = (0..done).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
        order.truncate(count);
        // what the inverse makes of a pair beyond these vectors: of the last block alone
        let residual = |pair: usize| {
            let part = |row: usize| {
                (done - BLOCK..done).map(|j| own.inverse[j].get(row).unwrap_or(&0.0) * eigen.eigenvectors[(j, pair)]).sum::<f64>()
            };
            (done..done + BLOCK).map(|row| part(row) * part(row)).sum::<f64>().sqrt()
        };
        if order.iter().any(|pair| residual(*pair) > SETTLED * eigen.eigenvalues[*pair]) {
            continue;
        }
        let shape = |pair: &usize| -> Vec<f64> {
            let mut x = vec![0.0; n];
            for (v, part) in own.vectors.iter().zip(eigen.eigenvectors.column(*pair).iter()) {
                x.iter_mut().zip(v).for_each(|(x, v)| *x += part * v);
            }
            x
        };
        let mut pairs: Vec<(f64, Vec<f64>)> = order.iter().map(shape).map(|x| (dot(&x, &k.times(&x)) / dot(&x, &m.times(&x)), x)).collect();
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let last = pairs.last()?.0;
        let bound = last + ABOVE * last.abs().max(-shift);
        let below = k.less(bound, m).factored().diagonal().filter(|d| *d < 0.0).count();
        let found = eigen.eigenvalues.iter().filter(|inverse| **inverse > 1.0 / (bound - shift)).count();
        let shapes = DMatrix::from_fn(n, pairs.len(), |i, j| pairs[j].1[i]);
        return (below == found).then(|| (DVector::from_iterator(pairs.len(), pairs.iter().map(|p| p.0)), shapes));
    }
}
