//! What a platform comes to: how few dampers serve its engines, and which engines share one.

use super::cut::cut;
use super::manifest::Manifest;
use super::tables::Rows;
use crate::analysis::campaign::{DAMPERS, Status, WORST_RATIO};
use crate::columns::heading;
use crate::input::campaign::{Campaign, Platform};
use maud::{Markup, html};

/// The bound of the worst ratio.
const BOUND: &str = "lower_bound_of_worst_ratio";

/// The rows of a number of dampers of the best case of what cases are compared by.
struct Assigned {
    /// Values of the first two of what varies, and the design.
    key: Vec<String>,
    rows: Vec<usize>,
}

impl Assigned {
    fn first(&self, rows: &Rows, column: &str) -> String {
        self.rows.first().map(|r| rows.word(column, *r)).unwrap_or_default()
    }

    fn worst(&self, rows: &Rows) -> String {
        let bound = self.first(rows, BOUND);
        let bound = if bound.is_empty() { String::new() } else { format!(", proved not below {bound}") };
        format!("{}{bound}", self.first(rows, WORST_RATIO))
    }
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
        let order = |r: &usize| (!is_as_asked(r), if worst[*r].is_finite() { worst[*r] } else { f64::INFINITY });
        let best = own.iter().copied().reduce(|a, b| if order(&b) < order(&a) { b } else { a }).filter(|_| !count.is_empty())?;
        let case = rows.word("case", best);
        Some(Assigned { key, rows: own.into_iter().filter(|r| rows.word("case", *r) == case).collect() })
    };
    rows.groups(&counted).into_iter().filter_map(of_group).collect()
}

/// What an engine is called, with its load.
fn study_of(platform: &Platform, rows: &Rows, row: usize) -> String {
    platform.axes().map(|a| rows.word(&a.name, row)).collect::<Vec<_>>().join(" ")
}

/// Engines that share a damper, by its number.
fn sharing(platform: &Platform, rows: &Rows, own: &Assigned) -> String {
    let mut sets: Vec<(String, Vec<String>)> = Vec::new();
    for row in &own.rows {
        let (damper, engine) = (rows.word("damper", *row), rows.word(&platform.engines.name, *row));
        match sets.iter_mut().find(|s| s.0 == damper) {
            Some(set) if set.1.contains(&engine) => {}
            Some(set) => set.1.push(engine),
            None => sets.push((damper, vec![engine])),
        }
    }
    sets.sort_by(|a, b| a.0.len().cmp(&b.0.len()).then(a.0.cmp(&b.0)));
    sets.iter().map(|s| s.1.join(" + ")).collect::<Vec<_>>().join(" | ")
}

/// A line for each number of dampers.
pub(super) fn told(campaign: &Campaign, platform: &Platform, rows: &Rows) -> String {
    let line = |own: &Assigned| {
        let dampers = own.first(rows, DAMPERS);
        let word = if dampers == "1" { "damper" } else { "dampers" };
        format!("\n{}, {dampers} {word}: worst ratio {}: {}", own.key.join(", "), own.worst(rows), sharing(platform, rows, own))
    };
    assigned(campaign, rows).iter().map(line).collect()
}

/// The tables of the page.
pub(super) fn dampers(manifest: &Manifest, campaign: &Campaign, platform: &Platform, rows: &Rows) -> Markup {
    let (all, more) = cut(assigned(campaign, rows));
    let by = compared_by(campaign);
    let kept = |name: &&String| {
        let said = [
            DAMPERS,
            "damper",
            WORST_RATIO,
            BOUND,
            "case",
            "status",
            "reason",
            "design",
            "evaluations",
            "starts_agreeing",
            "converged",
            "limits_hold",
        ];
        !said.contains(&name.as_str())
            && !manifest.axes.contains(name)
            && all.iter().flat_map(|s| &s.rows).any(|r| !rows.word(name, *r).is_empty())
    };
    let columns: Vec<&String> = rows.names.iter().filter(kept).collect();
    let by_target =
        if platform.targets.is_some() { "the target that is given" } else { "the least that a damper for this study alone reaches" };
    html! {
        h2 { "How few dampers serve the engines" }
        p class="soft" { "A ratio is an objective over " (by_target) ". Of all ways to give each engine one of so many dampers this has the least worst ratio that was found; the lower bound of all of them follows from what is proved of the damper of each set of engines." }
        div class="scroll" { table {
            thead { tr { @for name in &by { th class="words" { (heading(name)) } } th { "case" } th { "dampers" } th { "worst ratio" } th { "lower bound" } th class="words" { "which engines share one" } } }
            tbody { @for own in &all { tr {
                @for word in &own.key { td class="words" { (word) } } td { (own.first(rows, "case")) }
                @for name in [DAMPERS, WORST_RATIO, BOUND] { td { (own.first(rows, name)) } } td class="words" { (sharing(platform, rows, own)) }
            } } }
        } }
        (more)
        h2 { "Every engine with its damper" }
        div class="tools" { label { "Find " input type="search" data-of="engines" aria-label="Find engines"; } }
        div class="scroll" { table id="engines" class="sorts" {
            thead { tr { @for name in &by { th class="words" { (heading(name)) } } th { "dampers" } th { "damper" } th class="words" { "engine" } th { "status" } @for name in &columns { th { (heading(name)) } } } }
            tbody { @for own in &all { @for row in &own.rows { tr {
                @for word in &own.key { td class="words" { (word) } } td { (rows.word(DAMPERS, *row)) } td { (rows.word("damper", *row)) }
                td class="words" { (study_of(platform, rows, *row)) } td { (rows.word("status", *row).replace('_', " ")) }
                @for name in &columns { td { (rows.word(name, *row)) } }
            } } } }
        } }
    }
}
