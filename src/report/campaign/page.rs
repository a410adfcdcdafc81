//! `campaign.html`: what was asked, what came of it, the best, the yield, and what depends on what.

use super::counted::counted;
use super::cut::cut;
use super::dampers::{self, dampers};
use super::dataset::Dataset;
use super::error::CampaignError;
use super::manifest::Manifest;
use super::tables::{Rows, Values};
use super::whole_file;
use crate::analysis::campaign::{Status, indices};
use crate::columns::heading;
use crate::input::campaign::{Campaign, DAMPERS};
use crate::page::{TABLES, embedded, page};
use crate::text::short;
use maud::{Markup, PreEscaped, html};
use std::collections::BTreeMap;
use std::path::Path;

/// Its name.
#[doc(hidden)]
pub const PAGE: &str = "campaign.html";

const SCRIPT: &str = include_str!("campaign.js");

/// What tells a page of ours.
const MARK: &str = "<!-- hartog campaign -->";

/// Rows that are drawn.
const DRAWN: usize = 4000;
/// Bars of a distribution.
const BARS: usize = 24;
/// Normal deviate of a 95 % interval.
const TWO_SIDED_95: f64 = 1.959_964;

/// Writes the page, and tells what is most of it in a few lines.
///
/// # Errors
/// [`CampaignError`] where a table cannot be read, or the page cannot be written.
#[doc(hidden)]
pub fn write_page(folder: &Path, manifest: &Manifest, campaign: &Campaign, dataset: &Dataset) -> Result<String, CampaignError> {
    let path = folder.join(PAGE);
    if std::fs::read(&path).is_ok_and(|there| !String::from_utf8_lossy(&there).contains(MARK)) {
        return Err(CampaignError::Foreign { path, what: "is there and is no page of a campaign" });
    }
    let rows = Rows::read(folder, manifest, dataset)?;
    let body = html! {
        (PreEscaped(MARK))
        h1 { "Campaign " (campaign.name) }
        (asked(manifest, campaign, dataset))
        @match &campaign.platform {
            Some(platform) => (dampers(manifest, campaign, platform, &rows)),
            None => {
                (best(manifest, campaign, &rows))
                (yields(campaign, &rows))
                (distributions(manifest, campaign, &rows))
                (effects(manifest, campaign, &rows))
                (sensitivity(manifest, campaign, &rows))
            }
        }
        (scatter())
        (failures(&rows))
        (provenance(manifest, dataset))
        script type="application/json" id="data" { (PreEscaped(embedded(&data(manifest, &rows)))) }
        script { (PreEscaped(TABLES)) (PreEscaped(SCRIPT)) }
    };
    whole_file::write(&folder.join(PAGE), page(&format!("{} – hartog", campaign.name), &body).as_bytes())?;
    Ok(summary(manifest, campaign, &rows))
}

fn summary(manifest: &Manifest, campaign: &Campaign, rows: &Rows) -> String {
    let mut text = format!("{} of {}", counted(rows.count, "row"), counted(manifest.cases, "case"));
    if let Some(platform) = &campaign.platform {
        text += &dampers::told(campaign, platform, rows);
    } else if let Some((row, value)) = best_of(manifest, rows, 0..rows.count) {
        let of: Vec<String> = manifest.axes.iter().map(|a| format!("{a} {}", rows.word(a, row))).collect();
        let design = rows.word("design", row);
        text += &format!(
            "\nbest {}: {} by {design}, case {}: {}",
            heading(&manifest.objective),
            short(value),
            rows.word("case", row),
            of.join(", ")
        );
    }
    text
}

/// What rows are compared by: the first two of what varies, and the types.
fn compared_by(campaign: &Campaign) -> Vec<&str> {
    campaign.axes.iter().take(2).map(|a| a.name.as_str()).chain(["types"]).collect()
}

/// The row with the best objective of those that are as asked.
fn best_of(manifest: &Manifest, rows: &Rows, among: impl Iterator<Item = usize>) -> Option<(usize, f64)> {
    let values = rows.numbers(&manifest.objective)?;
    let sign = if manifest.larger_is_better { -1.0 } else { 1.0 };
    let good = among.filter(|r| rows.word("status", *r) == Status::Ok.word() && values[*r].is_finite());
    good.min_by(|a, b| (sign * values[*a]).total_cmp(&(sign * values[*b]))).map(|r| (r, values[r]))
}

