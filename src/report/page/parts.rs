//! Parts that pages share.

use crate::absorber::Parameter;
use crate::analysis::{DesignResult, Results};
use crate::files::Folder;
use crate::input::{InputFile, MeasureSpec, Study};
use crate::objective::{Condition, holds};
use crate::text::limits::not_judged;
use crate::text::{check, dash, notes, short, whole, width};
use crate::units::DEG_PER_RAD;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use maud::{DOCTYPE, Markup, PreEscaped, html};

/// How pages look.
const STYLE: &str = include_str!("page.css");

/// Tables that sort and filter.
pub(crate) const TABLES: &str = include_str!("tables.js");

/// A page that needs nothing from elsewhere.
pub(crate) fn page(title: &str, body: &Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(STYLE)) }
            }
            body { (body) }
        }
    };
    page.into_string()
}

/// A value of a measure in its own unit and sense.
pub(super) fn value_of(of: &MeasureSpec, value: f64) -> String {
    format!("{}{}", short(of.unit.shown(value)), of.unit.suffix())
}

/// Parameters that some design has, each once.
pub(super) fn parameters<'a>(designs: impl Iterator<Item = &'a DesignResult>) -> Vec<&'static Parameter> {
    let mut list: Vec<&Parameter> = Vec::new();
    for p in designs.flat_map(|d| &d.absorbers).filter_map(|m| m.absorber.declaration()).flat_map(|d| d.parameters) {
        if list.iter().all(|known| known.key != p.key) {
            list.push(p);
        }
    }
    list
}

pub(super) fn limits(study: &Study, results: &Results) -> Markup {
    let all = || results.designs.iter().chain(results.optima.iter().map(|o| &o.design));
    html! { @if !study.limits.is_empty() {
        h2 { "Limits" }
        div class="scroll" { table class="sorts" {
            thead { tr { th { "design" } th class="words" { "limit" } th { "value" } th { "used, %" } th { "" } } }
            tbody { @for d in all() { @for (l, ratio) in study.limits.iter().zip(&d.limits) {
                @let said = results.has_value(d, &l.of.measure);
                tr { td { (d.name) } td class="words" { (l.words) } td { @if said && l.of.measure.within.factors.is_empty() { (short(l.of.unit.shown(ratio * l.limit))) (l.of.unit.suffix()) } @else { "–" } } td { @if said { (format!("{:.1}", 100.0 * ratio)) } @else { "–" } }
                    td { @if !said { (no_value(d, &l.of.measure)) } @else if holds(*ratio) { span class="good" { "holds" } } @else { span class="bad" { "broken" } } } }
            } } }
        } }
        p class="soft" { "Judged in: " (limits_judged_in(study, results).join(", ")) "." }
        @for (d, words) in all().filter_map(|d| Some((d, not_judged(study, d)?))) { p class="bad" { (d.name) ": " (words) "." } }
        (rule_stresses(study, results))
    } }
}

/// Why a design has no value of a measure.
fn no_value(d: &DesignResult, measure: &crate::objective::Measure) -> Markup {
    html! {
        @if d.has(measure) { span class="bad" { "overheats" } } @else if d.absorbers.is_empty() { "no absorber" } @else { "no such absorber" }
    }
}

/// Conditions that limits are judged in, of some design at least.
pub(super) fn limits_judged_in(study: &Study, results: &Results) -> Vec<String> {
    let mut all = results.designs.iter().chain(results.optima.iter().map(|o| &o.design)).flat_map(|d| &d.conditions);
    let operates = all.any(|c| c.condition == Condition::InOperation);
    let held = study.held().iter().copied().chain(operates.then_some(Condition::InOperation));
    held.map(|c| c.name().replace('_', " ")).collect()
}

