//! A shaft put together from beams, bodies and bearings, and its dynamic stiffness at an order and a speed.

use super::beam::{Beam, blocks};
use super::body::Body;
use super::factored::Factored;
pub use super::motion::{Answer, Six, Turning};
use super::superelement::Superelement;
use super::{Real, across, cross};
use crate::numerics::C64;
use crate::numerics::block_tridiagonal::{Block, Columns, factor};
use crate::numerics::tridiagonal::Singular;
use nalgebra::{DMatrix, DVector, Vector3};
use std::collections::BTreeMap;

/// How a beam dissipates: its stiffness is K (1 + i eta + i omega tau).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dissipation {
    /// eta.
    pub loss_factor: f64,
    /// tau, s.
    pub time: f64,
}

impl Dissipation {
    /// 1 + i (eta + omega tau).
    pub(crate) fn factor(&self, omega: f64) -> C64 {
        C64::new(1.0, self.loss_factor + omega * self.time)
    }
}

/// A symmetric or skew matrix over the nodes of a row.
#[derive(Debug, Clone, PartialEq)]
struct Row {
    own: Vec<Real>,
    /// Of a node by the next one.
    next: Vec<Real>,
}

impl Row {
    fn new(nodes: usize) -> Self {
        Self { own: vec![Real::zeros(); nodes], next: vec![Real::zeros(); nodes - 1] }
    }

    fn add(&mut self, first: usize, [a, b, across]: [Real; 3], factor: f64) {
        self.own[first] += a * factor;
        self.own[first + 1] += b * factor;
        self.next[first] += across * factor;
    }

    /// Over all unknowns; `sign`: of the blocks below the diagonal.
    fn dense(&self, sign: f64) -> DMatrix<f64> {
        let n = 6 * self.own.len();
        let mut all = DMatrix::zeros(n, n);
        for (i, own) in self.own.iter().enumerate() {
            all.fixed_view_mut::<6, 6>(6 * i, 6 * i).copy_from(own);
        }
        for (i, next) in self.next.iter().enumerate() {
            all.fixed_view_mut::<6, 6>(6 * i, 6 * i + 6).copy_from(next);
            all.fixed_view_mut::<6, 6>(6 * i + 6, 6 * i).copy_from(&(next.transpose() * sign));
        }
        all
    }
}

/// A shaft in turning axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Shaft {
    /// Of the nodes, m; what is behind them are coordinates of modes, six to one.
    pub places: Vec<Vector3<f64>>,
    /// Of nodes whose rotation about the axis is no unknown of theirs.
    rotations: BTreeMap<usize, Answer>,
    /// What joins nodes that do not follow each other.
    superelement: Option<Box<Superelement>>,
    stiffness: Row,
    /// Loss factors times stiffness.
    loss: Row,
    damping: Row,
    mass: Row,
    gyroscopic: Row,
    /// K_s + Kc - Z.
    turning: Row,
    /// C_s.
    circulatory: Vec<Real>,
    /// Unknowns that are held at zero.
    held: Vec<[bool; 6]>,
    /// What the masses of bodies beside their nodes pull at these, per square of the speed: forces and moments.
    beside: Vec<Six>,
}

impl Shaft {
    /// Nodes at these places, not joined yet.
    pub fn new(places: Vec<Vector3<f64>>) -> Self {
        let n = places.len();
        let row = || Row::new(n);
        Self {
            stiffness: row(),
            loss: row(),
            damping: row(),
            mass: row(),
            gyroscopic: row(),
            turning: row(),
            circulatory: vec![Real::zeros(); n],
            held: vec![[false; 6]; n],
            beside: vec![Six::zeros(); n],
            rotations: BTreeMap::new(),
            superelement: None,
            places,
        }
    }

    /// Nodes at these places, then coordinates of modes, six to one, all joined by a superelement over them.
    pub(crate) fn joined(places: Vec<Vector3<f64>>, element: Superelement) -> Self {
        let nodes = element.mass.nrows() / 6;
        let behind = nodes - places.len();
        let mut shaft = Self::new(places.iter().copied().chain(std::iter::repeat_n(Vector3::zeros(), behind)).collect());
        (shaft.places, shaft.superelement) = (places, Some(Box::new(element)));
        shaft
    }

    /// Takes a motion for the rotation of a node about the axis.
    pub(crate) fn rotate_by(&mut self, node: usize, motion: Answer) {
        self.rotations.insert(node, motion);
    }

