//! Absorbers of catalogues in the order of the study's objective.

use super::evaluation_plan::{EvaluationPlan, asked};
use super::systems::engines_in;
use super::{Progress, RunError};
use crate::input::{DesignSpec, Study};
use crate::objective::in_operation::absorbers;
use crate::objective::{DesignPeaks, PeakFinder, holds};
use crate::response::{ResponseError, Work};
use rayon::prelude::*;

/// An absorber of a catalogue.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Ranked {
    /// The catalogue, as the study names it.
    pub file: String,
    /// The absorber.
    pub design: String,
    /// Its place in its catalogue, from 1.
    pub place: usize,
    /// The study's objective, the largest over the conditions that an optimum is to hold in; nothing where nothing damps a resonance.
    pub objective: Option<f64>,
    /// Largest limited measure over its limit; zero without limits.
    pub over_limit: f64,
    /// Index of that limit; nothing without limits, and where nothing damps a resonance.
    pub nearest_limit: Option<usize>,
    /// Whether it is among the best, which are reported like given designs.
    pub shown: bool,
}

/// Designs with the index of their catalogue.
pub(crate) type Best = Vec<(usize, DesignSpec)>;

/// Every absorber of every catalogue, those within all limits before the others, then by the objective; and the best of each as designs, with the index of their catalogue.
pub(crate) fn ranked(
    study: &Study,
    finders: &[PeakFinder],
    wanted: &EvaluationPlan,
    progress: &dyn Progress,
) -> Result<(Vec<Ranked>, Best), RunError> {
    let (mut list, mut best) = (Vec::new(), Vec::new());
    if !study.catalogues.is_empty() {
        progress.stage("catalogue", study.catalogues.iter().map(|c| c.designs.len()).sum());
    }
    for (index, catalogue) in study.catalogues.iter().enumerate() {
        let judged: Vec<Result<RankedBy, ResponseError>> =
            catalogue.designs.par_iter().map(|d| judge(finders, wanted, d)).inspect(|_| progress.step()).collect();
        let mut order: Vec<(usize, Option<RankedBy>)> = judged.into_iter().map(Result::ok).enumerate().collect();
        // stable: equals keep the order of the file
        let key = |judged: &Option<RankedBy>| judged.map_or((true, f64::INFINITY), |(value, over, _)| (!holds(over), value));
        order.sort_by(|a, b| key(&a.1).0.cmp(&key(&b.1).0).then(key(&a.1).1.total_cmp(&key(&b.1).1)));
        for (place, (i, judged)) in order.into_iter().enumerate() {
            let design = &catalogue.designs[i];
            let shown = place < catalogue.best && judged.is_some();
            if shown {
                best.push((index, design.clone()));
            }
            list.push(Ranked {
                file: catalogue.file.clone(),
                design: design.name.clone(),
                place: place + 1,
                objective: judged.map(|j| j.0),
                over_limit: judged.map_or(f64::INFINITY, |j| j.1),
                nearest_limit: judged.and_then(|j| j.2),
                shown,
            });
        }
    }
    Ok((list, best))
}

/// Objective, the largest limited measure over its limit, and the index of that.
type RankedBy = (f64, f64, Option<usize>);

/// What a row is ranked by, at its worst of the conditions that it is judged in.
fn judge(finders: &[PeakFinder], wanted: &EvaluationPlan, design: &DesignSpec) -> Result<RankedBy, ResponseError> {
    let (mut value, mut over, mut nearest) = (0.0f64, 0.0f64, None);
    for condition in wanted.judged_in(&design.absorbers) {
        for finder in engines_in(condition, finders) {
            let design = absorbers(condition, finder, &design.absorbers)?;
            let mut peaks = DesignPeaks::new(finder, &design, wanted.asked());
            let (objective, limits) = asked(&mut peaks, wanted, &mut Work::default())?;
            value = value.max(objective);
            for (i, ratio) in limits.into_iter().enumerate() {
                if nearest.is_none() || ratio > over {
                    (over, nearest) = (f64::max(over, ratio), Some(i));
                }
            }
        }
    }
    Ok((value, over, nearest))
}
