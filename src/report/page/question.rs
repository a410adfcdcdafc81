//! What was asked, what the answer is, and whether to believe it.

use super::parts::{limits_judged_in, value_of};
use crate::analysis::verdict::Verdict;
use crate::analysis::{DesignResult, OptimumResult, Results};
use crate::input::Study;
use crate::objective::{Condition, Over};
use crate::text::judged::{asked, is_other, list, of_what, word};
use crate::text::limits::broken_within_tolerances;
use crate::text::verdict::{clause, of_design};
use crate::text::{bounds, dash, short, tolerances};
use maud::{Markup, html};

/// A value of the study's first objective.
fn objective(study: &Study, value: f64) -> String {
    value_of(&study.objective, value)
}

/// What a design is judged by, with what that is and the reference beside it.
fn judged(study: &Study, results: &Results, d: &DesignResult) -> String {
    let shown = |v: f64| objective(study, v);
    dash(results.judged(d).map(|j| format!("{}{}", shown(j.value), of_what(&j, shown))))
}

/// Heads of the columns of a table of designs that tell what these are judged by.
pub(super) fn judged_heads(study: &Study) -> Markup {
    let of = &study.objective;
    let unit = of.unit.suffix().trim();
    let name = if is_other(study) { of.label.as_str() } else { "judged" };
    html! { th { (name) @if !unit.is_empty() { ", " (unit) } } th { "worst in" } }
}

/// Their cells: the value, and what it is reached in where that is not the reference.
pub(super) fn judged_cells(study: &Study, results: &Results, d: &DesignResult) -> Markup {
    let own = results.judged(d);
    let value = own.as_ref().map(|j| short(study.objective.unit.shown(j.value)));
    html! { td { (dash(value)) } td { (dash(own.filter(|j| !j.is_reference()).map(|j| word(j.reached_in)))) } }
}

/// What is absurd of designs: a line each of those of which something is to be said.
pub(super) fn verdicts<'d>(results: &Results, designs: impl Iterator<Item = &'d DesignResult>) -> Markup {
    let all: Vec<(&str, String)> =
        designs.map(|d| (d.name.as_str(), told(results, d, |_| true).join("; "))).filter(|d| !d.1.is_empty()).collect();
    html! { @if !all.is_empty() { p { "Verdicts:" } ul id="verdicts" { @for (name, words) in all { li { b { (name) } ": " span class="bad" { (words) } } } } } }
}

/// What is absurd of a design, as far as it is wanted.
fn told(results: &Results, d: &DesignResult, wanted: impl Fn(&Verdict) -> bool) -> Vec<String> {
    let (found, of) = of_design(results, d);
    found.iter().filter(|v| wanted(v)).map(|v| clause(v, of, &d.absorbers)).collect()
}

/// The question, then an answer each: the best as drawn, and the best within tolerances.
pub(super) fn question(study: &Study, results: &Results) -> Markup {
    let (low, high) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    // the objective may be the same in conditions that its limits are judged in
    let (judged_in, limits_in) = (asked(results), limits_judged_in(study, results));
    let (drawn, robust) = (results.best_optimum(false), results.best_optimum(true));
    html! {
        h1 { (study.engine.name) ": " (study.name) }
        p { "Which absorber makes the " (study.objective.label) @if study.objective.unit.is_inverse() { " largest" } @else { " smallest" }
            @if !matches!(study.objective.measure.over, Over::Property(_)) { " from " (low) " to " (high) " rpm" }
            @if !judged_in.is_empty() { ", at the worst of " (judged_in) }
            @if !study.limits.is_empty() { ", within " @for (i, l) in study.limits.iter().enumerate() { @if i > 0 { ", " } (l.words) }
                @if judged_in.is_empty() && limits_in != ["firing"] { ", each at the worst of " (list(&limits_in)) } }
            "?"
            @if let Some(spec) = study.robust.as_ref().filter(|_| robust.is_some()) { " And which at its worst within the tolerances of its making (" (tolerances(spec)) ")?" } }
        @if let Some(o) = drawn {
            (answer(study, results, &o.design, if robust.is_some() { "As drawn, " } else { "" }))
            (belief(o))
            @if let Some(r) = robust { (answer(study, results, &r.design, "Within the tolerances, ")) (belief(r)) }
        } @else if let Some(best) = results.best_given() {
            p { "The study asks for no optimum: its designs are compared." }
            (answer(study, results, best, "The best of them is "))
        } @else { p class="answer" { "The study asks for no optimum: its designs are compared." } }
    }
}

