//! A structure by the matrices of a few of its unknowns, as a finite-element program reduces it.

use nalgebra::{DMatrix, Vector3};
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

impl Structure {
    /// Motions as a rigid body: along x, y, z, then rotations about the axes through the origin; `None` where a node has no place.
    pub(crate) fn rigid_motions(&self) -> Option<DMatrix<f64>> {
        let mut all = DMatrix::zeros(self.unknowns.len(), 6);
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

    /// The same in axes with z along a crank that lies along another one: axes in turn, so that no entry of a matrix changes.
    #[must_use]
    pub fn along(&self, axis: CrankAxis) -> Self {
        let old = axis.in_turn();
        let place = |p: &Vector3<f64>| Vector3::new(p[old[0]], p[old[1]], p[old[2]]);
        Self {
            unknowns: self.unknowns.iter().map(|u| axis.after(*u)).collect(),
            places: self.places.iter().map(|(node, p)| (*node, place(p))).collect(),
            ..self.clone()
        }
    }
}

/// Along which axis a crank lies in the files of another program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CrankAxis {
    /// y becomes x, z becomes y, x becomes z.
    X,
    /// z becomes x, x becomes y, y becomes z.
    Y,
    /// As it is.
    Z,
}

impl CrankAxis {
    /// What an unknown is in the new axes.
    fn after(self, unknown: Unknown) -> Unknown {
        let first = match unknown.component {
            0 => return unknown,
            1..=3 => 1,
            _ => 4,
        };
        let new = self.in_turn().iter().position(|old| *old == usize::from(unknown.component - first)).unwrap_or(0);
        Unknown { component: first + new as u8, ..unknown }
    }

    /// Indices of the old axes that are the new x, y and z.
    fn in_turn(self) -> [usize; 3] {
        match self {
            Self::X => [1, 2, 0],
            Self::Y => [2, 0, 1],
            Self::Z => [0, 1, 2],
        }
    }
}
