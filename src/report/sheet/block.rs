//! A table of the page.

/// A table of the page: its title and its rows.
pub(super) struct Block {
    pub(super) title: &'static str,
    pub(super) rows: Vec<(String, String)>,
}

pub(super) fn row(name: &str, value: String) -> (String, String) {
    (name.to_owned(), value)
}