/// Where each design uses most of each limit by a rule.
fn rule_stresses(study: &Study, results: &Results) -> Markup {
    let all =
        || results.designs.iter().chain(results.optima.iter().map(|o| &o.design)).flat_map(|d| d.rule_stresses.iter().map(move |r| (d, r)));
    html! { @if all().next().is_some() {
        h3 { "Stress by rules, where it is nearest to its limit" }
        div class="scroll" { table class="sorts" {
            thead { tr { th { "design" } th class="words" { "limit" } th { "condition" } th { "cylinder" } th { "at rpm" } th { "of the rated speed" } th { "stress, MPa" } th { "limit there, MPa" } th { "%" } } }
            tbody { @for (d, r) in all() { @let l = &study.limits[r.limit]; @let limit = l.of.unit.shown(r.of_rated * l.limit); tr {
                td { (d.name) } td class="words" { (l.words) } td { (r.condition.name().replace('_', " ")) } td { (dash(r.cylinder.map(|c| (c + 1).to_string()))) }
                td { (format!("{:.0}", r.speed_rpm)) } td { (dash(l.rule.as_ref().map(|rule| short(r.speed_rpm / rule.rated_rpm)))) }
                td { (short(r.ratio * limit)) } td { (short(limit)) } td { (format!("{:.1}", 100.0 * r.ratio)) }
            } } }
        } }
    } }
}

pub(super) fn conditions(results: &Results) -> Markup {
    let all = || results.designs.iter().chain(results.optima.iter().filter(|o| o.main).map(|o| &o.design));
    html! { @if all().any(|d| !d.conditions.is_empty()) {
        h2 { "Conditions" }
        div class="scroll" { table class="sorts" {
            thead { tr { th { "design" } th class="words" { "condition" } th { "cylinder" } th { "twist, °" } th { "at rpm" } th { "torque, N m" } } }
            tbody { @for d in all() { @for c in &d.conditions {
                tr { td { (d.name) } td class="words" { (c.condition.name().replace('_', " ")) } td { (dash(c.cylinder.map(|c| (c + 1).to_string()))) }
                    td { (dash(c.twist.map(|p| short(p.value * DEG_PER_RAD)))) } td { (dash(c.twist.map(|p| format!("{:.0}", p.speed_rpm)))) } td { (dash(c.torque.map(|p| short(p.value)))) } }
            } } }
        } }
    } }
}

/// What `hartog check` prints: chain, modes, damping, pressure and what is assumed.
pub(super) fn model(study: &Study, on_flexible: bool) -> Markup {
    html! {
        h2 { "The model" }
        p class="soft" { "As `hartog check --verbose` prints it: chain, modes, pressure, crank (flexible where this response is that of a flexible crank), and what was computed." }
        div class="scroll" { pre { (width::for_a_file(|| width::wrapped(&check::model(study, on_flexible)))) } }
    }
}

/// What is to be known of the inputs, and what was found, as `hartog run --verbose` prints it.
pub(super) fn findings(study: &Study, results: &Results) -> Markup {
    let notes = width::for_a_file(|| notes(study, results));
    html! {
        @if !notes.is_empty() {
            h2 { "Notes and warnings" }
            ul { @for line in &notes { li { (line) } } }
        }
        h2 { "What was found, in words" }
        p class="soft" { "As `hartog run --verbose` prints it: margins, duty, catalogue, materials, heat, strain, conditions, tolerances, certificates with sensitivities and prices, limits and barred ranges." }
        div class="scroll" { pre { (width::for_a_file(|| width::wrapped(&whole(study, results.calibration.as_ref(), results)))) } }
    }
}

/// A picture that this run has written, as an address that holds it.
pub(super) fn picture(folder: &Folder, name: &str) -> Option<String> {
    let bytes = std::fs::read(folder.path().join(name)).ok().filter(|_| folder.has_written(name))?;
    Some(format!("data:image/svg+xml;base64,{}", STANDARD.encode(bytes)))
}

pub(super) fn provenance(study: &Study, inputs: &[InputFile], results: &Results) -> Markup {
    html! {
        h2 { "Where this comes from" }
        p { "hartog " (env!("CARGO_PKG_VERSION")) ", method " (results.method) @if let Some(o) = &study.optimise { ", seed " (o.seed) } ". Tables beside this page hold every number to full precision." }
        div class="scroll" { table { thead { tr { th { "input file" } th { "bytes" } th { "CRC-32" } } } tbody { @for f in inputs { tr { td { (f.path.display()) } td { (f.bytes) } td { (format!("{:08x}", f.crc32)) } } } } } }
    }
}
