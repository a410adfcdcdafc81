//! The answer of a run on one screen: which absorber, how much it saves, whether it is proved, whether it holds its limits, and the designs beside it.

use super::allocation;
use super::catalogue::best_of_catalogues;
use super::designs::{designs, narrow};
use super::flexible::by_models;
use super::judged::{sentence, value_of};
use super::limits::{barred, broken_within_tolerances, limits, not_judged, of_given};
use super::margin::below_acceptable;
use super::order_sheets;
use super::run::fronts;
use super::verdict::{clause, of_design};
use super::width::{is_wide, wrapped};
use super::{prices, proof};
use crate::absorber::{Host, Mounted};
use crate::analysis::judged::{Basis, Judged};
use crate::analysis::verdict::Verdict;
use crate::analysis::{Calibration, DesignResult, OptimumResult, Results};
use crate::input::{LimitSpec, Study};
use crate::objective::{Condition, holds};
use crate::optimise::Survey;
use crate::text::table::significant;

/// Lines of the screen, without the last one, which names the folder and what stands before it.
const LINES: usize = 37;
/// Rows of the table of designs are left out down to this number before anything else is.
const LEAST_ROWS: usize = 4;

/// The answer, in at most [`LINES`] lines unless the absorbers and limits of the design alone take more.
#[doc(hidden)]
pub fn answer(study: &Study, calibration: Option<&Calibration>, results: &Results) -> String {
    let head = head(study, results, calibration);
    let found = found(study, results);
    let notes = notes(study, results);
    if is_wide() {
        return format!("{head}\n{found}\n{}{notes}", designs(study, results));
    }
    let lines = |parts: &[&str]| parts.iter().map(|p| wrapped(p).lines().count()).sum::<usize>();
    // two empty lines stand between the parts
    let taken = lines(&[&head, &found]) + 2;
    let mut notes = wrapped(&notes);
    let most = LINES.saturating_sub(taken + LEAST_ROWS + 5);
    if notes.lines().count() > most {
        let kept: Vec<&str> = notes.lines().take(most.saturating_sub(1)).collect();
        notes = format!("{}\n  … more: --verbose\n", kept.join("\n"));
    }
    let mut rows = results.designs.len() + results.optima.len();
    let mut table = narrow(study, results, rows);
    while taken + lines(&[&table, &notes]) > LINES && rows > LEAST_ROWS {
        rows -= 1;
        table = narrow(study, results, rows);
    }
    format!("{head}\n{found}\n{table}{notes}")
}

/// Engine, its natural frequencies, and what was calibrated.
fn head(study: &Study, results: &Results, calibration: Option<&Calibration>) -> String {
    let mut text = format!("{}: {}\n", study.engine.name, super::flexible::frequencies(study, results));
    if let Some(c) = calibration {
        let fitted: Vec<String> = c.inputs.iter().map(|i| format!("{} {}", i.free.input.key(), significant(i.value, 4))).collect();
        text.push_str(&format!("  calibrated on {} amplitudes: {}\n", c.rows.len(), fitted.join(", ")));
    }
    text
}

/// Lines on limits that are printed; of more those that fail come first.
const MOST_LIMITS: usize = 8;

/// Lines on limits, those that tell of a failure first where there are too many, and how many are left out.
fn fewer(mut lines: Vec<String>) -> Vec<String> {
    if lines.len() > MOST_LIMITS {
        lines.sort_by_key(|line| !line.contains("FAILS"));
        let more = lines.split_off(MOST_LIMITS).len();
        let lines_on = if more == 1 { "line" } else { "lines" };
        lines.push(format!("  and {more} more {lines_on} on limits: --verbose has all"));
    }
    lines
}

