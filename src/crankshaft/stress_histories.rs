//! Stress histories of the locations, for multiaxial criteria: the sum of stresses per unit load over the cycle. Bending comes from the loads of the crank, which no absorber
//! changes; torque from the chain.
//!
//! A fillet with factors of nominal stress has a plane state: bending along the fillet's meridian and shear by torque, of which criteria ask for the corners only. A fillet
//! with stresses per unit load from elsewhere has any tensor, and keeps all samples.

use super::CriticalLocation;
use super::speed_table::At;
use crate::fatigue::multiaxial::bound::Within;
use crate::fatigue::multiaxial::history::deviator_of;
use crate::fatigue::multiaxial::invariants::Invariants;
use crate::fatigue::multiaxial::{Criterion, Grid, History, Limits, PlaneState, Undefined, evaluate, papadopoulos};
use crate::numerics::C64;
use crate::numerics::elementary::Elementary;
use crate::numerics::periodic_sums::PeriodicSums;
use rayon::prelude::*;

/// Samples that ranges are taken of together.
const BLOCK: usize = 16;

/// Loads of a section over the cycle: moment in the plane of the throw, across it, shear force in the plane.
pub(crate) type Section = [Vec<f64>; 3];

/// What a location bears by bending alone at a speed.
#[derive(Debug, Clone, Copy, Default)]
struct Bent {
    sqrt_j2_amplitude: f64,
    /// Of stresses per unit load only: those of a nominal state follow from the amplitude.
    mean_shear: f64,
    low: f64,
    high: f64,
    normal: f64,
}

/// What a location bears over the cycle.
pub(crate) enum Path {
    /// Bending and torsion of a nominal state.
    Plane(PlaneState),
    /// Any tensor.
    General(History),
}

/// Histories of all locations at the speeds of a sweep.
#[derive(Debug, Clone)]
pub(crate) struct Histories {
    limits: Limits,
    samples: usize,
    sums: PeriodicSums,
    /// By speed and section (front and rear web of each throw).
    sections: Vec<Vec<Section>>,
    /// By speed and location.
    bent: Vec<Vec<Bent>>,
    /// By location.
    twisted: Vec<Twisted>,
}

/// What a location bears by a torque of 1 N m.
#[derive(Debug, Clone, Copy)]
struct Twisted {
    sqrt_j2: f64,
    hydrostatic: f64,
    normal: f64,
}

impl Histories {
    /// From the loads of the sections at each speed. `harmonics`: of the torque, in the cycle.
    pub fn new(limits: Limits, harmonics: &[u32], locations: &[CriticalLocation], sections: Vec<Vec<Section>>) -> Self {
        let samples = sections.first().and_then(|s| s.first()).map_or(0, |s| s[0].len());
        let bent =
            sections.par_iter().map(|row| locations.iter().map(|location| bent(location, &row[section_of(location)])).collect()).collect();
        Self {
            limits,
            samples,
            sums: PeriodicSums::new(harmonics, samples),
            sections,
            bent,
            twisted: locations.iter().map(twisted).collect(),
        }
    }

    /// The torque at every sample, N m.
    pub fn torque(&self, phasors: &[C64], mean: f64) -> Vec<f64> {
        let mut torque = Vec::new();
        self.sums.at(phasors, mean, &mut torque);
        torque
    }

    /// What a location bears over the cycle under a torque.
    pub fn path(&self, location: &CriticalLocation, at: At, torque: &[f64]) -> Path {
        let section = section_of(location);
        let (low, high) = (&self.sections[at.low][section], &self.sections[at.high][section]);
        if let Some(units) = &location.unit_loads {
            let load = |which: usize, j: usize| at.between(low[which][j], high[which][j]);
            return Path::General(History::new((0..self.samples).map(|j| {
                let (m, t, v) = (load(0, j), load(1, j), load(2, j));
                std::array::from_fn(|c| units.moment[c] * m + units.tangential[c] * t + units.shear[c] * v + units.torque[c] * torque[j])
            })));
        }
        let (bending, shear) = self.plane(location, at, torque);
        Path::Plane(PlaneState::of(&bending, &shear))
    }

    /// The same with all its samples, whatever its state: what needs no corners.
    pub fn whole(&self, location: &CriticalLocation, at: At, torque: &[f64]) -> Path {
        match self.path(location, at, torque) {
            Path::Plane(_) => {
                let (bending, shear) = self.plane(location, at, torque);
                Path::General(History::plane_state(bending, shear))
            }
            general => general,
        }
    }

    /// Normal and shear stress of a nominal state at every sample.
    fn plane(&self, location: &CriticalLocation, at: At, torque: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let section = section_of(location);
        let (low, high) = (&self.sections[at.low][section], &self.sections[at.high][section]);
        let mut bending = vec![0.0; self.samples];
        // a row each: a sum of four products
        let shares = [(low, 1.0 - at.fraction), (high, at.fraction)];
        for (row, share) in shares {
            let (moment, shear) = (share * location.bending[0], share * location.radial);
            for ((b, m), v) in bending.iter_mut().zip(&row[0]).zip(&row[2]) {
                *b += moment * m + shear * v;
            }
        }
        (bending, torque.iter().map(|t| location.torsion * t).collect())
    }

