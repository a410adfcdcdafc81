//! The crank on bearings that stiffen with the displacement of its journals: its periodic motion at a speed.
//!
//! The mean and the orders act together, so that all harmonics of the cycle up to a limit are solved at once; the flywheel holds the mean torque. Absorbers are linear and add to every harmonic what they do there.

use super::{Assembled, LinearBearings, mean_load};
use crate::absorber::condensed::Condensed as Absorbers;
use crate::absorber::{Mounted, Operating};
use crate::drivetrain::flexible::OnStations;
use crate::engine::cycle::Cycle;
use crate::engine::{Engine, Excitation};
use crate::numerics::block_tridiagonal::Columns;
use crate::numerics::tridiagonal::Singular;
use crate::numerics::{C64, ZERO};
use crate::rotor::exponential_joint::ExponentialJoint;
use crate::rotor::harmonic_balance::{Balanced, Condensed, NotBalanced, balanced, balanced_in_stages, nearest_to};
use crate::rotor::shaft::{Answer, Shaft, Turning};
use crate::units::RAD_PER_S_PER_RPM;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

/// How often linear bearings are replaced by ones nearer to the joints.
const REPETITIONS: usize = 8;

/// Why there is no motion.
#[derive(Debug, Clone, PartialEq)]
pub enum NoMotion {
    /// Nothing damps a resonance that is met exactly, or the torque comes from a table.
    Unbounded,
    /// The method does not come there.
    NotBalanced(NotBalanced),
}

impl std::fmt::Display for NoMotion {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Unbounded => write!(f, "no bounded motion on linear bearings"),
            Self::NotBalanced(why) => why.fmt(f),
        }
    }
}

impl From<Singular> for NoMotion {
    fn from(_: Singular) -> Self {
        Self::Unbounded
    }
}

/// A crank with what acts on it.
#[derive(Debug)]
pub struct OnJoints<'a> {
    /// Put together on linear bearings.
    pub assembled: &'a Assembled,
    /// The same as the stations see it.
    pub crank: OnStations,
    /// Linear bearings it is put together on.
    pub linear: &'a LinearBearings,
    /// Of each point of each bearing that is there.
    pub joints: Vec<ExponentialJoint>,
    /// What drives it.
    pub engine: &'a Engine,
    /// Its orders; the highest is the last harmonic.
    pub excitation: &'a Excitation,
}

/// A periodic motion on joints and on linear bearings.
#[derive(Debug, Clone)]
pub struct OnBoth {
    /// On joints; answers are displacements of the points across the axis (two each), then angles of the stations.
    pub joints: Balanced,
    /// The same answers on linear bearings, by harmonic.
    pub linear: Vec<DVector<C64>>,
}

