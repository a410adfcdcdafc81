//! What is printed of a chart.

use super::table::table;
use crate::analysis::method_selection::Considered;
use crate::benchmark::crank_ladder::{Ladder, Rung, RungCost};
use crate::benchmark::energy::Balance;
use crate::benchmark::evolution::{Evolution, Round};
use crate::benchmark::growth::{Growth, SIZES};
use crate::benchmark::laws::LawCost;
use crate::benchmark::margin_methods::MarginCost;
use crate::benchmark::methods::Candidate;
use crate::benchmark::model_accuracy::ModelError;
use crate::benchmark::proofs::ProofCost;
use crate::benchmark::savings::Savings;
use crate::benchmark::speed_accuracy::{Search, SpeedAccuracy};
use crate::benchmark::stability::{Cell, Scenario};
use crate::benchmark::{Chart, Common};

/// All that is measured on a study.
#[doc(hidden)]
pub fn of_study(chart: &Chart) -> String {
    let engine = &chart.study.engine.name;
    let mut parts = Vec::new();
    if chart.methods.probes.is_empty() {
        parts.push(format!("{engine}: no design with one absorber to probe\n"));
    } else {
        let names: Vec<&str> = chart.methods.probes.iter().map(|p| p.0.as_str()).collect();
        parts.push(format!("{engine}: peak twist of {} probe designs ({})\n", names.len(), names.join(", ")));
        parts.push(methods(&chart.methods));
        parts.push(ways(&chart.methods));
    }
    parts.extend(chart.savings.as_ref().map(savings));
    parts.extend((!chart.margins.is_empty()).then(|| margins(&chart.margins)));
    parts.extend((!chart.laws.is_empty()).then(|| laws(&chart.laws)));
    parts.extend((!chart.fronts.is_empty()).then(|| fronts(&chart.fronts)));
    parts.extend((!chart.proofs.is_empty()).then(|| proofs(&chart.proofs)));
    parts.extend((!chart.models.is_empty()).then(|| models("What a simpler model costs, error of the peak:", &chart.models)));
    parts.extend(chart.ladder.as_ref().map(ladder));
    parts.join("\n")
}

/// Proofs against gap and free parameters.
fn proofs(measured: &[ProofCost]) -> String {
    let row = |p: &ProofCost| {
        let proved = if p.proved { "yes" } else { "no" };
        vec![
            p.kind.to_owned(),
            p.free.to_string(),
            format!("{:e}", p.gap),
            p.boxes.to_string(),
            format!("{:.2}", p.seconds),
            proved.to_owned(),
        ]
    };
    let rows: Vec<Vec<String>> = measured.iter().map(row).collect();
    format!(
        "What a proof costs that no design within the bounds is better by more than a gap, on all threads:\n{}",
        table(&["type", "free", "gap", "boxes", "time/s", "proved"], &rows)
    )
}

/// Models of the crank.
fn ladder(ladder: &Ladder) -> String {
    let percent = |e: Option<f64>| e.map_or_else(|| "-".into(), |e| format!("{:.2} %", 100.0 * e));
    let row = |r: &RungCost| {
        vec![r.rung.label().to_owned(), format!("{:.2}", r.seconds), percent(Some(r.peak)), percent(r.margin), percent(r.optimum)]
    };
    let rows: Vec<Vec<String>> = ladder.rungs.iter().map(row).collect();
    let rungs = table(&["model of the crank", "time/s", "peak", "margin", "optimum"], &rows);
    let chains: Vec<Rung> = ladder.bearings.first().map_or_else(Vec::new, |b| b.1.iter().map(|e| e.0).collect());
    let rows: Vec<Vec<String>> = ladder
        .bearings
        .iter()
        .map(|(factor, errors)| std::iter::once(format!("{factor}")).chain(errors.iter().map(|e| percent(Some(e.1)))).collect())
        .collect();
    let header: Vec<&str> = std::iter::once("bearings times").chain(chains.iter().map(|r| r.label())).collect();
    format!(
        "Largest errors against the flexible crank, times of one run each on all threads; an optimum is that of the model, computed on it:\n{rungs}\n\
         Error of the peak of chains against the flexible crank with stiffer and softer bearings:\n{}",
        table(&header, &rows)
    )
}

/// What is the same for all studies.
#[doc(hidden)]
pub fn common(common: &Common) -> String {
    let grid = models("Without refinement a grid misses the peak of one mode, share:", std::slice::from_ref(&common.grid));
    [growth(&common.growth), energy(&common.energy), grid, stability(&common.map)].join("\n")
}