    /// Share of the strength that a path uses by each criterion: the inverse of its safety factor, which is infinite where a criterion sees no danger. One search of planes serves all.
    pub fn used(&self, criteria: &[Criterion], path: &Path) -> Vec<f64> {
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

    /// The equivalent shear stresses of a plane state, Pa.
    fn of_plane_state(&self, criteria: &[Criterion], state: &PlaneState) -> Result<Vec<f64>, Undefined> {
        let known = criteria.iter().map(|c| c.by_invariants(state, &self.limits)).collect::<Result<Vec<_>, _>>()?;
        let unknown: Vec<Criterion> = criteria.iter().zip(&known).filter(|c| c.1.is_none()).map(|c| *c.0).collect();
        let mut found = Vec::new();
        if !unknown.is_empty() {
            let (mut normal, mut shear) = (state.normal.clone(), state.shear.clone());
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

    /// The equivalent shear stress of a share, Pa.
    pub fn equivalent(&self, used: f64) -> f64 {
        used * self.limits.torsion
    }

    /// At least the share that a location uses under a torque of this half peak-to-peak value, and of no larger size than `largest`.
    pub fn at_most(&self, criterion: Criterion, location: (usize, &CriticalLocation), at: At, half_peak_to_peak: f64, largest: f64) -> f64 {
        let (low, high) = (&self.bent[at.low][location.0], &self.bent[at.high][location.0]);
        let per_torque = &self.twisted[location.0];
        let (twisted, hydrostatic) = (per_torque.sqrt_j2 * half_peak_to_peak, per_torque.hydrostatic * largest);
        let bent = at.between(low.sqrt_j2_amplitude, high.sqrt_j2_amplitude);
        let within = Within {
            // deviators of bending and torsion of a nominal state are at right angles: their box has this ball
            sqrt_j2_amplitude: if location.1.unit_loads.is_none() { bent.hypotenuse(twisted) } else { bent + twisted },
            mean_shear: match &location.1.unit_loads {
                None => papadopoulos::at_most(3f64.sqrt() * bent, twisted),
                // half ranges of a sum are no larger than the sum of those of its parts, nor is the root of their mean square
                Some(_) => at.between(low.mean_shear, high.mean_shear) + twisted,
            },
            hydrostatic: (at.between(low.low, high.low) - hydrostatic, at.between(low.high, high.high) + hydrostatic),
            normal: at.between(low.normal, high.normal) + per_torque.normal * largest,
        };
        criterion.at_most(&within, &self.limits).unwrap_or(f64::INFINITY)
    }
}

/// Index of the web.
fn section_of(location: &CriticalLocation) -> usize {
    2 * location.throw + usize::from(location.rear)
}

fn twisted(location: &CriticalLocation) -> Twisted {
    let stress = location.unit_loads.map_or([0.0, 0.0, 0.0, location.torsion, 0.0, 0.0], |u| u.torque);
    Twisted {
        sqrt_j2: deviator_of(&stress).iter().map(|d| d * d).sum::<f64>().sqrt(),
        hydrostatic: ((stress[0] + stress[1] + stress[2]) / 3.0).abs(),
        normal: size(&stress),
    }
}

fn bent(location: &CriticalLocation, section: &Section) -> Bent {
    let history = match &location.unit_loads {
        Some(u) => {
            let tensor = |j: usize| -> [f64; 6] {
                std::array::from_fn(|c| u.moment[c] * section[0][j] + u.tangential[c] * section[1][j] + u.shear[c] * section[2][j])
            };
            History::new((0..section[0].len()).map(tensor))
        }
        None => {
            let path = section[0].iter().zip(&section[2]).map(|(m, v)| location.bending[0] * m + location.radial * v);
            let (low, high) = path.fold((f64::INFINITY, f64::NEG_INFINITY), |m, b| (m.0.min(b), m.1.max(b)));
            History::plane_state(vec![low, high], vec![0.0; 2])
        }
    };
    let i = Invariants::of(&history);
    Bent {
        sqrt_j2_amplitude: i.sqrt_j2_amplitude,
        mean_shear: if location.unit_loads.is_some() { papadopoulos::mean_shear(&history) } else { 0.0 },
        low: i.hydrostatic_mean - i.hydrostatic_amplitude,
        high: i.hydrostatic_max(),
        normal: (0..history.len()).map(|j| size(&history.tensor(j))).fold(0.0, f64::max),
    }
}

/// Frobenius norm of a tensor: no normal stress is larger.
fn size(t: &[f64; 6]) -> f64 {
    (t[..3].iter().map(|s| s * s).sum::<f64>() + 2.0 * t[3..].iter().map(|s| s * s).sum::<f64>()).sqrt()
}
