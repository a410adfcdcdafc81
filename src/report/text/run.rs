//! What a run prints: designs, optima, conditions, summary.

use super::buildability::parameters;
use super::certificate::certificate;
use super::judged::{sentence, value_of};
use super::limits::{barred, limits};
use super::margin::factor;
use super::materials::temperatures;
use super::robust::during;
use super::table::{dash, keyed, significant};
use super::verdict::{clause, of_design};
use super::{prices, proof};
use crate::analysis::judged::Basis;
use crate::analysis::method_selection::{Choice, Strategy};
use crate::analysis::{DesignResult, Nature, OptimumResult, PeakKind, Results};
use crate::captions::types_of;
use crate::input::{FrontSpec, MeasureSpec, Study, UnitOf};
use crate::objective::{Condition, Over, Peak, Place, holds};
use crate::optimise::Role;
use crate::response::Work;
use crate::units::DEG_PER_RAD;
use std::fmt::Write;

/// How searches evaluated designs, where that was chosen: a line each objective.
#[doc(hidden)]
pub fn choices(results: &Results) -> String {
    let objectives = results.study.objectives();
    results.choices.iter().zip(objectives).enumerate().map(|(i, (choice, objective))| chosen(results, (i, objective), choice)).collect()
}

fn chosen(results: &Results, (index, objective): (usize, &MeasureSpec), c: &Choice) -> String {
    let by = if index == 0 { String::new() } else { format!(" by {}", objective.word) };
    if c.chosen.strategy == Strategy::Exact {
        return format!("Searches{by}: every design exactly: nothing cheaper is within tolerance here.\n");
    }
    let mut work = Work::default();
    for o in results.optima.iter().filter(|o| o.objective == index) {
        work += o.optimum.stages.seeds;
        work += o.optimum.stages.search;
    }
    format!(
        "Searches{by}: {}, error estimated as {} %, the largest of {} probe designs, at about 1/{:.0} of the exact cost by counted work; {} of {} designs of the \
         optima were evaluated so, the others and all that is reported exactly.\n",
        c.chosen.strategy.label(),
        significant(100.0 * c.chosen.error, 2),
        c.probes,
        (c.exact / c.chosen.seconds).max(1.0),
        work.surrogate_evaluations,
        work.evaluations
    )
}

fn value(study: &Study, v: f64) -> String {
    value_of(&study.objective, v)
}

fn at_speed(p: &Peak) -> String {
    if let Over::AtDuty(point) = p.over {
        return format!(" at point {} of the duty", point + 1);
    }
    if p.place == Place::Nowhere { String::new() } else { format!(" at {:.1} rpm", p.speed_rpm) }
}

fn peak_words(results: &Results, nature: Option<&Nature>) -> String {
    let Some(n) = nature else { return String::new() };
    let what = match n.kind {
        PeakKind::Resonant => "resonant",
        PeakKind::Forced => "forced",
        PeakKind::EndOfRange => "end of the range",
    };
    let order = results.system.excitation.orders[n.order];
    format!(" ({what}: {:.2} times quasi-static; order {order} adds most, amplified {:.1} times)", n.over_static, n.amplification)
}

/// How an optimum was found and what holds it there.
pub fn optimum(study: &Study, results: &Results, o: &OptimumResult) -> String {
    let mut text = String::new();
    let outcome = &o.optimum.outcome;
    let best = o.optimum.value();
    let mut put = |line: String| {
        // writing to a string cannot fail
        let _ = writeln!(text, "{line}");
    };
    let objective = study.objective_of(o.objective);
    let judged = results.judged_optimum(o);
    put(format!("{}: {} {}", o.design.name, objective.label, sentence(study, &judged)));
    if judged.value > best * (1.0 + 1e-6) {
        let why = match judged.reached_in {
            Basis::In(Condition::InOperation) => "the worst of its conditions at the reference of the materials",
            Basis::OwnAmplitude => "which is of small twist",
            _ if o.robust => "and a worse deviation within the tolerances was found since",
            _ => "the rest whatever the spring and damper",
        };
        put(format!("  the search ended at {}, {why}", value_of(objective, best)));
    }
    let mut active: Vec<String> = Vec::new();
    for ((row, nature), load_case) in outcome.rows.rows.iter().zip(&o.natures).zip(&o.load_cases) {
        let p = &row.peak;
        // what no speed has no condition has
        let during = if p.place == Place::Nowhere { String::new() } else { during(&o.optimum.design, load_case) };
        let line = match row.role {
            Role::Objective(i) if outcome.rows.is_largest(row, 1e-5) => {
                let parts = study.combined.as_ref().filter(|_| o.objective > study.more_objectives.len());
                let own = parts.map_or(objective, |c| &c.parts[i].of);
                let of = if parts.is_some() { format!(" of {}", own.label) } else { String::new() };
                format!("  active peak{of}{}{during}, {}{}", at_speed(p), value_of(own, p.value), peak_words(results, nature.as_ref()))
            }
            // what is broken by more is said below, once
            Role::Limit(i) if row.value.abs() < 1e-5 => format!("  active limit{}{during}: {}", at_speed(p), study.limits[i].words),
            _ => continue,
        };
        if !active.contains(&line) {
            active.push(line);
        }
    }
    active.into_iter().for_each(&mut put);
    parameters(o).into_iter().for_each(&mut put);
    if o.proof.is_some() {
        put(format!("  {}", proof::clause(study, o)));
    }
    certificate(objective, o, value_of).into_iter().for_each(&mut put);
    limits(study, results, o).into_iter().for_each(&mut put);
    prices::line(study, results, o).into_iter().for_each(&mut put);
    text
}

