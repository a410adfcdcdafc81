//! The table of a chart.

use super::table::{Table, number, optional};
use crate::benchmark::Chart;
use crate::benchmark::crank_ladder::Ladder;
use crate::benchmark::methods::Candidate;
use crate::benchmark::savings::Savings;
use crate::files::{Folder, WriteError};
use crate::response::Work;

/// `speed_accuracy.csv`: methods with their settings, what choosing and skipping save, what simplifications cost, the growth of cost, and what methods
/// make of the scenarios.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub fn speed_accuracy(chart: &Chart, folder: &Folder) -> Result<(), WriteError> {
    let mut table = Table::new(&["method", "setting", "seconds_per_design", "peak_error", "stable", "note"]);
    let text = |words: &str| words.to_owned();
    for w in &chart.methods.ways {
        table.row([text("receptance"), w.strategy.label(), number(w.seconds), number(w.error), text("yes"), text("a way of searches")]);
    }
    if let Some(s) = &chart.savings {
        for [name, setting, seconds, error, note] in savings(s) {
            table.row([name, setting, seconds, error, String::new(), note]);
        }
    }
    for m in &chart.margins {
        let mut row = |setting: &str, seconds: Option<f64>, error: Option<f64>| {
            let (method, setting) = (text("margin"), format!("{}, {setting}", m.criterion));
            table.row([method, setting, optional(seconds), optional(error), text("yes"), text("smallest margin of a design")]);
        };
        if m.whole.is_some() {
            row("whole histories", m.whole, None);
        }
        row("corners, every fillet and speed", Some(m.all), m.whole.map(|_| m.difference));
        row("with bounds", Some(m.bounds), Some(m.missed));
    }
    laws_and_fronts(chart, &mut table);
    for m in std::iter::once(&chart.common.grid).chain(&chart.models) {
        for (x, error) in &m.points {
            table.row([text("model"), format!("{} {x}", m.what.label()), String::new(), number(*error), String::new(), String::new()]);
        }
    }
    for b in &chart.common.energy {
        let (error, word, note) = match &b.missing {
            Ok(missing) => (Some(missing.abs()), "", "share of the energy put in that its dampers do not take out".to_owned()),
            Err(e) => (None, "refused", e.to_string()),
        };
        table.row([text(b.method), format!("energy, {}: {}", b.scenario, b.setting), String::new(), optional(error), text(word), note]);
    }
    let mut put = |candidate: Candidate, setting: &str, seconds: Option<f64>, error: Option<f64>, stable: &str, note: String| {
        let finite = |x: Option<f64>| optional(x.filter(|x| x.is_finite()));
        let setting = candidate.setting().map_or_else(|| setting.to_owned(), |own| format!("{own}; {setting}"));
        table.row([candidate.method().to_owned(), setting, finite(seconds), finite(error), stable.to_owned(), note]);
    };
    for p in &chart.methods.points {
        let (error, stable, note) = match &p.error {
            Ok(e) => (Some(*e), "yes", String::new()),
            Err(e) => (None, "refused", e.to_string()),
        };
        put(p.candidate, &p.search.label(), Some(p.seconds), error, stable, note);
    }
    for g in &chart.common.growth {
        for (x, seconds) in &g.points {
            put(g.candidate, &format!("{x} {}", g.size), Some(*seconds), None, "", "one sweep of a uniform chain".into());
        }
        put(g.candidate, &format!("exponent in {}", g.size), None, None, "", number((g.exponent * 1e3).round() / 1e3));
    }
    for (scenario, cells) in &chart.common.map {
        for c in cells {
            let (error, note) = match &c.found {
                Ok(e) => (Some(*e), String::new()),
                Err(e) => (None, e.to_string()),
            };
            let word = if c.as_declared() { c.word() } else { "DEFECT" };
            put(c.candidate, &format!("scenario: {}", scenario.name), None, error, word, note);
        }
    }
    table.save(folder, "speed_accuracy.csv")
}

