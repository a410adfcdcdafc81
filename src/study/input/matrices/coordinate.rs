//! Rows of `row column value`: Matrix Market, and the bare ones of CalculiX.

use super::lines::{Entry, Lines, Raw};
use crate::input::error::InputError;

/// Matrix Market, coordinate or array, of real numbers.
pub(super) fn matrix_market(lines: &Lines) -> Result<Raw, InputError> {
    let mut all = lines.all().filter(|(line, text)| *line == 1 || !text.trim().is_empty() && !text.starts_with('%'));
    let (_, header) = all.next().unwrap_or((1, ""));
    let words: Vec<String> = header.split_whitespace().map(str::to_lowercase).collect();
    let word = |i: usize| words.get(i).map_or("", String::as_str);
    let (is_array, field, symmetry) = (word(2) == "array", word(3), word(4));
    if word(1) != "matrix" || !is_array && word(2) != "coordinate" {
        return Err(lines.wrong(
            1,
            "",
            format!("found `{header}`, expected `%%MatrixMarket matrix coordinate real symmetric` or the like"),
        ));
    }
    if !["real", "integer", "double"].contains(&field) {
        return Err(lines.wrong(1, field, format!("found a matrix of `{field}` numbers, expected real ones")));
    }
    if !["general", "symmetric", "skew-symmetric"].contains(&symmetry) {
        return Err(lines.wrong(1, symmetry, format!("found `{symmetry}`, expected general, symmetric or skew-symmetric")));
    }
    let Some((line, sizes)) = all.next() else { return Ok(Raw::default()) };
    let count = sizes.split_whitespace().nth(2).map(|count| lines.whole(line, count)).transpose()?;
    let sizes: Vec<usize> = sizes.split_whitespace().take(2).map(|s| Ok(lines.index(line, s)? + 1)).collect::<Result<_, InputError>>()?;
    let (Some(rows), Some(columns)) = (sizes.first().copied(), sizes.get(1).copied()) else {
        return Err(lines.wrong(line, "", "found no size, expected numbers of rows and columns"));
    };
    if rows != columns {
        return Err(lines.wrong(line, "", format!("found {rows} rows and {columns} columns, expected a square matrix")));
    }
    let mut raw = Raw { size: Some(rows), is_full: symmetry == "general", ..Raw::default() };
    let skew = usize::from(symmetry == "skew-symmetric");
    let lowest = |column: usize| if symmetry == "general" { 0 } else { column + skew };
    let (mut row, mut column) = (lowest(0), 0);
    for (line, text) in all {
        let parts: Vec<&str> = text.split_whitespace().collect();
        if is_array {
            for part in parts {
                raw.entries.push(Entry { row, column, value: lines.number(line, part)?, line });
                row += 1;
                if row == rows {
                    column += 1;
                    row = lowest(column);
                }
            }
            continue;
        }
        raw.entries.push(entry(lines, line, &parts)?);
    }
    let expected = match count {
        Some(count) if !is_array => count,
        _ if !is_array => return Err(lines.wrong(line, "", "found no number of entries, expected rows, columns and that")),
        _ => (0..columns).map(|column| (rows - lowest(column).min(rows)) as u64).sum(),
    };
    if raw.entries.len() as u64 != expected {
        return Err(lines.wrong(line, "", format!("found {} entries, expected {expected}, as it says here", raw.entries.len())));
    }
    Ok(raw)
}

fn entry(lines: &Lines, line: usize, parts: &[&str]) -> Result<Entry, InputError> {
    let [row, column, value] = parts else {
        return Err(lines.wrong(line, "", format!("found {} numbers, expected row, column and value", parts.len())));
    };
    Ok(Entry { row: lines.index(line, row)?, column: lines.index(line, column)?, value: lines.number(line, value)?, line })
}

/// Rows alone, as CalculiX stores matrices: one triangle.
pub(super) fn triplets(lines: &Lines) -> Result<Raw, InputError> {
    let mut raw = Raw::default();
    for (line, text) in lines.all().filter(|l| !l.1.trim().is_empty()) {
        let parts: Vec<&str> = text.split_whitespace().collect();
        raw.entries.push(entry(lines, line, &parts)?);
    }
    Ok(raw)
}
