//! The torsional chain: rigid stations joined by shaft lengths and gears, in a row or as a tree.
//!
//! Every station but the last leads to one after it: to the following one in a row, to any later one in a tree, so that leaves come first and the
//! root last. A gear has the ratio g = speed of a station over that of the station it leads to: the twist of the link is theta - g theta_next, and
//! its torque acts on the next station g times. Angles, torques and stiffnesses are those of their own shaft, not referred to another one.

use super::Difference;
use crate::numerics::{C64, I, ZERO};
use nalgebra::DMatrix;

/// A rigid inertia, with what joins it to the next one and to the ground.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Station {
    /// Unique in the chain.
    pub name: String,
    /// kg m².
    pub inertia: f64,
    /// N m/rad; zero joins nothing.
    pub stiffness_to_next: f64,
    /// N m s/rad.
    pub damping_to_next: f64,
    /// Hysteretic: the shaft's complex stiffness is k (1 + i eta).
    pub loss_factor_to_next: f64,
    /// N m/rad.
    pub stiffness_to_ground: f64,
    /// N m s/rad.
    pub damping_to_ground: f64,
    /// Throws (from 0) whose torque acts here.
    pub throws: Vec<usize>,
    /// How the next station is joined; nothing: it is the following one, without a gear. Boxed: rows are swept faster where stations are small.
    pub joint: Option<Box<Joint>>,
}

/// A link of a tree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
    /// Index of the station that is meant by "next", after this one.
    pub leads_to: usize,
    /// Speed of this station over that of the next, negative where they turn in opposite directions; one without a gear.
    pub gear: f64,
}

/// Stations, leaves first; the last one's `*_to_next` are zero.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// At least one.
    pub stations: Vec<Station>,
}

impl Chain {
    /// Number of stations.
    pub fn len(&self) -> usize {
        self.stations.len()
    }

    /// Never true for a checked chain.
    pub fn is_empty(&self) -> bool {
        self.stations.is_empty()
    }

    /// Index of a station by name.
    pub fn find(&self, name: &str) -> Option<usize> {
        self.stations.iter().position(|s| s.name == name)
    }

    /// Name of a shaft length.
    #[doc(hidden)]
    pub fn shaft_name(&self, shaft: usize) -> String {
        format!("{}-{}", self.stations[shaft].name, self.stations[self.next(shaft)].name)
    }

    /// Index of the station that a station leads to.
    pub fn next(&self, station: usize) -> usize {
        self.stations[station].joint.as_ref().map_or(station + 1, |j| j.leads_to)
    }

    /// Speed of a station over that of the one it leads to.
    #[doc(hidden)]
    pub fn gear(&self, station: usize) -> f64 {
        self.stations[station].joint.as_ref().map_or(1.0, |j| j.gear)
    }

    /// Whether every station leads to the following one, without gears.
    pub fn is_row(&self) -> bool {
        self.stations.iter().all(|s| s.joint.is_none())
    }

    /// Whether there is a gear.
    pub(crate) fn is_geared(&self) -> bool {
        self.stations.iter().any(|s| s.joint.as_ref().is_some_and(|j| j.gear != 1.0))
    }

    /// Twist of the link after a station.
    #[doc(hidden)]
    pub fn link(&self, shaft: usize) -> Difference {
        Difference { from: shaft, to: Some((self.next(shaft), self.gear(shaft))), scale: 1.0 }
    }

    /// Elastic twist between two stations, referred to the crankshaft: angle over speed ratio of the one less that of the other.
    pub(crate) fn between(&self, from: usize, to: usize) -> Difference {
        let (a, b) = self.speed_ratios().map_or((1.0, 1.0), |ratios| (ratios[from], ratios[to]));
        Difference { from, to: Some((to, a / b)), scale: 1.0 / a }
    }

    /// Speed of every station over that of the crankshaft (of the first station where there is no throw); nothing without gears.
    #[doc(hidden)]
    pub fn speed_ratios(&self) -> Option<Vec<f64>> {
        if !self.is_geared() {
            return None;
        }
        let mut over_root = vec![1.0; self.len()];
        for i in (0..self.len() - 1).rev() {
            over_root[i] = self.gear(i) * over_root[self.next(i)];
        }
        let crank = over_root[self.stations.iter().position(|s| !s.throws.is_empty()).unwrap_or(0)];
        Some(over_root.into_iter().map(|speed| speed / crank).collect())
    }

    /// Links from a station to the root.
    fn to_root(&self, station: usize) -> impl Iterator<Item = usize> {
        let last = self.len() - 1;
        std::iter::successors((station < last).then_some(station), move |i| Some(self.next(*i)).filter(|next| *next < last))
    }

