//! What is printed of a chart.

use super::table;
use crate::assess::methods::Candidate;
use crate::assess::speed_accuracy::{Search, SpeedAccuracy};
use crate::assess::stability::{Cell, Scenario};

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
        let cells = |p: Option<&&&crate::assess::speed_accuracy::Point>| match p {
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

/// Exponents of the cost.
pub fn growth(measured: &SpeedAccuracy) -> String {
    let of = |candidate: Candidate, size: &str| {
        let found = measured.growth.iter().find(|g| g.candidate == candidate && g.size == size);
        found.map_or_else(|| "-".into(), |g| format!("{:.2}", g.exponent))
    };
    let rows: Vec<Vec<String>> = Candidate::ALL
        .into_iter()
        .filter(|c| measured.growth.iter().any(|g| g.candidate == *c))
        .map(|c| vec![c.label(), of(c, "stations"), of(c, "orders"), of(c, "speeds")])
        .collect();
    format!("Exponents of the cost of a sweep, set-up aside:\n{}", table(&["method", "stations", "orders", "speeds"], &rows))
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
