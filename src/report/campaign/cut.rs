//! Long tables of the page.

use maud::{Markup, html};

/// Rows of tables that are told.
const TOLD: usize = 200;

/// As many rows of a table as are told, and what is said of the others.
pub(super) fn cut<T>(mut list: Vec<T>) -> (Vec<T>, Markup) {
    let more = list.len().saturating_sub(TOLD);
    list.truncate(TOLD);
    (list, html! { @if more > 0 { p class="soft" { "… and " (more) " more, in the tables of the campaign." } } })
}