fn asked(manifest: &Manifest, campaign: &Campaign, dataset: &Dataset) -> Markup {
    let done = manifest.shards - dataset.missing().len();
    html! {
        p { @match &campaign.platform {
                Some(platform) => { "Which dampers serve " @for (i, axis) in platform.axes().enumerate() { @if i > 0 { ", each at " } (counted(axis.variants.len(), "value")) " of " b { (axis.name) } } " in " (counted(manifest.cases, "case")) }
                None => { "What does " b { (campaign.each.name()) } " give for " (counted(manifest.cases, "case")) }
            }
            @for axis in &campaign.axes { ", " (axis.variants.len()) " of " b { (axis.name) } }
            @if let Some(sample) = &campaign.sample { ", " (sample.count().unwrap_or_default()) " points of " b { (sample.keys.iter().map(|k| k.name.as_str()).collect::<Vec<_>>().join(", ")) } }
            "?" }
        @if done < manifest.shards { p class="bad" { "Only " (done) " of " (manifest.shards) " shards are done: everything below is of these." } }
    }
}

/// The columns of numbers that are results.
fn results<'m>(manifest: &'m Manifest, rows: &'m Rows) -> impl Iterator<Item = &'m str> {
    let inputs = ["case", "exact", "point", "evaluations", "starts_agreeing", "converged", "dominated", "limits_hold"];
    let own = move |name: &&str| !inputs.contains(name) && !manifest.axes.iter().any(|a| a == name);
    let names = rows.names.iter().zip(&rows.columns).filter(|(_, c)| matches!(c, Values::Numbers(_)));
    names.map(|(name, _)| name.as_str()).filter(own)
}

fn best(manifest: &Manifest, campaign: &Campaign, rows: &Rows) -> Markup {
    let by = compared_by(campaign);
    let groups = rows.groups(&by);
    let best = |(key, own): (Vec<String>, Vec<usize>)| best_of(manifest, rows, own.into_iter()).map(|b| (key, b.0));
    let (shown, more) = cut(groups.into_iter().filter_map(best).collect::<Vec<_>>());
    let columns: Vec<&str> =
        results(manifest, rows).filter(|name| shown.iter().any(|(_, row)| !rows.word(name, *row).is_empty())).collect();
    let others: Vec<&str> = manifest.axes.iter().map(String::as_str).filter(|a| !by.contains(a)).collect();
    html! { @if !shown.is_empty() {
        h2 { "The best of each " (words(&by)) }
        p class="soft" { "By the " (heading(&manifest.objective)) ", " @if manifest.larger_is_better { "the largest" } @else { "the smallest" } " of the rows that are as asked." }
        div class="scroll" { table class="sorts" {
            thead { tr { @for name in &by { th class="words" { (heading(name)) } } th { "case" }
                @for axis in &others { th { (heading(axis)) } } @for name in &columns { th { (heading(name)) } } } }
            tbody { @for (key, row) in &shown { tr {
                @for word in key { td class="words" { (word) } } td { (rows.word("case", *row)) }
                @for axis in &others { td { (rows.word(axis, *row)) } } @for name in &columns { td { (rows.word(name, *row)) } }
            } } }
        } }
        (more)
    } }
}

/// Names of columns as a list of words.
fn words(names: &[&str]) -> String {
    let names: Vec<String> = names.iter().map(|n| n.replace('_', " ")).collect();
    match names.as_slice() {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        other => other.join(""),
    }
}

/// A share of rows with its 95 % confidence interval \[Wilson 1927\].
fn share(good: usize, all: usize) -> String {
    let (n, p, z) = (all as f64, good as f64 / all as f64, TWO_SIDED_95);
    let middle = (p + z * z / (2.0 * n)) / (1.0 + z * z / n);
    let half = z * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt() / (1.0 + z * z / n);
    format!("{:.1} % ({:.1} to {:.1})", 100.0 * p, 100.0 * (middle - half).max(0.0), 100.0 * (middle + half).min(1.0))
}

fn yields(campaign: &Campaign, rows: &Rows) -> Markup {
    let by = compared_by(campaign);
    let hold = |row: &usize| rows.word("status", *row) == Status::Ok.word();
    let (groups, more) =
        cut(rows.groups(&by).into_iter().filter(|(key, _)| key.last().is_some_and(|types| !types.is_empty())).collect::<Vec<_>>());
    html! { @if !groups.is_empty() {
        h2 { "Yield" }
        p class="soft" { "The share of rows with a design whose status is ok, within all limits of their studies, with its 95 % confidence interval as if cases were drawn at random (Wilson)." }
        div class="scroll" { table class="sorts" {
            thead { tr { @for name in &by { th class="words" { (heading(name)) } } th { "rows" } th { "yield" } } }
            tbody { @for (key, own) in &groups { tr { @for word in key { td class="words" { (word) } } td { (own.len()) } td { (share(own.iter().filter(|r| hold(r)).count(), own.len())) } } } }
        } }
        (more)
    } }
}