/// The best optimum with what it saves, its certificate and its limits; where nothing was searched, the best of the designs.
fn found(study: &Study, results: &Results) -> String {
    let judged = |d: &DesignResult| results.judged(d).map_or_else(|| "no steady motion".into(), |j| sentence(study, &j));
    let of = &study.objective.label;
    let mut text = String::new();
    let mut put = |line: String| text.extend([line.as_str(), "\n"]);
    let named = |d: &DesignResult| format!("{}: {of} {}{}", d.name, judged(d), doubtful(results, d));
    let sheet = |d: &DesignResult| {
        results.sheets.iter().find(|s| s.design == d.name).map(|s| format!("  {}", order_sheets::sentence(study, results, s)))
    };
    match (results.best_optimum(false), results.best_given()) {
        (Some(o), given) => {
            let nearest = if proof::is_impossible(o) {
                "No design of this family within its bounds holds all limits; nearest to them, by the limit that it is furthest beyond, is "
            } else if o.conflict.is_some() {
                "No design was found that holds all limits; nearest to them, by the limit that it is furthest beyond, is "
            } else {
                ""
            };
            put(format!("{nearest}{}", named(&o.design)));
            match sheet(&o.design) {
                Some(line) => put(line),
                None => parameters(study, &o.design).into_iter().for_each(&mut put),
            }
            put(format!("  {}", savings(study, results, &o.design, given)));
            put(format!("  {}", certificate(study, o)));
            if study.limits.is_empty() {
                put("  the study has no limits".into());
            }
            fewer(limits(study, results, o)).into_iter().for_each(&mut put);
            prices::line(study, results, o).into_iter().for_each(&mut put);
            let broken = not_judged(study, &o.design);
            broken.into_iter().for_each(|words| put(format!("  {words}; an optimum holds its limits in the `conditions` of [optimise]")));
            broken_within_tolerances(study, results, &o.design).into_iter().for_each(|words| put(format!("  {words}")));
            allocation::line(study, results, &o.design.name).into_iter().for_each(&mut put);
            by_models(results, &o.design).into_iter().for_each(&mut put);
            about(results, &o.design).into_iter().for_each(&mut put);
        }
        (None, Some(given)) => {
            put(format!("The study asks for no optimum. Best design: {}", named(given)));
            match sheet(given) {
                Some(line) => put(line),
                None => parameters(study, given).into_iter().for_each(&mut put),
            }
            put(format!("  {}", savings(study, results, given, None)));
            fewer(of_given(study, results, given)).into_iter().for_each(&mut put);
            not_judged(study, given).into_iter().for_each(|words| put(format!("  {words}")));
            by_models(results, given).into_iter().for_each(&mut put);
            about(results, given).into_iter().for_each(&mut put);
        }
        (None, None) => {
            put("The study asks for no optimum and has no design with an absorber.".into());
            results.designs.iter().for_each(|d| put(format!("  {}", named(d))));
        }
    }
    if let Some(robust) = results.best_optimum(true) {
        let held = if robust.limits_hold() { "" } else { ", which breaks limits" };
        put(format!("Within the tolerances: {}{held}", named(&robust.design)));
        sheet(&robust.design).into_iter().for_each(&mut put);
        allocation::line(study, results, &robust.design.name).into_iter().for_each(&mut put);
        let worse = results.verdicts(robust).into_iter().filter(|v| matches!(v, Verdict::WorseThanNone { .. }));
        worse.for_each(|v| put(format!("  verdict: {}", clause(&v, study.objective_of(robust.objective), &robust.design.absorbers))));
    }
    text
}

/// What makes a design doubtful, for its first line: nobody sells what it is made of, or it is used where nothing is known of that.
fn doubtful(results: &Results, d: &DesignResult) -> &'static str {
    let unbuildable = of_design(results, d).0.iter().any(|v| matches!(v, Verdict::Unbuildable { .. }));
    let outside = results.sheets.iter().any(|s| s.design == d.name && !s.outside.is_empty());
    match (unbuildable, outside) {
        (true, _) => "; CANNOT BE BUILT of what exists",
        (false, true) => "; OUTSIDE what is known of its material",
        (false, false) => "",
    }
}