    /// Rotation of a node about the axis.
    pub(crate) fn rotation(&self, node: usize) -> Answer {
        self.rotations.get(&node).cloned().unwrap_or_else(|| vec![(node, 5, 1.0)])
    }

    /// Whether it is known how a node moves by a component: it is free to, or its rotation follows from other motions.
    #[doc(hidden)]
    pub fn moves(&self, node: usize, k: usize) -> bool {
        !self.held[node][k] || (k == 5 && self.rotations.contains_key(&node))
    }

    /// Joins a node to the next by a beam.
    pub fn join(&mut self, first: usize, beam: &Beam, dissipation: Dissipation) {
        let on = beam.matrices();
        let stiffness = blocks(&on.stiffness);
        self.stiffness.add(first, stiffness, 1.0);
        self.loss.add(first, stiffness, dissipation.loss_factor);
        self.damping.add(first, stiffness, dissipation.time);
        self.mass.add(first, blocks(&on.mass), 1.0);
        self.gyroscopic.add(first, blocks(&on.gyroscopic), 1.0);
        self.turning.add(first, blocks(&on.turning), 1.0);
    }

    /// Joins a node to the next by a spring in rotation about the axis, N m/rad.
    pub(crate) fn join_in_torsion(&mut self, first: usize, stiffness: f64, dissipation: Dissipation) {
        let mut block = Real::zeros();
        block[(5, 5)] = stiffness;
        let all = [block, block, -block];
        self.stiffness.add(first, all, 1.0);
        self.loss.add(first, all, dissipation.loss_factor);
        self.damping.add(first, all, dissipation.time);
    }

    /// Puts a body on a node.
    pub fn put(&mut self, node: usize, body: &Body) {
        let on = body.on(self.places[node]);
        self.mass.own[node] += on.mass;
        self.gyroscopic.own[node] += on.gyroscopic;
        self.turning.own[node] += on.turning;
        let force = across() * body.arm * body.mass;
        // what the mass pulls as if it were at the node is in its matrix
        let moment = body.arm.cross(&force);
        let mut own = self.beside[node].fixed_rows_mut::<3>(0);
        own += force;
        let mut own = self.beside[node].fixed_rows_mut::<3>(3);
        own += moment;
    }

    /// Puts a body on a node, on the axis, that rotates about it by itself: with its mass, its gyroscopic and its centrifugal moments, without its inertia about the axis.
    pub fn carry(&mut self, node: usize, body: &Body) {
        self.put(node, body);
        self.mass.own[node][(5, 5)] -= body.tensor[(2, 2)];
    }

    /// Centrifugal forces and moments of all masses as they are drawn, per square of the speed.
    pub fn unbalance(&self) -> Vec<Six> {
        let mut places: Vec<Six> = self.places.iter().map(|p| Six::new(p.x, p.y, 0.0, 0.0, 0.0, 0.0)).collect();
        places.resize(self.len(), Six::zeros());
        let of_element = self.unbalance_of_superelement();
        let unbalance_at = |i: usize| {
            let mut sum = self.mass.own[i] * places[i] + self.beside[i] + of_element.get(i).copied().unwrap_or_default();
            if i + 1 < places.len() {
                sum += self.mass.next[i] * places[i + 1];
            }
            if i > 0 {
                sum += self.mass.next[i - 1].transpose() * places[i - 1];
            }
            sum
        };
        (0..self.len()).map(unbalance_at).collect()
    }

    /// That of the superelement: what its mass does against rigid rotation about the axis, a quarter of a turn before. Its sums of forces are exact, of moments but for axial parts; to coordinates of modes it gives nothing.
    fn unbalance_of_superelement(&self) -> Vec<Six> {
        let Some(element) = &self.superelement else { return Vec::new() };
        let rotation = self.rigid_rotation();
        let along = &element.mass * DVector::from_fn(6 * rotation.len(), |i, _| rotation[i / 6][i % 6]);
        let turned = |i: usize| Six::new(along[6 * i + 1], -along[6 * i], 0.0, along[6 * i + 4], -along[6 * i + 3], 0.0);
        (0..self.places.len()).map(turned).collect()
    }

    /// Inertia against rotation about the axis alone, kg m².
    pub(crate) fn put_polar(&mut self, node: usize, inertia: f64) {
        self.mass.own[node][(5, 5)] += inertia;
    }

