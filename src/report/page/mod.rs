//! `report.html`: one page with everything of a run; it needs no network and no other file.

mod classification;
mod crank_modes;
mod data;
mod folder;
mod fronts;
mod modes;
mod numbers;
mod parts;
mod question;
mod tables;

pub use classification::write as write_classification;
pub use folder::write as write_folder;

use super::files::{Folder, WriteError};
use super::names::PAGE;
use crate::analysis::{DesignResult, OptimumResult, Results, TradeoffResult};
use crate::input::{FrontSpec, InputFile, Study};
use crate::text::judged::is_apart;
use crate::text::{dash, short};
use crate::units::DEG_PER_RAD;
use maud::{Markup, PreEscaped, html};
pub(crate) use parts::{TABLES, page};
use parts::{conditions, findings, limits, model, parameters, picture, provenance, value_of};
use question::{judged_cells, judged_heads, question, verdicts};

const SCRIPT: &str = include_str!("page.js");
/// The modes of a flexible crank.
const CRANK: &str = include_str!("crank.js");

/// Tables that the page draws, and that of times, which is written after it.
const DRAWN: [&str; 3] = ["response", "margin", "timing"];

/// What takes long of the page and asks for no plots.
pub(crate) struct Prepared {
    /// What its script draws from.
    data: String,
    /// What was found, in words.
    findings: Markup,
    /// What the model is.
    model: Markup,
}

/// JSON in a page: within a script `<` begins comments and ends it, and the two separators once ended lines of scripts.
pub(crate) fn embedded(data: &serde_json::Value) -> String {
    let escaped = [('<', "\\u003c"), ('\u{2028}', "\\u2028"), ('\u{2029}', "\\u2029")];
    escaped.iter().fold(data.to_string(), |text, (c, by)| text.replace(*c, by))
}

/// That of a run.
pub(crate) fn prepared(study: &Study, results: &Results) -> Prepared {
    Prepared {
        data: embedded(&data::data(study, results)),
        findings: findings(study, results),
        model: model(study, results.system.flexible.is_some()),
    }
}

/// Writes the page about its data; plots of the run are taken from the folder.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
#[doc(hidden)]
pub fn write((study, inputs): (&Study, &[InputFile]), results: &Results, prepared: &Prepared, folder: &Folder) -> Result<(), WriteError> {
    folder.write(PAGE, page(&format!("{} – hartog", study.name), &body((study, inputs), results, prepared, folder)).as_bytes())
}

fn body((study, inputs): (&Study, &[InputFile]), results: &Results, prepared: &Prepared, folder: &Folder) -> Markup {
    html! {
        (question(study, results))
        (designs(study, results))
        (fronts::fronts(results))
        (response(results))
        (margins(study, results))
        (limits(study, results))
        (modes::modes(results.system.flexible.is_some()))
        (certificates(study, results))
        (conditions(results))
        (prepared.findings)
        (tables::tables(folder, &DRAWN))
        (prepared.model)
        (plots(study, results, folder))
        (provenance(study, inputs, results))
        script type="application/json" id="data" { (PreEscaped(&prepared.data)) }
        script { (PreEscaped(TABLES)) (PreEscaped(SCRIPT)) @if results.system.flexible.is_some() { (PreEscaped(CRANK)) } }
    }
}

fn designs(study: &Study, results: &Results) -> Markup {
    let all = || results.designs.iter().chain(results.optima.iter().map(|o| &o.design));
    // the twist that every table shows may be what designs are judged by
    let judged = is_apart(study, results);
    let swept = |d: &DesignResult| data::sweeps(results).any(|s| s.design == d.name);
    let columns = parameters(all());
    let cell = |d: &DesignResult, key: &str| {
        let each = d.absorbers.iter().map(|m| dash(m.absorber.value(key).map(short)));
        if d.absorbers.is_empty() { dash(None) } else { each.collect::<Vec<_>>().join(" | ") }
    };
    html! {
        h2 { "Designs" }
        div class="tools" { label { "Find " input type="search" data-of="designs" aria-label="Find designs"; }
            label { input type="checkbox" id="radians"; " radians" }
            span class="soft" { "Ticked designs are drawn below. Values of several absorbers are separated by |." } }
        div class="scroll" { table id="designs" class="sorts" {
            thead { tr {
                th { "design" } @for p in &columns { th { (p.label.replacen('/', ", ", 1)) } } th { "twist, °" } th { "at rpm" } th { "torque, N m" } th { "dissipated, W" }
                @if judged { (judged_heads(study)) } @if !study.limits.is_empty() { th { "limits" } }
            } }
            tbody { @for d in all() {
                tr data-design=(d.name) {
                    td { @if swept(d) { label { input type="checkbox" aria-label=(format!("draw {}", d.name)); span class="swatch" {} (d.name) } } @else { (d.name) } }
                    @for p in &columns { td { (cell(d, p.key)) } }
                    td { (dash(d.twist.map(|p| short(p.value * DEG_PER_RAD)))) }
                    td { (dash(d.twist.map(|p| format!("{:.0}", p.speed_rpm)))) }
                    td { (dash(d.torque.map(|p| short(p.value)))) }
                    td { (dash(d.power.map(short))) }
                    @if judged { (judged_cells(study, results, d)) }
                    @if !study.limits.is_empty() { td { @if results.holds_limits(d) { span class="good" { "hold" } } @else { span class="bad" { "broken" } } } }
                }
            } }
        } }
        (verdicts(results, all()))
    }
}