fn duration(seconds: f64) -> String {
    if seconds < 1e-3 { format!("{:.1} µs", 1e6 * seconds) } else { format!("{:.2} ms", 1e3 * seconds) }
}

/// A row a method: its coarsest and finest grid, and refined.
pub fn methods(measured: &SpeedAccuracy) -> String {
    let mut rows = Vec::new();
    for candidate in Candidate::ALL {
        let own: Vec<_> = measured.points.iter().filter(|p| p.candidate == candidate).collect();
        let finest = own.iter().rfind(|p| matches!(p.search, Search::Grid(_)));
        let refined = own.iter().find(|p| matches!(p.search, Search::Refined(_)));
        let cells = |p: Option<&&&crate::benchmark::speed_accuracy::Point>| match p {
            Some(p) => match &p.error {
                Ok(e) => [p.search.label(), duration(p.seconds), format!("{e:.1e}")],
                Err(_) => [p.search.label(), "-".into(), "refused".into()],
            },
            None => ["-".into(), "-".into(), "-".into()],
        };
        let row = [vec![candidate.label()], cells(finest.as_ref()).to_vec(), cells(refined.as_ref()).to_vec()].concat();
        if !own.is_empty() {
            rows.push(row);
        }
    }
    table(&["method", "grid", "per design", "error", "refined", "per design", "error"], &rows)
}

/// Strategies of a search: tables at several strides, and exactly.
pub(crate) fn ways(measured: &SpeedAccuracy) -> String {
    let row = |w: &Considered| vec![w.strategy.label(), duration(w.seconds), format!("{:.1e}", w.error)];
    table(&["strategy of a search", "per design", "error"], &measured.ways.iter().map(row).collect::<Vec<_>>())
}

/// What choosing and skipping save, and how often the error exceeds its estimate.
pub fn savings(s: &Savings) -> String {
    let mut text = format!(
        "Random absorbers: {} a design with nothing skipped ({} syntheses, {} direct solutions), {} with only what can win ({}, {}): {}\n",
        duration(s.full.seconds),
        s.full.work.syntheses,
        s.full.work.direct_solves,
        duration(s.skipping.seconds),
        s.skipping.work.syntheses,
        s.skipping.work.direct_solves,
        if s.identical { "the same peaks to the last bit" } else { "DEFECT: other peaks" }
    );
    if let (Some((cost, h)), Some((every, best))) = (&s.surrogate, s.designs_per_second) {
        text.push_str(&format!(
            "`auto` chooses {}: {} a design; of {} random absorbers {} err by more than their estimate, median of estimated over true error {:.1}; {} of {} \
             not evaluated exactly err by more than the tolerance\n",
            s.choice.chosen.strategy.label(),
            duration(cost.seconds),
            h.designs,
            h.exceeded,
            h.ratio,
            h.accepted - h.within,
            h.accepted
        ));
        text.push_str(&format!(
            "Designs a second on {} threads: {:.0} thousand with the peak of each, {:.2} million for the best of all{}\n",
            s.threads,
            1e-3 * every,
            1e-6 * best,
            if s.same_best { "" } else { " (DEFECT: another best design)" }
        ));
    } else {
        text.push_str("`auto` stays exact here\n");
    }
    text.push_str(&format!(
        "One point of the kernel: {:.2} ns; a direct sweep of {}: {:.3} ms\n",
        1e9 * s.point,
        s.sweep.label(),
        1e3 * s.sweep.seconds
    ));
    text
}

/// What the smallest margin of a design costs, a row a criterion.
pub(crate) fn margins(costs: &[MarginCost]) -> String {
    let row = |m: &MarginCost| {
        let whole = m.whole.map_or_else(|| "-".into(), duration);
        let difference = if m.whole.is_some() { format!("{:.1e}", m.difference) } else { "-".into() };
        vec![m.criterion.to_owned(), whole, duration(m.all), difference, duration(m.bounds), format!("{:.1e}", m.missed)]
    };
    let header = ["smallest margin, per design", "whole histories", "corners", "difference", "with bounds", "difference"];
    table(&header, &costs.iter().map(row).collect::<Vec<_>>())
}

/// Laws of absorbers against a spring and damper, a row a type.
pub(crate) fn laws(costs: &[LawCost]) -> String {
    let row = |l: &LawCost| {
        vec![l.name.to_owned(), duration(l.seconds), format!("{:.2}", l.seconds / l.plain), format!("{:.2} %", 100.0 * l.error)]
    };
    let header = ["law of an absorber", "per design", "times a spring and damper", "error if taken for one"];
    table(&header, &costs.iter().map(row).collect::<Vec<_>>())
}

