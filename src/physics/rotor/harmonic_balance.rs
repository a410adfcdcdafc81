//! Periodic motion of a shaft on joints that are not linear, by harmonic balance.
//!
//! All that is linear is condensed onto the points of the joints exactly: with x0 the motion there on linear bearings, H the motion per unit force and f, f_lin the forces of joints and linear bearings,
//! every harmonic obeys x = x0 - H (f(x) - f_lin(x)). Forces are taken at samples of the cycle and analysed into harmonics; Newton's method with \[Saad & Schultz 1986\]
//! for its steps solves it, in axes that turn with the shaft.

use super::exponential_joint::ExponentialJoint;
use super::waves::{Rows, Waves};
use crate::numerics::C64;
use crate::numerics::elementary::Elementary;
use crate::numerics::gmres::gmres;
use nalgebra::{DMatrix, DVector};

/// Balanced: the largest residual over the reach of the joints.
const CLOSE: f64 = 1e-10;
/// Steps of Newton's method, and products for each.
const STEPS: usize = 60;
const PRODUCTS: usize = 300;
/// Products of all steps: what takes more is given up.
const MOST_PRODUCTS: usize = 8000;
/// What is left of a residual by a step's linear system.
const SOLVED: f64 = 1e-3;
/// Shortest share of a step, and of the way from linear bearings to joints.
const SHORTEST: f64 = 1.0 / 64.0;
/// Beyond this displacement over the reach a law that grows without end tells nothing of a bearing near to it.
const FARTHEST: f64 = 1.2;

/// A shaft on linear bearings as the points of its joints see it, by harmonics of its cycle from the mean on.
#[derive(Debug, Clone)]
pub struct Condensed {
    /// Of the shaft, rad/s.
    pub speed: f64,
    /// Of the first harmonic, rad/s.
    pub first: f64,
    /// Answers without joints: first both displacements of each point, m, then whatever else is asked.
    pub free: Vec<DVector<C64>>,
    /// Answers per unit force on both directions of each point, a column each.
    pub per_force: Vec<DMatrix<C64>>,
    /// N/m and N s/m of the linear bearing on each point.
    pub linear: Vec<[f64; 2]>,
}

/// A periodic motion on joints.
#[derive(Debug, Clone)]
pub struct Balanced {
    /// Answers by harmonic.
    pub answers: Vec<DVector<C64>>,
    /// Displacement over reach of each point at the samples of a cycle, the largest.
    pub largest: f64,
    /// Steps of Newton's method.
    pub steps: usize,
    /// Products with its matrix.
    pub products: usize,
    /// Stages from linear bearings to the joints; one where Newton's method went there at once.
    pub stages: usize,
    /// Largest residual over reach.
    pub residual: f64,
    /// Largest displacement of any of the upper sixth of the harmonics over reach: what is left out is several times as large.
    pub last: f64,
    /// Of each point, N/m and N s/m: the linear bearing whose force differs least from the joint's over the cycle (least squares).
    pub equivalent: Vec<[f64; 2]>,
}

/// A motion that was not found.
#[derive(Debug, Clone, PartialEq)]
pub struct NotBalanced {
    /// Steps of Newton's method until then.
    pub steps: usize,
    /// Largest residual over reach.
    pub residual: f64,
    /// How far from linear bearings (0) to joints (1) it came.
    pub share: f64,
}

impl std::fmt::Display for NotBalanced {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { steps, residual, share } = self;
        if !residual.is_finite() {
            return write!(f, "harmonic balance does not converge: on linear bearings journals go far beyond the joints' reach");
        }
        write!(
            f,
            "harmonic balance does not converge: residual {residual:.1e} of the joints' reach after {steps} steps, {share:.3} of the way from linear bearings"
        )
    }
}

struct Problem<'a> {
    condensed: &'a Condensed,
    joints: &'a [ExponentialJoint],
    reach: f64,
    waves: Waves,
    free: Rows,
}

/// Forces at samples, and their derivatives by point: by displacement (2 × 2) and velocity.
struct Sampled {
    forces: DMatrix<f64>,
    slopes: Vec<([[f64; 2]; 2], f64)>,
    largest: f64,
}

