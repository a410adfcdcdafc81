//! A structure by the matrices of a few of its unknowns, as a finite-element program reduces it, and what of it can be checked.

use super::reduction::modes_of;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use std::collections::BTreeMap;

/// An unknown: a motion of a node (1 to 3 along x, y, z; 4 to 6 rotations about them), or the coordinate of a mode (0).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Unknown {
    /// Number of the node, or of the mode.
    pub node: u64,
    /// 0 to 6.
    pub component: u8,
}

/// Matrices over unknowns, SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Structure {
    /// In the sequence of rows and columns.
    pub unknowns: Vec<Unknown>,
    /// Of the nodes, m, as far as they are known.
    pub places: BTreeMap<u64, Vector3<f64>>,
    /// K.
    pub stiffness: DMatrix<f64>,
    /// M.
    pub mass: Option<DMatrix<f64>>,
    /// G of turning axes, per rad/s.
    pub gyroscopic: Option<DMatrix<f64>>,
    /// K_s + Kc - Z of turning axes, per rad²/s².
    pub turning: Option<DMatrix<f64>>,
}

/// What a structure is found to be.
#[derive(Debug, Clone, PartialEq)]
pub struct Checks {
    /// Largest |K - K'| over the largest |K|.
    pub asymmetry: f64,
    /// The same of M.
    pub mass_asymmetry: Option<f64>,
    /// Largest |K X| over the largest |K| for motions X as a rigid body, lengths in m; where all nodes have a place.
    pub rigid_residual: Option<f64>,
    /// Squares of frequencies that are zero beside the others.
    pub rigid_modes: Option<usize>,
    /// Mass in x, y and z, kg.
    pub mass: Option<[f64; 3]>,
    /// Centre of mass, m.
    pub centre: Option<Vector3<f64>>,
    /// Inertia about the z axis, kg m².
    pub polar_inertia: Option<f64>,
    /// Elastic frequencies, the lowest first, Hz; `None` without a positive definite mass matrix.
    pub frequencies_hz: Option<Vec<f64>>,
    /// Torsional stiffness from the first node that rotates about z to the last one along z, both free otherwise, N m/rad.
    pub torsional_stiffness: Option<f64>,
}

/// An eigenvalue below this share of the first elastic one is that of a rigid motion.
const RIGID: f64 = 1e-6;
/// Rigid motions of a free body.
const FREE: usize = 6;

fn asymmetry(x: &DMatrix<f64>) -> f64 {
    let largest = x.amax();
    if largest > 0.0 { (x - x.transpose()).amax() / largest } else { 0.0 }
}

impl Structure {
    /// Motions as a rigid body: along x, y, z, then rotations about the axes through the origin; `None` where a node has no place.
    pub(crate) fn rigid_motions(&self) -> Option<DMatrix<f64>> {
        let mut all = DMatrix::zeros(self.unknowns.len(), FREE);
        for (row, unknown) in self.unknowns.iter().enumerate().filter(|u| u.1.component > 0) {
            let place = *self.places.get(&unknown.node)?;
            let k = usize::from(unknown.component - 1);
            for m in 0..3 {
                let axis = Vector3::from_fn(|i, _| f64::from(u8::from(i == m)));
                if k < 3 {
                    all[(row, m)] = axis[k];
                    all[(row, 3 + m)] = axis.cross(&place)[k];
                } else {
                    all[(row, 3 + m)] = axis[k - 3];
                }
            }
        }
        Some(all)
    }

    /// How many nodes.
    pub fn nodes(&self) -> usize {
        let mut all: Vec<u64> = self.unknowns.iter().filter(|u| u.component > 0).map(|u| u.node).collect();
        all.sort_unstable();
        all.dedup();
        all.len()
    }

