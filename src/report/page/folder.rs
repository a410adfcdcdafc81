//! `report.html` of what has no page of its own: what was printed, and the plots and tables of the folder.

use super::parts::{TABLES, page, picture};
use super::tables::{in_words, tables};
use crate::files::{Folder, WriteError};
use crate::names::PAGE;
use crate::text::width;
use maud::{PreEscaped, html};

/// Writes the page; plots and tables are taken from the folder, in the order in which they were written.
///
/// # Errors
/// [`WriteError`] where it cannot be written.
#[doc(hidden)]
pub fn write(title: &str, printed: impl Fn() -> String, folder: &Folder) -> Result<(), WriteError> {
    let printed = width::for_a_file(|| width::wrapped(&printed()));
    let names = folder.names();
    let stem = |name: &str, end: &str| name.strip_suffix(end).map(str::to_owned);
    let pictures: Vec<String> = names.iter().filter_map(|n| stem(n, ".svg")).collect();
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
        (tables(folder, &[]))
        p class="soft" { "hartog " (env!("CARGO_PKG_VERSION")) ". `summary.json` beside this page names every file with its size and checksum." }
        script { (PreEscaped(TABLES)) }
    };
    folder.write(PAGE, page(&format!("{title} – hartog"), &body).as_bytes())
}