/// Amplitudes of one unknown at a harmonic as rows.
fn put(rows: &mut Rows, harmonic: usize, column: usize, value: C64) {
    rows[(harmonic, column)] = value.re;
    if harmonic > 0 {
        let last = rows.nrows() / 2;
        rows[(last + harmonic, column)] = value.im;
    }
}

fn get(rows: &Rows, harmonic: usize, column: usize) -> C64 {
    C64::new(rows[(harmonic, column)], if harmonic > 0 { rows[(rows.nrows() / 2 + harmonic, column)] } else { 0.0 })
}

/// Displacements of points among answers by harmonic, as rows.
fn displacements(answers: &[DVector<C64>], unknowns: usize) -> Rows {
    let mut rows = Rows::zeros(2 * answers.len() - 1, unknowns);
    for (m, x) in answers.iter().enumerate() {
        (0..unknowns).for_each(|i| put(&mut rows, m, i, x[i]));
    }
    rows
}

impl<'a> Problem<'a> {
    fn new(condensed: &'a Condensed, joints: &'a [ExponentialJoint]) -> Self {
        let free = displacements(&condensed.free, 2 * joints.len());
        let reach = joints.iter().map(|j| j.reach).fold(f64::INFINITY, f64::min);
        Self { condensed, joints, reach, waves: Waves::new(condensed.free.len() - 1), free }
    }

    /// Velocities in axes that stand still, along those that turn.
    fn velocity(&self, x: &Rows) -> Rows {
        let (first, speed) = (self.condensed.first, self.condensed.speed);
        let mut v = Rows::zeros(x.nrows(), x.ncols());
        for column in 0..x.ncols() {
            // across the axis: -Omega of the other for the first, Omega for the second
            let (other, sign) = if column % 2 == 0 { (column + 1, -1.0) } else { (column - 1, 1.0) };
            for m in 0..self.condensed.free.len() {
                let rate = C64::new(0.0, m as f64 * first) * get(x, m, column);
                put(&mut v, m, column, rate + get(x, m, other) * (sign * speed));
            }
        }
        v
    }

    /// Joints' forces less those of the linear bearings, at samples; `share` of them.
    fn sampled(&self, x: &Rows, share: f64) -> Sampled {
        let (z, v) = (self.waves.to_samples(x), self.waves.to_samples(&self.velocity(x)));
        let mut sampled = Sampled {
            forces: DMatrix::zeros(z.nrows(), z.ncols()),
            slopes: Vec::with_capacity(z.nrows() * self.joints.len()),
            largest: 0.0,
        };
        for (p, (joint, [k, c])) in self.joints.iter().zip(&self.condensed.linear).enumerate() {
            for j in 0..z.nrows() {
                let (at, rate) = ([z[(j, 2 * p)], z[(j, 2 * p + 1)]], [v[(j, 2 * p)], v[(j, 2 * p + 1)]]);
                let found = joint.at(at, rate);
                for i in 0..2 {
                    sampled.forces[(j, 2 * p + i)] = share * (found.force[i] - k * at[i] - c * rate[i]);
                }
                let [[xx, xy], [yx, yy]] = found.by_displacement;
                sampled.slopes.push(([[share * (xx - k), share * xy], [share * yx, share * (yy - k)]], share * (found.by_velocity - c)));
                sampled.largest = sampled.largest.max(at[0].hypotenuse(at[1]) / joint.reach);
            }
        }
        sampled
    }

    /// x less what forces at samples do to it.
    fn moved(&self, x: &Rows, forces: &DMatrix<f64>) -> Rows {
        let rows = self.waves.to_rows(forces);
        let mut out = x.clone();
        for (m, per_force) in self.condensed.per_force.iter().enumerate() {
            let force = DVector::from_fn(x.ncols(), |i, _| get(&rows, m, i));
            let motion = per_force.rows(0, x.ncols()) * force;
            for (i, moved) in motion.iter().enumerate() {
                put(&mut out, m, i, get(x, m, i) + moved);
            }
        }
        out
    }

