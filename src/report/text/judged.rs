//! The value that a design is judged by, in words: of what it is the worst, and the reference beside it.

use super::margin::factor;
use super::table::significant;
use crate::analysis::Results;
use crate::analysis::judged::{Basis, Judged};
use crate::input::{MeasureSpec, Study, UnitOf};
use crate::objective::Condition;
use crate::units::DEG_PER_RAD;

/// A basis in words.
pub(crate) fn word(basis: Basis) -> String {
    match basis {
        Basis::OwnAmplitude => "its own amplitude".into(),
        Basis::Tolerances => "its tolerances".into(),
        Basis::In(condition) => condition.name().replace('_', " "),
    }
}

/// Several in words.
pub(crate) fn list(words: &[String]) -> String {
    match words {
        [rest @ .., last] if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => words.concat(),
    }
}

/// What a value is the worst of: "worst of cold, firing and hot: cold"; empty where it is the reference.
fn worst_of(judged: &Judged) -> String {
    if judged.is_reference() {
        return String::new();
    }
    let tolerances = judged.worst_of.contains(&Basis::Tolerances);
    let is_drawn = |b: &Basis| tolerances && matches!(b, Basis::In(Condition::InOperation) | Basis::OwnAmplitude);
    let others: Vec<Basis> = judged.worst_of.iter().copied().filter(|b| *b != Basis::Tolerances && !is_drawn(b)).collect();
    let words: Vec<String> = others.iter().map(|b| word(*b)).collect();
    // tolerances are about the reference of each condition
    let drawn: Vec<String> = judged.worst_of.iter().filter(|b| is_drawn(b)).map(|b| word(*b)).collect();
    let all = match words.len() {
        _ if tolerances && others == [Basis::In(Condition::Firing)] => "worst".to_owned(),
        1 if !tolerances => return format!("in {}", list(&words)),
        _ => format!("worst of {}", list(&words)),
    };
    let within = match (tolerances, drawn.as_slice()) {
        (false, _) => String::new(),
        (true, []) => " within its tolerances".into(),
        (true, drawn) => format!(" within its tolerances, and {} as drawn", list(drawn)),
    };
    let reached = Some(judged.reached_in).filter(|b| *b != Basis::Tolerances).map(word);
    format!("{all}{within}{}", reached.map_or_else(String::new, |r| format!(": {r}")))
}

/// What is said behind a value, in brackets; `shown` writes a value.
pub(crate) fn of_what(judged: &Judged, shown: impl Fn(f64) -> String) -> String {
    let reference = judged.other_reference().map(|r| format!("at the reference {}", shown(r)));
    let all: Vec<String> = Some(worst_of(judged)).filter(|w| !w.is_empty()).into_iter().chain(reference).collect();
    if all.is_empty() { String::new() } else { format!(" ({})", all.join("; ")) }
}

/// The value with what is behind it.
pub(super) fn sentence(study: &Study, judged: &Judged) -> String {
    let shown = |v: f64| value_of(study.objective_of(judged.objective), v);
    format!("{}{}", shown(judged.value), of_what(judged, shown))
}

/// Whether tables of designs need a column for it: where the objective is not the twist that they show, or some design is judged by another value of it.
pub(crate) fn is_apart(study: &Study, results: &Results) -> bool {
    let all = results.designs.iter().chain(results.optima.iter().map(|o| &o.design));
    is_other(study) || all.filter_map(|d| results.judged(d)).any(|j| j.other_reference().is_some())
}

/// Whether the objective is not the synthesised twist that every table shows.
pub(crate) fn is_other(study: &Study) -> bool {
    study.objective.measure.synthesised() != Some(study.twist)
}

/// What designs are judged in, conditions in the sequence of the study, operation and own amplitude last; tolerances, which are of some designs only, are none of it.
fn bases(results: &Results) -> Vec<Basis> {
    let designs = results.designs.iter().chain(results.optima.iter().map(|o| &o.design));
    let mut all: Vec<Basis> = Vec::new();
    for basis in designs.filter_map(|d| results.judged(d)).flat_map(|j| j.worst_of) {
        if basis != Basis::Tolerances && !all.contains(&basis) {
            all.push(basis);
        }
    }
    let held = results.study.held();
    let place = |b: &Basis| match b {
        Basis::In(c) => held.iter().position(|own| own == c).unwrap_or(held.len()),
        Basis::OwnAmplitude | Basis::Tolerances => held.len() + 1,
    };
    all.sort_by_key(place);
    all
}

/// The same in words, as a question names it: empty where it is the reference alone.
pub(crate) fn asked(results: &Results) -> String {
    let all = bases(results);
    let words: Vec<String> = all.iter().map(|b| word(*b)).collect();
    if all == [Basis::In(Condition::Firing)] { String::new() } else { list(&words) }
}

/// A value of a measure in its own unit and sense.
pub(super) fn value_of(objective: &MeasureSpec, v: f64) -> String {
    match objective.unit {
        _ if v == f64::INFINITY => "no steady motion".into(),
        UnitOf::Angle => format!("{:.6}°", v * DEG_PER_RAD),
        UnitOf::Torque => format!("{v:.4} N m"),
        UnitOf::Margin => factor(1.0 / v),
        unit => format!("{}{}", significant(unit.shown(v), 6), unit.suffix()),
    }
}
