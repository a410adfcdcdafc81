//! What is printed: tables that line up, and sentences.

use super::csv::in_unit;
use crate::absorber::Ring;
use crate::assess::{DesignResult, Nature, OptimumResult, PeakKind, Results};
use crate::response::Quantity;
use crate::study::{Study, UnitOf};
use crate::units::DEG_PER_RAD;
use std::fmt::Write;

/// A table whose columns line up: the first to the left, the others to the right.
pub fn table(header: &[&str], rows: &[Vec<String>]) -> String {
    let width = |c: usize| rows.iter().map(|r| r[c].chars().count()).chain([header[c].chars().count()]).max().unwrap_or(0);
    let widths: Vec<usize> = (0..header.len()).map(width).collect();
    let line = |cells: &[String]| {
        let padded = cells.iter().zip(&widths).enumerate().map(|(i, (c, w))| if i == 0 { format!("{c:<w$}") } else { format!("{c:>w$}") });
        format!("  {}\n", padded.collect::<Vec<_>>().join("  ").trim_end())
    };
    let head: Vec<String> = header.iter().map(|h| (*h).to_owned()).collect();
    let rule = "-".repeat(widths.iter().sum::<usize>() + 2 * (widths.len() - 1));
    rows.iter().fold(format!("{}  {rule}\n", line(&head)), |text, row| text + &line(row))
}

/// A number with about `digits` significant digits, without exponent where it is short.
pub fn significant(x: f64, digits: i32) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let decimals = (digits - 1 - x.abs().log10().floor() as i32).max(0) as usize;
    if x.abs() < 1e-4 || x.abs() >= 1e8 { format!("{x:.*e}", digits as usize - 1) } else { format!("{x:.decimals$}") }
}

fn dash(text: Option<String>) -> String {
    text.unwrap_or_else(|| "-".into())
}

fn design_row(study: &Study, results: &Results, d: &DesignResult) -> Vec<String> {
    let one = d.absorbers.first().map(|a| a.absorber);
    let orders = &results.system.excitation.orders;
    let frequency = |i: usize| dash(d.frequencies_hz.get(i).map(|f| format!("{f:.2}")));
    let mut row = vec![
        d.name.clone(),
        dash(one.map(|a| significant(a.ring_inertia(), 4))),
        dash(one.map(|a| a.stiffness()).filter(|k| k.is_finite()).map(|k| significant(k, 5))),
        dash(one.map(|a| significant(a.damping(), 4))),
        frequency(0),
        frequency(1),
        frequency(2),
        dash(d.twist.map(|p| significant(p.value * DEG_PER_RAD, 4))),
        dash(d.twist.map(|p| format!("{:.0}", p.speed_rpm))),
        dash(d.order_twist.map(|p| significant(p.value * DEG_PER_RAD, 4))),
        dash(d.order_twist.map(|p| format!("{} @ {:.0}", orders[p.order], p.speed_rpm))),
        dash(d.torque.map(|p| format!("{:.0}", p.value))),
        dash(d.power.map(|p| significant(p, 3))),
    ];
    if other_objective(study) {
        row.push(dash(d.objective.map(|v| significant(in_unit(study, v), 5))));
    }
    row
}

/// Whether the objective is not the synthesised twist that every table shows.
fn other_objective(study: &Study) -> bool {
    !(study.objective.column == "peak_twist_deg" && study.objective.measure.quantities == [study.twist])
}

/// The table of designs and optima.
pub fn designs(study: &Study, results: &Results) -> String {
    let mut header = vec![
        "design",
        "ring/kg m²",
        "k/N m/rad",
        "c/N m s/rad",
        "f1/Hz",
        "f2/Hz",
        "f3/Hz",
        "twist/°",
        "at/rpm",
        "order/°",
        "order @ rpm",
        "torque/N m",
        "lost/W",
    ];
    if other_objective(study) {
        header.push(study.objective.column);
    }
    let all = results.designs.iter().chain(results.optima.iter().map(|o| &o.design));
    let rows: Vec<Vec<String>> = all.map(|d| design_row(study, results, d)).collect();
    let name = |i: usize| study.chain.stations[i].name.as_str();
    let between = match study.twist {
        Quantity::Twist { from, to } => format!("{} to {}", name(from), to.map_or("ground", name)),
        _ => String::new(),
    };
    let (low, high) = (study.speeds_rpm[0], study.speeds_rpm[study.speeds_rpm.len() - 1]);
    format!(
        "{}\n  twist: half peak-to-peak of all orders with phase, {between}, largest over {low} to {high} rpm; order: its largest single order;\n  \
         torque: largest vibratory torque of a shaft; lost: power dissipated in the absorber\n",
        table(&header, &rows)
    )
}

