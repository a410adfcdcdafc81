//! What a study asks of every design.

use crate::absorber::Mounted;
use crate::input::{LimitSpec, Study};
use crate::objective::{Condition, DesignPeaks, Measure, PeakFinder};
use crate::response::{Quantity, ResponseError, Work};

/// What to evaluate.
#[derive(Debug)]
pub struct EvaluationPlan<'a> {
    /// Reported twist.
    pub twist: Quantity,
    /// Reported station.
    pub hub: usize,
    /// Objective.
    pub objective: &'a Measure,
    /// Limits.
    pub limits: &'a [LimitSpec],
    /// Margins of the crank.
    pub margins: &'a [Measure],
    /// Conditions besides firing; in operation every design is reported that differs then.
    pub conditions: Vec<Condition>,
    /// Conditions that an optimum is to hold in.
    pub held: &'a [Condition],
}

impl<'a> EvaluationPlan<'a> {
    /// What a study asks; `margins` as it judges the crank.
    #[doc(hidden)]
    pub fn new(study: &'a Study, margins: &'a [Measure]) -> Self {
        Self {
            twist: study.twist,
            hub: study.hub,
            objective: &study.objective.measure,
            limits: &study.limits,
            margins,
            conditions: study.conditions.iter().copied().chain([Condition::InOperation]).collect(),
            held: study.held(),
        }
    }

    /// What is minimised and what is limited.
    pub(crate) fn asked(&self) -> impl Iterator<Item = &Measure> {
        std::iter::once(self.objective).chain(self.limits.iter().map(|l| &l.of.measure))
    }

    /// Conditions that a design is judged in: those that an optimum is to hold in, and in operation where that differs.
    pub(crate) fn judged_in(&self, design: &[Mounted]) -> Vec<Condition> {
        let in_operation = Some(Condition::InOperation).filter(|c| !c.changes_nothing(design));
        self.held.iter().copied().chain(in_operation).collect()
    }
}

/// All shafts.
pub fn shafts(finder: &PeakFinder) -> Vec<Quantity> {
    (0..finder.system.chain.len() - 1).map(Quantity::ShaftTorque).collect()
}

/// Objective, and each limited measure over its limit.
pub(crate) fn asked(peaks: &mut DesignPeaks, wanted: &EvaluationPlan, work: &mut Work) -> Result<(f64, Vec<f64>), ResponseError> {
    let mut largest = |m: &Measure| Ok(peaks.peak(m, work)?.map_or(0.0, |p| p.value));
    let limits = wanted.limits.iter().map(|l| Ok(largest(&l.of.measure)? / l.limit)).collect::<Result<_, _>>()?;
    Ok((largest(wanted.objective)?, limits))
}
