//! Eigenpairs of undamped and damped systems with a diagonal mass matrix.

use super::C64;
use super::roots::between;
use nalgebra::{DMatrix, DVector, Schur, SymmetricEigen};
use std::convert::Infallible;

/// Rounds of inverse iteration, the relative change at which it ends, and how far it may lead.
const MOST_ITERATIONS: usize = 20;
const SETTLED: f64 = 1e-12;
const STRAYED: f64 = 0.05;

/// Eigenpairs of K phi = lambda M phi for symmetric K and diagonal M, ascending, one for each mass that is not zero; the columns of the second value
/// are scaled to phi' M phi = 1. Solved as the symmetric problem M^-1/2 K M^-1/2. Coordinates without mass follow the others statically, or stay
/// where nothing holds them.
pub(crate) fn generalised(k: &DMatrix<f64>, m: &[f64]) -> (Vec<f64>, DMatrix<f64>) {
    if !m.contains(&0.0) {
        return massive(k, m);
    }
    let (heavy, light): (Vec<usize>, Vec<usize>) = (0..m.len()).partition(|i| m[*i] > 0.0);
    let part = |rows: &[usize], columns: &[usize]| DMatrix::from_fn(rows.len(), columns.len(), |i, j| k[(rows[i], columns[j])]);
    let (coupled, own) = (part(&light, &heavy), part(&light, &light));
    let follow = own.lu().solve(&-&coupled).unwrap_or_else(|| DMatrix::zeros(light.len(), heavy.len()));
    let condensed = part(&heavy, &heavy) + coupled.transpose() * &follow;
    let masses: Vec<f64> = heavy.iter().map(|i| m[*i]).collect();
    let (lambda, shapes) = massive(&condensed, &masses);
    let following = follow * &shapes;
    let row = |i: usize| heavy.iter().position(|h| *h == i).ok_or_else(|| light.iter().position(|l| *l == i).unwrap_or_default());
    let all = DMatrix::from_fn(m.len(), heavy.len(), |i, j| match row(i) {
        Ok(r) => shapes[(r, j)],
        Err(r) => following[(r, j)],
    });
    (lambda, all)
}

/// The same where every mass is positive.
fn massive(k: &DMatrix<f64>, m: &[f64]) -> (Vec<f64>, DMatrix<f64>) {
    let n = m.len();
    let root: Vec<f64> = m.iter().map(|m| m.sqrt()).collect();
    let a = DMatrix::from_fn(n, n, |i, j| k[(i, j)] / (root[i] * root[j]));
    let eigen = SymmetricEigen::new(a);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
    let vectors = DMatrix::from_fn(n, n, |i, j| eigen.eigenvectors[(i, order[j])] / root[i]);
    (order.iter().map(|&i| eigen.eigenvalues[i]).collect(), vectors)
}

/// The same with any mass matrix, symmetric; `None` where that is not positive definite.
pub(crate) fn of_full_mass(k: &DMatrix<f64>, m: &DMatrix<f64>) -> Option<(DVector<f64>, DMatrix<f64>)> {
    let lower = m.clone().cholesky()?.unpack();
    let half = lower.solve_lower_triangular(k)?.transpose();
    let reduced = lower.solve_lower_triangular(&half)?;
    let eigen = SymmetricEigen::new((&reduced + reduced.transpose()) * 0.5);
    let mut order: Vec<usize> = (0..k.nrows()).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
    let vectors = DMatrix::from_columns(&order.iter().map(|i| eigen.eigenvectors.column(*i).into_owned()).collect::<Vec<_>>());
    let shapes = lower.tr_solve_lower_triangular(&vectors)?;
    Some((DVector::from_iterator(order.len(), order.iter().map(|i| eigen.eigenvalues[*i])), shapes))
}

/// Share of the sum of squares below which an element of a vector counts as none: it moves an eigenvalue by less than rounding.
const NONE: f64 = 1e-14;
/// Eigenvalues of diag(d) + v v' for ascending d, ascending; `squares` are those of the elements of v. One lies above each d and below the next \[Golub & Van Loan 2013, section 8.4.3\], where
/// 1 + sum of v_i²/(d_i - x) is zero; where an element is none, it is d itself. Each is found to an interval of this share of its upper end.
pub(crate) fn of_rank_one(d: &[f64], squares: &[f64], narrow: f64) -> Vec<f64> {
    let total: f64 = squares.iter().sum();
    let (mut list, mut poles) = (Vec::with_capacity(d.len()), Vec::<(f64, f64)>::with_capacity(d.len()));
    for (d, square) in d.iter().zip(squares) {
        match poles.last_mut() {
            _ if *square <= NONE * total => list.push(*d),
            // of equal d all but one stay
            Some((last, sum)) if *last == *d => {
                *sum += square;
                list.push(*d);
            }
            _ => poles.push((*d, *square)),
        }
    }
    for (i, &(low, square)) in poles.iter().enumerate() {
        let others = |x: f64, end: f64| poles.iter().filter(|p| p.0 != low && p.0 != end).map(|p| p.1 / (p.0 - x)).sum::<f64>();
        let Ok(found) = match poles.get(i + 1) {
            // times the distances from both ends the sum is finite at these, below zero at the first and above at the other
            Some(&(high, next)) => {
                let mut f = |x: f64| {
                    Ok::<f64, Infallible>((x - low) * (high - x) * (1.0 + others(x, high)) - square * (high - x) + next * (x - low))
                };
                between((low, -square * (high - low)), (high, next * (high - low)), narrow * high, &mut f)
            }
            None => {
                let (high, mut f) = (low + total, |x: f64| Ok((x - low) * (1.0 + others(x, low)) - square));
                let Ok(last) = f(high);
                between((low, -square), (high, last), narrow * high, &mut f)
            }
        };
        list.push(found);
    }
    list.sort_by(f64::total_cmp);
    list
}