impl OnJoints<'_> {
    /// Nodes of the points.
    fn points(&self) -> Vec<usize> {
        self.assembled.bearings.concat()
    }

    /// Place of the angles of the stations among the answers.
    pub fn stations(&self) -> usize {
        2 * self.points().len()
    }

    /// The motion at a speed with absorbers, sought from the motion on linear bearings or from one nearby.
    ///
    /// # Errors
    /// [`NoMotion`] where there is none on linear bearings or the method does not come to the joints.
    pub fn at(&self, speed_rpm: f64, design: &[Mounted], nearby: Option<&OnBoth>) -> Result<OnBoth, NoMotion> {
        let given: Vec<[f64; 2]> = self.given();
        let condensed = self.condensed(speed_rpm, design, &given)?;
        let joints = match balanced(&condensed, &self.joints, nearby.map(|n| &n.joints)) {
            Ok(joints) => joints,
            Err(_) => match balanced_in_stages(&condensed, &self.joints) {
                Ok(joints) => joints,
                Err(_) => self.on_nearer_bearings(speed_rpm, design, given)?,
            },
        };
        Ok(OnBoth { joints, linear: condensed.free })
    }

    /// From linear bearings that are near to the joints over their own motion, found by repetition from stiff ones.
    fn on_nearer_bearings(&self, speed_rpm: f64, design: &[Mounted], given: Vec<[f64; 2]>) -> Result<Balanced, NoMotion> {
        let stiff = self.joints.iter().map(|j| [j.stiffness[1], j.damping[1]]);
        let mut linear: Vec<[f64; 2]> = given.into_iter().zip(stiff).map(|(own, stiff)| [0, 1].map(|k| own[k].max(stiff[k]))).collect();
        for _ in 0..REPETITIONS {
            let condensed = self.condensed(speed_rpm, design, &linear)?;
            let near = nearest_to(&condensed, &self.joints);
            for (own, near) in linear.iter_mut().zip(near) {
                // half of the way, by ratios
                (0..2).filter(|k| near[*k] > 0.0).for_each(|k| own[k] = (own[k] * near[k]).sqrt());
            }
        }
        let condensed = self.condensed(speed_rpm, design, &linear)?;
        balanced(&condensed, &self.joints, None).map_err(NoMotion::NotBalanced)
    }

    /// Linear bearings of all points, N/m and N s/m.
    fn given(&self) -> Vec<[f64; 2]> {
        let nodes = &self.assembled.bearings;
        let points_of = |b: usize| (0..nodes[b].len()).map(move |p| self.linear.point(b, p, nodes[b].len()));
        (0..nodes.len()).flat_map(points_of).map(|l| [l.stiffness, l.damping]).collect()
    }

    /// All that is linear, as the points see it on these linear bearings.
    fn condensed(&self, speed_rpm: f64, design: &[Mounted], linear: &[[f64; 2]]) -> Result<Condensed, NoMotion> {
        let mut shaft = self.crank.shaft.clone();
        for ((node, own), given) in self.points().into_iter().zip(linear).zip(self.given()) {
            shaft.bear(node, (own[0] - given[0], own[1] - given[1]));
        }
        let speed = speed_rpm * RAD_PER_S_PER_RPM;
        let first = 2.0 / f64::from(self.engine.strokes) * speed;
        let harmonics = self.excitation.harmonics.last().map_or(0, |h| *h as usize);
        let mean = mean_load(self.assembled, &Cycle::new(self.engine).ok_or(NoMotion::Unbounded)?, speed_rpm);
        let all: Vec<(DVector<C64>, DMatrix<C64>)> = (0..=harmonics)
            .into_par_iter()
            .map(|m| {
                let at = Turning { omega: m as f64 * first, speed };
                let force = match self.excitation.harmonics.iter().position(|h| *h as usize == m) {
                    _ if m == 0 => mean.clone(),
                    Some(order) => self.crank.forces(self.engine, self.excitation, (order, speed_rpm)),
                    None => DVector::from_element(mean.len(), ZERO),
                };
                self.harmonic((&shaft, at), &force, design)
            })
            .collect::<Result<_, _>>()?;
        let (free, per_force) = all.into_iter().unzip();
        Ok(Condensed { speed, first, free, per_force, linear: linear.to_vec() })
    }

    /// Answers under a load and per unit force on each point in each direction, with absorbers.
    fn harmonic(
        &self,
        (shaft, at): (&Shaft, Turning),
        force: &DVector<C64>,
        design: &[Mounted],
    ) -> Result<(DVector<C64>, DMatrix<C64>), NoMotion> {
        let (points, stations) = (self.points(), &self.crank.stations);
        // the absorbers turn with the mean as if they were not there
        let sums: Vec<(usize, C64)> = if at.omega == 0.0 {
            Vec::new()
        } else {
            let hubs = Absorbers::new(design, Operating { omega: at.omega, shaft_speed: at.speed }).hubs;
            hubs.iter().map(|h| (h.station, h.numerator / h.denominator)).collect()
        };
        let forces = 1 + 2 * points.len();
        let mut x = vec![Columns::zeros(forces + sums.len()); shaft.len()];
        for (i, own) in x.iter_mut().enumerate() {
            (0..6).for_each(|k| own[(k, 0)] = force[6 * i + k]);
        }
        for (p, node) in points.iter().enumerate() {
            (0..2).for_each(|k| x[*node][(k, 1 + 2 * p + k)] = C64::from(1.0));
        }
        for (a, (station, _)) in sums.iter().enumerate() {
            for (node, k, factor) in shaft.rotation(stations[*station]) {
                x[node][(k, forces + a)] += C64::from(factor);
            }
        }
        if at.omega == 0.0 {
            let mut held = shaft.clone();
            held.hold_rotation(stations[stations.len() - 1]);
            held.factored(at)?.solve(&mut x)?;
        } else {
            shaft.factored(at)?.solve(&mut x)?;
        }
        let displacements = points.iter().flat_map(|node| [vec![(*node, 0, 1.0)], vec![(*node, 1, 1.0)]]);
        let asked: Vec<Answer> = displacements.chain(stations.iter().map(|node| shaft.rotation(*node))).collect();
        let mut y = DMatrix::from_fn(asked.len(), forces + sums.len(), |i, j| {
            asked[i].iter().map(|(node, k, factor)| x[*node][(*k, j)] * *factor).sum()
        });
        if !sums.is_empty() {
            // torques of the absorbers: (1 + H Z) theta = theta_0 with H of their stations
            let row = |a: usize| 2 * points.len() + sums[a].0;
            let n = sums.len();
            let matrix = DMatrix::from_fn(n, n, |a, b| y[(row(a), forces + b)] * sums[b].1 + if a == b { C64::from(1.0) } else { ZERO });
            let angles = DMatrix::from_fn(n, forces, |a, j| y[(row(a), j)]);
            let moved = matrix.lu().solve(&angles).ok_or(NoMotion::Unbounded)?;
            let torques = DMatrix::from_fn(n, forces, |a, j| sums[a].1 * moved[(a, j)]);
            let change = y.columns(forces, n) * torques;
            let mut own = y.columns_mut(0, forces);
            own -= change;
        }
        Ok((y.column(0).into_owned(), y.columns(1, forces - 1).into_owned()))
    }
}
