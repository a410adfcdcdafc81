//! Tables that line up, and numbers with so many digits.

use crate::numerics::elementary::Elementary;

/// A table whose columns line up: the first to the left, the others to the right.
pub fn table(header: &[&str], rows: &[Vec<String>]) -> String {
    aligned(header, rows, |c| c == 0)
}

/// A table whose columns line up, to the left where `left` says so and to the right elsewhere.
pub(crate) fn aligned(header: &[&str], rows: &[Vec<String>], left: impl Fn(usize) -> bool) -> String {
    let width = |c: usize| rows.iter().map(|r| r[c].chars().count()).chain([header[c].chars().count()]).max().unwrap_or(0);
    let widths: Vec<usize> = (0..header.len()).map(width).collect();
    let line = |cells: &[String]| {
        let padded = cells.iter().zip(&widths).enumerate().map(|(i, (c, w))| if left(i) { format!("{c:<w$}") } else { format!("{c:>w$}") });
        format!("  {}\n", padded.collect::<Vec<_>>().join("  ").trim_end())
    };
    let head: Vec<String> = header.iter().map(|h| (*h).to_owned()).collect();
    let rule = "-".repeat(widths.iter().sum::<usize>() + 2 * (widths.len() - 1));
    rows.iter().fold(format!("{}  {rule}\n", line(&head)), |text, row| text + &line(row))
}

/// A number with about `digits` significant digits, without exponent where it is short.
pub(crate) fn significant(x: f64, digits: i32) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let decimals = (digits - 1 - x.abs().decimal_logarithm().floor() as i32).max(0) as usize;
    if x.abs() < 1e-4 || x.abs() >= 1e8 { format!("{x:.*e}", digits as usize - 1) } else { format!("{x:.decimals$}") }
}

/// The text, or a dash where a value does not apply.
pub(crate) fn dash(text: Option<String>) -> String {
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
