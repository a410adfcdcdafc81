//! What a platform comes to: how few dampers serve its engines, and which engines share one.

use super::cut::cut;
use super::manifest::Manifest;
use super::tables::Rows;
use crate::analysis::campaign::Status;
use crate::columns::heading;
use crate::input::campaign::{BOUND_OF_RATIO, Campaign, DAMPER, DAMPERS, Platform, RATIO, WORST_RATIO};
use maud::{Markup, html};

/// Columns of ratios.
const RATIOS: [&str; 3] = [WORST_RATIO, BOUND_OF_RATIO, RATIO];

/// The rows of a number of dampers of the best case of what cases are compared by.
struct Assigned {
    /// Values of the first two of what varies, and the design.
    key: Vec<String>,
    rows: Vec<usize>,
    /// Of how many cases it is the best.
    of: usize,
}

impl Assigned {
    fn first(&self, rows: &Rows, column: &str) -> String {
        self.rows.first().map(|r| word(rows, column, *r)).unwrap_or_default()
    }

    /// Statuses of rows that are not as asked, each once.
    fn statuses(&self, rows: &Rows) -> Vec<String> {
        let mut list: Vec<String> = self.rows.iter().map(|r| rows.word("status", *r).replace('_', " ")).collect();
        list.retain(|status| status != Status::Ok.word());
        list.sort();
        list.dedup();
        list
    }
}

/// What stands in a row: ratios with four decimals.
fn word(rows: &Rows, column: &str, row: usize) -> String {
    let number = rows.numbers(column).map(|all| all[row]).filter(|x| x.is_finite() && RATIOS.contains(&column));
    number.map_or_else(|| rows.word(column, row), |x| format!("{x:.4}"))
}

/// What cases are compared by.
fn compared_by(campaign: &Campaign) -> Vec<&str> {
    campaign.axes.iter().take(2).map(|a| a.name.as_str()).chain(["design"]).collect()
}

/// Assignments of the best cases, for each number of dampers.
fn assigned(campaign: &Campaign, rows: &Rows) -> Vec<Assigned> {
    let (by, Some(worst)) = (compared_by(campaign), rows.numbers(WORST_RATIO)) else { return Vec::new() };
    let counted: Vec<&str> = by.iter().copied().chain([DAMPERS]).collect();
    let of_group = |(mut key, own): (Vec<String>, Vec<usize>)| {
        let count = key.pop()?;
        let is_as_asked = |r: &usize| rows.word("status", *r) == Status::Ok.word();
        let order = |r: &usize| (if worst[*r].is_finite() { worst[*r] } else { f64::INFINITY }, !is_as_asked(r));
        let best = own.iter().copied().reduce(|a, b| if order(&b) < order(&a) { b } else { a }).filter(|_| !count.is_empty())?;
        let case = rows.word("case", best);
        let mut cases: Vec<String> = own.iter().map(|r| rows.word("case", *r)).collect();
        cases.dedup();
        Some(Assigned { key, of: cases.len(), rows: own.into_iter().filter(|r| rows.word("case", *r) == case).collect() })
    };
    rows.groups(&counted).into_iter().filter_map(of_group).collect()
}

/// What an engine is called, with its load.
fn study_of(platform: &Platform, rows: &Rows, row: usize) -> String {
    platform.axes().map(|a| rows.exact(&a.name, row)).collect::<Vec<_>>().join(" ")
}

/// Engines that share a damper, by its number; then those that none serves.
fn sharing(platform: &Platform, rows: &Rows, own: &Assigned) -> String {
    let mut sets: Vec<(String, Vec<String>)> = Vec::new();
    for row in &own.rows {
        let (damper, engine) = (rows.word(DAMPER, *row), rows.exact(&platform.engines.name, *row));
        match sets.iter_mut().find(|s| s.0 == damper) {
            Some(set) if set.1.contains(&engine) => {}
            Some(set) => set.1.push(engine),
            None => sets.push((damper, vec![engine])),
        }
    }
    sets.sort_by(|a, b| a.0.len().cmp(&b.0.len()).then(a.0.cmp(&b.0)));
    let (served, left_out): (Vec<_>, Vec<_>) = sets.into_iter().partition(|s| !s.0.is_empty());
    let served = served.iter().map(|s| s.1.join(" + ")).collect::<Vec<_>>().join(" | ");
    match left_out.first() {
        Some(out) if served.is_empty() => format!("none was found for {}", out.1.join(", ")),
        Some(out) => format!("{served}; none was found for {}", out.1.join(", ")),
        None => served,
    }
}

