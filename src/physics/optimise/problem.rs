//! A design problem as optimisers see it: rows of peaks, each with its value and gradient.

use super::checkpoint::{self, Remembers};
use super::load_case::LoadCase;
use super::variables::Space;
use crate::absorber::Mounted;
use crate::numerics::elementary::Elementary;
use crate::objective::condition::Condition;
use crate::objective::measure::{HELD, Limit, Measure, Over};
use crate::objective::peak::Peak;
use crate::objective::peak_search::PeakFinder;
use crate::objective::{Asked, Shared};
use crate::response::{ResponseError, Work};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt::Debug;

/// Smallest share of the largest peak for which a peak enters the rows: one step of an optimiser does not lift others past it.
pub(super) const ROW_SHARE: f64 = 0.8;
/// The same of the crank's utilisation, most of which is bending that no absorber changes.
const ROW_SHARE_OF_MARGIN: f64 = 0.95;
/// What is below this share of its limit is no row: it does not reach it in one step.
const FAR_BELOW: f64 = 0.1;
/// Peaks within this share of the largest are active: what another design has there says most of it.
const ACTIVE: f64 = 1e-3;
/// Weight of the worst excess over a limit, relative to the objective: exact penalties need more than the multipliers, which are of
/// order one in these units.
pub(crate) const PENALTY: f64 = 20.0;
/// Cost of a design without a finite response.
pub(crate) const UNBOUNDED_COST: f64 = 1e30;

/// What a row is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Role {
    /// An objective, by its index.
    Objective(usize),
    /// A limit, by its index.
    Limit(usize),
}

impl Role {
    /// Whether it is a limit.
    #[doc(hidden)]
    pub fn is_limit(self) -> bool {
        matches!(self, Self::Limit(_))
    }
}

/// One peak at a point.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
pub struct Row {
    /// Index of the load case.
    pub load_case: usize,
    /// What it is a peak of.
    pub role: Role,
    /// Objective: its value in its unit. Limit: logarithm of value over limit.
    pub value: f64,
    /// With respect to the coordinates.
    pub gradient: Vec<f64>,
    /// The peak behind it.
    pub peak: Peak,
}

/// All rows at a point.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
pub struct Rows {
    /// Objective and limits, those of the objective first, largest first.
    pub rows: Vec<Row>,
    /// Of the objectives, where they are added up; one for all of them where the largest counts.
    weights: Vec<f64>,
}

impl Rows {
    /// The objective: its largest row, or the sum of the largest of each.
    pub fn objective(&self) -> f64 {
        if let [_] = self.weights.as_slice() {
            return self.rows.iter().find(|r| !r.role.is_limit()).map_or(0.0, |r| r.value);
        }
        // the largest of each comes first
        let largest = |i: usize| self.rows.iter().find(|r| r.role == Role::Objective(i)).map_or(0.0, |r| r.value);
        self.weights.iter().enumerate().map(|(i, weight)| weight * largest(i)).sum()
    }

    /// Weights of the terms of the objective.
    pub(super) fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Index of the term of the objective that a row is of; nothing of a limit.
    pub(super) fn term(&self, role: Role) -> Option<usize> {
        match role {
            Role::Limit(_) => None,
            Role::Objective(_) if self.weights.len() == 1 => Some(0),
            Role::Objective(i) => Some(i),
        }
    }

    /// Whether a row is as large as its term of the objective, but for a share.
    #[doc(hidden)]
    pub fn is_largest(&self, row: &Row, share: f64) -> bool {
        let own = self.rows.iter().filter(|r| self.term(r.role) == self.term(row.role)).map(|r| r.value).fold(0.0, f64::max);
        row.value >= own * (1.0 - share)
    }

    /// Whether all limits hold.
    #[doc(hidden)]
    pub fn hold(&self) -> bool {
        self.excess() <= HELD
    }

    /// Largest excess over a limit (a logarithm); zero where all hold.
    pub fn excess(&self) -> f64 {
        self.rows.iter().filter(|r| r.role.is_limit()).map(|r| r.value).fold(0.0, f64::max)
    }
}

/// Minimise the largest of some measures, each in units of a value of it, or their weighted sum, over a family of absorbers and all load cases, within limits.
#[derive(Debug)]
pub struct Problem<'a> {
    /// At least one in which the family can change something.
    pub load_cases: &'a [LoadCase<'a>],
    /// The family.
    pub space: Space,
    /// Minimised: the largest of them,
    pub objectives: &'a [Limit],
    /// or their sum with these weights, where there are any.
    pub weights: &'a [f64],
    /// To hold.
    pub limits: &'a [Limit],
    /// What remembers its searches from one run to the next.
    pub memory: Option<Remembers<'a>>,
}