/// Each absorber of a design: type, station and parameters with their units.
fn parameters(study: &Study, d: &DesignResult) -> Vec<String> {
    let line = |m: &Mounted| {
        let host = match m.on {
            Host::Station(station) => study.chain.stations[station].name.clone(),
            Host::Ring(inner) => format!("ring {}", inner + 1),
        };
        let declared = m.absorber.declaration().map_or(&[][..], |t| t.parameters);
        let one = |p: &crate::absorber::Parameter| {
            let (symbol, unit) = p.label.split_once('/').unwrap_or((p.label, ""));
            m.absorber.value(p.key).map(|x| format!("{symbol} {} {unit}", significant(x, 5)).trim_end().to_owned())
        };
        let all: Vec<String> = declared.iter().filter_map(one).collect();
        format!("  {} on {host}: {}", m.absorber.type_name(), all.join(", "))
    };
    d.absorbers.iter().map(line).collect()
}

/// Values of two designs that are of the same: where only one is judged in operation, at its own amplitude or within tolerances, those at the reference, which are told.
fn alike(own: &Judged, other: &Judged) -> (&'static str, f64, f64) {
    let beyond = |j: &Judged, b: Basis| j.worst_of.contains(&b);
    let apart = [Basis::In(Condition::InOperation), Basis::OwnAmplitude, Basis::Tolerances];
    let differ = apart.into_iter().any(|b| beyond(own, b) != beyond(other, b));
    let changes = own.other_reference().is_some() || other.other_reference().is_some();
    if differ && changes { ("at the reference", own.reference, other.reference) } else { ("", own.value, other.value) }
}

/// By how much a design is better than others, in words: than the engine without absorber, and than the best given design.
fn savings(study: &Study, results: &Results, d: &DesignResult, given: Option<&DesignResult>) -> String {
    let own = results.judged(d).map(|j| j.value);
    let none = results.designs.iter().find(|d| d.absorbers.is_empty()).and_then(|d| d.objective);
    let none = none.or_else(|| results.bare.first().copied().flatten());
    let against = |value: f64, other: f64| {
        let change = 100.0 * (study.objective.unit.ratio(value / other) - 1.0);
        let words = match change {
            c if !c.is_finite() => return None,
            c if c.abs() < 0.05 => "the same as".to_owned(),
            c if c < 0.0 => format!("{:.1} % less than", -c),
            c => format!("{c:.1} % more than"),
        };
        Some((words, value_of(&study.objective, other)))
    };
    let mut parts = Vec::new();
    if let Some((words, value)) = own.zip(none).and_then(|(own, none)| against(own, none)) {
        parts.push(format!("{words} without absorber ({value})"));
    }
    if let Some(best) = given
        && let (Some(own), Some(other)) = (results.judged(d), results.judged(best))
        && let (at, own, other) = alike(&own, &other)
        && let Some((words, value)) = against(own, other)
    {
        let fails = if results.holds_limits(best) { "" } else { ", which breaks limits" };
        let with = if at.is_empty() { String::new() } else { format!("{at}, with {}, ", value_of(&study.objective, own)) };
        parts.push(format!("{with}{words} the best given design, {} ({value}{fails})", best.name));
    }
    if parts.is_empty() { "nothing to compare it with".into() } else { parts.join("; ") }
}

/// What is proved, what was looked at and what that says, in a line.
fn certificate(study: &Study, o: &OptimumResult) -> String {
    let residual = o.optimum.outcome.kkt_residual;
    let first = if residual.is_finite() { format!("first-order residual {residual:.0e}") } else { "no first-order residual".into() };
    let unmet = if o.is_unfinished() { " (NOT CONVERGED)" } else { "" };
    let survey = o.survey.as_ref().map_or_else(String::new, surveyed);
    let elsewhere = if o.scan.designs > 0 { format!("{} designs elsewhere and ", o.scan.designs) } else { String::new() };
    let result = if o.scan.better || o.nearby.better { "led to it" } else { "are no better" };
    format!(
        "{}; {} of {} starts agree, {first}{unmet}, {elsewhere}{} near it {result}{survey}",
        proof::clause(study, o),
        o.optimum.agreeing(),
        o.optimum.starts.len(),
        o.nearby.designs
    )
}