/// Rows of laws of absorbers, and of NSGA-II beside fronts.
fn laws_and_fronts(chart: &Chart, table: &mut Table) {
    let text = |words: &str| words.to_owned();
    for l in &chart.laws {
        let note = format!(
            "{:.3} times a spring and damper; error of the peak if it is taken for the one it is at the first mode",
            l.seconds / l.plain
        );
        table.row([text("law"), text(l.name), number(l.seconds), number(l.error), text("yes"), note]);
    }
    for p in &chart.proofs {
        let setting = format!("{}, {} free, gap {:e}", p.kind, p.free, p.gap);
        let note = format!("{} boxes; {}", p.boxes, if p.proved { "proved" } else { "not proved" });
        table.row([text("proof"), setting, number(p.seconds), String::new(), text("yes"), note]);
    }
    for f in &chart.fronts {
        for r in &f.rounds {
            let setting = format!("{}, {} against {}: {} evaluations", f.family, f.of[0], f.of[1], r.evaluations);
            let note = format!(
                "largest gap to a front of {} evaluations; median {}; {} of {} points reached; {} below it",
                f.evaluations,
                number(r.median),
                r.reached,
                f.points,
                number(r.below)
            );
            table.row([text("nsga_2"), setting, String::new(), optional(Some(r.largest).filter(|x| x.is_finite())), text("yes"), note]);
        }
    }
}

/// Rows of what choosing and skipping save: method, setting, seconds, error, note.
fn savings(s: &Savings) -> Vec<[String; 5]> {
    let mut rows = Vec::new();
    let mut put = |method: &str, setting: String, seconds: Option<f64>, error: Option<f64>, note: String| {
        rows.push([method.to_owned(), setting, optional(seconds), optional(error), note]);
    };
    let work = |w: &Work| format!("{} syntheses and {} direct solutions a design", w.syntheses, w.direct_solves);
    let same = if s.identical { "the same peaks to the last bit" } else { "DEFECT: other peaks" };
    put("receptance", "random absorbers, nothing skipped".into(), Some(s.full.seconds), None, work(&s.full.work));
    put(
        "receptance",
        "random absorbers, only what can win".into(),
        Some(s.skipping.seconds),
        None,
        format!("{}; {same}", work(&s.skipping.work)),
    );
    for c in &s.choice.considered {
        let note = if *c == s.choice.chosen { "estimated; chosen" } else { "estimated" };
        put(
            "auto",
            format!("considered: {}", c.strategy.label()),
            Some(c.seconds),
            Some(c.error),
            format!("{note}; nominal seconds by counted work"),
        );
    }
    for m in &s.smaller_models {
        put(
            "auto",
            format!("not considered: {}", m.candidate.label()),
            Some(m.seconds),
            Some(m.error),
            "estimated; nominal seconds by counted work".into(),
        );
    }
    if let Some((cost, h)) = &s.surrogate {
        put("auto", format!("{} random absorbers", h.designs), Some(cost.seconds), None, work(&cost.work));
        let share = |n: usize, of: usize| n as f64 / of.max(1) as f64;
        put(
            "auto",
            "true error above the estimate, share".into(),
            None,
            Some(share(h.exceeded, h.designs)),
            format!("{} of {}", h.exceeded, h.designs),
        );
        put("auto", "median of estimated over true error".into(), None, None, number(h.ratio));
        put(
            "auto",
            "true error above the tolerance, share of those not sent on".into(),
            None,
            Some(share(h.accepted - h.within, h.accepted)),
            format!("{} of {}", h.accepted - h.within, h.accepted),
        );
    }
    if let Some((every, best)) = s.designs_per_second {
        let same = if s.same_best { "the same best design" } else { "DEFECT: another best design" };
        put("auto", format!("designs a second, {} threads, the peak of each", s.threads), Some(1.0 / every), None, format!("{every:.0}"));
        put(
            "auto",
            format!("designs a second, {} threads, the best of all", s.threads),
            Some(1.0 / best),
            None,
            format!("{best:.0}; {same}"),
        );
    }
    put("receptance", "one point of the kernel".into(), Some(s.point), None, format!("{:.2} ns", 1e9 * s.point));
    put("direct", format!("sweep of {}", s.sweep.label()), Some(s.sweep.seconds), None, format!("{:.3} ms", 1e3 * s.sweep.seconds));
    rows
}

/// `crank_ladder.csv`: a row a model of the crank with its time and errors, then a row a model and factor on the stiffness of all bearings.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub(crate) fn crank_ladder(ladder: &Ladder, folder: &Folder) -> Result<(), WriteError> {
    let mut table = Table::new(&["model", "bearing_ratio", "seconds", "peak_error", "margin_error", "optimum_error"]);
    for r in &ladder.rungs {
        table.row([r.rung.label().to_owned(), number(1.0), number(r.seconds), number(r.peak), optional(r.margin), optional(r.optimum)]);
    }
    for (factor, errors) in &ladder.bearings {
        for (rung, error) in errors {
            table.row([rung.label().to_owned(), number(*factor), String::new(), number(*error), String::new(), String::new()]);
        }
    }
    table.save(folder, "crank_ladder.csv")
}
