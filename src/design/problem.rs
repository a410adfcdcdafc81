//! A design problem as optimisers see it: rows of peaks, each with its value and gradient.

use super::measure::{Limit, Measure};
use super::peaks::{Peak, PeakFinder};
use super::space::Space;
use crate::response::{ResponseError, Work};

/// Smallest share of the largest peak for which a peak enters the rows: one step of an optimiser does not lift others past it.
const ROW_SHARE: f64 = 0.8;
/// Weight of the worst excess over a limit, relative to the objective: exact penalties need more than the multipliers, which are of
/// order one in these units.
pub const PENALTY: f64 = 20.0;
/// Cost of a design without a finite response.
pub const UNBOUNDED_COST: f64 = 1e30;

/// One peak at a point.
#[derive(Debug, Clone)]
pub struct Row {
    /// `None`: the objective; else the index of a limit.
    pub limit: Option<usize>,
    /// Objective: its value. Limit: logarithm of value over limit.
    pub value: f64,
    /// With respect to the coordinates.
    pub gradient: Vec<f64>,
    /// The peak behind it.
    pub peak: Peak,
}

/// All rows at a point.
#[derive(Debug, Clone)]
pub struct Rows {
    /// Objective and limits, those of the objective first, largest first.
    pub rows: Vec<Row>,
}

impl Rows {
    /// Largest row of the objective.
    pub fn objective(&self) -> f64 {
        self.rows.iter().find(|r| r.limit.is_none()).map_or(0.0, |r| r.value)
    }

    /// Largest excess over a limit (a logarithm); zero where all hold.
    pub fn excess(&self) -> f64 {
        self.rows.iter().filter(|r| r.limit.is_some()).map(|r| r.value).fold(0.0, f64::max)
    }
}

/// Minimise the largest peak of a measure over a family of absorbers, within limits.
#[derive(Debug)]
pub struct Problem<'a> {
    /// Evaluates peaks.
    pub finder: &'a PeakFinder<'a>,
    /// The family.
    pub space: Space,
    /// To be small.
    pub objective: &'a Measure,
    /// To hold.
    pub limits: &'a [Limit],
}

impl Problem<'_> {
    /// Objective and worst excess at a point.
    ///
    /// # Errors
    /// [`ResponseError::Unbounded`] where nothing damps a resonance.
    pub fn value(&self, w: &[f64], work: &mut Work) -> Result<(f64, f64), ResponseError> {
        let design = [self.space.absorber(w)];
        let largest = |m: &Measure, work: &mut Work| Ok(self.finder.peak(&design, m, work)?.map_or(0.0, |p| p.value));
        let value = largest(self.objective, work)?;
        let mut excess = 0.0_f64;
        for limit in self.limits {
            excess = excess.max((largest(&limit.measure, work)? / limit.limit).ln());
        }
        Ok((value, excess))
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
        let design = [self.space.absorber(w)];
        let mut rows = Vec::new();
        let measures =
            std::iter::once((None, self.objective, 1.0)).chain(self.limits.iter().enumerate().map(|(i, l)| (Some(i), &l.measure, l.limit)));
        for (limit, measure, unit) in measures {
            for peak in self.finder.peaks(&design, measure, ROW_SHARE, work)? {
                let gradient = self.finder.gradient(&design, 0, &peak, work)?;
                // the logarithm keeps limits that are missed by far of a size with the objective
                let (value, unit) = if limit.is_some() { ((peak.value / unit).ln(), peak.value) } else { (peak.value, 1.0) };
                let gradient = self.space.chain_rule(w, gradient).iter().map(|g| g / unit).collect();
                rows.push(Row { limit, value, gradient, peak });
            }
        }
        Ok(Rows { rows })
    }
}
