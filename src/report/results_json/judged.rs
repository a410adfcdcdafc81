//! The value that a design is judged by, and what is absurd of it.

use crate::analysis::judged::Basis;
use crate::analysis::{DesignResult, Results};
use crate::input::Study;
use crate::text::verdict::{clause, of_design, word};
use schemars::JsonSchema;
use serde::Serialize;

/// The value that a design is judged by, in the unit of its objective.
#[derive(Debug, Serialize, JsonSchema)]
pub(crate) struct Judged {
    /// Key of the objective.
    objective: &'static str,
    /// The worst of what is asked of the design.
    value: f64,
    /// Its unit.
    unit: &'static str,
    /// What it is the worst of: conditions, `own_amplitude` (where twist is not small), `tolerances`.
    worst_of: Vec<&'static str>,
    /// In which of these it is reached.
    reached_in: &'static str,
    /// The same measure at the reference: all cylinders fire, materials are at their reference, twist is small, parameters are as drawn.
    reference: f64,
}

/// Something absurd.
#[derive(Debug, Serialize, JsonSchema)]
pub(crate) struct Verdict {
    /// `worse_than_none`, `little_gain`, `overheats`, `modulus`, `loss_factor`, `strain`, `viscosity`, `own_frequency` (outside what exists) or `on_bound`.
    verdict: &'static str,
    /// In words.
    words: String,
}

/// Of an optimum by the objective that it minimises, of another design by the first.
pub(crate) fn judged(study: &Study, results: &Results, d: &DesignResult) -> Option<Judged> {
    let optimum = results.optima.iter().find(|o| o.design.name == d.name);
    let j = optimum.map_or_else(|| results.judged(d), |o| Some(results.judged_optimum(o)))?;
    let of = study.objective_of(j.objective);
    let (value, reference) = (of.unit.shown(j.value), of.unit.shown(j.reference));
    (value.is_finite() && reference.is_finite()).then(|| Judged {
        objective: of.key,
        value,
        unit: of.unit.symbol(),
        worst_of: j.worst_of.iter().copied().map(Basis::name).collect(),
        reached_in: j.reached_in.name(),
        reference,
    })
}

/// What is absurd of a design.
pub(crate) fn verdicts(results: &Results, d: &DesignResult) -> Vec<Verdict> {
    let (found, of) = of_design(results, d);
    found.iter().map(|v| Verdict { verdict: word(v), words: clause(v, of, &d.absorbers) }).collect()
}