/// A line for each family of each front: its knee, or that it has no design.
pub(super) fn fronts(study: &Study, results: &Results) -> String {
    let Some(FrontSpec::Of { measures, points }) = &study.front else { return String::new() };
    let mut text = String::new();
    for t in &results.tradeoffs {
        let [first, second] = t.of.map(|i| &measures[i]);
        for (family, front) in &t.families {
            let left = front.points.iter().filter(|p| !p.dominated).count();
            let knee = front.points.iter().find(|p| p.knee).map_or_else(String::new, |p| {
                let shown = |m: &MeasureSpec, v: f64| format!("{}{}", significant(m.unit.shown(v), 4), m.unit.suffix());
                format!(", knee at {} and {}", shown(first, p.values[0]), shown(second, p.values[1]))
            });
            let what = match front.points.len() {
                0 => "no design was found within the limits".to_owned(),
                1 => "one design is best in both".to_owned(),
                count if left == count => format!("{count} points, none of them dominated{knee}"),
                count if left == 0 => format!("{count} points, all of them dominated by designs of another family"),
                count => format!("{count} points, {left} of them not dominated{knee}"),
            };
            // in a gap of a front there may be designs all the same
            let fewer = match front.points.len() {
                count if count > 1 && 4 * count <= 3 * points => format!(" ({points} were asked for; between these no other was found)"),
                _ => String::new(),
            };
            let _ = writeln!(text, "Front of {} against {}, {}: {what}{fewer}.", first.label, second.label, types_of(family));
        }
    }
    text
}

/// What the run found, in sentences.
#[doc(hidden)]
pub fn summary(study: &Study, results: &Results) -> String {
    let mut text = fronts(study, results);
    let held = study.held();
    for (i, limit) in study.limits.iter().enumerate() {
        let broken = |d: &&DesignResult| !holds(d.limits[i]);
        let size = |d: &DesignResult| match limit.of.unit {
            _ if d.limits[i] == f64::INFINITY => "no steady motion".into(),
            UnitOf::Margin => factor(1.0 / (d.limits[i] * limit.limit)),
            UnitOf::Life => value_of(&limit.of, d.limits[i] * limit.limit),
            _ => format!("{:.0} %", 100.0 * d.limits[i]),
        };
        let list: Vec<String> = results.designs.iter().filter(broken).map(|d| format!("`{}` ({})", d.name, size(d))).collect();
        if !list.is_empty() {
            let _ = writeln!(text, "Limit {}: broken by {}.", limit.words, list.join(", "));
        }
    }
    for d in results.designs.iter().chain(results.optima.iter().map(|o| &o.design)) {
        barred(study, d).into_iter().for_each(|line| text.extend([line.as_str(), "\n"]));
    }
    // the floor is that of the firing engine
    if let Some(floor) = results.forced_floor.filter(|_| *held == [Condition::Firing]) {
        let none = results.designs.iter().find(|d| d.absorbers.is_empty());
        let beside = none.map_or_else(String::new, |d| format!("; with its resonances it is {}", value(study, objective(d))));
        let _ = writeln!(text, "Quasi-static, as if nothing resonated, the engine without absorber has {}{beside}.", value(study, floor));
    }
    text.push_str(&answer(study, results));
    text
}