fn surveyed(s: &Survey) -> String {
    let lower = if s.under_limits { "lower within the limits" } else { "lower" };
    let found = match s.followed {
        _ if s.better => "it was found from one of them".to_owned(),
        0 => format!("none of them is {lower}"),
        _ => format!("none of them is {lower}, nor what those that were followed led to"),
    };
    format!(", {} over all bounds: {found}", s.designs)
}

/// What is absurd of a design, and what its state in operation leaves out.
fn about(results: &Results, d: &DesignResult) -> Vec<String> {
    let (found, of) = of_design(results, d);
    let warm = results.heat.iter().find(|h| h.design == d.name && d.absorbers.len() > 1);
    let alone = warm.map(|h| {
        let number = h.absorber + 1;
        format!("  in operation absorber {number} alone follows its heat; the others stay at the reference of their material")
    });
    found.iter().map(|v| format!("  verdict: {}", clause(v, of, &d.absorbers))).chain(alone).collect()
}

/// What makes other optima than the best one useless, a line each: why a run ends with the exit code of a failure.
fn failures(study: &Study, results: &Results) -> String {
    let best = results.best_optimum(false).map(|o| o.design.name.as_str());
    let line = |o: &OptimumResult| {
        let of = study.objective_of(o.objective);
        let serious = |v: &&Verdict| matches!(v, Verdict::WorseThanNone { .. } | Verdict::Overheats { .. });
        let mut words: Vec<String> = results.verdicts(o).iter().filter(serious).map(|v| clause(v, of, &o.design.absorbers)).collect();
        let broken = study.limits.iter().zip(&o.design.limits).filter(|(_, ratio)| !holds(**ratio));
        words.extend(broken.map(|(limit, _)| format!("FAILS {}", limit.words)));
        words.extend(broken_within_tolerances(study, results, &o.design).filter(|_| o.robust));
        (!words.is_empty()).then(|| format!("{}: {}\n", o.design.name, words.join("; ")))
    };
    results.optima.iter().filter(|o| Some(o.design.name.as_str()) != best).filter_map(line).collect()
}

/// What else was found: other objectives, fronts, catalogues, limits that given designs break.
fn notes(study: &Study, results: &Results) -> String {
    let mut text = String::new();
    let named = results.best_optimum(false).map(|o| &o.design).or_else(|| results.best_given());
    named.into_iter().flat_map(|d| barred(study, d)).for_each(|line| text.extend([line.as_str(), "\n"]));
    for (i, objective) in study.objectives().enumerate().skip(1) {
        let all = results.optima.iter().filter(|o| o.objective == i && o.main);
        if let Some(o) = all.min_by(|a, b| a.optimum.value().total_cmp(&b.optimum.value())) {
            let own = results.judged_optimum(o);
            text.push_str(&format!("Best by {}: {} with {}.\n", objective.label, o.design.name, value_of(objective, own.value)));
        }
    }
    text.push_str(&best_of_catalogues(study, results));
    text.push_str(&failures(study, results));
    below_acceptable(study, results).iter().for_each(|line| text.extend([line.as_str(), "\n"]));
    text.push_str(&fronts(study, results));
    let hot: Vec<String> = results.designs.iter().filter(|d| results.overheats(&d.name)).map(|d| format!("`{}`", d.name)).collect();
    if !hot.is_empty() {
        text.push_str(&format!("Overheats at some speeds, without a temperature in balance: {}.\n", hot.join(", ")));
    }
    let broken = |(i, limit): (usize, &LimitSpec)| {
        let by: Vec<String> = results.designs.iter().filter(|d| !holds(d.limits[i])).map(|d| format!("`{}`", d.name)).collect();
        (!by.is_empty()).then(|| format!("Limit {}: broken by {}.", limit.words, by.join(", ")))
    };
    fewer(study.limits.iter().enumerate().filter_map(broken).collect()).iter().for_each(|line| text.extend([line.as_str(), "\n"]));
    if text.is_empty() { text } else { format!("\n{text}") }
}
