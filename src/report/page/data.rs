//! What the script of the page draws, as JSON; five significant digits, which is more than a screen shows.

use super::numbers::{digits, list};
use super::{fronts, modes};
use crate::analysis::sweeps::QuantitySweep;
use crate::analysis::{DesignResult, Results, Sweeps};
use crate::input::Study;
use crate::objective::Condition;
use serde_json::{Map, Value, json};

/// Curves over speed on the page: those of all files, and of optima of other sizes.
pub(super) fn sweeps(results: &Results) -> impl Iterator<Item = &Sweeps> {
    results.sweeps.iter().chain(&results.sweeps_of_sizes)
}

/// Designs whose curves are on the page: those that are swept, the given ones first.
pub(super) fn shown(results: &Results) -> Vec<&DesignResult> {
    let all = || results.designs.iter().chain(results.optima.iter().map(|o| &o.design));
    sweeps(results).filter_map(|s| all().find(|d| d.name == s.design)).collect()
}

/// What the script knows a quantity by.
pub(super) fn key(q: &QuantitySweep) -> String {
    format!("{} {} {}", q.of.name(), q.place, q.condition.name())
}

/// A quantity in words.
pub(super) fn label(q: &QuantitySweep) -> String {
    let condition = if q.condition == Condition::Firing { String::new() } else { format!(", {}", q.condition.name()) };
    format!("{} of {}{condition}", q.of.name(), q.place).replace('_', " ")
}

/// What the script knows temperatures by.
pub(super) const TEMPERATURE: (&str, &str) = ("temperature", "temperature of the absorber reached from cold");

fn sweep(s: &Sweeps, results: &Results) -> Value {
    let mut own = Map::new();
    if let Some(heat) = results.heat.iter().find(|h| h.design == s.design) {
        let reached: Value = heat.points.iter().map(|p| p.cold_start().map_or(Value::Null, |b| digits(b.celsius))).collect();
        own.insert(TEMPERATURE.0.into(), json!({ "total": reached, "orders": [] }));
    }
    for (i, q) in s.quantities.iter().enumerate() {
        // orders of the twist; of all else what they come to together
        let orders: Value = if i == 0 { q.orders.iter().map(|o| list(&o.amplitude)).collect() } else { json!([]) };
        own.insert(key(q), json!({ "total": list(&q.total), "orders": orders }));
    }
    Value::Object(own)
}

fn margins(study: &Study, results: &Results) -> Value {
    let criteria = study.fatigue.as_ref().map_or(&[][..], |f| f.criteria.as_slice());
    let margins_of = |m: &crate::analysis::MarginSweep| {
        let each = criteria.iter().enumerate().map(|(i, c)| (c.column().to_owned(), list(&m.smallest(i))));
        (m.design.clone(), Value::Object(each.collect()))
    };
    Value::Object(results.margins.iter().map(margins_of).collect())
}

/// Everything.
pub(super) fn data(study: &Study, results: &Results) -> Value {
    let shown = shown(results);
    let design = |d: &&DesignResult| json!({ "name": d.name, "told": fronts::told(&d.absorbers) });
    let none = shown.iter().find(|d| d.absorbers.is_empty()).or(shown.first()).map(|d| d.name.clone());
    let best = results.best_optimum(false).map(|o| &o.design);
    let chosen: Vec<String> = none.into_iter().chain(best.map(|d| d.name.clone())).collect();
    let quantities = results.sweeps.iter().max_by_key(|s| s.quantities.len()).map_or(&[][..], |s| &s.quantities);
    let unit = |q: &QuantitySweep| if q.of.unit() == "deg" { "°" } else { q.of.unit() };
    let named = |q: &QuantitySweep| json!({ "name": key(q), "label": label(q), "unit": unit(q) });
    let temperature = (!results.heat.is_empty()).then(|| json!({ "name": TEMPERATURE.0, "label": TEMPERATURE.1, "unit": "°C" }));
    let sweeps: Map<String, Value> = sweeps(results).map(|s| (s.design.clone(), sweep(s, results))).collect();
    json!({
        "speeds": list(&study.speeds_rpm),
        "orders": results.system.excitation.orders.iter().map(ToString::to_string).collect::<Vec<_>>(),
        "designs": shown.iter().map(design).collect::<Vec<_>>(),
        "chosen": chosen,
        "quantities": quantities.iter().map(named).chain(temperature).collect::<Vec<_>>(),
        "sweeps": sweeps,
        "margins": margins(study, results),
        "modes": modes::data(study, results),
        "fronts": fronts::data(study, results, &shown),
    })
}