    /// What it is found to be.
    pub fn checks(&self) -> Checks {
        let rigid = self.rigid_motions();
        let largest = self.stiffness.amax();
        let rigid_residual = rigid.as_ref().filter(|_| largest > 0.0).map(|x| (&self.stiffness * x).amax() / largest);
        let eigen = self.mass.as_ref().and_then(|m| modes_of(&self.stiffness, m)).map(|found| found.0);
        // beside the seventh of a free body, and beside the largest of one with fewer
        let rigid_modes = eigen.as_ref().map(|all| {
            let beside = all.iter().copied().find(|s| *s > 1e-12 * all.amax()).unwrap_or(0.0);
            all.iter().filter(|s| **s < RIGID * beside.max(all.get(FREE).copied().unwrap_or(beside))).count()
        });
        let hz = |s: &f64| s.max(0.0).sqrt() / std::f64::consts::TAU;
        let frequencies_hz = eigen.as_ref().zip(rigid_modes).map(|(all, rigid)| all.iter().skip(rigid).map(hz).collect());
        let body = rigid.as_ref().zip(self.mass.as_ref()).map(|(x, m)| x.transpose() * m * x);
        let mass = body.as_ref().map(|b| [0, 1, 2].map(|k| b[(k, k)]));
        // m S(c)' stands beside the translations
        let centre = body.as_ref().zip(mass).map(|(b, m)| Vector3::new(b[(1, 5)], -b[(0, 5)], b[(0, 4)]) / m[0]);
        Checks {
            asymmetry: asymmetry(&self.stiffness),
            mass_asymmetry: self.mass.as_ref().map(asymmetry),
            rigid_residual,
            rigid_modes,
            mass,
            centre,
            polar_inertia: body.as_ref().map(|b| b[(5, 5)]),
            frequencies_hz,
            torsional_stiffness: rigid.as_ref().and_then(|x| self.torsional_stiffness(x)),
        }
    }

    /// By a unit torque on the last node against the first; what moves as a rigid body is held softly, which changes nothing of a twist.
    fn torsional_stiffness(&self, rigid: &DMatrix<f64>) -> Option<f64> {
        let along = |u: &Unknown| self.places.get(&u.node).map(|p| p.z);
        let mut ends: Vec<(f64, usize)> =
            self.unknowns.iter().enumerate().filter(|(_, u)| u.component == 6).filter_map(|(i, u)| Some((along(u)?, i))).collect();
        ends.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (first, last) = (ends.first()?.1, ends.last()?.1);
        let orthonormal = rigid.clone().qr().q();
        let held = &self.stiffness + &orthonormal * orthonormal.transpose() * self.stiffness.amax();
        let torque = DVector::from_fn(held.nrows(), |i, _| f64::from(u8::from(i == last)) - f64::from(u8::from(i == first)));
        let motion = held.lu().solve(&torque)?;
        let twist = motion[last] - motion[first];
        (first != last && twist.is_finite() && twist > 0.0).then(|| 1.0 / twist)
    }

    /// The same in other axes: `axes` has in its rows the directions of the new x, y, z.
    #[must_use]
    pub fn turned(&self, axes: &Matrix3<f64>) -> Option<Self> {
        let n = self.unknowns.len();
        let mut turn = DMatrix::identity(n, n);
        for (i, u) in self.unknowns.iter().enumerate().filter(|u| u.1.component > 0) {
            let first = if u.component > 3 { 4 } else { 1 };
            for k in 0..3u8 {
                let other = Unknown { node: u.node, component: first + k };
                // a motion along some of the axes only has none along the new ones
                let j = self.unknowns.iter().position(|o| *o == other)?;
                turn[(i, j)] = axes[(usize::from(u.component - first), usize::from(k))];
            }
        }
        let of = |x: &DMatrix<f64>| &turn * x * turn.transpose();
        Some(Self {
            unknowns: self.unknowns.clone(),
            places: self.places.iter().map(|(node, p)| (*node, axes * p)).collect(),
            stiffness: of(&self.stiffness),
            mass: self.mass.as_ref().map(of),
            gyroscopic: self.gyroscopic.as_ref().map(of),
            turning: self.turning.as_ref().map(of),
        })
    }
}