    /// The motion on linear bearings, that of each point no farther than the reach of its joint: beyond it the law grows without end, and a step of Newton's method comes back by little.
    fn within_reach(&self) -> Rows {
        let (mut x, z) = (self.free.clone(), self.waves.to_samples(&self.free));
        for (p, joint) in self.joints.iter().enumerate() {
            let farthest = (0..z.nrows()).map(|j| z[(j, 2 * p)].hypotenuse(z[(j, 2 * p + 1)])).fold(joint.reach, f64::max);
            x.columns_mut(2 * p, 2).scale_mut(joint.reach / farthest);
        }
        x
    }

    fn residual(&self, x: &Rows, share: f64) -> (Rows, Sampled) {
        let sampled = self.sampled(x, share);
        (self.moved(x, &sampled.forces) - &self.free, sampled)
    }

    /// Product with the matrix of Newton's method.
    fn product(&self, slopes: &[([[f64; 2]; 2], f64)], x: &Rows) -> Rows {
        let (z, v) = (self.waves.to_samples(x), self.waves.to_samples(&self.velocity(x)));
        let n = z.nrows();
        let mut forces = DMatrix::zeros(n, z.ncols());
        for p in 0..self.joints.len() {
            for (j, (by, rate)) in slopes[p * n..(p + 1) * n].iter().enumerate() {
                let at = [z[(j, 2 * p)], z[(j, 2 * p + 1)]];
                for i in 0..2 {
                    forces[(j, 2 * p + i)] = by[i][0] * at[0] + by[i][1] * at[1] + rate * v[(j, 2 * p + i)];
                }
            }
        }
        self.moved(x, &forces)
    }

    /// Newton's method from a motion, counting steps and products; the motion and its residual, or the residual where it comes no further.
    fn solve(&self, mut x: Rows, share: f64, work: &mut (usize, usize)) -> Result<(Rows, f64), f64> {
        let shape = (x.nrows(), x.ncols());
        let (mut residual, mut sampled) = self.residual(&x, share);
        for _ in 0..STEPS {
            let size = residual.amax() / self.reach;
            if size <= CLOSE {
                return Ok((x, size));
            }
            if work.1 > MOST_PRODUCTS {
                return Err(size);
            }
            let slopes = &sampled.slopes;
            let rows = |y: &DVector<f64>| Rows::from_column_slice(shape.0, shape.1, y.as_slice());
            let (step, products) = gmres(|y| flat(self.product(slopes, &rows(y))), &-flat(residual.clone()), SOLVED, PRODUCTS);
            *work = (work.0 + 1, work.1 + products);
            let step = rows(&step);
            let mut length = 1.0;
            let found = loop {
                let there = &x + &step * length;
                let (r, s) = self.residual(&there, share);
                if r.norm() < residual.norm() * (1.0 - 1e-4 * length) {
                    break Some((there, r, s));
                }
                length *= 0.5;
                if length < SHORTEST {
                    break None;
                }
            };
            let Some((there, r, s)) = found else { return Err(size) };
            (x, residual, sampled) = (there, r, s);
        }
        Err(residual.amax() / self.reach)
    }
}

fn flat(rows: Rows) -> DVector<f64> {
    DVector::from_vec(rows.data.into())
}

/// The motion on joints, one for each point, by Newton's method from the motion on linear bearings or from one nearby.
///
/// # Errors
/// [`NotBalanced`] where it does not come there.
pub fn balanced(condensed: &Condensed, joints: &[ExponentialJoint], nearby: Option<&Balanced>) -> Result<Balanced, NotBalanced> {
    let problem = Problem::new(condensed, joints);
    let mut work = (0, 0);
    let start = nearby.map_or_else(|| problem.within_reach(), |n| displacements(&n.answers, 2 * joints.len()));
    match problem.solve(start, 1.0, &mut work) {
        Ok((x, residual)) => Ok(problem.found(&x, residual, (work, 1))),
        Err(residual) => Err(NotBalanced { steps: work.0, residual, share: 0.0 }),
    }
}

/// The same in stages from linear bearings to the joints.
///
/// # Errors
/// [`NotBalanced`] where it does not come there.
pub(crate) fn balanced_in_stages(condensed: &Condensed, joints: &[ExponentialJoint]) -> Result<Balanced, NotBalanced> {
    let problem = Problem::new(condensed, joints);
    let mut work = (0, 0);
    match problem.in_stages(&mut work) {
        Ok((x, residual, stages)) => Ok(problem.found(&x, residual, (work, stages))),
        Err((residual, share)) => Err(NotBalanced { steps: work.0, residual, share }),
    }
}

