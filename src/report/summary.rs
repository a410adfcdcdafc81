//! What `summary.json` tells of a run besides its files: nothing that differs from run to run.

use super::results_json;
use crate::analysis::{OptimumResult, Results};
use crate::input::{InputFile, Study};
use serde_json::{Map, Value, json};

/// Inputs, seed, method, and of each optimum its value, certificate and evaluations.
#[doc(hidden)]
pub fn about(study: &Study, inputs: &[InputFile], results: &Results) -> Map<String, Value> {
    let mut about = about_study(study, inputs);
    about.insert("seed".into(), study.optimise.as_ref().map(|o| o.seed).into());
    about.insert("method".into(), results.method.into());
    about.insert("searches_by".into(), results.choices.first().map(|c| c.chosen.strategy.label()).into());
    about.insert("limits_hold".into(), results.limits_hold().into());
    about.insert("optima".into(), results.optima.iter().map(|o| optimum(study, results, o)).collect());
    about
}

/// The inputs of a command on a study, and the keys that it gave other values.
#[doc(hidden)]
pub fn about_study(study: &Study, inputs: &[InputFile]) -> Map<String, Value> {
    let mut about = about_inputs(inputs);
    if !study.set.is_empty() {
        about.insert("set".into(), json!(study.set));
    }
    about
}

/// The inputs of a command, which is all that is told of those that search for nothing.
#[doc(hidden)]
pub fn about_inputs(inputs: &[InputFile]) -> Map<String, Value> {
    let input = |f: &InputFile| json!({ "path": f.path.display().to_string(), "bytes": f.bytes, "crc32": format!("{:08x}", f.crc32) });
    Map::from_iter([("inputs".to_owned(), inputs.iter().map(input).collect())])
}

fn optimum(study: &Study, results: &Results, o: &OptimumResult) -> Value {
    let objective = study.objective_of(o.objective);
    let value = objective.unit.shown(o.optimum.value());
    let work = o.optimum.stages.all();
    let mut told = json!({
        "design": o.design.name,
        "objective": objective.key,
        "value": value.is_finite().then_some(value),
        "unit": objective.unit.symbol(),
        "limits_hold": results.holds_limits(&o.design),
        "first_order_residual": o.optimum.outcome.kkt_residual,
        "starts": o.optimum.starts.len(),
        "starts_that_agree": o.optimum.agreeing(),
        "evaluations": work.evaluations,
        "evaluations_without_finite_response": work.unbounded_evaluations,
        "judged": results_json::judged(study, results, &o.design),
    });
    let verdicts = results_json::verdicts(results, &o.design);
    if let (Value::Object(map), false) = (&mut told, verdicts.is_empty()) {
        map.insert("verdicts".into(), json!(verdicts));
    }
    told
}
