//! The fronts of a run, for the script of the page and as its section.

use super::numbers::{digits, list};
use crate::absorber::Mounted;
use crate::analysis::{DesignResult, FrontResult, Results, TradeoffResult};
use crate::captions::types_of;
use crate::csv::in_unit;
use crate::input::{FrontSpec, MeasureSpec, Study};
use crate::text::short;
use maud::{Markup, html};
use serde_json::{Map, Value, json};

/// A design in words: the parameters of its absorbers.
pub(super) fn told(absorbers: &[Mounted]) -> String {
    let parameters = |m: &Mounted| {
        let law = m.absorber.law()?;
        let parts = law.declaration().parameters.iter().zip(law.values());
        let values: Vec<String> = parts.map(|(p, v)| format!("{} {}", p.label.replacen('/', ", ", 1), short(v))).collect();
        Some(values.join("; "))
    };
    absorbers.iter().filter_map(parameters).collect::<Vec<_>>().join(" | ")
}

/// The measures that the study wants fronts of; none where it wants them over ring inertia.
fn measures(study: &Study) -> &[MeasureSpec] {
    match &study.front {
        Some(FrontSpec::Of { measures, .. }) => measures,
        _ => &[],
    }
}

fn axis(m: &MeasureSpec) -> String {
    let (label, unit) = (m.label.replace('_', " "), m.unit.suffix().trim());
    if unit.is_empty() { label } else { format!("{label}, {unit}") }
}

fn said(m: &MeasureSpec, value: f64) -> String {
    format!("{} {}{}", m.label.replace('_', " "), short(m.unit.shown(value)), m.unit.suffix())
}

/// A point of a front: where it stands, whether another beats it, and what is said of it.
struct Point {
    at: [f64; 2],
    dominated: bool,
    told: String,
}

fn family(name: &str, points: &[Point]) -> Value {
    let along = |i: usize| list(&points.iter().map(|p| p.at[i]).collect::<Vec<_>>());
    let dominated: Vec<bool> = points.iter().map(|p| p.dominated).collect();
    json!({ "name": name, "x": along(0), "y": along(1), "dominated": dominated, "told": points.iter().map(|p| p.told.as_str()).collect::<Vec<_>>() })
}

/// The fronts over ring inertia; `shown`: designs with curves on the page.
fn over_inertia(study: &Study, results: &Results, shown: &[&DesignResult]) -> Option<Value> {
    if results.fronts.is_empty() {
        return None;
    }
    let point = |p: &crate::optimise::FrontPoint| Point {
        at: [p.design[0].absorber.ring_inertia(), in_unit(study, p.value)],
        dominated: p.dominated,
        told: format!("{}: {}", told(&p.design), said(&study.objective, p.value)),
    };
    let family_of = |f: &FrontResult| family(f.declaration.name, &f.front.points.iter().map(point).collect::<Vec<_>>());
    let ring = |d: &DesignResult| d.absorbers.iter().map(|m| m.absorber.ring_inertia()).sum();
    let beside = |d: &&DesignResult| {
        let value = d.objective.filter(|_| !d.absorbers.is_empty())?;
        Some((d.name.clone(), json!([digits(ring(d)), digits(in_unit(study, value))])))
    };
    Some(json!({
        "title": "over ring inertia",
        "x": "ring inertia, kg m²",
        "y": axis(&study.objective),
        "fronts": results.fronts.iter().map(family_of).collect::<Vec<_>>(),
        "designs": shown.iter().filter_map(beside).collect::<Map<_, _>>(),
    }))
}

/// The front of a pair: the second measure to the right, the first upwards, as in its plot.
fn of_pair(study: &Study, t: &TradeoffResult) -> Value {
    let [up, right] = t.of.map(|m| &measures(study)[m]);
    let third = (0..measures(study).len()).find(|m| !t.of.contains(m)).map(|m| &measures(study)[m]);
    let coordinates = |values: [f64; 2]| [right.unit.shown(values[1]), up.unit.shown(values[0])];
    let family_of = |(i, (name, front)): (usize, &(String, crate::optimise::Tradeoff))| {
        let point = |(k, p): (usize, &crate::optimise::TradeoffPoint)| {
            let more = third.zip(t.third.get(i).and_then(|v| v.get(k)));
            Point {
                at: coordinates(p.values),
                dominated: p.dominated,
                told: format!(
                    "{}: {}, {}{}{}",
                    told(&p.design),
                    said(up, p.values[0]),
                    said(right, p.values[1]),
                    more.map_or_else(String::new, |(m, v)| format!(", {}", said(m, *v))),
                    if p.knee { "; the knee" } else { "" }
                ),
            }
        };
        let finite = |p: &Point| p.at.iter().all(|v| v.is_finite());
        family(&types_of(name), &front.points.iter().enumerate().map(point).filter(finite).collect::<Vec<_>>())
    };
    let beside = |g: &crate::analysis::Beside| {
        let place = coordinates(g.values);
        place.iter().all(|v| v.is_finite()).then(|| (g.design.clone(), json!(place.map(digits))))
    };
    json!({
        "title": format!("{} against {}", up.label.replace('_', " "), right.label.replace('_', " ")),
        "x": axis(right),
        "y": axis(up),
        "fronts": t.families.iter().enumerate().map(family_of).collect::<Vec<_>>(),
        "designs": t.given.iter().filter_map(beside).collect::<Map<_, _>>(),
    })
}

/// All fronts.
pub(super) fn data(study: &Study, results: &Results, shown: &[&DesignResult]) -> Vec<Value> {
    over_inertia(study, results, shown).into_iter().chain(results.tradeoffs.iter().map(|t| of_pair(study, t))).collect()
}

/// Their section.
pub(super) fn fronts(results: &Results) -> Markup {
    let number = results.tradeoffs.len() + usize::from(!results.fronts.is_empty());
    html! { @if number > 0 {
        h2 { "Fronts" }
        p class="soft" { "Each point is the best absorber of its kind that was found at that cost. Filled ones hold the limits, and no other point of any kind is better in both; of the others, beaten or beyond a limit, those beyond are the nearest to their limits that were found. Given designs stand beside: a click draws one below." }
        div class="tools" hidden[number < 2] { label { "Front " select id="fronts" {} } }
        div id="front" {}
        p id="picked" class="read" {}
    } }
}
