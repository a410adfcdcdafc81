//! Cells in messages.

/// A cell for a message: a quotation mark left open makes one of the rest of the file.
pub(crate) fn shown(cell: &str) -> String {
    const MOST: usize = 40;
    let line = cell.lines().next().unwrap_or("");
    if line.chars().count() > MOST || line.len() < cell.len() { line.chars().take(MOST).chain(['…']).collect() } else { line.to_owned() }
}