impl Problem<'_> {
    /// What a search of this problem finds, or found in an earlier run; `own`: what tells it from other searches.
    pub(super) fn remembered<T: Serialize + DeserializeOwned, E>(
        &self,
        own: &impl Debug,
        work: &mut Work,
        search: impl FnOnce(&mut Work) -> Result<T, E>,
    ) -> Result<T, E> {
        let Some(Remembers { memory, .. }) = self.memory else { return search(work) };
        let load_cases: Vec<_> = self.load_cases.iter().map(|s| (s.condition, s.cylinder, s.deviation, s.engine)).collect();
        let key = (own, &self.space, self.objectives, self.weights, self.limits, load_cases);
        let (found, spent) = checkpoint::remembered(Some(memory), &key, || {
            let mut spent = Work::default();
            search(&mut spent).map(|found| (found, spent))
        })?;
        *work += spent;
        Ok(found)
    }

    /// Tells what was found.
    pub(super) fn tell(&self, point: &[f64], rows: &Rows) {
        if let Some(Remembers { memory, search: Some(search) }) = self.memory {
            let (value, excess) = (rows.objective(), rows.excess());
            memory.found(&checkpoint::BestSoFar { search, value, excess, design: self.space.named(point) });
        }
    }

    /// Objective and worst excess at a point, as right as the study asks of searches.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where nothing damps a resonance.
    pub fn value(&self, w: &[f64], work: &mut Work) -> Result<(f64, f64), ResponseError> {
        self.value_below(w, f64::INFINITY, work)
    }

    /// The same; where the objective is above `most`, the excess counts as infinite: limits are not asked for then.
    ///
    /// # Errors
    /// As [`Self::value`].
    pub(super) fn value_below(&self, w: &[f64], most: f64, work: &mut Work) -> Result<(f64, f64), ResponseError> {
        let found = self.by((w, most), |finder, design, of, shared| finder.value(design, of, shared, work));
        work.noted(found)
    }

    /// The same of objectives that cost more than limits: where the excess is above `most`, the objective counts as infinite and is not asked for.
    ///
    /// # Errors
    /// As [`Self::value`].
    pub(super) fn value_near_limits(&self, w: &[f64], most: f64, work: &mut Work) -> Result<(f64, f64), ResponseError> {
        let limits = Problem { objectives: &[], space: self.space.clone(), ..*self };
        let (_, excess) = limits.value(w, work)?;
        if excess > most {
            return Ok((f64::INFINITY, excess));
        }
        let objectives = Problem { limits: &[], space: self.space.clone(), ..*self };
        Ok((objectives.value(w, work)?.0, excess))
    }

    /// The same to rounding.
    ///
    /// # Errors
    /// As [`Self::value`].
    #[doc(hidden)]
    pub fn exactly(&self, w: &[f64], work: &mut Work) -> Result<(f64, f64), ResponseError> {
        let found = self.by((w, f64::INFINITY), |finder, design, of, shared| finder.exact_value(design, of, shared, work));
        work.noted(found)
    }

    /// With a value of a measure as asked, where it is no less than what comes with it; no further than to an objective above `most`.
    fn by(
        &self,
        (w, most): (&[f64], f64),
        mut of: impl FnMut(&PeakFinder, &[Mounted], (&Measure, f64), &Shared) -> Result<f64, ResponseError>,
    ) -> Result<(f64, f64), ResponseError> {
        let own = self.space.design(w);
        let (mut values, mut excess) = (vec![0.0_f64; self.objectives.len()], 0.0_f64);
        for (_, load_case) in self.steering() {
            let (design, shared) = (load_case.absorbers(&own)?, self.shared(load_case));
            for (value, objective) in values.iter_mut().zip(self.objectives) {
                for (measure, unit) in load_case.parts_of(objective) {
                    *value = value.max(of(load_case.finder, &design, (measure, 0.0), &shared)? / unit);
                }
            }
            if self.together(&values) > most {
                return Ok((self.together(&values), f64::INFINITY));
            }
            for (measure, limit) in self.limits.iter().flat_map(|l| load_case.parts_of(l)) {
                // what does not reach its limit exceeds nothing
                excess = excess.max((of(load_case.finder, &design, (measure, limit), &shared)? / limit).logarithm());
            }
        }
        Ok((self.together(&values), excess))
    }

    /// The objective by the values of its terms.
    fn together(&self, values: &[f64]) -> f64 {
        match self.weights {
            [] => values.iter().copied().fold(0.0, f64::max),
            weights => values.iter().zip(weights).map(|(v, w)| v * w).sum(),
        }
    }

    /// Whether the objective at a point is certainly above a value: at the speeds of the largest peaks of some rows it is already.
    pub(super) fn is_surely_above(&self, w: &[f64], (rows, value): (&Rows, f64), work: &mut Work) -> bool {
        let (own, mut values) = (self.space.design(w), vec![0.0_f64; self.objectives.len()]);
        rows.rows.iter().filter(|r| rows.is_largest(r, ACTIVE)).any(|row| {
            let Role::Objective(i) = row.role else { return false };
            let load_case = &self.load_cases[row.load_case];
            // speeds that are excepted from a limit have rows of their own
            let holds = |m: &Measure| m.within.holds(row.peak.speed_rpm);
            let Some((measure, unit)) = load_case.parts_of(&self.objectives[i]).find(|part| holds(part.0)) else { return false };
            let least = load_case.finder.at_least(&load_case.absorbers_at_few_speeds(&own), (measure, &row.peak), work);
            values[i] = values[i].max(least.unwrap_or(0.0) / unit);
            self.together(&values) > value
        })
    }

    /// One number for a search without derivatives: objective with a penalty; large, never infinite, where nothing damps a resonance.
    pub fn cost(&self, w: &[f64], work: &mut Work) -> f64 {
        self.value(w, work).map_or(UNBOUNDED_COST, |(value, excess)| value * (1.0 + PENALTY * excess))
    }

    /// All peaks that matter, with gradients.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where nothing damps a resonance.
    pub fn rows(&self, w: &[f64], work: &mut Work) -> Result<Rows, ResponseError> {
        self.rows_near(w, ROW_SHARE, work)
    }

    /// Those of at least a share of the largest of their measure.
    pub(super) fn rows_near(&self, w: &[f64], share: f64, work: &mut Work) -> Result<Rows, ResponseError> {
        let found = self.rows_of(w, share, work);
        work.noted(found)
    }

    fn rows_of(&self, w: &[f64], share: f64, work: &mut Work) -> Result<Rows, ResponseError> {
        let own = self.space.design(w);
        let objectives = self.objectives.iter().enumerate().map(|(i, l)| (Role::Objective(i), l));
        let limits = self.limits.iter().enumerate().map(|(i, l)| (Role::Limit(i), l));
        let asked: Vec<_> = objectives
            .chain(limits)
            .flat_map(|(role, limit)| limit.parts().map(move |part| (role, limit, part)))
            .map(|(role, limit, (measure, unit, in_service))| {
                let of_margin = matches!(measure.over, Over::Margin(_));
                let keep = if of_margin { share.max(ROW_SHARE_OF_MARGIN) } else { share };
                (role, measure, unit, keep, move |case: &LoadCase| case.counts(limit, measure, in_service))
            })
            .collect();
        // case by case: what measures share of one is given up before the next
        let mut by_measure: Vec<Vec<(usize, Peak)>> = vec![Vec::new(); asked.len()];
        let mut designs = Vec::new();
        for (load_case, s) in self.steering() {
            let (design, shared) = (s.absorbers(&own)?, self.shared(s));
            for ((role, measure, unit, keep, _), found) in asked.iter().zip(&mut by_measure).filter(|(a, _)| (a.4)(s)) {
                let least = if role.is_limit() { FAR_BELOW * unit } else { 0.0 };
                let peaks = s.finder.peaks_knowing(&design, measure, Asked { keep: *keep, least }, &shared, work)?;
                found.extend(peaks.into_iter().map(|p| (designs.len(), p)));
            }
            designs.push((load_case, s.finder, design));
        }
        let varying: Vec<usize> = (0..own.len()).filter(|i| self.space.varies(*i)).collect();
        let mut rows = Vec::new();
        for ((role, measure, unit, share, _), mut found) in asked.into_iter().zip(by_measure) {
            // peaks that are large in their own load case may be small among all
            let largest = found.iter().map(|p| p.1.value).fold(0.0, f64::max);
            found.retain(|p| p.1.value >= share * largest);
            found.sort_by(|a, b| b.1.value.total_cmp(&a.1.value));
            for (case, peak) in found {
                let (load_case, finder, design) = &designs[case];
                let gradient = match self.load_cases[*load_case].condition {
                    Condition::InOperation => self.gradient_in_operation(&self.load_cases[*load_case], w, (measure, &peak), work)?,
                    _ => self.space.chain_rule(w, &finder.gradients(design, &varying, measure, &peak, work)?),
                };
                // the logarithm keeps limits that are missed by far of a size with the objective
                let (value, unit) = if role.is_limit() { ((peak.value / unit).logarithm(), peak.value) } else { (peak.value / unit, unit) };
                let gradient = gradient.iter().map(|g| g / unit).collect();
                rows.push(Row { load_case: *load_case, role, value, gradient, peak });
            }
        }
        // objectives first, the largest of all of them before the others
        rows.sort_by(|a, b| {
            a.role.is_limit().cmp(&b.role.is_limit()).then(if a.role.is_limit() {
                std::cmp::Ordering::Equal
            } else {
                b.value.total_cmp(&a.value)
            })
        });
        let weights = if self.weights.is_empty() { vec![1.0] } else { self.weights.to_vec() };
        Ok(Rows { rows, weights })
    }

    /// What evaluations of a design in one load case share.
    fn shared(&self, case: &LoadCase) -> Shared {
        Shared::of(self.objectives.iter().chain(self.limits).flat_map(|l| case.parts_of(l)).map(|part| part.0))
    }

    /// Load cases in which the family can change something, with their indices.
    pub(super) fn steering(&self) -> impl Iterator<Item = (usize, &LoadCase<'_>)> {
        self.load_cases.iter().enumerate().filter(|(_, s)| s.steers(&self.space))
    }
}
