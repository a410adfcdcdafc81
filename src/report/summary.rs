//! What `summary.json` tells of a run besides its files: nothing that differs from run to run.

use crate::analysis::{OptimumResult, Results};
use crate::input::{InputFile, Study};
use serde_json::{Map, Value, json};

/// Inputs, seed, method, and of each optimum its value, certificate and evaluations.
pub(crate) fn about(study: &Study, inputs: &[InputFile], results: &Results) -> Map<String, Value> {
    let input = |f: &InputFile| json!({ "path": f.path, "bytes": f.bytes, "crc32": format!("{:08x}", f.crc32) });
    let mut about = Map::new();
    about.insert("inputs".into(), inputs.iter().map(input).collect());
    about.insert("seed".into(), study.optimise.as_ref().map(|o| o.seed).into());
    about.insert("method".into(), results.method.into());
    about.insert("searches_by".into(), results.choices.first().map(|c| c.chosen.strategy.label()).into());
    about.insert("limits_hold".into(), results.limits_hold().into());
    about.insert("optima".into(), results.optima.iter().map(optimum).collect());
    about
}

fn optimum(o: &OptimumResult) -> Value {
    let work = o.optimum.stages.all();
    json!({
        "design": o.design.name,
        "objective_si": o.optimum.value(),
        "limits_hold": o.design.within_limits(),
        "first_order_residual": o.optimum.outcome.kkt_residual,
        "starts": o.optimum.starts.len(),
        "starts_that_agree": o.optimum.agreeing(),
        "evaluations": work.evaluations,
        "evaluations_without_finite_response": work.unbounded_evaluations,
    })
}
