//! OP4 of Nastran as text, not sparse: a header, then for each column `column row count` and its numbers in fields of the width that the header tells.

use super::lines::{Entry, Lines, Raw};
use crate::input::error::InputError;

/// Columns, rows, form and type of a header, in fields of eight characters, and what follows; `None` where a line is none.
fn header(line: &str) -> Option<([String; 4], String)> {
    let cell = |i: usize| line.chars().skip(8 * i).take(8).collect::<String>().trim().to_owned();
    let cells = [0, 1, 2, 3].map(cell);
    let rest: String = line.chars().skip(32).collect();
    let is_name = rest.trim_start().starts_with(|c: char| c.is_ascii_alphabetic());
    (cells.iter().all(|c| c.parse::<i64>().is_ok()) && is_name).then_some((cells, rest))
}

/// Whether a line is the header of a matrix.
pub(super) fn is_header(line: &str) -> bool {
    header(line).is_some()
}

/// Width of a number by a format as 1P,5E16.9.
fn width(rest: &str) -> Option<usize> {
    let format = rest.rsplit(|c: char| c.is_whitespace() || c == ',').next()?;
    let after = format.split(['E', 'D', 'e', 'd']).nth(1)?;
    after.split('.').next()?.parse().ok().filter(|w| (8..=40).contains(w))
}

pub(super) fn read(lines: &Lines) -> Result<Raw, InputError> {
    let mut all = lines.all().filter(|l| !l.1.trim().is_empty()).peekable();
    let Some((line, text)) = all.next() else { return Ok(Raw::default()) };
    let Some((cells, rest)) = header(text) else {
        return Err(lines.wrong(
            line,
            "",
            "found no header, expected columns, rows, form and type in fields of eight characters, then a name",
        ));
    };
    let (columns, rows) = (lines.index(line, &cells[0])? + 1, cells[1].as_str());
    if rows.starts_with('-') {
        return Err(lines.wrong(line, rows, "found a sparse matrix with a negative number of rows, expected one that is not sparse"));
    }
    let rows = lines.index(line, rows)? + 1;
    if rows != columns {
        return Err(lines.wrong(line, "", format!("found {rows} rows and {columns} columns, expected a square matrix")));
    }
    if !["1", "2"].contains(&cells[3].as_str()) {
        return Err(lines.wrong(line, "", format!("found numbers of type {}, expected real ones (1 or 2)", cells[3])));
    }
    let Some(width) = width(&rest) else {
        return Err(lines.wrong(line, "", "found no format, expected one such as 1P,5E16.9 behind the name"));
    };
    let mut raw = Raw { size: Some(rows), ..Raw::default() };
    while let Some((line, text)) = all.next() {
        if is_header(text) {
            return Err(lines.wrong(line, "", "found a second matrix, expected one a file"));
        }
        let cells: Vec<&str> = text.split_whitespace().collect();
        let [column, row, count] = cells.as_slice() else {
            return Err(lines.wrong(line, "", format!("found `{}`, expected column, first row and count", text.trim())));
        };
        let (column, count) = (lines.whole(line, column)? as usize, lines.whole(line, count)? as usize);
        if *row == "0" {
            return Err(lines.wrong(line, "", "found a sparse column, expected a matrix that is not sparse"));
        }
        let first = lines.index(line, row)?;
        let mut own: Vec<(f64, usize)> = Vec::new();
        while let Some((line, text)) = all.next_if(|(_, text)| text.contains('.')) {
            let digits: Vec<char> = text.trim_end().chars().collect();
            for cell in digits.chunks(width) {
                own.push((lines.number(line, &cell.iter().collect::<String>())?, line));
            }
        }
        // numbers of double precision may count as two words each
        if own.len() != count && 2 * own.len() != count {
            return Err(lines.wrong(line, "", format!("found {} numbers, expected {count}", own.len())));
        }
        // behind the last column there is one that says nothing
        if column > columns {
            continue;
        }
        raw.entries.extend(own.into_iter().enumerate().map(|(i, (value, line))| Entry { row: first + i, column: column - 1, value, line }));
    }
    Ok(raw)
}