/// The best given design beside the best optimum; where nothing was searched, the best of the designs.
fn answer(study: &Study, results: &Results) -> String {
    let judged = |d: &DesignResult| results.judged(d).map_or_else(String::new, |j| sentence(study, &j));
    let mut text = String::new();
    let best = results.best_given();
    let whose = match (study.limits.is_empty(), best.is_some_and(DesignResult::within_limits)) {
        (true, _) => "",
        (false, true) => " within the limits",
        (false, false) if results.designs.iter().any(|d| !d.absorbers.is_empty() && d.within_limits()) => "",
        (false, false) => " (no design with an absorber is within the limits)",
    };
    match (best, results.best_optimum(false)) {
        (Some(best), Some(own)) => {
            // what is said is said of the margin or the life, not of its inverse
            let ratio = 100.0 * (1.0 - study.objective.unit.ratio(objective(&own.design) / objective(best)));
            let compare = if !ratio.is_finite() {
                "not comparable".to_owned()
            } else if ratio.abs() < 1e-4 {
                "the same".to_owned()
            } else if ratio > 0.0 {
                format!("{ratio:.1} % lower")
            } else {
                format!("{:.1} % higher", -ratio)
            };
            let (given, found) = (judged(best), judged(&own.design));
            let _ = writeln!(text, "Best given design{whose}: {} with {given}. {}: {found}, {compare}.", best.name, own.design.name);
        }
        (Some(best), None) => {
            let _ = writeln!(text, "Best design{whose}: {} with {}.", best.name, judged(best));
            let (found, of) = of_design(results, best);
            let words: Vec<String> = found.iter().map(|v| clause(v, of, &best.absorbers)).collect();
            if !words.is_empty() {
                let _ = writeln!(text, "  verdict on {}: {}", best.name, words.join("; "));
            }
        }
        _ => {}
    }
    if let Some(robust) = results.best_optimum(true) {
        let held = if robust.limits_hold() { "" } else { ", which breaks limits" };
        let _ = writeln!(text, "Best within the tolerances: {} with {}{held}.", robust.design.name, judged(&robust.design));
    }
    text
}

/// Designs in the conditions of the study: what each comes to, and what the best optimum costs or saves against the best given design.
pub fn conditions(study: &Study, results: &Results) -> String {
    let all: Vec<&DesignResult> = results.designs.iter().chain(results.optima.iter().filter(|o| o.main).map(|o| &o.design)).collect();
    let mut rows = Vec::new();
    for d in &all {
        for c in &d.conditions {
            let share = |x: f64, of: Option<f64>| {
                let percent = |o: f64| (100.0 * (x / o - 1.0)).round();
                dash(of.filter(|o| *o > 0.0).map(percent).map(|p| if p == 0.0 { "0".into() } else { format!("{p:+.0}") }))
            };
            let without = all.iter().find(|d| d.absorbers.is_empty());
            let none = without.and_then(|n| n.conditions.iter().find(|o| o.condition == c.condition)?.twist);
            // a lost or locked absorber is set against the engine that never had one
            let none = none.or_else(|| without.and_then(|n| n.twist)).map(|p| p.value);
            let twist = c.twist.map_or(0.0, |p| p.value);
            rows.push(vec![
                d.name.clone(),
                c.condition.name().replace('_', " "),
                dash(c.cylinder.map(|c| (c + 1).to_string())),
                dash(c.twist.map(|p| significant(p.value * DEG_PER_RAD, 4))),
                dash(c.twist.map(|p| format!("{:.0}", p.speed_rpm))),
                dash(c.twist.map(|p| results.system.excitation.orders[p.order].to_string())),
                dash(c.torque.map(|p| format!("{:.0}", p.value))),
                share(twist, d.twist.map(|p| p.value)),
                if d.absorbers.is_empty() { "-".into() } else { share(twist, none) },
            ]);
        }
    }
    if rows.is_empty() {
        return String::new();
    }
    let header = ["design", "condition", "cylinder", "twist/°", "at/rpm", "order", "torque/N m", "% over firing", "% over none"];
    let mut text = format!(
        "Conditions:\n{}  cylinder: the one whose misfire is worst; torque: the largest of any misfire; order: the largest in the peak; % over firing: against the same\n  \
         design when all cylinders fire and the absorber works; % over none: against the engine without absorber in the same condition\n",
        keyed(&header, &rows, 2)
    );
    text.push_str(&temperatures(study, results));
    if !results.appearing.is_empty() {
        let list: Vec<String> = results.appearing.iter().map(ToString::to_string).collect();
        let _ = writeln!(
            text,
            "  A misfire brings orders into the net torque of all throws that cancel there while every cylinder fires: {}.",
            list.join(", ")
        );
    }
    if let (Some(best), Some(own)) = (results.best_given(), results.best_optimum(false)) {
        for own in &own.design.conditions {
            let Some(given) = best.conditions.iter().find(|c| c.condition == own.condition) else { continue };
            let unit = study.objective.unit;
            let change = 100.0 * (unit.ratio(own.objective / given.objective) - 1.0);
            let words = match (unit.is_inverse(), change < 0.0) {
                _ if change.abs() < 0.05 => "changes nothing".to_owned(),
                (true, false) => format!("gains {change:.1} %"),
                (false, true) => format!("saves {:.1} %", -change),
                _ => format!("costs {:.1} %", change.abs()),
            };
            let _ = writeln!(
                text,
                "  {}: the best optimum {words} against {}: {} and {}.",
                own.condition.name().replace('_', " "),
                best.name,
                value(study, own.objective),
                value(study, given.objective)
            );
        }
    }
    text
}

/// Infinite where no steady motion of it is known.
fn objective(d: &DesignResult) -> f64 {
    d.objective.unwrap_or(f64::INFINITY)
}
