//! Tables that line up, and numbers with so many digits.

use super::width::columns;
pub(crate) use crate::numerics::significant::significant;

/// A table whose columns line up: the first to the left, the others to the right.
pub fn table(header: &[&str], rows: &[Vec<String>]) -> String {
    aligned(header, rows, |c| c == 0)
}

/// The same, rows being told apart by the first so many columns together.
pub(super) fn keyed(header: &[&str], rows: &[Vec<String>], keys: usize) -> String {
    in_blocks(header, rows, keys, |c| c == 0)
}

/// A table whose columns line up, to the left where `left` says so and to the right elsewhere.
pub(crate) fn aligned(header: &[&str], rows: &[Vec<String>], left: impl Fn(usize) -> bool) -> String {
    in_blocks(header, rows, 1, left)
}

/// Columns that do not fit the width follow below, each block with the first columns, which tell rows apart.
fn in_blocks(header: &[&str], rows: &[Vec<String>], keys: usize, left: impl Fn(usize) -> bool) -> String {
    let width = |c: usize| rows.iter().map(|r| r[c].chars().count()).chain([header[c].chars().count()]).max().unwrap_or(0);
    let widths: Vec<usize> = (0..header.len()).map(width).collect();
    let block = |columns: &[usize]| {
        let line = |cell: &dyn Fn(usize) -> String| {
            let padded = columns.iter().map(|c| {
                let (text, w) = (cell(*c), widths[*c]);
                if left(*c) { format!("{text:<w$}") } else { format!("{text:>w$}") }
            });
            format!("  {}\n", padded.collect::<Vec<_>>().join("  ").trim_end())
        };
        let rule = "-".repeat(columns.iter().map(|c| widths[*c]).sum::<usize>() + 2 * (columns.len() - 1));
        rows.iter().fold(format!("{}  {rule}\n", line(&|c| header[c].to_owned())), |text, row| text + &line(&|c| row[c].clone()))
    };
    blocks(&widths, keys, columns()).iter().map(|b| block(b)).collect::<Vec<_>>().join("\n")
}

/// Columns of each block: the keys, and as many others as fit, at least one.
fn blocks(widths: &[usize], keys: usize, most: usize) -> Vec<Vec<usize>> {
    let own: Vec<usize> = (0..keys).collect();
    let head: usize = widths[..keys].iter().map(|w| 2 + w).sum();
    let mut blocks = vec![own.clone()];
    let mut length = head;
    for (c, width) in widths.iter().enumerate().skip(keys) {
        if length + 2 + width > most && blocks.last().is_some_and(|b| b.len() > keys) {
            blocks.push(own.clone());
            length = head;
        }
        let last = blocks.len() - 1;
        blocks[last].push(c);
        length += 2 + width;
    }
    blocks
}

/// The text, or a dash where a value does not apply.
#[doc(hidden)]
pub fn dash(text: Option<String>) -> String {
    text.unwrap_or_else(|| "-".into())
}

/// Speeds in words: how many, from which to which.
pub(super) fn between(speeds: &[f64]) -> String {
    match speeds {
        [only] => format!("{only} rpm"),
        [first, .., last] => format!("{} speeds from {first} to {last} rpm", speeds.len()),
        [] => String::new(),
    }
}
