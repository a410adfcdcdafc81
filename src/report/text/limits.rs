//! What the limits of a study come to for an optimum.

use super::margin::factor;
use super::proof::is_impossible;
use super::table::significant;
use crate::analysis::{BarredRange, DesignResult, OptimumResult, Results, StillBroken};
use crate::input::{LimitSpec, Study, UnitOf};
use crate::objective::{Condition, Over, Property, holds};
use crate::optimise::Conflict;

/// A smaller gain, per cent of the objective, is rounding.
const WORTH_SAYING: f64 = 1e-6;

/// A value of a limited measure in its unit.
fn value(limit: &LimitSpec, inside: f64) -> String {
    match limit.of.unit {
        UnitOf::Margin => factor(1.0 / inside),
        unit => format!("{}{}", significant(unit.shown(inside), 4), unit.suffix()),
    }
}

/// The condition in which a limit is used most, of those that it is to hold in; `None` where it is one of several that the table of conditions has not.
fn worst_in(study: &Study, design: &DesignResult, limit: usize, ratio: f64) -> Option<Condition> {
    let is_held = |c: Condition| study.held().contains(&c) || c == Condition::InOperation;
    let told = design.conditions.iter().filter(|c| is_held(c.condition));
    let mut reached = told.filter(|c| c.limits.get(limit).is_some_and(|own| (own / ratio - 1.0).abs() <= 1e-9));
    let mut others = study.held().iter().filter(|h| design.conditions.iter().all(|c| c.condition != **h));
    reached.next().map(|c| c.condition).or_else(|| others.next().copied().filter(|_| others.next().is_none()))
}

/// What a limit that is used up is worth; `None` where it is not.
pub(crate) fn worth(limit: &LimitSpec, price: f64) -> Option<String> {
    let way = if limit.of.unit.is_inverse() { "less" } else { "more" };
    (price > WORTH_SAYING).then(|| format!("one per cent {way} of it would bring {} %", significant(price, 2)))
}

/// A line for each limit, then those that cannot hold together.
pub(super) fn limits(study: &Study, results: &Results, o: &OptimumResult) -> Vec<String> {
    let mut lines = Vec::new();
    for (i, ((limit, ratio), price)) in study.limits.iter().zip(&o.design.limits).zip(&o.prices).enumerate() {
        let as_drawn = if o.robust { " as drawn" } else { "" };
        let costs = worth(limit, *price).filter(|_| o.conflict.is_none()).map_or_else(String::new, |worth| format!("; {worth}"));
        let beside = beside_a_jump(o, limit, *ratio).unwrap_or_default();
        lines.push(line((study, results), &o.design, i, (as_drawn, &format!("{costs}{beside}"))));
    }
    lines.extend(o.conflict.iter().flat_map(|c| conflict(study, c, (&o.design.limits, o))));
    lines
}

/// A line for each limit of a design that was given.
pub(super) fn of_given(study: &Study, results: &Results, d: &DesignResult) -> Vec<String> {
    (0..study.limits.len()).map(|i| line((study, results), d, i, ("", ""))).collect()
}

/// Whether a design holds a limit, what it comes to and in which condition, with what is said behind the verdict and behind the value.
fn line((study, results): (&Study, &Results), d: &DesignResult, i: usize, (as_drawn, more): (&str, &str)) -> String {
    let (limit, ratio) = (&study.limits[i], d.limits[i]);
    let in_operation = d.conditions.iter().filter(|c| c.condition == Condition::InOperation).count();
    let held = study.held().len() + in_operation;
    let worst = match worst_in(study, d, i, ratio).filter(|_| held > 1) {
        None => String::new(),
        // its name says so
        Some(c @ Condition::InOperation) => format!(", worst {}", c.name().replace('_', " ")),
        Some(c) => format!(", worst in {}", c.name().replace('_', " ")),
    };
    let found = match limit.of.measure.within.factors.as_slice() {
        _ if !d.has(&limit.of.measure) => "it has no such absorber".into(),
        _ if !results.has_value(d, &limit.of.measure) => "it overheats: no temperature is in balance".into(),
        _ if ratio == f64::INFINITY => "at some speeds no steady motion is known".into(),
        [] if matches!(limit.of.measure.over, Over::Property(Property::Band { .. })) => {
            format!("the one that is nearest or deepest inside is {} times the nearer end", significant(ratio, 4))
        }
        [] => format!("it is {}", value(limit, ratio * limit.limit)),
        _ => of_curve(limit, ratio),
    };
    let verdict = if holds(ratio) { "holds" } else { "FAILS" };
    format!("  limit: {}: {verdict}{as_drawn} ({found}{worst}{more})", limit.words)
}

/// A share of a limit that follows speed: of what is allowed at the speed where most of it is used.
fn of_curve(limit: &LimitSpec, ratio: f64) -> String {
    format!("{:.1} % of what is allowed at the worst speed", 100.0 * limit.of.unit.ratio(ratio))
}

/// Where a design stands beside a jump of a limited measure, in words.
fn beside_a_jump(o: &OptimumResult, limit: &LimitSpec, ratio: f64) -> Option<String> {
    let jump = o.jump(limit, ratio)?;
    let declared = o.design.absorbers[jump.absorber].absorber.declaration();
    let label = declared.map_or("", |d| d.parameters[jump.parameter].label);
    let symbol = label.split_once('/').map_or(label, |(symbol, _)| symbol);
    Some(format!(
        "; BESIDE A JUMP: broken where {symbol} of absorber {} changes by {} %",
        jump.absorber + 1,
        significant(100.0 * jump.change, 2)
    ))
}

