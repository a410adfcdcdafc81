//! Undamped modes of a shaft at rest, and of which kind each is.

use super::shaft::{Shaft, Six};
use crate::numerics::lowest_modes::lowest;
use crate::numerics::{C64, eigen};
use nalgebra::{DMatrix, DVector};

/// Below this share of the largest quotient of the diagonals of stiffness and mass the square of a frequency is what rounding leaves of zero: the mode is rigid.
const RIGID: f64 = 1e-12;

/// A mode at rest.
#[derive(Debug, Clone, PartialEq)]
pub struct FreeMode {
    /// rad/s; zero of a rigid one.
    pub omega: f64,
    /// Motion of each node, scaled to phi' M phi = 1.
    pub shape: Vec<Six>,
    /// Share of the kinetic energy in rotation of the nodes about the axis.
    pub torsion: f64,
    /// In motion along the axis.
    pub axial: f64,
}

impl FreeMode {
    /// The rest: bending.
    pub fn bending(&self) -> f64 {
        (1.0 - self.torsion - self.axial).max(0.0)
    }

    /// The kind with the largest share.
    pub fn kind(&self) -> &'static str {
        let shares = [(self.bending(), "bending"), (self.torsion, "torsion"), (self.axial, "axial")];
        shares.into_iter().reduce(|a, b| if b.0 > a.0 { b } else { a }).map_or("bending", |s| s.1)
    }
}

/// The lowest modes of a shaft at rest, ascending; nothing where its mass matrix is not positive definite.
pub fn free_modes(shaft: &Shaft, count: usize) -> Option<Vec<FreeMode>> {
    let free = shaft.free();
    let part = |all: DMatrix<f64>| DMatrix::from_fn(free.len(), free.len(), |i, j| all[(free[i], free[j])]);
    let (m, k) = (part(shaft.mass_matrix()), part(shaft.stiffness_matrix()));
    let (squares, shapes) = lowest(&k, &m, count)?;
    let largest = (0..free.len()).map(|i| k[(i, i)] / m[(i, i)]).fold(0.0, f64::max);
    let mode = |i: usize| {
        let omega = if squares[i] > RIGID * largest { squares[i].sqrt() } else { 0.0 };
        of(shaft, &free, &shapes.column(i).into_owned(), omega)
    };
    Some((0..squares.len()).map(mode).collect())
}

/// A mode from its unknowns.
fn of(shaft: &Shaft, free: &[usize], own: &DVector<f64>, omega: f64) -> FreeMode {
    let mut shape = vec![Six::zeros(); shaft.len()];
    free.iter().zip(own.iter()).for_each(|(i, x)| shape[i / 6][i % 6] = *x);
    for node in 0..shaft.places.len() {
        // of a node that moves along the axes only, too; without mass of its own
        shape[node][5] = shaft.rotation(node).iter().map(|(node, k, factor)| shape[*node][*k] * factor).sum();
    }
    let turned: Vec<Six> = shape.iter().zip(shaft.rigid_rotation()).map(|(x, rotation)| rotation * x[5]).collect();
    let mut along: Vec<Six> = shape.iter().map(|x| Six::new(0.0, 0.0, x[2], 0.0, 0.0, 0.0)).collect();
    along.iter_mut().skip(shaft.places.len()).for_each(|x| *x = Six::zeros());
    let share = |part: &[Six]| shaft.kinetic(part, part) / shaft.kinetic(&shape, &shape);
    FreeMode { omega, torsion: share(&turned), axial: share(&along), shape }
}

/// Eigenvalues s (1/s) of a shaft that turns, in axes that turn with it, in the coordinates of its modes at rest; those with positive imaginary part, by it. Loss factors count as the viscous damping equal to them at the
/// frequencies of the modes. `None` where they cannot be computed.
pub fn at_speed(shaft: &Shaft, modes: &[FreeMode], speed: f64) -> Option<Vec<C64>> {
    let whole = |m: &FreeMode| DVector::from_fn(6 * m.shape.len(), |i, _| m.shape[i / 6][i % 6]);
    let all = DMatrix::from_columns(&modes.iter().map(whole).collect::<Vec<_>>());
    let modal = |matrix: DMatrix<f64>| all.transpose() * matrix * &all;
    let n = modes.len();
    let mean = |i: usize, j: usize| 0.5 * (modes[i].omega + modes[j].omega);
    let loss = modal(shaft.loss_matrix());
    let viscous = DMatrix::from_fn(n, n, |i, j| if mean(i, j) > 0.0 { loss[(i, j)] / mean(i, j) } else { 0.0 });
    let c = modal(shaft.damping_matrix()) + viscous + modal(shaft.gyroscopic_matrix()) * speed;
    let k = DMatrix::from_fn(n, n, |i, j| if i == j { modes[i].omega * modes[i].omega } else { 0.0 });
    let k = k + modal(shaft.turning_matrix()) * (speed * speed) + modal(shaft.circulatory_matrix()) * speed;
    let mut found = eigen::quadratic(&DMatrix::identity(n, n), &c, &k)?;
    found.retain(|s| s.im > 0.0);
    found.sort_by(|a, b| a.im.total_cmp(&b.im));
    Some(found)
}