/// Squares of the circular frequencies of M x'' + K x = 0 with positive definite M and symmetric K, ascending. Nothing where M is not that or something is not finite.
pub(crate) fn undamped(m: &DMatrix<f64>, k: &DMatrix<f64>) -> Option<Vec<f64>> {
    let n = m.nrows();
    let is_diagonal = (0..n).all(|i| (0..i).all(|j| m[(i, j)] == 0.0) && m[(i, i)] > 0.0);
    let reduced = if is_diagonal {
        let root: Vec<f64> = (0..n).map(|i| m[(i, i)].sqrt()).collect();
        DMatrix::from_fn(n, n, |i, j| k[(i, j)] / (root[i] * root[j]))
    } else {
        let lower = m.clone().cholesky()?.unpack();
        let half = lower.solve_lower_triangular(k)?.transpose();
        lower.solve_lower_triangular(&half)?
    };
    if !reduced.iter().all(|x| x.is_finite()) {
        return None;
    }
    let mut squares: Vec<f64> = reduced.symmetric_eigenvalues().iter().copied().collect();
    squares.sort_by(f64::total_cmp);
    Some(squares)
}

/// The eigenvalue of M s² + C s + K nearest to `first`, by inverse iteration with its quotient (Ruhe 1973, SIAM J. Numer. Anal. 10), which converges quadratically. Nothing where it leads elsewhere.
pub(crate) fn near(m: &DMatrix<f64>, c: &DMatrix<f64>, k: &DMatrix<f64>, first: C64) -> Option<C64> {
    let n = m.nrows();
    let mut s = first;
    // neither along nor across any one motion
    let mut x = DVector::from_fn(n, |i, _| C64::from(1.0 + 0.3 * ((7 * i) % 5) as f64));
    for _ in 0..MOST_ITERATIONS {
        let at = DMatrix::from_fn(n, n, |i, j| s * (s * m[(i, j)] + c[(i, j)]) + k[(i, j)]);
        let slope = DMatrix::from_fn(n, n, |i, j| 2.0 * s * m[(i, j)] + c[(i, j)]);
        let next = at.lu().solve(&(slope * &x))?;
        let largest = next.icamax();
        let change = x[largest] / next[largest];
        if !change.is_finite() {
            // s is an eigenvalue to the last digit
            return (s.is_finite()).then_some(s);
        }
        s -= change;
        x = &next / next[largest];
        if (s - first).norm() > STRAYED * first.norm() {
            return None;
        }
        if change.norm() <= SETTLED * s.norm() {
            return Some(s);
        }
    }
    None
}

/// Eigenvalues s (1/s, both of each conjugate pair) of M s² + C s + K with positive definite M, from the companion form. Nothing where the
/// matrices are not finite or the iteration does not end.
pub fn quadratic(m: &DMatrix<f64>, c: &DMatrix<f64>, k: &DMatrix<f64>) -> Option<Vec<C64>> {
    let n = m.nrows();
    let lu = m.clone().lu();
    let (c, k) = (lu.solve(c)?, lu.solve(k)?);
    if !k.iter().chain(c.iter()).all(|x| x.is_finite()) {
        return None;
    }
    // time is scaled so that both blocks of the companion matrix have the same size
    let scale = k.amax().sqrt().max(c.amax());
    if scale == 0.0 {
        return Some(vec![C64::default(); 2 * n]);
    }
    let companion = DMatrix::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
        (true, true) => 0.0,
        (true, false) => f64::from(u8::from(j - n == i)),
        (false, true) => -k[(i - n, j)] / (scale * scale),
        (false, false) => -c[(i - n, j - n)] / scale,
    });
    let schur = Schur::try_new(companion, f64::EPSILON, 200 * n)?;
    Some(schur.complex_eigenvalues().iter().map(|s| s * scale).collect())
}
