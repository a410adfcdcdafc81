//! `report.html` of what has no page of its own: what was printed, and the plots and tables of the folder.

use super::parts::{TABLES, page, picture};
use crate::report::files::{Folder, WriteError};
use crate::report::names::PAGE;
use crate::report::text::{short, width};
use maud::{Markup, PreEscaped, html};
use std::path::Path;

/// Rows above which a table is only named.
const MOST_ROWS: usize = 1000;
/// Bytes above which a table is only named.
const MOST_BYTES: u64 = 1 << 20;

/// Writes the page; plots and tables are taken from the folder, in the order in which they were written.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
pub(crate) fn write(title: &str, printed: impl Fn() -> String, folder: &Folder) -> Result<(), WriteError> {
    let printed = width::for_a_file(|| width::wrapped(&printed()));
    let names = folder.names();
    let stem = |name: &str, end: &str| name.strip_suffix(end).map(str::to_owned);
    let pictures: Vec<String> = names.iter().filter_map(|n| stem(n, ".svg")).collect();
    let tables: Vec<String> = names.iter().filter_map(|n| stem(n, ".csv")).collect();
    let body = html! {
        h1 { (title) }
        h2 { "In short" }
        div class="scroll" { pre { (printed.trim_end()) } }
        @if !pictures.is_empty() {
            h2 { "Plots" }
            div class="pair large" { @for name in &pictures { @if let Some(source) = picture(folder, &format!("{name}.svg")) {
                figure { img src=(source) alt=(in_words(name)); figcaption class="soft" { (in_words(name)) } }
            } } }
        }
        @if !tables.is_empty() {
            h2 { "Tables" }
            p class="soft" { "Numbers of four significant digits; the files beside this page hold all of them." }
            @for name in &tables { (table(folder, name)) }
        }
        p class="soft" { "hartog " (env!("CARGO_PKG_VERSION")) ". `summary.json` beside this page names every file with its size and checksum." }
        script { (PreEscaped(TABLES)) }
    };
    folder.write(PAGE, page(&format!("{title} – hartog"), &body).as_bytes())
}

/// The name of a file as a caption.
fn in_words(name: &str) -> String {
    let words = name.replace('_', " ");
    words.chars().take(1).flat_map(char::to_uppercase).chain(words.chars().skip(1)).collect()
}

/// A table of the folder that can be opened, sorted and filtered; a long one is only named.
fn table(folder: &Folder, name: &str) -> Markup {
    let file = format!("{name}.csv");
    let Some((head, rows)) = read(&folder.path().join(&file)) else {
        return html! { p { b { (file) } span class="soft" { " is too long for a page." } } };
    };
    html! {
        details open[rows.len() <= 40 && head.len() <= 12] {
            summary { b { (file) } ", " (rows.len()) @if rows.len() == 1 { " row" } @else { " rows" } }
            div class="tools" { label { "Find " input type="search" data-of=(format!("table_{name}")) aria-label=(format!("Find in {file}")); } }
            div class="scroll" { table id=(format!("table_{name}")) class="sorts" {
                thead { tr { @for h in &head { th { (h) } } } }
                tbody { @for row in &rows { tr { @for value in row { td { (cell(value)) } } } } }
            } }
        }
    }
}

/// Head and rows of a table; none where it is too long.
fn read(path: &Path) -> Option<(Vec<String>, Vec<Vec<String>>)> {
    std::fs::metadata(path).ok().filter(|m| m.len() <= MOST_BYTES)?;
    let mut reader = csv::Reader::from_path(path).ok()?;
    let of = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect::<Vec<_>>();
    let head = of(reader.headers().ok()?);
    let rows: Vec<Vec<String>> = reader.records().take(MOST_ROWS + 1).map(|r| r.ok().map(|r| of(&r))).collect::<Option<_>>()?;
    (rows.len() <= MOST_ROWS).then_some((head, rows))
}

/// Long numbers are cut to what a page shows.
fn cell(value: &str) -> String {
    match value.parse::<f64>() {
        Ok(number) if value.len() > 7 && number.is_finite() && value.contains(['.', 'e']) => short(number),
        _ => value.to_owned(),
    }
}
