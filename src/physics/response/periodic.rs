//! Steady motion in time: the periodic state of a linear step, found directly instead of by marching through the transient.
//!
//! A step takes the state z = (angles, rates) and the torques F at both its ends to the next state, z' = A z + B F + D F'. Over a cycle
//! of N steps z_N = A^N z_0 + w, and z_N = z_0 gives z_0. Order zero is left out of the torque; bodies without elastic path to the ground have
//! no angle of their own, and of all periodic motions the one with the smallest state is taken: the others differ by a constant angle.

use super::bodies::Bodies;
use super::power::Power;
use super::{Quantity, ResponseError};
use crate::drivetrain::System;
use crate::numerics::C64;
use crate::numerics::elementary::turn;
use crate::numerics::harmonics::Analyser;
use crate::units::RAD_PER_S_PER_RPM;
use nalgebra::{DMatrix, DVector};

/// One step of an integrator.
#[derive(Debug, Clone)]
pub struct Step {
    /// A.
    pub state: DMatrix<f64>,
    /// B.
    pub now: DMatrix<f64>,
    /// D.
    pub next: DMatrix<f64>,
}

/// Powers of dense matrices of twice this size are as much as can be waited for.
const MOST_BODIES: usize = 256;
/// A stiffness to the ground below this share of the largest stiffness is rounding.
const FREE: f64 = 1e-12;
/// A motion that misses its own start by more than this share of it is not periodic.
const CLOSED: f64 = 1e-6;

/// Refuses what time integration cannot take: loss factors, which have no meaning in time, and too few samples for the highest order.
///
/// # Errors
/// [`ResponseError::NotApplicable`].
pub fn check(method: &'static str, system: &System, bodies: &Bodies, steps: usize) -> Result<(), ResponseError> {
    if !bodies.laws.is_empty() {
        return Err(ResponseError::NotApplicable { method, why: "the law of an absorber depends on frequency or speed" });
    }
    if system.chain.is_geared() {
        return Err(ResponseError::NotApplicable { method, why: "the free motion of geared shafts is not one common angle" });
    }
    if bodies.hysteresis.amax() > 0.0 {
        return Err(ResponseError::NotApplicable { method, why: "loss factors have no meaning in time" });
    }
    if bodies.len() > MOST_BODIES {
        return Err(ResponseError::NotApplicable { method, why: "the matrices of so many bodies are too large" });
    }
    if bodies.inertia.contains(&0.0) {
        return Err(ResponseError::NotApplicable { method, why: "a body has no inertia" });
    }
    if 2 * system.excitation.harmonics.iter().max().copied().unwrap_or(0) as usize >= steps {
        return Err(ResponseError::NotApplicable { method, why: "the steps are too few for the highest order" });
    }
    Ok(())
}

/// Seconds of a working cycle at a speed.
pub(crate) fn cycle_seconds(system: &System, speed_rpm: f64) -> f64 {
    let first = system.excitation.orders[0].value() / f64::from(system.excitation.harmonics[0]);
    std::f64::consts::TAU / (first * speed_rpm * RAD_PER_S_PER_RPM)
}

/// A periodic motion at the samples of a cycle.
#[derive(Debug, Clone)]
pub struct Motion {
    /// Angles, then rates.
    pub states: Vec<DVector<f64>>,
    /// Torque on every body, N m.
    pub torques: Vec<DVector<f64>>,
}

/// The periodic motion at one speed in `steps` steps.
///
/// # Errors
/// [`ResponseError::Unbounded`] where there is no periodic state, [`ResponseError::NotApplicable`] where it cannot be found.
pub fn motion(
    method: &'static str,
    system: &System,
    bodies: &Bodies,
    speed_rpm: f64,
    steps: usize,
    step: &Step,
) -> Result<Motion, ResponseError> {
    let n = bodies.len();
    let torques: Vec<DVector<f64>> = torques(system, n, speed_rpm, steps);
    let next = |z: &DVector<f64>, j: usize| &step.state * z + &step.now * &torques[j] + &step.next * &torques[(j + 1) % steps];
    // from rest: what the torque alone leaves after a cycle
    let mut left = DVector::zeros(2 * n);
    for j in 0..steps {
        left = next(&left, j);
    }
    let cycle = power(&step.state, steps);
    let unbounded = || ResponseError::unbounded(system.excitation.orders[0], speed_rpm);
    let mut state = closed(bodies, &cycle, &left).ok_or_else(unbounded)?;
    let start = state.clone();
    let mut states = Vec::with_capacity(steps);
    for j in 0..steps {
        let after = next(&state, j);
        states.push(std::mem::replace(&mut state, after));
    }
    if (&state - &start).amax() > CLOSED * start.amax() {
        let why = "the motion does not close after a cycle: a mode is too stiff or too little damped for the digits of the step";
        return Err(ResponseError::NotApplicable { method, why });
    }
    Ok(Motion { states, torques })
}