/// Limits that a design breaks in a condition of the study that it is not judged in.
pub(crate) fn not_judged(study: &Study, d: &DesignResult) -> Option<String> {
    let others = d.conditions.iter().filter(|c| !study.held().contains(&c.condition) && c.condition != Condition::InOperation);
    let broken: Vec<String> = others
        .filter_map(|c| {
            let (i, worst) = c.limits.iter().copied().enumerate().filter(|l| !holds(l.1)).max_by(|a, b| a.1.total_cmp(&b.1))?;
            Some(format!("{} ({:.1} % of {})", c.condition.name().replace('_', " "), 100.0 * worst, study.limits[i].words))
        })
        .collect();
    (!broken.is_empty()).then(|| format!("not judged, and broken there: limits in {}", broken.join(", ")))
}

/// The limits that a design breaks somewhere within the tolerances of a study, with how much of them it comes to; `None` where it breaks none, and where tolerances were not looked at.
pub(crate) fn broken_within_tolerances(study: &Study, results: &Results, d: &DesignResult) -> Option<String> {
    let within = results.robust.iter().find(|r| r.design == d.name)?;
    let broken = study.limits.iter().zip(&within.limits).filter(|(_, worst)| !holds(worst.value));
    let words: Vec<String> =
        broken.map(|(l, worst)| format!("{} ({:.1} % of it)", l.words, 100.0 * l.of.unit.ratio(worst.value))).collect();
    (!words.is_empty()).then(|| format!("within the tolerances limits are broken: {}", words.join("; ")))
}

/// A line for each range of speed that a rule bars for a design, those that the rule does not allow first.
pub(super) fn barred(study: &Study, d: &DesignResult) -> Vec<String> {
    let line = |b: &BarredRange| {
        let during = if b.condition == Condition::Firing { String::new() } else { format!(", {}", b.condition.name().replace('_', " ")) };
        let rated = study.limits[b.limit].rule.as_ref().map(|r| r.rated_rpm).filter(|r| (b.from_rpm..=b.to_rpm).contains(r));
        let rated = rated.map_or_else(String::new, |r| format!(", the rated {r} rpm among them"));
        let allowed = rated + &b.objection.map_or_else(String::new, |o| format!(": not allowed, {}", o.words()));
        let (breaks, bars) = if b.excepted { ("is above it", "within what the study excepts,") } else { ("breaks it", "which bars") };
        format!(
            "  {}: `{}` {breaks} at {:.0} rpm{during} ({:.0} %), {bars} {:.0} to {:.0} rpm{allowed}",
            study.limits[b.limit].words,
            d.name,
            b.critical_rpm,
            100.0 * b.ratio,
            b.from_rpm,
            b.to_rpm
        )
    };
    let outside = |b: &StillBroken| {
        let which = if d.barred.iter().any(|r| r.limit == b.limit) { "outside that, too" } else { "at no critical speed" };
        format!(
            "  {}: `{}` breaks it {which}: most at {:.0} rpm ({:.0} %)",
            study.limits[b.limit].words,
            d.name,
            b.speed_rpm,
            100.0 * b.ratio
        )
    };
    let mut ranges: Vec<&BarredRange> = d.barred.iter().collect();
    ranges.sort_by_key(|b| b.objection.is_none());
    ranges.into_iter().map(line).chain(d.still_broken.iter().map(outside)).collect()
}

/// Which limits were not held together, how near a design comes, which others it breaks, and what loosening one would take.
fn conflict(study: &Study, c: &Conflict, (nearest, o): (&[f64], &OptimumResult)) -> Vec<String> {
    let no_design = if is_impossible(o) { "It is proved that no design of this family" } else { "No design of this family was found that" };
    let within = if o.robust { " within the tolerances" } else { "" };
    let words = |i: usize| format!("`{}`", study.limits[i].words);
    let names: Vec<String> = c.parties.iter().map(|p| words(p.limit)).collect();
    let of = study.limits.len();
    let beyond = 100.0 * (c.ratio - 1.0);
    let mut lines = vec![match names.as_slice() {
        _ if of == 1 => {
            format!("  {no_design} holds this limit{within}: the nearest is {} % beyond it.", significant(beyond, 4))
        }
        [one] => format!("  {no_design} holds all of its {of} limits{within}: the nearest is {} % beyond {one}.", significant(beyond, 4)),
        _ => format!(
            "  {no_design} holds all of its {of} limits{within}. In conflict at the nearest design: {}. It is {} % beyond each of them.",
            names.join(", "),
            significant(beyond, 4)
        ),
    }];
    if of == 1 {
        return lines;
    }
    let others = (0..of).filter(|i| !holds(nearest[*i]) && c.parties.iter().all(|p| p.limit != *i));
    lines.extend(others.map(|i| format!("    that design breaks {}, too", words(i))));
    for party in &c.parties {
        let limit = &study.limits[party.limit];
        lines.push(match party.loosened {
            Some(factor) => {
                let follows_speed = !limit.of.measure.within.factors.is_empty();
                let nearest = if follows_speed { of_curve(limit, factor) } else { value(limit, factor * limit.limit) };
                format!("    {}: the nearest that was found while all others hold is {nearest}", words(party.limit))
            }
            None => format!("    {}: however far it is loosened, no design was found that holds the others", words(party.limit)),
        });
    }
    lines
}
