//! Symmetric matrices with a narrow band, factored as L D L' without exchange of rows.

use nalgebra::DMatrix;

/// The lower half of a symmetric matrix, row by row: so many elements before that of the diagonal, and this.
#[derive(Debug, Clone)]
pub(crate) struct Banded {
    n: usize,
    before: usize,
    rows: Vec<f64>,
}

impl Banded {
    /// The band of a symmetric matrix outside which all elements are zero.
    pub(crate) fn of(all: &DMatrix<f64>) -> Self {
        let n = all.nrows();
        let reach = |i: usize| (0..i).find(|j| all[(i, *j)] != 0.0).map_or(0, |j| i - j);
        let before = (0..n).map(reach).max().unwrap_or(0);
        let place = |i: usize, c: usize| if i + c < before { 0.0 } else { all[(i, i + c - before)] };
        Self { n, before, rows: (0..n).flat_map(|i| (0..=before).map(move |c| place(i, c))).collect() }
    }

    /// Rows and columns.
    pub(crate) fn len(&self) -> usize {
        self.n
    }

    /// Element of the lower half within the band.
    fn at(&self, i: usize, j: usize) -> f64 {
        self.rows[i * (self.before + 1) + self.before + j - i]
    }

    fn at_mut(&mut self, i: usize, j: usize) -> &mut f64 {
        &mut self.rows[i * (self.before + 1) + self.before + j - i]
    }

    /// Elements of the diagonal.
    pub(crate) fn diagonal(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.n).map(|i| self.at(i, i))
    }

    /// This less a factor times another one.
    #[must_use]
    pub(crate) fn less(&self, factor: f64, other: &Self) -> Self {
        let before = self.before.max(other.before);
        let element = |own: &Self, i: usize, j: usize| if i - j <= own.before { own.at(i, j) } else { 0.0 };
        let place = |i: usize, c: usize| {
            if i + c < before { 0.0 } else { element(self, i, i + c - before) - factor * element(other, i, i + c - before) }
        };
        Self { n: self.n, before, rows: (0..self.n).flat_map(|i| (0..=before).map(move |c| place(i, c))).collect() }
    }

    /// Its product with a vector.
    pub(crate) fn times(&self, x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; self.n];
        for i in 0..self.n {
            for j in i.saturating_sub(self.before)..i {
                y[i] += self.at(i, j) * x[j];
                y[j] += self.at(i, j) * x[i];
            }
            y[i] += self.at(i, i) * x[i];
        }
        y
    }

    /// L D L' of it: L below the diagonal, D on it. As many elements of D are below zero as eigenvalues are.
    #[must_use]
    pub(crate) fn factored(mut self) -> Self {
        for i in 0..self.n {
            let first = i.saturating_sub(self.before);
            for j in first..i {
                // L D of this row, until D is divided out below
                let sum: f64 = (first.max(j.saturating_sub(self.before))..j).map(|k| self.at(i, k) * self.at(j, k)).sum();
                *self.at_mut(i, j) -= sum;
            }
            for j in first..i {
                let scaled = self.at(i, j);
                let own = scaled / self.at(j, j);
                *self.at_mut(i, j) = own;
                *self.at_mut(i, i) -= own * scaled;
            }
        }
        self
    }

    /// Solves for a right side in place; of a matrix that is factored.
    pub(crate) fn solve(&self, x: &mut [f64]) {
        for i in 0..self.n {
            let sum: f64 = (i.saturating_sub(self.before)..i).map(|j| self.at(i, j) * x[j]).sum();
            x[i] -= sum;
        }
        x.iter_mut().zip(self.diagonal()).for_each(|(x, d)| *x /= d);
        for i in (0..self.n).rev() {
            for j in i.saturating_sub(self.before)..i {
                x[j] -= self.at(i, j) * x[i];
            }
        }
    }
}
