//! What a run prints: designs, optima, conditions, summary.

use super::certificate::certificate;
use super::limits::{barred, limits};
use super::margin::factor;
use super::materials::temperatures;
use super::parameters::parameters;
use super::robust::during;
use super::table::{dash, keyed, significant, table};
use super::width::is_wide;
use crate::absorber::parameter::{DAMPING, RING_INERTIA, STIFFNESS};
use crate::absorber::{Absorber, Host, Mounted, Parameter};
use crate::analysis::choice::{Choice, Strategy};
use crate::analysis::{DesignResult, Nature, OptimumResult, PeakKind, Results};
use crate::input::{FrontSpec, MeasureSpec, Study, UnitOf};
use crate::objective::{Condition, Over, Peak, Place, holds};
use crate::optimise::Role;
use crate::report::csv::in_unit;
use crate::response::{Quantity, Work};
use crate::units::DEG_PER_RAD;
use std::fmt::Write;

/// Parameters that some absorber has besides ring inertia, stiffness and damping.
fn other_parameters<'a>(designs: impl Iterator<Item = &'a DesignResult>) -> Vec<&'static Parameter> {
    let mut list: Vec<&Parameter> = Vec::new();
    for p in designs.flat_map(|d| &d.absorbers).filter_map(|m| m.absorber.declaration()).flat_map(|t| t.parameters) {
        if ![RING_INERTIA.key, STIFFNESS.key, DAMPING.key].contains(&p.key) && list.iter().all(|known| known.key != p.key) {
            list.push(p);
        }
    }
    list
}

/// Ring, stiffness, damping and the other parameters of an absorber.
fn absorber_cells(mounted: Option<&Mounted>, others: &[&Parameter]) -> Vec<String> {
    let one = mounted.map(|m| &m.absorber);
    let mut cells = vec![
        dash(one.map(|a| significant(a.ring_inertia(), 4))),
        dash(one.and_then(Absorber::stiffness).map(|k| significant(k, 5))),
        dash(one.and_then(Absorber::damping).map(|c| significant(c, 4))),
    ];
    cells.extend(others.iter().map(|p| dash(one.and_then(|a| a.value(p.key)).map(|x| significant(x, 4)))));
    cells
}

/// A line for each absorber of a design after its first.
fn further_absorbers(study: &Study, d: &DesignResult, others: &[&Parameter], columns: usize) -> Vec<Vec<String>> {
    let line = |(i, m): (usize, &Mounted)| {
        let host = match m.on {
            Host::Station(station) => study.chain.stations[station].name.clone(),
            Host::Ring(inner) => format!("ring {}", inner + 1),
        };
        let mut row = vec![format!("  {}: {} on {host}", i + 1, m.absorber.type_name())];
        row.extend(absorber_cells(Some(m), others));
        row.resize(columns, String::new());
        row
    };
    d.absorbers.iter().enumerate().skip(1).map(line).collect()
}

fn design_row(study: &Study, results: &Results, d: &DesignResult, others: &[&Parameter]) -> Vec<String> {
    let orders = &results.system.excitation.orders;
    let frequency = |i: usize| dash(d.frequencies_hz.get(i).map(|f| format!("{f:.2}")));
    let mut row = vec![d.name.clone()];
    row.extend(absorber_cells(d.absorbers.first(), others));
    if is_wide() {
        row.extend([frequency(0), frequency(1), frequency(2)]);
    }
    row.extend([dash(d.twist.map(|p| significant(p.value * DEG_PER_RAD, 4))), dash(d.twist.map(|p| format!("{:.0}", p.speed_rpm)))]);
    if is_wide() {
        row.push(dash(d.order_twist.map(|p| significant(p.value * DEG_PER_RAD, 4))));
        row.push(dash(d.order_twist.map(|p| format!("{} @ {:.0}", orders[p.order], p.speed_rpm))));
    }
    row.extend([dash(d.torque.map(|p| format!("{:.0}", p.value))), dash(d.power.map(|p| significant(p, 3)))]);
    if other_objective(study) {
        row.push(dash(d.objective.map(|v| significant(in_unit(study, v), 5))));
    }
    row
}

/// Whether the objective is not the synthesised twist that every table shows.
fn other_objective(study: &Study) -> bool {
    study.objective.measure.synthesised() != Some(study.twist)
}

