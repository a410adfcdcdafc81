//! Stability of a steady motion by Floquet's theory: disturbances grow where a multiplier of the linearised motion over one cycle is larger than one.
//!
//! The equations of chain, rings and the one absorber are linearised about the motion, A(t) = A0 + V(t) with the mean A0, and V in the rows of that absorber and its hub only. Over one cycle their
//! product is taken from steps exp(A0 dt/2) exp(V dt) exp(A0 dt/2) at some samples of the balance, exact in A0 and of second order in what changes, and extrapolated from
//! twice that step; the steps are halved until that tells. Where nothing holds the chain to the ground, angles are
//! counted from the hub.

use super::balance::{Balance, Steady};
use super::in_time::{InTime, Rows, mean_slopes};
use crate::absorber::Reaction;
use crate::numerics::matrix_exponential::matrix_exponential;
use crate::numerics::matrix_product::{ROWS, multiply, product};
use crate::units::RAD_PER_S_PER_RPM;
use nalgebra::{DMatrix, Schur};
use std::f64::consts::TAU;

/// A multiplier is larger than one beyond this: rounding of the chain's free rotation.
const LARGER: f64 = 1e-6;

/// Steps of so many samples, as long as halving them changes the multiplier by more than this, or by more than a share of its distance from one.
const STRIDES: [usize; 4] = [8, 4, 2, 1];
const SETTLED: f64 = 1e-3;
const FAR: f64 = 10.0;

/// Sweeps for the multipliers.
const MOST_SWEEPS: usize = 10_000;

/// Whether small disturbances of a motion die out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stability {
    /// They do; with the largest multiplier.
    Stable(f64),
    /// They grow by the largest multiplier in a cycle.
    Unstable(f64),
    /// The chain or another absorber has a law that is known by frequency only.
    Unknown,
}

impl Stability {
    /// Whether disturbances may die out.
    pub fn may_last(self) -> bool {
        !matches!(self, Self::Unstable(_))
    }
}

impl Balance<'_> {
    /// Of a motion.
    pub fn stability(&self, steady: &Steady) -> Stability {
        let Some(in_time) = &self.in_time else { return Stability::Unknown };
        let reactions = self.reactions(steady.speed_rpm, (steady.mean_twist, &steady.twist), &steady.hub);
        let shaft_speed = steady.speed_rpm * RAD_PER_S_PER_RPM;
        let sample_seconds = TAU / (self.order_of_cycle() * shaft_speed) / reactions.len() as f64;
        let mean = mean_slopes(&reactions);
        let held = in_time.rows((&mean.0, &mean.1));
        let whole = in_time.whole(&held);
        // exp(A0 dt/2) of steps of so many samples, filled up with zeros to whole groups: products of those are quicker
        let height = whole.nrows().next_multiple_of(ROWS);
        let half_step = |stride: usize| matrix_exponential(&(&whole * (0.5 * stride as f64 * sample_seconds))).resize(height, height, 0.0);
        let fine = half_step(STRIDES[1]);
        let mut largest = f64::INFINITY;
        let mut coarser: Option<f64> = None;
        for (i, stride) in STRIDES.into_iter().enumerate() {
            // the first steps are twice the second ones
            let half = match i {
                0 => product(&fine, &fine),
                1 => fine.clone(),
                _ => half_step(stride),
            };
            let own = multiplier(in_time, &held, reactions.iter().step_by(stride), (half, stride as f64 * sample_seconds));
            if let Some(coarser) = coarser.replace(own) {
                // the error is of second order in the step
                let change = own - coarser;
                largest = if change.is_finite() { own + change / 3.0 } else { f64::INFINITY };
                if change.abs() <= SETTLED && (largest - 1.0).abs() > FAR * change.abs() {
                    break;
                }
            }
        }
        if largest > 1.0 + LARGER { Stability::Unstable(largest) } else { Stability::Stable(largest) }
    }
}

