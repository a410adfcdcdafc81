//! A shaft put together from beams, bodies and bearings, and its dynamic stiffness at an order and a speed.

use super::beam::{Beam, blocks};
use super::body::Body;
use super::{Real, across, cross};
use crate::numerics::C64;
use crate::numerics::block_tridiagonal::{Block, Columns, Factored, factor};
use crate::numerics::tridiagonal::Singular;
use nalgebra::{DMatrix, DVector, SVector, Vector3};

/// Motion of a node, or what acts on it.
pub type Six = SVector<f64, 6>;

/// Where a shaft turns and oscillates, rad/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turning {
    /// Of the oscillation.
    pub omega: f64,
    /// Of the shaft.
    pub speed: f64,
}

/// How a beam dissipates: its stiffness is K (1 + i eta + i omega tau).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dissipation {
    /// eta.
    pub loss_factor: f64,
    /// tau, s.
    pub time: f64,
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
    /// Of the nodes, m.
    pub places: Vec<Vector3<f64>>,
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
            places,
        }
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

    /// Centrifugal forces and moments of all masses as they are drawn, per square of the speed.
    pub fn unbalance(&self) -> Vec<Six> {
        let places: Vec<Six> = self.places.iter().map(|p| Six::new(p.x, p.y, 0.0, 0.0, 0.0, 0.0)).collect();
        let unbalance_at = |i: usize| {
            let mut sum = self.mass.own[i] * places[i] + self.beside[i];
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

    /// Leaves out what rotation does: G, C_s and K_s + Kc - Z.
    pub(crate) fn without_rotation(&mut self) {
        (self.gyroscopic, self.turning) = (Row::new(self.places.len()), Row::new(self.places.len()));
        self.circulatory.fill(Real::zeros());
    }

    /// How many nodes.
    // never none
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// The dynamic stiffness, factored.
    ///
    /// # Errors
    /// [`Singular`] at an undamped resonance, and where nothing holds the shaft.
    pub(crate) fn factored(&self, at: Turning) -> Result<Factored, Singular> {
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
        factor((0..n).map(diagonal_block).collect(), &upper, lower)
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

    /// M over all unknowns.
    pub fn mass_matrix(&self) -> DMatrix<f64> {
        self.mass.dense(1.0)
    }

    /// K over all unknowns, bearings included.
    pub fn stiffness_matrix(&self) -> DMatrix<f64> {
        self.stiffness.dense(1.0)
    }

    /// G over all unknowns.
    pub fn gyroscopic_matrix(&self) -> DMatrix<f64> {
        self.gyroscopic.dense(-1.0)
    }

    /// K_s + Kc - Z over all unknowns.
    pub fn turning_matrix(&self) -> DMatrix<f64> {
        self.turning.dense(1.0)
    }

    /// C_s over all unknowns.
    pub fn circulatory_matrix(&self) -> DMatrix<f64> {
        Row { own: self.circulatory.clone(), next: vec![Real::zeros(); self.len() - 1] }.dense(1.0)
    }

    /// C over all unknowns.
    pub fn damping_matrix(&self) -> DMatrix<f64> {
        self.damping.dense(1.0)
    }

    /// Loss factors times stiffness, over all unknowns.
    pub fn loss_matrix(&self) -> DMatrix<f64> {
        self.loss.dense(1.0)
    }

    /// Unknowns that move.
    pub fn free(&self) -> Vec<usize> {
        (0..6 * self.len()).filter(|i| !self.held[i / 6][i % 6]).collect()
    }

    /// Motion of the nodes when the shaft turns as a rigid body by a unit about the axis.
    pub fn rigid_rotation(&self) -> Vec<Six> {
        self.places.iter().map(|p| Six::new(-p.y, p.x, 0.0, 0.0, 0.0, 1.0)).collect()
    }

    /// x' M y of some nodes' motions.
    pub fn kinetic(&self, x: &[Six], y: &[Six]) -> f64 {
        let own = (0..self.len()).map(|i| x[i].dot(&(self.mass.own[i] * y[i]))).sum::<f64>();
        let across = |i: usize| x[i].dot(&(self.mass.next[i] * y[i + 1])) + y[i].dot(&(self.mass.next[i] * x[i + 1]));
        own + (0..self.len() - 1).map(across).sum::<f64>()
    }
}