/// How searches evaluated designs, where that was chosen: a line each objective.
pub(crate) fn choices(results: &Results) -> String {
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

/// The table of designs and optima.
pub fn designs(study: &Study, results: &Results) -> String {
    let all = || results.designs.iter().chain(results.optima.iter().map(|o| &o.design));
    let others = other_parameters(all());
    let mut header = vec!["design", "ring/kg m²", "k/N m/rad", "c/N m s/rad"];
    header.extend(others.iter().map(|p| p.label));
    let columns = ["f1/Hz", "f2/Hz", "f3/Hz", "twist/°", "at/rpm", "order/°", "order @ rpm", "torque/N m", "dissipated/W"];
    header.extend(columns.into_iter().filter(|c| is_wide() || !["f1/Hz", "f2/Hz", "f3/Hz", "order/°", "order @ rpm"].contains(c)));
    if other_objective(study) {
        header.push(&study.objective.column);
    }
    let mut rows = Vec::new();
    for d in all() {
        rows.push(design_row(study, results, d, &others));
        rows.extend(further_absorbers(study, d, &others, header.len()));
    }
    let name = |i: usize| study.chain.stations[i].name.as_str();
    let between = match study.twist {
        Quantity::Twist { from, to } => format!("{} to {}", name(from), to.map_or("ground", name)),
        _ => String::new(),
    };
    let order = if is_wide() { "order: its largest single order; " } else { "" };
    let (low, high) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    format!(
        "{}\n  twist: half peak-to-peak of all orders with phase, {between}, largest over {low} to {high} rpm;\n  {order}\
         torque: largest vibratory torque of a shaft; dissipated: mean power dissipated in the absorbers\n",
        table(&header, &rows)
    )
}

fn value(study: &Study, v: f64) -> String {
    value_of(&study.objective, v)
}

fn value_of(objective: &MeasureSpec, v: f64) -> String {
    match objective.unit {
        UnitOf::Angle => format!("{:.6}°", v * DEG_PER_RAD),
        UnitOf::Torque => format!("{v:.4} N m"),
        UnitOf::Margin => factor(1.0 / v),
        unit => format!("{}{}", significant(unit.shown(v), 6), unit.suffix()),
    }
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
    let at_worst = if o.robust { " at worst within the tolerances" } else { "" };
    put(format!("{}: {}{at_worst} {}", o.design.name, objective.label, value_of(objective, best)));
    let own = o.design.objective.filter(|_| o.objective == 0);
    // of the conditions that it is judged in, not of all that are reported
    let worst = o.design.conditions.iter().find(|c| own == Some(c.objective));
    if let (Some(all), Some(c)) = (own.filter(|v| *v > best * (1.0 + 1e-9)), worst) {
        let why = match c.condition {
            Condition::InOperation => "at its own temperature and strain; searches are at the reference of its material",
            _ => "whatever the spring and damper; the rest is optimised",
        };
        put(format!("  {}: {}, {why}", c.condition.name().replace('_', " "), value(study, all)));
    }
    for ((row, nature), load_case) in outcome.rows.rows.iter().zip(&o.natures).zip(&o.load_cases) {
        let p = &row.peak;
        let during = during(&o.optimum.design, load_case);
        match row.role {
            Role::Objective(i) if outcome.rows.is_largest(row, 1e-5) => {
                let parts = study.combined.as_ref().filter(|_| o.objective > study.more_objectives.len());
                let own = parts.map_or(objective, |c| &c.parts[i].of);
                let of = if parts.is_some() { format!(" of {}", own.label) } else { String::new() };
                put(format!(
                    "  active peak{of}{}{during}, {}{}",
                    at_speed(p),
                    value_of(own, p.value),
                    peak_words(results, nature.as_ref())
                ));
            }
            // what is broken by more is said below, once
            Role::Limit(i) if row.value.abs() < 1e-5 => put(format!("  active limit{}{during}: {}", at_speed(p), study.limits[i].words)),
            _ => {}
        }
    }
    parameters(o).into_iter().for_each(&mut put);
    certificate(objective, o, value_of).into_iter().for_each(&mut put);
    limits(study, o).into_iter().for_each(&mut put);
    text
}

/// A line for each family of each front: its knee, or that it has no design.
fn fronts(study: &Study, results: &Results) -> String {
    let Some(FrontSpec::Of { measures, .. }) = &study.front else { return String::new() };
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
                count => format!("{count} points, {left} of them not dominated{knee}"),
            };
            let _ = writeln!(text, "Front of {} against {}, {}: {what}.", first.label, second.label, family.replace('_', " and "));
        }
    }
    text
}