/// The largest multiplier by steps of dt, of which exp(A0 dt/2) is given, at these reactions; `held`: the rows of A0 that they change.
fn multiplier<'r>(
    in_time: &InTime,
    held: &Rows,
    reactions: impl ExactSizeIterator<Item = &'r (Reaction, Reaction)>,
    (half, dt): (DMatrix<f64>, f64),
) -> f64 {
    let (steps, size) = (reactions.len(), 2 * in_time.angles());
    let rows = [size / 2 + in_time.hub, size - 1];
    let full = product(&half, &half);
    let (mut monodromy, mut next) = (half.clone(), DMatrix::zeros(half.nrows(), half.nrows()));
    for (j, (own, torque)) in reactions.enumerate() {
        let mut change = in_time.rows((&own.by, &torque.by));
        for (row, held) in change.iter_mut().zip(held) {
            row.iter_mut().zip(held).for_each(|(now, held)| *now = (*now - held) * dt);
        }
        kick(&mut monodromy, rows, &change);
        multiply(if j + 1 < steps { &full } else { &half }, &monodromy, &mut next);
        std::mem::swap(&mut monodromy, &mut next);
    }
    largest_multiplier(&monodromy.resize(size, size, 0.0), in_time)
}

/// Multiplies from the left by exp of a matrix V of two rows: 1 + phi(V') V with V' the part of V in the columns of these rows, phi(x) = (e^x - 1)/x.
fn kick(matrix: &mut DMatrix<f64>, rows: [usize; 2], change: &Rows) {
    let own = [0, 1].map(|i| rows.map(|j: usize| change[i][j]));
    let product = |a: [[f64; 2]; 2], b: [[f64; 2]; 2]| -> [[f64; 2]; 2] {
        [0, 1].map(|i| [0, 1].map(|j: usize| a[i][0] * b[0][j] + a[i][1] * b[1][j]))
    };
    let (mut phi, mut term) = ([[1.0, 0.0], [0.0, 1.0]], [[1.0, 0.0], [0.0, 1.0]]);
    for k in 2..12 {
        term = product(term, own).map(|r| r.map(|x| x / f64::from(k)));
        for (sum, row) in phi.iter_mut().zip(term) {
            sum.iter_mut().zip(row).for_each(|(sum, x)| *sum += x);
        }
    }
    // of a ring, only slopes by its twist and rate change
    let changed: Vec<usize> = (0..change[0].len()).filter(|j| change.iter().any(|row| row[*j] != 0.0)).collect();
    for mut column in matrix.column_iter_mut() {
        let given = [0, 1].map(|r: usize| changed.iter().map(|j| column[*j] * change[r][*j]).sum::<f64>());
        for (row, phi) in rows.into_iter().zip(phi) {
            column[row] += phi[0] * given[0] + phi[1] * given[1];
        }
    }
}

/// The largest multiplier; in a chain that is free to turn, of angles from the hub.
fn largest_multiplier(monodromy: &DMatrix<f64>, in_time: &InTime) -> f64 {
    let mut matrix = monodromy.clone();
    if in_time.free {
        let hub = in_time.hub;
        // all angles but the twist, the last: the column of the hub's angle is that of turning all, which changes nothing
        for i in (0..in_time.angles() - 1).filter(|i| *i != hub) {
            for j in 0..matrix.ncols() {
                matrix[(i, j)] -= monodromy[(hub, j)];
            }
        }
        matrix = matrix.remove_row(hub).remove_column(hub);
    }
    // growth beyond numbers is growth; the iteration must not go on for ever on what rounding makes of it
    let finite = matrix.iter().all(|x| x.is_finite());
    let schur = if finite { Schur::try_new(matrix, f64::EPSILON, MOST_SWEEPS) } else { None };
    schur.map_or(f64::INFINITY, |s| s.complex_eigenvalues().iter().map(|m| m.norm()).fold(0.0, f64::max))
}