/// A line for each number of dampers; of what came to nothing why.
pub(super) fn told(campaign: &Campaign, platform: &Platform, rows: &Rows) -> String {
    let line = |own: &Assigned| {
        let (dampers, worst, bound) = (own.first(rows, DAMPERS), own.first(rows, WORST_RATIO), own.first(rows, BOUND_OF_RATIO));
        let word = if dampers == "1" { "damper" } else { "dampers" };
        let bound = if bound.is_empty() { bound } else { format!(", proved not below {bound}") };
        let ratio = if worst.is_empty() {
            format!("no assignment was found that holds all limits{bound}")
        } else {
            format!("worst ratio {worst}{bound}")
        };
        let case = if own.of > 1 { format!(" (case {}, the best of {})", own.first(rows, "case"), own.of) } else { String::new() };
        let statuses = own.statuses(rows).join(", ");
        let statuses = if statuses.is_empty() { statuses } else { format!(" [{statuses}]") };
        format!("\n{}, {dampers} {word}: {ratio}: {}{case}{statuses}", own.key.join(", "), sharing(platform, rows, own))
    };
    let lines: String = assigned(campaign, rows).iter().map(line).collect();
    let none = |row: &usize| rows.word(DAMPERS, *row).is_empty();
    let without =
        (0..rows.count).find(none).map(|row| format!("\n{}: {}", rows.word("status", row).replace('_', " "), rows.word("reason", row)));
    lines + &without.unwrap_or_default()
}

/// The tables of the page.
pub(super) fn dampers(manifest: &Manifest, campaign: &Campaign, platform: &Platform, rows: &Rows) -> Markup {
    let (all, more) = cut(assigned(campaign, rows));
    let by = compared_by(campaign);
    // the design comes last
    let axes = by.len() - 1;
    let of_platform = |name: &String| platform.axes().any(|a| a.name == *name);
    let others: Vec<&String> = manifest.axes.iter().filter(|a| !by.contains(&a.as_str()) && !of_platform(a)).collect();
    let kept = |name: &&String| {
        let said = ["case", "status", "reason", "design", "starts_agreeing", "converged", "limits_hold"];
        let is_said = said.contains(&name.as_str()) || [DAMPERS, DAMPER, WORST_RATIO, BOUND_OF_RATIO].contains(&name.as_str());
        !is_said && !manifest.axes.contains(name) && all.iter().flat_map(|s| &s.rows).any(|r| !rows.word(name, *r).is_empty())
    };
    let columns: Vec<&String> = rows.names.iter().filter(kept).collect();
    let by_target =
        if platform.targets.is_some() { "the target that is given" } else { "the best that a damper for this study alone reaches" };
    html! { @if !all.is_empty() {
        h2 { "How few dampers serve the engines" }
        p class="soft" { "A ratio is an objective over " (by_target) ", of a margin the inverse: what is larger is worse. Of all ways to give each engine one of so many dampers this has the least worst ratio that was found; no other is below the lower bound, which follows from what is proved of the dampers of sets of engines." }
        div class="scroll" { table {
            thead { tr { @for name in &by[..axes] { th class="words" { (heading(name)) } } th { "dampers" } th { "worst ratio" } th { "lower bound" } th class="words" { "which engines share one" } th class="words" { "design" } th { "case" } @for name in &others { th { (heading(name)) } } } }
            tbody { @for own in &all { tr {
                @for word in &own.key[..axes] { td class="words" { (word) } } @for name in [DAMPERS, WORST_RATIO, BOUND_OF_RATIO] { td { (own.first(rows, name)) } }
                td class="words" { (sharing(platform, rows, own)) } td class="words" { (own.first(rows, "design")) } td { (own.first(rows, "case")) } @for name in &others { td { (own.first(rows, name)) } }
            } } }
        } }
        (more)
        h2 { "Every engine with its damper" }
        div class="tools" { label { "Find " input type="search" data-of="engines" aria-label="Find engines"; } }
        div class="scroll" { table id="engines" class="sorts" {
            thead { tr { @for name in &by { th class="words" { (heading(name)) } } th { "dampers" } th { "damper" } th class="words" { "engine" } th { "status" } @for name in &columns { th { (heading(name)) } } } }
            tbody { @for own in &all { @for row in &own.rows { tr {
                @for word in &own.key { td class="words" { (word) } } td { (rows.word(DAMPERS, *row)) } td { (rows.word(DAMPER, *row)) }
                td class="words" { (study_of(platform, rows, *row)) } td { (rows.word("status", *row).replace('_', " ")) }
                @for name in &columns { td { (word(rows, name, *row)) } }
            } } } }
        } }
    } }
}
