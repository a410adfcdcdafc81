//! How wide printed text may be.

use std::cell::Cell;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Columns where nothing else is said.
#[doc(hidden)]
pub const USUAL: usize = 100;
/// Columns below which tables are not made narrower.
const LEAST: usize = 60;

/// Of this process: what is printed has one width.
static WIDTH: AtomicUsize = AtomicUsize::new(USUAL);

/// Sets the width of all that is printed from now on; `None`: as wide as it comes.
#[doc(hidden)]
pub fn set(columns: Option<usize>) {
    WIDTH.store(columns.map_or(usize::MAX, |c| c.max(LEAST)), Ordering::Relaxed);
}

thread_local! {
    /// Of what is written on this thread instead.
    static OWN: Cell<Option<usize>> = const { Cell::new(None) };
}

/// Text for a file: as wide on every terminal.
pub(crate) fn for_a_file<T>(write: impl FnOnce() -> T) -> T {
    OWN.set(Some(USUAL));
    let written = write();
    OWN.set(None);
    written
}

/// The width.
pub(crate) fn columns() -> usize {
    OWN.get().unwrap_or_else(|| WIDTH.load(Ordering::Relaxed))
}

/// Whether all columns of a table are wanted, however wide it becomes.
pub(crate) fn is_wide() -> bool {
    columns() == usize::MAX
}

/// Sentences that are longer than the width, broken between words; what follows is indented as they are, and by two more.
#[doc(hidden)]
pub fn wrapped(text: &str) -> String {
    let width = columns();
    let mut out = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        let body = line.trim_end_matches('\n');
        if body.chars().count() <= width {
            out.push_str(line);
            continue;
        }
        let indent = body.chars().take_while(|c| *c == ' ').count();
        let mut length = 0;
        for word in body.split_whitespace() {
            let own = word.chars().count();
            if length == 0 {
                out.push_str(&" ".repeat(indent));
                length = indent + own;
            } else if length + 1 + own > width {
                out.push('\n');
                out.push_str(&" ".repeat(indent + 2));
                length = indent + 2 + own;
            } else {
                out.push(' ');
                length += 1 + own;
            }
            out.push_str(word);
        }
        if line.ends_with('\n') {
            out.push('\n');
        }
    }
    out
}
