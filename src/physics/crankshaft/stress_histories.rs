//! Stress histories of the locations, for multiaxial criteria: the sum of stresses per unit load over the cycle. Bending comes from the loads of the crank, which no absorber
//! changes; torque from the chain.
//!
//! A fillet with factors of nominal stress has a plane state: bending along the fillet's meridian and shear by torque, of which criteria ask for the corners only. A fillet
//! with stresses per unit load from elsewhere has any tensor, and keeps all samples.

use super::CriticalLocation;
use super::loads::Section;
use super::path_bounds::PathBounds;
use super::speed_table::At;
use super::web_paths::WebPath;
use crate::fatigue::multiaxial::bound::Within;
use crate::fatigue::multiaxial::outline::{self, Row};
use crate::fatigue::multiaxial::plane_state::Points;
use crate::fatigue::multiaxial::{Criterion, Grid, History, Limits, PlaneState, Shear, Undefined, evaluate};
use crate::numerics::C64;
use crate::numerics::periodic_sums::PeriodicSums;
use hartog_kernel::kernel;
use std::cell::OnceCell;

/// Samples that ranges are taken of together.
const BLOCK: usize = 16;

/// What a location bears over the cycle.
pub(crate) enum Path {
    /// Bending and torsion of a nominal state.
    Plane(PlaneState),
    /// Any tensor.
    General(History),
}

/// The torque of a shaft over the cycle: what is asked for is found once.
#[derive(Debug)]
pub(crate) struct SampledTorque<'a> {
    histories: &'a Histories,
    phasors: &'a [C64],
    mean: f64,
    values: OnceCell<Vec<f64>>,
    row: OnceCell<Row>,
}

impl SampledTorque<'_> {
    /// At every sample, mean included, N m.
    fn values(&self) -> &[f64] {
        self.values.get_or_init(|| {
            let mut values = Vec::new();
            self.histories.sums.at(self.phasors, self.mean, &mut values);
            values
        })
    }

    /// For outlines.
    fn row(&self) -> &Row {
        self.row.get_or_init(|| Row::of(self.values()))
    }
}

/// Histories of all locations at the speeds of a sweep.
#[derive(Debug, Clone)]
pub(crate) struct Histories {
    limits: Limits,
    samples: usize,
    sums: PeriodicSums,
    /// By speed and section (front and rear web of each throw).
    sections: Vec<Vec<Section>>,
    /// What no path exceeds, by its ranges.
    pub(super) bounds: PathBounds,
}

impl Histories {
    /// From the loads of the sections at each speed. `harmonics`: of the torque, in the cycle.
    pub fn new(limits: Limits, harmonics: &[u32], locations: &[CriticalLocation], sections: Vec<Vec<Section>>) -> Self {
        let samples = sections.first().and_then(|s| s.first()).map_or(0, |s| s[0].len());
        let bounds = PathBounds::new(locations, &sections);
        Self { limits, samples, sums: PeriodicSums::new(harmonics, samples), sections, bounds }
    }

    /// How many there are over the cycle.
    pub(super) fn samples(&self) -> usize {
        self.samples
    }

    /// A torque of these orders, with a mean.
    pub fn torque<'a>(&'a self, phasors: &'a [C64], mean: f64) -> SampledTorque<'a> {
        SampledTorque { histories: self, phasors, mean, values: OnceCell::new(), row: OnceCell::new() }
    }

    /// What a location bears over the cycle under a torque.
    pub fn path(&self, location: &CriticalLocation, at: At, torque: &SampledTorque) -> Path {
        if let Some(units) = &location.unit_loads {
            let [m, t, v] = self.loads(location.web(), at);
            let rows = [&m, &t, &v, torque.values()];
            let component = |c: usize| sum(rows, [units.moment[c], units.tangential[c], units.shear[c], units.torque[c]]);
            return Path::General(History { components: std::array::from_fn(component) });
        }
        let (bending, shear) = self.plane(location, at, torque);
        Path::Plane(PlaneState::of(bending, shear))
    }

    /// Moment, moment across the throw and shear force of a web at every sample.
    fn loads(&self, web: usize, at: At) -> Section {
        let (low, high) = (&self.sections[at.low][web], &self.sections[at.high][web]);
        std::array::from_fn(|l| low[l].iter().zip(&high[l]).map(|(low, high)| at.between(*low, *high)).collect())
    }

    /// The path of all loads of a web, and where its torque is up to `rise` times as large.
    pub(super) fn web_path(&self, web: usize, at: At, torque: &SampledTorque, rise: f64) -> WebPath {
        let [m, t, v] = self.loads(web, at);
        WebPath::of([&m, &t, &v, torque.values()], rise, torque.mean)
    }

    /// What the path of a nominal state does not exceed, and where its torque is `rise` times as large.
    pub fn outline(&self, location: &CriticalLocation, at: At, torque: &SampledTorque, rise: f64) -> [Within; 2] {
        outline::within(&Row::of(&self.bending(location, at)), (location.torsion, torque.row()), rise)
    }