fn response(results: &Results) -> Markup {
    let quantities = results.sweeps.iter().max_by_key(|s| s.quantities.len()).map_or(&[][..], |s| &s.quantities);
    html! {
        h2 { "Response over speed" }
        div class="tools" {
            label { "Quantity " select id="quantity" { @for q in quantities { option value=(data::key(q)) { (data::label(q)) } } @if !results.heat.is_empty() { option value=(data::TEMPERATURE.0) { (data::TEMPERATURE.1) } } } }
            label { "Order " select id="order" { option value="all" { "all together" } @for (i, o) in results.system.excitation.orders.iter().enumerate() { option value=(i) { (o) } } } }
            label { input type="checkbox" id="log"; " logarithmic" }
            span class="soft" { "Drag to zoom, double-click or Escape for all; arrow keys read out." }
        }
        div id="response" {}
    }
}

fn margins(study: &Study, results: &Results) -> Markup {
    let criteria = study.fatigue.as_ref().map_or(&[][..], |f| f.criteria.as_slice());
    html! { @if !results.margins.is_empty() {
        h2 { "Margin of the crank" }
        div class="tools" { label { "Criterion " select id="criterion" { @for c in criteria { option value=(c.column()) { (c.column().replace('_', " ")) } } } } }
        div id="margin" {}
        @if let Some(crank) = study.crank.as_ref().filter(|c| !c.assumed.is_empty()) { p class="soft" { "Assumed dimensions: " (crank.assumed.join(", ")) "." } }
    } }
}

/// Whether a search ended at another value than the one that its optimum is judged by.
fn ends_elsewhere(results: &Results) -> bool {
    let ends = |o: &OptimumResult| (results.judged_optimum(o).value / o.optimum.value() - 1.0).abs() > 1e-6;
    results.optima.iter().any(ends)
}

fn certificates(study: &Study, results: &Results) -> Markup {
    let several = results.optima.iter().any(|o| o.objective > 0);
    let value = if ends_elsewhere(results) { "value at the end of the search" } else { "value" };
    html! { @if !results.optima.is_empty() {
        h2 { "Certificates of the optima" }
        div class="scroll" { table class="sorts" {
            thead { tr { th { "optimum" } th { (value) } @if several { th class="words" { "of" } } th { "starts that agree" } th { "first-order residual" } th { "active peaks and limits" } th { "other local optima" } th { "evaluations" } } }
            tbody { @for o in &results.optima {
                @let stages = &o.optimum.stages;
                tr {
                    td { (o.design.name) }
                    td { (value_of(study.objective_of(o.objective), o.optimum.value())) }
                    @if several { td class="words" { (study.objective_of(o.objective).label) } }
                    td { (o.optimum.agreeing()) " of " (o.optimum.starts.len()) }
                    td { (format!("{:.0e}", o.optimum.outcome.kkt_residual)) }
                    td { (o.optimum.outcome.multipliers.iter().filter(|m| **m > 1e-6).count()) }
                    td { (o.optimum.others.len()) }
                    td { (stages.seeds.evaluations + stages.search.evaluations + stages.minimax.evaluations) }
                }
            } }
        } }
    } }
}

/// Plots of the chain and its excitation, as they are in the folder.
fn plots(study: &Study, results: &Results, folder: &Folder) -> Markup {
    let measures = match &study.front {
        Some(FrontSpec::Of { measures, .. }) => measures.as_slice(),
        _ => &[],
    };
    let front = |t: &TradeoffResult| {
        let [first, second] = t.of.map(|m| &measures[m].word);
        (format!("front_{first}_{second}.svg"), "What one measure costs the other")
    };
    let others = [
        ("heat.svg", "Temperatures in balance"),
        ("large_twist.svg", "Motions at their own amplitude"),
        ("tolerance_band.svg", "Within tolerances"),
        ("campbell.svg", "Natural frequencies and critical speeds"),
        ("excitation.svg", "Orders of the torque"),
        ("crank.svg", "Loads along the crank"),
    ];
    let all = results.tradeoffs.iter().map(front).chain(others.map(|(name, words)| (name.to_owned(), words)));
    html! {
        h2 { "Fronts, chain and excitation" }
        div class="pair" { @for (name, words) in all { @if let Some(source) = picture(folder, &name) { figure { img src=(source) alt=(words); figcaption class="soft" { (words) } } } } }
    }
}