/// Linear bearings nearest to joints over the motion on the linear bearings that are there, N/m and N s/m of each point; displacements count up to [`FARTHEST`] of the reach.
pub(crate) fn nearest_to(condensed: &Condensed, joints: &[ExponentialJoint]) -> Vec<[f64; 2]> {
    let problem = Problem::new(condensed, joints);
    problem.equivalent(&problem.free)
}

/// A motion, its residual and how many stages led to it.
type Reached = (Rows, f64, usize);

impl Problem<'_> {
    /// From linear bearings to the joints in stages; the residual and the share of the way where that fails.
    fn in_stages(&self, work: &mut (usize, usize)) -> Result<Reached, (f64, f64)> {
        let (mut share, mut step, mut stages) = (0.0, 0.25f64, 0);
        let mut x = self.within_reach();
        loop {
            let to = f64::min(share + step, 1.0);
            match self.solve(x.clone(), to, work) {
                Ok((there, residual)) => {
                    (x, share, stages) = (there, to, stages + 1);
                    if share == 1.0 {
                        return Ok((x, residual, stages));
                    }
                    step *= 1.5;
                }
                Err(residual) => {
                    step *= 0.5;
                    if step < SHORTEST || work.1 > MOST_PRODUCTS {
                        return Err((residual, share));
                    }
                }
            }
        }
    }

    fn found(&self, x: &Rows, residual: f64, ((steps, products), stages): ((usize, usize), usize)) -> Balanced {
        let sampled = self.sampled(x, 1.0);
        let rows = self.waves.to_rows(&sampled.forces);
        let harmonics = self.condensed.free.len();
        let answer = |m: usize| {
            let force = DVector::from_fn(x.ncols(), |i, _| get(&rows, m, i));
            &self.condensed.free[m] - &self.condensed.per_force[m] * force
        };
        let answers: Vec<DVector<C64>> = (0..harmonics).map(answer).collect();
        let upper = (harmonics - harmonics.div_ceil(6).min(harmonics - 1))..harmonics;
        let last =
            upper.flat_map(|m| (0..x.ncols()).map(move |i| (m, i))).map(|(m, i)| get(x, m, i).norm()).fold(0.0, f64::max) / self.reach;
        Balanced { answers, largest: sampled.largest, steps, products, stages, residual, last, equivalent: self.equivalent(x) }
    }

    /// Linear bearings nearest to the joints over the cycle: k and c of least squares of f on z and v.
    fn equivalent(&self, x: &Rows) -> Vec<[f64; 2]> {
        let (z, v) = (self.waves.to_samples(x), self.waves.to_samples(&self.velocity(x)));
        let linear_fit = |(p, joint): (usize, &ExponentialJoint)| {
            let (mut zz, mut zv, mut vv, mut fz, mut fv) = (0.0, 0.0, 0.0, 0.0, 0.0);
            for j in 0..z.nrows() {
                let (at, rate) = ([z[(j, 2 * p)], z[(j, 2 * p + 1)]], [v[(j, 2 * p)], v[(j, 2 * p + 1)]]);
                // farther off as at the farthest
                let size = at[0].hypotenuse(at[1]) / (FARTHEST * joint.reach);
                let f = match size > 1.0 {
                    true => joint.at(at.map(|z| z / size), rate.map(|v| v / size)).force.map(|f| f * size),
                    false => joint.at(at, rate).force,
                };
                for i in 0..2 {
                    zz += at[i] * at[i];
                    zv += at[i] * rate[i];
                    vv += rate[i] * rate[i];
                    fz += f[i] * at[i];
                    fv += f[i] * rate[i];
                }
            }
            let det = zz * vv - zv * zv;
            // in uniform motion along a circle, or at rest, displacement and velocity tell the same
            if det > 1e-12 * zz * vv {
                [(fz * vv - fv * zv) / det, (fv * zz - fz * zv) / det]
            } else {
                [joint.stiffness[0], joint.damping[0]]
            }
        };
        self.joints.iter().enumerate().map(linear_fit).collect()
    }
}