/// A value below which a share of ascending values lies.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    sorted[((sorted.len() - 1) as f64 * share).round() as usize]
}

/// Bars of how often values are where between the smallest and the largest.
fn histogram(sorted: &[f64]) -> Markup {
    let (low, high) = (sorted[0], sorted[sorted.len() - 1]);
    let mut counts = [0usize; BARS];
    for x in sorted {
        let share = if high > low { (x - low) / (high - low) } else { 0.5 };
        counts[((share * BARS as f64) as usize).min(BARS - 1)] += 1;
    }
    let most = counts.iter().copied().max().unwrap_or(1).max(1);
    html! {
        svg width="120" height="24" viewBox=(format!("0 0 {} 24", 5 * BARS)) role="img" aria-label="distribution from the smallest to the largest value" {
            @for (i, n) in counts.iter().enumerate() { @let height = 24.0 * *n as f64 / most as f64;
                rect x=(5 * i) y=(format!("{:.1}", 24.0 - height)) width="4" height=(format!("{height:.1}")) fill="var(--c0)" {} }
        }
    }
}

fn distributions(manifest: &Manifest, campaign: &Campaign, rows: &Rows) -> Markup {
    let first = campaign.axes.first().map_or("types", |a| a.name.as_str());
    let groups: Vec<_> = rows.groups(&[first, "design"]).into_iter().filter(|(key, _)| !key[1].is_empty()).collect();
    let one = |name: &str, own: &[usize]| {
        let all = rows.numbers(name)?;
        let mut values: Vec<f64> = own.iter().map(|r| all[*r]).filter(|x| x.is_finite()).collect();
        values.sort_by(f64::total_cmp);
        (!values.is_empty()).then_some(values)
    };
    let list: Vec<(&str, &Vec<String>, Vec<f64>)> =
        results(manifest, rows).flat_map(|name| groups.iter().filter_map(move |(key, own)| Some((name, key, one(name, own)?)))).collect();
    let (list, more) = cut(list);
    html! {
        h2 { "Distributions of results" }
        div class="tools" { label { "Find " input type="search" data-of="distributions" aria-label="Find results"; } }
        div class="scroll" { table id="distributions" class="sorts" {
            thead { tr { th { "result" } th class="words" { (heading(first)) } th class="words" { "design" } th { "rows" } th { "smallest" } th { "5 %" } th { "median" } th { "95 %" } th { "largest" } th { "" } } }
            tbody { @for (name, key, values) in &list { tr {
                td { (heading(name)) } @for word in *key { td class="words" { (word) } } td { (values.len()) }
                @for share in [0.0, 0.05, 0.5, 0.95, 1.0] { td { (short(quantile(values, share))) } }
                td { (histogram(values)) }
            } } }
        } }
        (more)
    }
}

/// Mean of the objective at each value of each axis, over all that else varies.
fn effects(manifest: &Manifest, campaign: &Campaign, rows: &Rows) -> Markup {
    let Some(all) = rows.numbers(&manifest.objective) else { return html! {} };
    let mut list = Vec::new();
    for axis in &campaign.axes {
        for (key, own) in rows.groups(&[axis.name.as_str(), "design"]).into_iter().filter(|(key, _)| !key[1].is_empty()) {
            let values: Vec<f64> = own.iter().map(|r| all[*r]).filter(|x| x.is_finite()).collect();
            if !values.is_empty() {
                list.push((axis.name.clone(), key, values.len(), values.iter().sum::<f64>() / values.len() as f64));
            }
        }
    }
    let (list, more) = cut(list);
    html! { @if !list.is_empty() {
        h2 { "Main effects" }
        p class="soft" { "Mean of the " (heading(&manifest.objective)) " at each value of what varies, over all that varies else." }
        div class="scroll" { table class="sorts" {
            thead { tr { th { "of" } th class="words" { "value" } th class="words" { "design" } th { "rows" } th { "mean" } } }
            tbody { @for (axis, key, n, mean) in &list { tr { td { (axis) } td class="words" { (key[0]) } td class="words" { (key[1]) } td { (n) } td { (short(*mean)) } } } }
        } }
        (more)
    } }
}