fn value(study: &Study, v: f64) -> String {
    match study.objective.unit {
        UnitOf::Angle => format!("{:.6}°", v * DEG_PER_RAD),
        UnitOf::Torque => format!("{v:.4} N m"),
    }
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
    put(format!("{}: {} {}", o.design.name, study.objective.label, value(study, best)));
    for (row, nature) in outcome.rows.rows.iter().zip(&o.natures) {
        let p = &row.peak;
        match row.limit {
            None if p.value >= best * (1.0 - 1e-5) => {
                put(format!("  active peak at {:.1} rpm, {}{}", p.speed_rpm, value(study, p.value), peak_words(results, nature.as_ref())));
            }
            Some(i) if row.value > -1e-5 => put(format!("  active limit at {:.1} rpm: {}", p.speed_rpm, study.limits[i].0)),
            _ => {}
        }
    }
    let starts = &o.optimum.starts;
    let agreeing = o.optimum.agreeing();
    let worst = starts.iter().map(|s| s.finished / o.optimum.cost() - 1.0).filter(|above| above.is_finite()).fold(0.0, f64::max);
    let rest = match worst {
        _ if agreeing == starts.len() => String::new(),
        above if above < 10.0 => format!("; the worst of the others ended {:.2} % above", 100.0 * above),
        _ => "; others ended far above".into(),
    };
    put(format!("  {agreeing} of {} starts agree to 1e-6{rest}", starts.len()));
    let s = &o.optimum.stages;
    put(format!(
        "  evaluations: {} of starts, {} of search, {} of minimax; KKT residual {}; {}",
        s.seeds.evaluations,
        s.search.evaluations,
        s.minimax.evaluations,
        if outcome.kkt_residual.is_finite() { format!("{:.0e}", outcome.kkt_residual) } else { "not available".into() },
        outcome.stop.reason()
    ));
    for ((words, _), ratio) in study.limits.iter().zip(&o.design.limits) {
        put(format!("  limit: {words}: {} ({:.1} % of it)", if *ratio <= 1.0 + 1e-6 { "holds" } else { "FAILS" }, 100.0 * ratio));
    }
    text
}

/// What the run found, in sentences.
pub fn summary(study: &Study, results: &Results) -> String {
    let mut text = String::new();
    for (i, (words, _)) in study.limits.iter().enumerate() {
        let broken = |d: &&DesignResult| d.limits[i] > 1.0 + 1e-6;
        let list: Vec<String> =
            results.designs.iter().filter(broken).map(|d| format!("{} ({:.0} %)", d.name, 100.0 * d.limits[i])).collect();
        if !list.is_empty() {
            let _ = writeln!(text, "Limit {words}: broken by the given {}.", list.join(", "));
        }
    }
    let objective = |d: &DesignResult| d.objective.unwrap_or(0.0);
    if let Some(floor) = results.forced_floor {
        let none = results.designs.iter().find(|d| d.absorbers.is_empty());
        let beside = none.map_or_else(String::new, |d| format!("; without absorber it is {}", value(study, objective(d))));
        let _ = writeln!(text, "Forced floor: {} would be left if nothing resonated{beside}.", value(study, floor));
    }
    let given = results.designs.iter().filter(|d| !d.absorbers.is_empty());
    if let (Some(best), Some(own)) = (
        given.min_by(|a, b| objective(a).total_cmp(&objective(b))),
        results.optima.iter().filter(|o| o.main).min_by(|a, b| a.optimum.value().total_cmp(&b.optimum.value())),
    ) {
        let ratio = 100.0 * (1.0 - own.optimum.value() / objective(best));
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
            "Best given design: {} with {}. {}: {}, {compare}.",
            best.name,
            value(study, objective(best)),
            own.design.name,
            value(study, own.optimum.value())
        );
    }
    text
}
