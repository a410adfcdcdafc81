//! Tables of a folder on its page: each can be opened, sorted and filtered.

use crate::captions::caption;
use crate::columns::heading;
use crate::files::Folder;
use crate::text::short;
use maud::{Markup, html};
use std::path::Path;

/// Rows above which a table is only named.
const MOST_ROWS: usize = 1000;
/// Bytes above which a table is only named.
const MOST_BYTES: u64 = 1 << 20;

/// The tables that this command has written, by name, without those that the page draws or that are of no interest to its reader.
pub(super) fn tables(folder: &Folder, left_out: &[&str]) -> Markup {
    let mut stems: Vec<String> = folder.names().iter().filter_map(|n| n.strip_suffix(".csv").map(str::to_owned)).collect();
    stems.retain(|stem| !left_out.contains(&stem.as_str()));
    stems.sort();
    html! { @if !stems.is_empty() {
        h2 { "Tables" }
        p class="soft" { "Numbers of four significant digits; the files beside this page hold all of them." }
        @for stem in &stems { (table(folder, stem)) }
    } }
}

/// The name of a file as a caption.
pub(super) fn in_words(name: &str) -> String {
    let words = name.replace('_', " ");
    words.chars().take(1).flat_map(char::to_uppercase).chain(words.chars().skip(1)).collect()
}

/// A table of the folder that can be opened, sorted and filtered; a long one is only named.
fn table(folder: &Folder, name: &str) -> Markup {
    let file = format!("{name}.csv");
    let Some((head, rows)) = read(&folder.path().join(&file)) else {
        return html! { p { b { (caption(name)) } span class="soft" { ": " (file) " is too long for a page." } } };
    };
    html! {
        details open[rows.len() <= 40 && head.len() <= 12] {
            summary { b { (caption(name)) } " (" (file) ", " (rows.len()) @if rows.len() == 1 { " row)" } @else { " rows)" } }
            div class="tools" { label { "Find " input type="search" data-of=(format!("table_{name}")) aria-label=(format!("Find in {file}")); } }
            div class="scroll" { table id=(format!("table_{name}")) class="sorts" {
                thead { tr { @for h in &head { th { (heading(h)) } } } }
                tbody { @for row in &rows { tr { @for value in row { td { (cell(value)) } } } } }
            } }
        }
    }
}

/// Head and rows of a table; none where it is too long.
fn read(path: &Path) -> Option<(Vec<String>, Vec<Vec<String>>)> {
    std::fs::metadata(path).ok().filter(|m| m.len() <= MOST_BYTES)?;
    let mut reader = csv::Reader::from_path(path).ok()?;
    let cells = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect::<Vec<_>>();
    let head = cells(reader.headers().ok()?);
    let rows: Vec<Vec<String>> = reader.records().take(MOST_ROWS + 1).map(|r| r.ok().map(|r| cells(&r))).collect::<Option<_>>()?;
    (rows.len() <= MOST_ROWS).then_some((head, rows))
}

/// Long numbers are cut to what a page shows.
fn cell(value: &str) -> String {
    match value.parse::<f64>() {
        Ok(number) if value.len() > 7 && number.is_finite() && value.contains(['.', 'e']) => short(number),
        _ => value.to_owned(),
    }
}