/// NSGA-II beside fronts, a row a run.
pub(crate) fn fronts(fronts: &[Evolution]) -> String {
    let share = |x: f64| if x.is_finite() { format!("{:.3} %", 100.0 * x) } else { "-".into() };
    let row = |f: &Evolution, r: &Round| {
        let name = format!("{}, {} against {}", f.family, f.of[0], f.of[1]);
        let work = format!("{:.1}", r.evaluations as f64 / f.evaluations as f64);
        vec![name, work, format!("{} of {}", r.reached, f.points), share(r.median), share(r.largest), share(r.below)]
    };
    let rows: Vec<Vec<String>> = fronts.iter().flat_map(|f| f.rounds.iter().map(move |r| row(f, r))).collect();
    table(&["NSGA-II beside the front", "work", "reached", "median above", "most above", "below"], &rows)
}

/// What simplifications cost, a row each, under a heading.
pub fn models(heading: &str, models: &[ModelError]) -> String {
    let mut text = format!("{heading}\n");
    for m in models {
        let points: Vec<String> = m.points.iter().map(|(x, e)| format!("{x}: {e:.1e}")).collect();
        text.push_str(&format!("  {}: {}\n", m.what.label(), points.join(", ")));
    }
    text
}

/// Exponents of the cost.
pub fn growth(measured: &[Growth]) -> String {
    let exponent = |candidate: Candidate, size: &str| {
        let found = measured.iter().find(|g| g.candidate == candidate && g.size == size);
        found.map_or_else(|| "-".into(), |g| format!("{:.2}", g.exponent))
    };
    let rows: Vec<Vec<String>> = Candidate::ALL
        .into_iter()
        .filter(|c| measured.iter().any(|g| g.candidate == *c))
        .map(|c| std::iter::once(c.label()).chain(SIZES.map(|size| exponent(c, size))).collect())
        .collect();
    format!("Exponents of the cost of a sweep, set-up aside:\n{}", table(&[&["method"], &SIZES[..]].concat(), &rows))
}

/// Energy balances: a row a method, a column a scenario.
pub fn energy(balances: &[Balance]) -> String {
    let mut scenarios: Vec<&str> = Vec::new();
    let mut ways: Vec<(&str, &str)> = Vec::new();
    for b in balances {
        if !scenarios.contains(&b.scenario) {
            scenarios.push(b.scenario);
        }
        if !ways.contains(&(b.method, b.setting)) {
            ways.push((b.method, b.setting));
        }
    }
    let cell = |way: &(&str, &str), scenario: &str| {
        let found = balances.iter().find(|b| (b.method, b.setting) == *way && b.scenario == scenario);
        found.map_or_else(|| "-".into(), |b| b.missing.as_ref().map_or_else(|_| "refused".into(), |m| format!("{:.0e}", m.abs())))
    };
    let row = |way: &(&str, &str)| {
        let name = format!("{}: {}", way.0.replace('_', " "), way.1);
        std::iter::once(name).chain(scenarios.iter().map(|s| cell(way, s))).collect::<Vec<_>>()
    };
    let header: Vec<&str> = std::iter::once("energy not dissipated, share").chain(scenarios.iter().copied()).collect();
    table(&header, &ways.iter().map(row).collect::<Vec<_>>())
}

/// Defects by name, or how many cells came as declared.
pub fn stability(map: &[(Scenario, Vec<Cell>)]) -> String {
    let cells: Vec<(&str, &Cell)> = map.iter().flat_map(|(s, cells)| cells.iter().map(move |c| (s.name, c))).collect();
    let count = |word: &str| cells.iter().filter(|c| c.1.as_declared() && c.1.word() == word).count();
    let mut text = format!(
        "Stability: {} scenarios, {} methods: {} right within 0.1 %, {} rough within 10 %, {} refused by name, {} wrong and known to be\n",
        map.len(),
        map.first().map_or(0, |m| m.1.len()),
        count("right"),
        count("rough"),
        count("refused"),
        count("wrong")
    );
    for (scenario, cell) in cells.iter().filter(|c| !c.1.as_declared()) {
        text.push_str(&format!("  DEFECT: {}, {scenario}: declared {:?}, found {:?}\n", cell.candidate.label(), cell.declared, cell.found));
    }
    text
}