    /// A bearing that stands still, alike in all directions across the axis: N/m and N s/m.
    pub fn bear(&mut self, node: usize, (stiffness, damping): (f64, f64)) {
        for i in 0..2 {
            self.stiffness.own[node][(i, i)] += stiffness;
            self.damping.own[node][(i, i)] += damping;
        }
        let turned = cross(Vector3::z()) * damping;
        let mut block = self.circulatory[node].fixed_view_mut::<3, 3>(0, 0);
        block += turned;
    }

    /// A spring and a damper between a unit motion of a node and the ground that turns with the shaft.
    pub fn tie(&mut self, node: usize, motion: &Six, (stiffness, damping): (f64, f64)) {
        let block = motion * motion.transpose();
        self.stiffness.own[node] += block * stiffness;
        self.damping.own[node] += block * damping;
    }

    /// Holds unknowns of a node.
    pub fn hold(&mut self, node: usize, held: [bool; 6]) {
        self.held[node] = held;
    }

    /// Holds the rotation of a node about the axis, too.
    #[doc(hidden)]
    pub fn hold_rotation(&mut self, node: usize) {
        self.held[node][5] = true;
    }

    /// Leaves out what rotation does: G, C_s and K_s + Kc - Z.
    pub(crate) fn without_rotation(&mut self) {
        (self.gyroscopic, self.turning) = (Row::new(self.len()), Row::new(self.len()));
        self.circulatory.fill(Real::zeros());
        if let Some(element) = &mut self.superelement {
            element.without_rotation();
        }
    }

