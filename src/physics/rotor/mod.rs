//! A shaft in bending, torsion and axial motion at constant speed, in axes that turn with it.
//!
//! A node has u, v, w and small rotations fx, fy, fz relative to uniform rotation Omega about z, positive in the direction of rotation. Nodes follow each
//! other; beams join a node to the next, rigid bodies sit on nodes, bearings stand still. With omega = n Omega an order obeys
//!
//! ```text
//! (-omega² M + i omega (C + Omega G) + (1 + i eta) K + Omega C_s + Omega² (K_s + Kc - Z)) q = f
//! ```
//!
//! G holds Coriolis forces and gyroscopic moments, Z centrifugal forces, Kc the centrifugal moments of tilting, K_s the stiffening of webs by their tension, C_s what bearings
//! that stand still do to a shaft that turns \[Genta 2005\], \[Friswell et al. 2010\]. With K_s rigid rotation about z costs nothing; without it torsion would be
//! unstable. Derived here for beams and bodies anywhere beside the axis: `tests/flexible_crank` holds them to closed forms and to exact motion.

pub mod beam;
pub mod body;
pub mod exponential_joint;
mod factored;
pub mod free_modes;
pub mod harmonic_balance;
mod motion;
pub mod reduction;
pub mod shaft;
pub mod structure;
pub mod structure_checks;
pub(crate) mod superelement;
pub(crate) mod transfer;
mod waves;

use nalgebra::{Matrix3, SMatrix, Vector3};

/// A block of the matrix of an element: a node's own, or of one node and the next.
pub type Real = SMatrix<f64, 6, 6>;

/// S(a): the matrix of a ×.
pub(crate) fn cross(a: Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -a.z, a.y, a.z, 0.0, -a.x, -a.y, a.x, 0.0)
}

/// diag(1, 1, 0): across the axis.
pub(crate) fn across() -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 0.0))
}

/// Gyroscopic matrix of a body with the tensor I about its centre: tr(I) S(e) - 2 S(I e); for diag(A, B, C) (A + B - C) S(e).
pub(crate) fn gyroscopic(tensor: &Matrix3<f64>) -> Matrix3<f64> {
    let e = Vector3::z();
    cross(e) * tensor.trace() - cross(tensor * e) * 2.0
}

/// Stiffness of a body against tilting, per square of the speed: the symmetric part of S(e) I S(e) - S(e) S(I e); for diag(A, B, C) diag(C - B, C - A, 0).
pub(crate) fn tilting(tensor: &Matrix3<f64>) -> Matrix3<f64> {
    let e = Vector3::z();
    let whole = cross(e) * tensor * cross(e) - cross(e) * cross(tensor * e);
    (whole + whole.transpose()) * 0.5
}