    /// The same with all its samples, whatever its state: what needs no corners.
    pub fn whole(&self, location: &CriticalLocation, at: At, torque: &SampledTorque) -> History {
        match self.path(location, at, torque) {
            Path::Plane(_) => {
                let (bending, shear) = self.plane(location, at, torque);
                History::plane_state(bending, shear)
            }
            Path::General(history) => history,
        }
    }

    /// Normal and shear stress of a nominal state at every sample.
    fn plane(&self, location: &CriticalLocation, at: At, torque: &SampledTorque) -> (Vec<f64>, Vec<f64>) {
        (self.bending(location, at), torque.values().iter().map(|t| location.torsion * t).collect())
    }

    /// Its normal stress.
    fn bending(&self, location: &CriticalLocation, at: At) -> Vec<f64> {
        let section = location.web();
        let (low, high) = (&self.sections[at.low][section], &self.sections[at.high][section]);
        let mut bending = vec![0.0; self.samples];
        for (row, share) in [(low, 1.0 - at.fraction), (high, at.fraction)] {
            if share != 0.0 {
                add(&mut bending, (share * location.bending[0], &row[0]), (share * location.radial, &row[2]));
            }
        }
        bending
    }

    /// Share of the strength that a path uses by each criterion: the inverse of its safety factor, which is infinite where a criterion sees no danger. One search of planes serves all.
    pub fn shares(&self, criteria: &[Criterion], path: &Path) -> Vec<f64> {
        let stresses = match path {
            Path::Plane(state) if state.is_zero() => Ok(vec![0.0; criteria.len()]),
            Path::Plane(state) => self.of_plane_state(criteria, state),
            Path::General(history) if history.components.iter().flatten().all(|s| *s == 0.0) => Ok(vec![0.0; criteria.len()]),
            Path::General(history) => self.searched(criteria, history),
        };
        match stresses {
            Ok(stresses) => stresses.into_iter().map(|stress| stress / self.limits.torsion).collect(),
            Err(undefined) => unreachable!("checked in the study: {undefined}"),
        }
    }

    /// Whether a criterion asks for a search of the planes of a path, which serves others, too.
    pub(super) fn is_searched(criterion: Criterion, path: &Path) -> bool {
        criterion.searches_planes() || (matches!(path, Path::General(_)) && criterion.shear() == Shear::Planes)
    }

    /// The equivalent shear stresses of a plane state, Pa.
    fn of_plane_state(&self, criteria: &[Criterion], state: &PlaneState) -> Result<Vec<f64>, Undefined> {
        let known = criteria.iter().map(|c| c.stress(state, &self.limits)).collect::<Result<Vec<_>, _>>()?;
        let unknown: Vec<Criterion> = criteria.iter().zip(&known).filter(|c| c.1.is_none()).map(|c| *c.0).collect();
        let mut found = Vec::new();
        if !unknown.is_empty() {
            let Points { mut normal, mut shear } = state.corners().clone();
            // whole blocks are looked at together: the first corner once more costs nothing
            let count = normal.len().next_multiple_of(BLOCK);
            normal.resize(count, normal[0]);
            shear.resize(count, shear[0]);
            found = self.searched(&unknown, &History::plane_state(normal, shear))?;
        }
        let mut found = found.into_iter();
        Ok(known.into_iter().map(|stress| stress.or_else(|| found.next()).unwrap_or(0.0).max(0.0)).collect())
    }

    /// The equivalent shear stresses of any history, Pa.
    fn searched(&self, criteria: &[Criterion], history: &History) -> Result<Vec<f64>, Undefined> {
        let (verdicts, _) = evaluate(history, &self.limits, criteria, Grid::default())?;
        Ok(verdicts.into_iter().map(|v| self.limits.torsion / v.safety_factor).collect())
    }

    /// At least the share that a path within some ranges uses.
    pub fn at_most(&self, criterion: Criterion, within: &Within) -> f64 {
        criterion.at_most(within, &self.limits).unwrap_or(f64::INFINITY)
    }

    /// The equivalent shear stress of a share, Pa.
    pub fn equivalent(&self, used: f64) -> f64 {
        used * self.limits.torsion
    }
}

/// A sum of four rows, each with its weight.
#[kernel]
fn sum([a, b, c, d]: [&[f64]; 4], w: [f64; 4]) -> Vec<f64> {
    let rows = a.iter().zip(b).zip(c).zip(d);
    rows.map(|(((a, b), c), d)| w[0] * a + w[1] * b + w[2] * c + w[3] * d).collect()
}

/// Adds the stress of moments and of shear forces, each times its own per unit.
#[kernel]
fn add(stress: &mut [f64], (by_moment, moment): (f64, &[f64]), (by_shear, shear): (f64, &[f64])) {
    for ((s, m), v) in stress.iter_mut().zip(moment).zip(shear) {
        *s += by_moment * m + by_shear * v;
    }
}