impl Motion {
    /// Phasors of a quantity, for all orders.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where they are not finite.
    pub fn phasors(&self, system: &System, bodies: &Bodies, quantity: Quantity, speed_rpm: f64) -> Result<Vec<C64>, ResponseError> {
        let n = bodies.len();
        let between = bodies.between(&system.chain, quantity);
        let shaft = if let Quantity::ShaftTorque(s) = quantity { Some(&system.chain.stations[s]) } else { None };
        let output = |z: &DVector<f64>| {
            let twist = between.of(|body| z[body]);
            let rate = between.of(|body| z[n + body]);
            shaft.map_or(twist, |s| s.stiffness_to_next * twist + s.damping_to_next * rate)
        };
        let outputs: Vec<f64> = self.states.iter().map(output).collect();
        let mut found = Analyser::new(outputs.len(), &system.excitation.harmonics).analyse(&outputs);
        found.iter_mut().zip(&system.excitation.orders).for_each(|(y, order)| *y = quantity.of_angle(*y, order.omega(speed_rpm)));
        if found.iter().all(|y| y.is_finite()) { Ok(found) } else { Err(ResponseError::unbounded(system.excitation.orders[0], speed_rpm)) }
    }

    /// Power by the means of the samples.
    pub fn power(&self, bodies: &Bodies) -> Power {
        let sample = |(z, torque): (&DVector<f64>, &DVector<f64>)| power_of(bodies, z, torque);
        mean(self.states.iter().zip(&self.torques).map(sample), self.states.len())
    }
}

/// Power of a state under a torque.
pub(crate) fn power_of(bodies: &Bodies, state: &DVector<f64>, torque: &DVector<f64>) -> Power {
    let rates = state.rows(bodies.len(), bodies.len());
    Power { input: rates.dot(torque), dissipated: rates.dot(&(&bodies.damping * rates)) }
}

/// Sum of powers over a count.
pub fn mean(powers: impl Iterator<Item = Power>, count: usize) -> Power {
    let sum = powers.fold(Power::default(), |a, b| Power { input: a.input + b.input, dissipated: a.dissipated + b.dissipated });
    Power { input: sum.input / count as f64, dissipated: sum.dissipated / count as f64 }
}

/// The state z with z = cycle z + left. Each group of bodies without elastic path to the ground leaves its common angle open: the system is
/// bordered by that direction and by the momentum that the group's torque changes, which closes both its eigenvalues at one.
fn closed(bodies: &Bodies, cycle: &DMatrix<f64>, left: &DVector<f64>) -> Option<DVector<f64>> {
    let n = bodies.len();
    let groups = free_groups(bodies);
    let size = 2 * n + groups.len();
    let mut bordered = DMatrix::zeros(size, size);
    bordered.view_mut((0, 0), (2 * n, 2 * n)).copy_from(&(DMatrix::identity(2 * n, 2 * n) - cycle));
    for (g, group) in groups.iter().enumerate() {
        for &body in group {
            bordered[(2 * n + g, body)] = 1.0;
            bordered[(n + body, 2 * n + g)] += bodies.inertia[body];
            for i in 0..n {
                bordered[(i, 2 * n + g)] += bodies.damping[(i, body)];
            }
        }
    }
    let right = DVector::from_fn(size, |i, _| if i < 2 * n { left[i] } else { 0.0 });
    let found = bordered.full_piv_lu().solve(&right)?;
    Some(found.rows(0, 2 * n).into_owned()).filter(|z| z.iter().all(|x| x.is_finite()))
}

/// Bodies joined by springs, where none of a group is tied to the ground.
fn free_groups(bodies: &Bodies) -> Vec<Vec<usize>> {
    let (n, largest) = (bodies.len(), bodies.stiffness.amax());
    let mut group: Vec<usize> = (0..n).collect();
    for i in 0..n {
        for j in 0..i {
            if bodies.stiffness[(i, j)] != 0.0 && group[i] != group[j] {
                let (from, to) = (group[i], group[j]);
                group.iter_mut().filter(|g| **g == from).for_each(|g| *g = to);
            }
        }
    }
    let mut groups: Vec<Vec<usize>> = (0..n).map(|g| (0..n).filter(|i| group[*i] == g).collect()).collect();
    // what is left of a row of the stiffness ties its body to the ground
    groups.retain(|members| !members.is_empty() && members.iter().all(|i| bodies.stiffness.row(*i).sum().abs() <= FREE * largest));
    groups
}

/// Torque on every body at every sample of the cycle, without its mean, N m.
fn torques(system: &System, bodies: usize, speed_rpm: f64, steps: usize) -> Vec<DVector<f64>> {
    let stations = system.chain.len();
    let mut orders = vec![vec![C64::default(); stations]; system.orders()];
    for (n, row) in orders.iter_mut().enumerate() {
        system.torque(n, speed_rpm, row);
    }
    let turn: Vec<C64> = (0..steps).map(|j| turn(std::f64::consts::TAU * j as f64 / steps as f64)).collect();
    let torque_at = |j: usize, station: usize| -> f64 {
        orders.iter().zip(&system.excitation.harmonics).map(|(row, h)| (row[station] * turn[(j * *h as usize) % steps]).re).sum()
    };
    (0..steps).map(|j| DVector::from_fn(bodies, |i, _| if i < stations { torque_at(j, i) } else { 0.0 })).collect()
}

/// A matrix to a whole power, by squaring.
fn power(matrix: &DMatrix<f64>, mut exponent: usize) -> DMatrix<f64> {
    let mut result = DMatrix::identity(matrix.nrows(), matrix.ncols());
    let mut square = matrix.clone();
    while exponent > 0 {
        if exponent % 2 == 1 {
            result = &result * &square;
        }
        square = &square * &square;
        exponent /= 2;
    }
    result
}
