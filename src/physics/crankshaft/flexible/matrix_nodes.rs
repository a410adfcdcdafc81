//! Where the nodes of matrices of another program stand among those of a shaft.

use super::imported::ImportedCrank;
use crate::numerics::elementary::Elementary;
use crate::rotor::shaft::Answer;
use crate::rotor::structure::Unknown;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use std::collections::BTreeMap;

/// Where the nodes of the matrices stand among those of a shaft.
pub(super) struct Nodes<'a> {
    pub own: &'a ImportedCrank,
    /// Nodes of the matrices in turn: the hub, then along z, the flywheel last.
    pub numbers: Vec<u64>,
    pub place: BTreeMap<u64, usize>,
    /// First node that holds coordinates of modes.
    pub modes: usize,
    /// All nodes.
    pub count: usize,
    /// Turns the axes of the matrices to those of the engine.
    pub turn: Matrix3<f64>,
}

impl<'a> Nodes<'a> {
    /// With so many before the hub and behind the flywheel; `turned`: how far the axes of the matrices are turned against those of the engine, rad.
    pub fn new(own: &'a ImportedCrank, (before, behind): (usize, usize), turned: f64) -> Self {
        let (sine, cosine) = turned.sine_cosine();
        let mut numbers: Vec<u64> = own.structure.unknowns.iter().filter(|u| u.component > 0).map(|u| u.node).collect();
        numbers.sort_unstable();
        numbers.dedup();
        let along = |n: &u64| (*n == own.flywheel, *n != own.hub);
        numbers.sort_by(|a, b| along(a).cmp(&along(b)).then(own.place(*a).z.total_cmp(&own.place(*b).z)));
        let modal = own.structure.unknowns.iter().filter(|u| u.component == 0).count();
        let modes = before + numbers.len() + behind;
        Self {
            own,
            place: numbers.iter().enumerate().map(|(i, n)| (*n, before + i)).collect(),
            numbers,
            modes,
            count: modes + modal.div_ceil(6),
            turn: Matrix3::new(cosine, sine, 0.0, -sine, cosine, 0.0, 0.0, 0.0, 1.0),
        }
    }

    /// Index of an unknown of the matrices among those of the shaft; `modal`: how many coordinates of modes come before it.
    fn index(&self, unknown: &Unknown, modal: usize) -> usize {
        match unknown.component {
            0 => 6 * self.modes + modal,
            component => 6 * self.place[&unknown.node] + usize::from(component) - 1,
        }
    }

    /// Indices of all unknowns of the matrices.
    pub(super) fn indices(&self) -> Vec<usize> {
        let mut modal = 0..;
        let of = |u: &Unknown| self.index(u, if u.component == 0 { modal.next().unwrap_or(0) } else { 0 });
        self.own.structure.unknowns.iter().map(of).collect()
    }

    /// Whether a node moves by a component, from 1.
    pub fn moves(&self, node: u64, component: u8) -> bool {
        self.own.structure.unknowns.contains(&Unknown { node, component })
    }

    /// A matrix of the structure over the unknowns of the shaft, in the axes of the engine.
    pub fn scattered(&self, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        let (n, indices) = (6 * self.count, self.indices());
        let mut all = DMatrix::zeros(n, n);
        for (i, row) in indices.iter().enumerate() {
            for (j, column) in indices.iter().enumerate() {
                all[(*row, *column)] = matrix[(i, j)];
            }
        }
        let mut turn = DMatrix::identity(n, n);
        for first in (0..6 * self.modes).step_by(3) {
            turn.fixed_view_mut::<3, 3>(first, first).copy_from(&self.turn);
        }
        &turn * all * turn.transpose()
    }

    /// A motion of the unknowns of the matrices over those of the shaft.
    pub fn motion(&self, own: &DVector<f64>) -> DVector<f64> {
        let mut all = DVector::zeros(6 * self.count);
        self.indices().iter().zip(own.iter()).for_each(|(index, x)| all[*index] = *x);
        for first in (0..6 * self.modes).step_by(3) {
            let turned = self.turn * all.fixed_rows::<3>(first);
            all.fixed_rows_mut::<3>(first).copy_from(&turned);
        }
        all
    }

    /// Unknowns as the files have them, in the axes of the matrices.
    pub fn written(&self) -> Vec<(Unknown, Answer)> {
        let back = |index: usize, scale: f64| -> Answer {
            let (node, k) = (index / 6, index % 6);
            if node >= self.modes {
                return vec![(node, k, scale)];
            }
            let first = 3 * (k / 3);
            (0..3).map(|i| (node, first + i, scale * self.turn[(i, k - first)])).filter(|f| f.2 != 0.0).collect()
        };
        self.own.written.iter().zip(self.indices()).map(|(w, index)| (w.unknown, back(index, w.scale))).collect()
    }

    /// Middle points of the journals beside a throw with their weights at the place of its pin.
    pub fn beside(&self, z: f64) -> Vec<(usize, f64)> {
        let at = |node: u64| self.own.structure.places[&node].z;
        let middles: Vec<u64> = self.own.journals.iter().map(|points| points[points.len() / 2]).collect();
        let before = middles.iter().copied().filter(|m| at(*m) <= z).max_by(|a, b| at(*a).total_cmp(&at(*b)));
        let behind = middles.iter().copied().filter(|m| at(*m) > z).min_by(|a, b| at(*a).total_cmp(&at(*b)));
        match (before, behind) {
            (Some(a), Some(b)) => {
                let share = (z - at(a)) / (at(b) - at(a));
                vec![(self.place[&a], 1.0 - share), (self.place[&b], share)]
            }
            (one, other) => one.or(other).map(|m| (self.place[&m], 1.0)).into_iter().collect(),
        }
    }

    /// Motion of a pin along a direction against the axis beside it.
    pub(super) fn against_axis(&self, pin: u64, direction: &Vector3<f64>) -> Answer {
        let along = |node: usize, factor: f64| (0..3).map(move |k| (node, k, factor * direction[k])).filter(|f| f.2 != 0.0);
        let beside = self.beside(self.own.structure.places[&pin].z);
        along(self.place[&pin], 1.0).chain(beside.into_iter().flat_map(|(node, weight)| along(node, -weight))).collect()
    }
}