/// A design as an answer.
fn answer(study: &Study, results: &Results, d: &DesignResult, lead: &str) -> Markup {
    let given = results.designs.iter().find(|d| d.absorbers.is_empty()).and_then(|d| d.objective);
    let none = given.or_else(|| results.bare.first().copied().flatten());
    let within =
        results.robust.iter().find(|r| r.design == d.name).filter(|_| !results.optima.iter().any(|o| o.robust && o.design.name == d.name));
    html! {
        p class="answer" {
            (lead) b { (d.name) } ": " (judged(study, results, d))
            @if let Some(w) = within { "; at its worst within the tolerances " (objective(study, w.worst.value)) }
            @if let Some(none) = none { "; without absorber it is " (objective(study, none)) }
            ". "
            @if d.objective.is_none() { span class="bad" { "At some speeds no steady motion of it is known. " } }
            @if study.limits.is_empty() { "The study has no limits." }
            @else if results.holds_limits(d) { span class="good" { "All limits hold" (scope(results, d)) "." } }
            @else { span class="bad" { "Limits are broken" (if study.optimise.is_some() { ": no design that holds them all was found." } else { "." }) } }
            @if let Some(words) = broken_within_tolerances(study, results, d) { span class="bad" { (if results.holds_limits(d) { " But " } else { " " }) (words) "." } }
        }
        // bounds are told below, with what lies beyond them
        @let said = told(results, d, |v| !matches!(v, Verdict::OnBound(_)));
        @if !said.is_empty() { ul { @for v in said { li class="bad" { (v) } } } }
    }
}

/// What the limits of an optimum within tolerances were judged in.
fn scope(results: &Results, d: &DesignResult) -> &'static str {
    let robust = results.optima.iter().any(|o| o.robust && o.design.name == d.name);
    let operates = d.conditions.iter().any(|c| c.condition == Condition::InOperation);
    match (robust, operates) {
        (false, _) if results.robust.iter().any(|r| r.design == d.name) => " as drawn",
        (false, _) => "",
        (true, false) => " within the tolerances",
        (true, true) => " within the tolerances, and as drawn in operation",
    }
}

/// How an optimum was found.
fn belief(o: &OptimumResult) -> Markup {
    html! {
        p {
            (o.optimum.agreeing()) " of " (o.optimum.starts.len()) " starts agree; first-order residual "
            (format!("{:.0e}", o.optimum.outcome.kkt_residual)) @if o.is_unfinished() { " " span class="bad" { "(not converged)" } } "; " @if o.scan.designs > 0 { (o.scan.designs) " designs elsewhere and " } (o.nearby.designs) " near it "
            @if o.scan.better || o.nearby.better { "were looked at, one of which led to it." } @else { "are no better." }
            @if let Some(s) = &o.survey { " " (s.designs) " designs over all its bounds were looked at" @if s.under_limits { " for ones within the limits" } "; " @if s.better { "it was found from one of them." } @else if s.followed == 0 { "none was worth following." } @else { "those that were followed led to nothing lower." } }
            @if o.on_bounds.is_empty() { " It lies on no bound." } @else { " It lies on these bounds:" }
        }
        @if !o.on_bounds.is_empty() { ul { @for line in bounds(o) { li class="bad" { (line.trim().replace('`', "")) } } } }
    }
}