    /// Links between two stations, each with what its twist counts for in [`Self::between`].
    pub(crate) fn path(&self, from: usize, to: usize) -> Vec<(usize, f64)> {
        let (mut up, mut down): (Vec<usize>, Vec<usize>) = (self.to_root(from).collect(), self.to_root(to).collect());
        while up.last().is_some() && up.last() == down.last() {
            up.pop();
            down.pop();
        }
        let ratios = self.speed_ratios();
        let weight = |link: usize| ratios.as_ref().map_or(1.0, |r| 1.0 / r[link]);
        up.into_iter().map(|i| (i, weight(i))).chain(down.into_iter().map(|i| (i, -weight(i)))).collect()
    }

    /// Complex stiffness of the shaft after station `shaft` at circular frequency `omega`: k (1 + i eta) + i omega c, N m/rad.
    pub(crate) fn shaft_stiffness(&self, shaft: usize, omega: f64) -> C64 {
        let s = &self.stations[shaft];
        C64::new(s.stiffness_to_next, s.stiffness_to_next * s.loss_factor_to_next + omega * s.damping_to_next)
    }

    /// What ties station `i` to inertial space at `omega`: k + i omega c - omega² J, N m/rad.
    pub(crate) fn ground_stiffness(&self, i: usize, omega: f64) -> C64 {
        let s = &self.stations[i];
        s.stiffness_to_ground - omega * omega * s.inertia + I * (omega * s.damping_to_ground)
    }

    /// Sum of all inertias, kg m²; behind gears each times the square of its speed over that of the crankshaft.
    pub fn total_inertia(&self) -> f64 {
        match self.speed_ratios() {
            None => self.stations.iter().map(|s| s.inertia).sum(),
            Some(ratios) => self.stations.iter().zip(ratios).map(|(s, ratio)| s.inertia * ratio * ratio).sum(),
        }
    }

    /// Inertias, kg m²: the diagonal of J.
    pub fn inertias(&self) -> Vec<f64> {
        self.stations.iter().map(|s| s.inertia).collect()
    }

    /// K, N m/rad (n by n).
    pub fn stiffness_matrix(&self) -> DMatrix<f64> {
        let n = self.len();
        let mut k = DMatrix::zeros(n, n);
        for (i, s) in self.stations.iter().enumerate() {
            k[(i, i)] += s.stiffness_to_ground;
            if i + 1 < n {
                let (next, gear) = (self.next(i), self.gear(i));
                k[(i, i)] += s.stiffness_to_next;
                k[(next, next)] += s.stiffness_to_next * gear * gear;
                k[(i, next)] -= s.stiffness_to_next * gear;
                k[(next, i)] -= s.stiffness_to_next * gear;
            }
        }
        k
    }

    /// C times angles of the stations, which others may follow.
    pub(crate) fn damped(&self, x: &[C64]) -> Vec<C64> {
        let mut damped = vec![ZERO; x.len()];
        for (i, s) in self.stations.iter().enumerate() {
            damped[i] += x[i] * s.damping_to_ground;
            if i + 1 < self.len() {
                let (next, gear) = (self.next(i), self.gear(i));
                let torque = (x[i] - x[next] * gear) * s.damping_to_next;
                damped[i] += torque;
                damped[next] -= torque * gear;
            }
        }
        damped
    }

    /// No less than the norm of M^-1/2 C M^-1/2, with these masses of the stations: its largest sum of a row, 1/s.
    pub(crate) fn largest_damping(&self, masses: &[f64]) -> f64 {
        let mut rows: Vec<f64> = self.stations.iter().zip(masses).map(|(s, m)| s.damping_to_ground / m).collect();
        for (i, s) in self.stations.iter().enumerate().take(self.len() - 1).filter(|s| s.1.damping_to_next != 0.0) {
            let (next, gear) = (self.next(i), self.gear(i).abs());
            let across = s.damping_to_next * gear / (masses[i] * masses[next]).sqrt();
            rows[i] += s.damping_to_next / masses[i] + across;
            rows[next] += s.damping_to_next * gear * gear / masses[next] + across;
        }
        rows.into_iter().fold(0.0, f64::max)
    }

    /// Bodies that no spring ties to the ground: shafts without stiffness cut the chain. Each has one rigid mode.
    pub fn rigid_bodies(&self) -> usize {
        let mut free = 0;
        // whether a spring ties what hangs together with a station, of those before it
        let mut tied = vec![false; self.len()];
        for (i, s) in self.stations.iter().enumerate() {
            tied[i] |= s.stiffness_to_ground > 0.0;
            if i + 1 == self.len() || s.stiffness_to_next == 0.0 {
                free += usize::from(!tied[i]);
            } else {
                let next = self.next(i);
                tied[next] |= tied[i];
            }
        }
        free
    }
}