/// Sobol's indices of every design, of each combination of what varies.
fn sensitivity(manifest: &Manifest, campaign: &Campaign, rows: &Rows) -> Markup {
    let Some(sample) = campaign.sample.as_ref().filter(|s| s.indices) else { return html! {} };
    let (Some(cases), Some(all)) = (rows.numbers("case"), rows.numbers(&manifest.objective)) else { return html! {} };
    let points = sample.count().unwrap_or(1);
    let mut list = Vec::new();
    for (key, own) in rows.groups(&["design"]).into_iter().filter(|(key, _)| !key[0].is_empty()) {
        let mut by_combination: BTreeMap<usize, Vec<Option<f64>>> = BTreeMap::new();
        for row in own {
            let case = cases[row] as usize;
            let values = by_combination.entry(case / points).or_insert_with(|| vec![None; points]);
            values[case % points] = Some(all[row]).filter(|x| x.is_finite());
        }
        for (combination, values) in by_combination {
            let Some(found) = indices(&values, sample.keys.len()) else { continue };
            let labels = campaign.cases_of(combination * points..combination * points + 1).first().map(|c| campaign.labels(c).join(", "));
            list.extend(
                sample.keys.iter().zip(found).map(|(k, index)| (key[0].clone(), labels.clone().unwrap_or_default(), k.name.clone(), index)),
            );
        }
    }
    let (list, more) = cut(list);
    html! { @if !list.is_empty() {
        h2 { "How much of the variance each key makes" }
        p class="soft" { "Sobol's indices of the " (heading(&manifest.objective)) ": by itself (first order, Saltelli) and with all that it does together with others (total, Jansen), each with half of its 95 % confidence interval as if points were drawn at random." }
        div class="scroll" { table class="sorts" {
            thead { tr { th { "design" } th class="words" { "of" } th class="words" { "key" } th { "first order" } th { "±" } th { "total" } th { "±" } } }
            tbody { @for (design, labels, key, x) in &list { tr { td { (design) } td class="words" { (labels) } td class="words" { (key) }
                td { (format!("{:.3}", x.first)) } td { (format!("{:.3}", x.first_within)) } td { (format!("{:.3}", x.total)) } td { (format!("{:.3}", x.total_within)) } } } }
        } }
        (more)
    } }
}

fn scatter() -> Markup {
    html! {
        h2 { "Any two columns" }
        div class="tools" { label { "Across " select id="across" {} } label { "Up " select id="up" {} } label { "Design " select id="of" {} } span class="soft" id="drawn" {} }
        div id="scatter" {}
        p class="read" id="read" {}
    }
}

fn failures(rows: &Rows) -> Markup {
    let (groups, more) = cut(rows.groups(&["status", "reason"]));
    html! {
        h2 { "What became of the cases" }
        div class="scroll" { table class="sorts" {
            thead { tr { th { "status" } th { "rows" } th class="words" { "why" } th { "first case" } } }
            tbody { @for (key, own) in &groups { tr { td { (key[0].replace('_', " ")) } td { (own.len()) } td class="words" { (key[1]) } td { (rows.word("case", own[0])) } } } }
        } }
        (more)
    }
}

fn provenance(manifest: &Manifest, dataset: &Dataset) -> Markup {
    html! {
        h2 { "Where it comes from" }
        p { "Campaign " (manifest.address) ", digest of its tables " (dataset.digest()) ", " (manifest.program) "." }
        div class="scroll" { table { thead { tr { th { "input file" } th { "bytes" } th { "CRC-32" } } }
            tbody { @for f in &manifest.inputs { tr { td { (f.path.file_name().unwrap_or_default().display()) } td { (f.bytes) } td { (format!("{:08x}", f.crc32)) } } } } } }
    }
}

/// Rows that are drawn, evenly chosen: columns of numbers, and the design.
fn data(manifest: &Manifest, rows: &Rows) -> serde_json::Value {
    let step = rows.count.div_ceil(DRAWN).max(1);
    let chosen = || (0..rows.count).step_by(step);
    let numbers = rows.names.iter().zip(&rows.columns).filter_map(|(name, values)| match values {
        Values::Numbers(all) if all.iter().any(|x| x.is_finite()) => {
            let shown: Vec<Option<f64>> = chosen().map(|r| Some(all[r]).filter(|x| x.is_finite())).collect();
            Some((heading(name), serde_json::json!(shown)))
        }
        _ => None,
    });
    let columns: serde_json::Map<String, serde_json::Value> = numbers.collect();
    let designs: Vec<String> = chosen().map(|r| rows.word("design", r)).collect();
    // what is sampled says more across than a few values
    let named = manifest.axes.iter().rev().map(String::as_str).chain([DAMPERS]);
    let across = named.map(heading).find(|name| columns.contains_key(name));
    serde_json::json!({ "columns": columns, "design": designs, "rows": rows.count, "across": across, "up": heading(&manifest.objective) })
}
