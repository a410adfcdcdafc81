//! What the script of the page draws, as JSON; five significant digits, which is more than a screen shows.

use super::modes;
use super::numbers::{digits, list};
use crate::analysis::sweeps::QuantitySweep;
use crate::analysis::{DesignResult, Results, Sweeps};
use crate::input::Study;
use crate::objective::Condition;
use crate::report::csv::in_unit;
use serde_json::{Map, Value, json};

/// Designs whose curves are on the page: those that are swept, the given ones first.
pub(super) fn shown(results: &Results) -> Vec<&DesignResult> {
    let all = || results.designs.iter().chain(results.optima.iter().map(|o| &o.design));
    results.sweeps.iter().filter_map(|s| all().find(|d| d.name == s.design)).collect()
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
    let of = |m: &crate::analysis::MarginSweep| {
        let each = criteria.iter().enumerate().map(|(i, c)| (c.column().to_owned(), list(&m.smallest(i))));
        (m.design.clone(), Value::Object(each.collect()))
    };
    Value::Object(results.margins.iter().map(of).collect())
}

/// A design in words: its parameters.
fn told(d: &DesignResult) -> String {
    let of = |m: &crate::absorber::Mounted| {
        let law = m.absorber.law()?;
        let parts = law.declaration().parameters.iter().zip(law.values());
        let values: Vec<String> =
            parts.map(|(p, v)| format!("{} {}", p.label.replacen('/', ", ", 1), crate::report::text::short(v))).collect();
        Some(values.join("; "))
    };
    d.absorbers.iter().filter_map(of).collect::<Vec<_>>().join(" | ")
}

/// The fronts over ring inertia.
fn front(study: &Study, results: &Results) -> Option<Value> {
    if results.fronts.is_empty() {
        return None;
    }
    let fronts = results.fronts.iter().map(|f| {
        let points = &f.front.points;
        let x: Vec<f64> = points.iter().map(|p| p.design[0].absorber.ring_inertia()).collect();
        let y: Vec<f64> = points.iter().map(|p| in_unit(study, p.value)).collect();
        let words = |p: &crate::optimise::FrontPoint| {
            let a = &p.design[0].absorber;
            let number = |symbol: &str, v: Option<f64>| v.map_or_else(String::new, |v| format!(", {symbol} {}", crate::report::text::short(v)));
            format!(
                "ring {} kg m²{}{}: {}{}",
                crate::report::text::short(a.ring_inertia()),
                number("k", a.stiffness()),
                number("c", a.damping()),
                crate::report::text::short(in_unit(study, p.value)),
                study.objective.unit.suffix()
            )
        };
        let dominated: Vec<bool> = points.iter().map(|p| p.dominated).collect();
        json!({ "name": f.declaration.name, "x": list(&x), "y": list(&y), "dominated": dominated, "told": points.iter().map(words).collect::<Vec<_>>() })
    });
    let fronts: Vec<Value> = fronts.collect();
    Some(
        json!({ "x": "ring inertia, kg m²", "y": format!("{}{}", study.objective.label, comma(study.objective.unit.suffix())), "fronts": fronts }),
    )
}

fn comma(unit: &str) -> String {
    let unit = unit.trim();
    if unit.is_empty() { String::new() } else { format!(", {unit}") }
}

/// Everything.
pub(super) fn data(study: &Study, results: &Results) -> Value {
    let shown = shown(results);
    let design = |d: &&DesignResult| {
        let place = d.objective.filter(|_| !d.absorbers.is_empty()).map(|v| {
            let ring: f64 = d.absorbers.iter().map(|m| m.absorber.ring_inertia()).sum();
            json!([digits(ring), digits(in_unit(study, v))])
        });
        json!({ "name": d.name, "front": place, "told": told(d) })
    };
    let none = shown.iter().find(|d| d.absorbers.is_empty()).or(shown.first()).map(|d| d.name.clone());
    let best = results
        .optima
        .iter()
        .filter(|o| o.main && o.objective == 0 && !o.robust)
        .min_by(|a, b| a.optimum.value().total_cmp(&b.optimum.value()));
    let chosen: Vec<String> = none.into_iter().chain(best.map(|o| o.design.name.clone())).collect();
    let quantities = results.sweeps.iter().max_by_key(|s| s.quantities.len()).map_or(&[][..], |s| &s.quantities);
    let unit = |q: &QuantitySweep| if q.of.unit() == "deg" { "°" } else { q.of.unit() };
    let named = |q: &QuantitySweep| json!({ "name": key(q), "label": label(q), "unit": unit(q) });
    let temperature = (!results.heat.is_empty()).then(|| json!({ "name": TEMPERATURE.0, "label": TEMPERATURE.1, "unit": "°C" }));
    let sweeps: Map<String, Value> = results.sweeps.iter().map(|s| (s.design.clone(), sweep(s, results))).collect();
    json!({
        "speeds": list(&study.speeds_rpm),
        "orders": results.system.excitation.orders.iter().map(ToString::to_string).collect::<Vec<_>>(),
        "designs": shown.iter().map(design).collect::<Vec<_>>(),
        "chosen": chosen,
        "quantities": quantities.iter().map(named).chain(temperature).collect::<Vec<_>>(),
        "sweeps": sweeps,
        "margins": margins(study, results),
        "modes": modes::data(study, results),
        "front": front(study, results),
    })
}
