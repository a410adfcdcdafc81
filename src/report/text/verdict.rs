//! What is absurd of an optimum, in words.

use super::judged::value_of;
use super::table::significant;
use crate::absorber::Mounted;
use crate::analysis::buildable::{Property, Range, Source, range};
use crate::analysis::verdict::{LITTLE, Verdict};
use crate::analysis::{DesignResult, Results};
use crate::input::MeasureSpec;
use crate::units::PA_PER_MPA;

/// m²/s per mm²/s.
const MM2: f64 = 1e-6;

/// A word for programs.
pub(crate) fn word(verdict: &Verdict) -> &'static str {
    match verdict {
        Verdict::WorseThanNone { .. } => "worse_than_none",
        Verdict::LittleGain { .. } => "little_gain",
        Verdict::Overheats { .. } => "overheats",
        Verdict::OnBound(_) => "on_bound",
        Verdict::Unbuildable { exists, .. } => match exists.of {
            Property::Modulus => "modulus",
            Property::LossFactor => "loss_factor",
            Property::Strain => "strain",
            Property::Viscosity => "viscosity",
            Property::OwnFrequency => "own_frequency",
        },
    }
}

/// Name, unit and factor to the unit in which a reader knows a property.
fn known_as(of: Property) -> (&'static str, &'static str, f64) {
    match of {
        Property::Modulus => ("shear modulus", " MPa", 1.0 / PA_PER_MPA),
        Property::LossFactor => ("loss factor", "", 1.0),
        Property::Strain => ("shear strain", " %", 100.0),
        Property::Viscosity => ("viscosity", " mm²/s", 1.0 / MM2),
        Property::OwnFrequency => ("the ring's own frequency", " Hz", 1.0),
    }
}

/// Where a property is taken that follows frequency.
fn at(of: Property) -> &'static str {
    match of {
        Property::Modulus | Property::LossFactor => " at its own frequency",
        Property::Strain | Property::Viscosity | Property::OwnFrequency => "",
    }
}

/// A number with three digits, without zeros that say nothing.
fn brief(x: f64) -> String {
    let text = significant(x, 3);
    if text.contains('.') && !text.contains('e') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// What exists of a property: "0.02 to 0.6", and what is usual.
pub(crate) fn exists(of: &Range) -> String {
    let (_, unit, factor) = known_as(of.of);
    let span = |a: f64, b: f64| format!("{} to {}{unit}", brief(factor * a), brief(factor * b));
    let most = span(of.least.value, of.most.value);
    of.usual.map_or_else(|| most.clone(), |(a, b)| format!("{}, at the most {most}", span(a, b)))
}

/// What rubber has of a loss factor.
pub(super) fn rubber_loss() -> String {
    exists(range(Property::LossFactor))
}

/// A finding as a clause.
pub(crate) fn clause(verdict: &Verdict, of: &MeasureSpec, design: &[Mounted]) -> String {
    let which = |i: usize| if design.len() > 1 { format!(" of absorber {}", i + 1) } else { String::new() };
    match verdict {
        Verdict::WorseThanNone { value, none } => {
            format!("WORSE THAN NO ABSORBER: {} against {}", value_of(of, *value), value_of(of, *none))
        }
        Verdict::LittleGain { value, none } => {
            let gain = 100.0 * (of.unit.ratio(value / none) - 1.0).abs();
            let (gain, least) = (significant(gain, 2), brief(100.0 * LITTLE));
            format!("gains {gain} % against no absorber, less than {least} %: {} against {}", value_of(of, *value), value_of(of, *none))
        }
        Verdict::Unbuildable { absorber, value, exists: range } => {
            let (name, unit, factor) = known_as(range.of);
            let source = match range.beyond(*value).unwrap_or(&range.most).source {
                Source::Published(key) => format!(" [{key}]"),
                Source::Assumed(_) => " (assumption)".into(),
            };
            let own = if factor * value < 1e-3 { format!("{:.0e}", factor * value) } else { brief(factor * value) };
            format!("{name}{} {own}{unit}{}; what exists has {}{source}", which(*absorber), at(range.of), exists(range))
        }
        Verdict::OnBound(hit) => {
            let declaration = design[hit.absorber].absorber.declaration();
            let key = declaration.map_or("", |d| d.parameters[hit.parameter].key);
            format!("{key}{} on the {} bound of its search", which(hit.absorber), if hit.upper { "upper" } else { "lower" })
        }
        Verdict::Overheats { speeds, limit } => format!("OVERHEATS at {speeds} of the speeds: its material bears {} °C", brief(*limit)),
    }
}

/// What is absurd of a design, with the objective that it is judged by: of an optimum, and of the best given design where nothing was searched.
pub(crate) fn of_design<'r>(results: &'r Results, d: &DesignResult) -> (Vec<Verdict>, &'r MeasureSpec) {
    if let Some(o) = results.optima.iter().find(|o| o.design.name == d.name) {
        return (results.verdicts(o), results.study.objective_of(o.objective));
    }
    let is_answer = results.optima.is_empty() && results.best_given().is_some_and(|best| best.name == d.name);
    let own = results.judged(d).filter(|_| is_answer);
    (own.map(|j| results.verdicts_of(d, &j)).unwrap_or_default(), &results.study.objective)
}

/// A line an optimum of which something is to be said, below the table of designs.
pub(super) fn verdicts(results: &Results) -> String {
    let mut text = String::new();
    for o in &results.optima {
        let of = results.study.objective_of(o.objective);
        let clauses: Vec<String> = results.verdicts(o).iter().map(|v| clause(v, of, &o.design.absorbers)).collect();
        if !clauses.is_empty() {
            text.push_str(&format!("  verdict on {}: {}\n", o.design.name, clauses.join("; ")));
        }
    }
    text
}