    /// How many nodes, those that hold coordinates of modes included.
    // never none
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        self.held.len()
    }

    /// The dynamic stiffness, factored.
    ///
    /// # Errors
    /// [`Singular`] at an undamped resonance, and where nothing holds the shaft.
    pub(crate) fn factored(&self, at: Turning) -> Result<Factored, Singular> {
        if self.superelement.is_some() {
            return Factored::whole(self.free(), |place| self.between(place, at));
        }
        let n = self.len();
        let diagonal_block = |i: usize| {
            let mut block = self.block(&|row: &Row| &row.own[i], at).0 + (self.circulatory[i] * at.speed).map(C64::from);
            for (k, held) in self.held[i].iter().enumerate() {
                if *held {
                    block.row_mut(k).fill(C64::ZERO);
                    block.column_mut(k).fill(C64::ZERO);
                    block[(k, k)] = C64::from(1.0);
                }
            }
            block
        };
        let (mut upper, mut lower) = (Vec::with_capacity(n - 1), Vec::with_capacity(n - 1));
        for i in 0..n - 1 {
            let (mut right, below) = self.block(&|row: &Row| &row.next[i], at);
            let mut below = below.transpose();
            for (k, _) in self.held[i].iter().enumerate().filter(|h| *h.1) {
                right.row_mut(k).fill(C64::ZERO);
                below.column_mut(k).fill(C64::ZERO);
            }
            for (k, _) in self.held[i + 1].iter().enumerate().filter(|h| *h.1) {
                right.column_mut(k).fill(C64::ZERO);
                below.row_mut(k).fill(C64::ZERO);
            }
            upper.push(right);
            lower.push(below);
        }
        factor((0..n).map(diagonal_block).collect(), &upper, lower).map(Factored::Blocks)
    }

    /// The dynamic stiffness between two unknowns.
    fn between(&self, (i, j): (usize, usize), at: Turning) -> C64 {
        let (a, b, place) = (i / 6, j / 6, (i % 6, j % 6));
        let (first, transposed) = (a.min(b), (place.1, place.0));
        let own = match a.abs_diff(b) {
            0 => self.entry(&|row: &Row| row.own[a][place], at) + self.circulatory[a][place] * at.speed,
            1 if a < b => self.entry(&|row: &Row| row.next[first][place], at),
            1 => {
                // of the transpose of what stands above, its skew part with the other sign
                let above = |row: &Row| row.next[first][transposed];
                self.entry(&above, at) - C64::new(0.0, 2.0 * at.omega * at.speed * above(&self.gyroscopic))
            }
            _ => C64::ZERO,
        };
        self.superelement.as_ref().map_or(own, |element| own + element.between((i, j), at))
    }

    /// An entry of the dynamic stiffness of beams, bodies and bearings, from those of their matrices.
    fn entry(&self, of: &dyn Fn(&Row) -> f64, at: Turning) -> C64 {
        let (w, speed) = (at.omega, at.speed);
        let real = of(&self.stiffness) - of(&self.mass) * (w * w) + of(&self.turning) * (speed * speed);
        C64::new(real, of(&self.loss) + (of(&self.damping) + speed * of(&self.gyroscopic)) * w)
    }

    /// Motion of all nodes under forces and moments on them.
    ///
    /// # Errors
    /// [`Singular`] at an undamped resonance, and where nothing holds the shaft.
    pub fn response(&self, at: Turning, force: &DVector<C64>) -> Result<DVector<C64>, Singular> {
        let mut x: Vec<Columns> = (0..self.len()).map(|i| Columns::from_fn(1, |k, _| force[6 * i + k])).collect();
        self.factored(at)?.solve(&mut x)?;
        Ok(DVector::from_fn(force.len(), |i, _| x[i / 6][(i % 6, 0)]))
    }

    /// K + i loss + i omega (C + Omega G) - omega² M + Omega² (K_s + Kc - Z) of one block; then with the sign of G changed, as the transpose of what stands below the diagonal.
    fn block<'a>(&'a self, of: &dyn Fn(&'a Row) -> &'a Real, at: Turning) -> (Block, Block) {
        let (w, speed) = (at.omega, at.speed);
        let real = of(&self.stiffness) - of(&self.mass) * (w * w) + of(&self.turning) * (speed * speed);
        let lossy = of(&self.loss) + of(&self.damping) * w;
        let skew = of(&self.gyroscopic) * (w * speed);
        (real.zip_map(&(lossy + skew), C64::new), real.zip_map(&(lossy - skew), C64::new))
    }

    /// A matrix of beams, bodies and bearings over all unknowns, with that of the superelement.
    fn whole(&self, own: DMatrix<f64>, of: impl Fn(&Superelement) -> &DMatrix<f64>) -> DMatrix<f64> {
        self.superelement.as_ref().map_or(own.clone(), |element| own + of(element))
    }

    /// M over all unknowns.
    pub fn mass_matrix(&self) -> DMatrix<f64> {
        self.whole(self.mass.dense(1.0), |element| &element.mass)
    }

    /// K over all unknowns, bearings included.
    pub fn stiffness_matrix(&self) -> DMatrix<f64> {
        self.whole(self.stiffness.dense(1.0), |element| &element.stiffness)
    }

    /// G over all unknowns.
    pub fn gyroscopic_matrix(&self) -> DMatrix<f64> {
        self.whole(self.gyroscopic.dense(-1.0), |element| &element.gyroscopic)
    }

    /// K_s + Kc - Z over all unknowns.
    pub fn turning_matrix(&self) -> DMatrix<f64> {
        self.whole(self.turning.dense(1.0), |element| &element.turning)
    }

    /// C_s over all unknowns.
    pub fn circulatory_matrix(&self) -> DMatrix<f64> {
        Row { own: self.circulatory.clone(), next: vec![Real::zeros(); self.len() - 1] }.dense(1.0)
    }

    /// C over all unknowns.
    pub fn damping_matrix(&self) -> DMatrix<f64> {
        self.whole(self.damping.dense(1.0), |element| &element.damping)
    }

    /// Loss factors times stiffness, over all unknowns.
    pub fn loss_matrix(&self) -> DMatrix<f64> {
        self.whole(self.loss.dense(1.0), |element| &element.loss)
    }

    /// Unknowns that move.
    pub fn free(&self) -> Vec<usize> {
        (0..6 * self.len()).filter(|i| !self.held[i / 6][i % 6]).collect()
    }

    /// Motion of the nodes when the shaft turns as a rigid body by a unit about the axis.
    pub fn rigid_rotation(&self) -> Vec<Six> {
        let mut all: Vec<Six> = self.places.iter().map(|p| Six::new(-p.y, p.x, 0.0, 0.0, 0.0, 1.0)).collect();
        all.resize(self.len(), Six::zeros());
        all
    }

    /// x' M y of some nodes' motions.
    pub fn kinetic(&self, x: &[Six], y: &[Six]) -> f64 {
        let own = (0..self.len()).map(|i| x[i].dot(&(self.mass.own[i] * y[i]))).sum::<f64>();
        let across = |i: usize| x[i].dot(&(self.mass.next[i] * y[i + 1])) + y[i].dot(&(self.mass.next[i] * x[i + 1]));
        let row = own + (0..self.len() - 1).map(across).sum::<f64>();
        let Some(element) = &self.superelement else { return row };
        let all = |x: &[Six]| DVector::from_fn(6 * x.len(), |i, _| x[i / 6][i % 6]);
        row + (all(x).transpose() * &element.mass * all(y))[(0, 0)]
    }
}
