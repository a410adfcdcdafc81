//! `optima.csv`: a row an optimum: its value and why it is to be believed.

use super::table::{Table, number, optional};
use crate::analysis::Results;
use crate::files::{Folder, WriteError};
use crate::input::Study;

/// `optima.csv`. `kkt_residual`: length of the steepest-descent step, in logarithms of the parameters; `smallest_curvature`: of the Lagrangian along the directions that first
/// order leaves free, share of the objective per square of those. `lower_bound`: what no design within bounds and limits is proved to be below (of a margin: above). `upper_bound`: what it is itself at no speed above (of a margin: below).
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn optima(study: &Study, results: &Results, folder: &Folder) -> Result<(), WriteError> {
    if results.optima.is_empty() {
        return Ok(());
    }
    let mut table = Table::new(&[
        "design",
        "objective",
        "value",
        "unit",
        "limits_hold",
        "converged",
        "kkt_residual",
        "free_directions",
        "smallest_curvature",
        "starts",
        "starts_agreeing",
        "found_from",
        "other_optima",
        "best_other",
        "designs_elsewhere",
        "designs_nearby",
        "evaluations_search",
        "evaluations_minimax",
        "proof",
        "lower_bound",
        "upper_bound",
        "proof_boxes",
    ]);
    for o in &results.optima {
        let objective = study.objective_of(o.objective);
        let (optimum, outcome) = (&o.optimum, &o.optimum.outcome);
        let in_the_box = o.survey.is_some_and(|s| s.better);
        let found_from = match (o.nearby.better, in_the_box, o.scan.better) {
            (true, _, _) => "nearby",
            (false, true, _) => "box",
            (false, false, true) => "elsewhere",
            (false, false, false) => "start",
        };
        let [lower, upper] = o.proof.as_ref().map_or([None; 2], |p| [p.lower_bound, p.upper_bound]);
        table.row([
            o.design.name.clone(),
            objective.key.to_owned(),
            number(objective.unit.shown(optimum.value())),
            objective.unit.symbol().to_owned(),
            results.holds_limits(&o.design).to_string(),
            o.has_converged().to_string(),
            optional(Some(outcome.kkt_residual).filter(|r| r.is_finite())),
            o.second_order.map_or_else(String::new, |s| s.free.to_string()),
            optional(o.second_order.and_then(|s| s.curvature)),
            optimum.starts.len().to_string(),
            optimum.agreeing().to_string(),
            found_from.to_owned(),
            optimum.others.len().to_string(),
            optional(optimum.others.first().map(|l| objective.unit.shown(l.value))),
            o.scan.designs.to_string(),
            o.nearby.designs.to_string(),
            (optimum.stages.seeds.evaluations + optimum.stages.search.evaluations).to_string(),
            optimum.stages.minimax.evaluations.to_string(),
            o.proof.as_ref().map_or_else(String::new, |p| p.verdict.word().to_owned()),
            optional(lower.map(|b| objective.unit.shown(b))),
            optional(upper.map(|b| objective.unit.shown(b))),
            o.proof.as_ref().map_or_else(String::new, |p| p.boxes.to_string()),
        ]);
    }
    table.save(folder, "optima.csv")
}