/// What the run found, in sentences.
pub(crate) fn summary(study: &Study, results: &Results) -> String {
    let mut text = fronts(study, results);
    let held = study.optimise.as_ref().map_or(&[Condition::Firing][..], |o| &o.conditions);
    for (i, limit) in study.limits.iter().enumerate() {
        let broken = |d: &&DesignResult| !holds(d.limits[i]);
        let size = |d: &DesignResult| match limit.of.unit {
            UnitOf::Margin => factor(1.0 / (d.limits[i] * limit.limit)),
            UnitOf::Life => value_of(&limit.of, d.limits[i] * limit.limit),
            _ => format!("{:.0} %", 100.0 * d.limits[i]),
        };
        let list: Vec<String> = results.designs.iter().filter(broken).map(|d| format!("{} ({})", d.name, size(d))).collect();
        if !list.is_empty() {
            let _ = writeln!(text, "Limit {}: broken by the given {}.", limit.words, list.join(", "));
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
    let with = || results.designs.iter().filter(|d| !d.absorbers.is_empty());
    let any_holds = with().any(DesignResult::within_limits);
    let given = with().filter(|d| !any_holds || d.within_limits());
    let whose = match (study.limits.is_empty(), any_holds) {
        (true, _) => "",
        (false, true) => " within the limits",
        (false, false) => " (none is within the limits)",
    };
    if let (Some(best), Some(own)) =
        (given.min_by(|a, b| better(a, b)), results.optima.iter().filter(|o| o.main).min_by(|a, b| better(&a.design, &b.design)))
    {
        let is_inverse = study.objective.unit.is_inverse();
        let share = objective(&own.design) / objective(best);
        // what is said is said of the margin or the life, not of its inverse
        let ratio = 100.0 * (1.0 - if is_inverse { 1.0 / share } else { share });
        let compare = if !ratio.is_finite() {
            "not comparable".to_owned()
        } else if ratio.abs() < 1e-4 {
            "the same".to_owned()
        } else if ratio > 0.0 {
            format!("{ratio:.1} % lower")
        } else {
            format!("{:.1} % higher", -ratio)
        };
        let _ = writeln!(
            text,
            "Best given design{whose}: {} with {}. {}: {}, {compare}.",
            best.name,
            value(study, objective(best)),
            own.design.name,
            value(study, objective(&own.design))
        );
        let in_operation = results.conditions().filter(|c| *c == Condition::InOperation);
        let judged_in: Vec<Condition> = held.iter().copied().chain(in_operation).collect();
        if judged_in != [Condition::Firing] {
            let names: Vec<String> = judged_in.iter().map(|c| c.name().replace('_', " ")).collect();
            let _ = writeln!(text, "  (each at its worst of: {})", names.join(", "));
        }
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
    let given = results.designs.iter().filter(|d| !d.absorbers.is_empty());
    let own = results.optima.iter().filter(|o| o.main).min_by(|a, b| better(&a.design, &b.design));
    if let (Some(best), Some(own)) = (given.min_by(|a, b| better(a, b)), own) {
        for own in &own.design.conditions {
            let Some(given) = best.conditions.iter().find(|c| c.condition == own.condition) else { continue };
            let change = 100.0 * (own.objective / given.objective - 1.0);
            let words = if change.abs() < 0.05 {
                "changes nothing".to_owned()
            } else {
                format!("{} {:.1} %", if change < 0.0 { "saves" } else { "costs" }, change.abs())
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

/// Order of designs by objective; what is level (a lost absorber is the same for all) by the twist while all works.
fn better(a: &DesignResult, b: &DesignResult) -> std::cmp::Ordering {
    const LEVEL: f64 = 1e-9;
    let (x, y) = (objective(a), objective(b));
    if (x - y).abs() <= LEVEL * x.abs() {
        let twist = |d: &DesignResult| d.twist.map_or(0.0, |p| p.value);
        return twist(a).total_cmp(&twist(b));
    }
    x.total_cmp(&y)
}

fn objective(d: &DesignResult) -> f64 {
    d.objective.unwrap_or(0.0)
}
