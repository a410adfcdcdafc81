//! What Abaqus writes by `*MATRIX GENERATE` and `*MATRIX OUTPUT`: lines `node, component, node, component, value`, or `row, column, value`.

use super::lines::{Entry, Lines, Raw};
use crate::input::error::InputError;
use crate::rotor::structure::Unknown;

pub(super) fn read(lines: &Lines) -> Result<Raw, InputError> {
    let mut rows: Vec<([Unknown; 2], f64, usize)> = Vec::new();
    let mut raw = Raw::default();
    for (line, text) in lines.all().filter(|l| !l.1.trim().is_empty() && !l.1.starts_with('*')) {
        let parts: Vec<&str> = text.split(',').map(str::trim).filter(|p| !p.is_empty()).collect();
        match parts.as_slice() {
            [row, column, value] => {
                raw.entries.push(Entry {
                    row: lines.index(line, row)?,
                    column: lines.index(line, column)?,
                    value: lines.number(line, value)?,
                    line,
                });
            }
            [n, c, m, d, value] => {
                let unknown = |node: &str, component: &str| -> Result<Unknown, InputError> {
                    Ok(Unknown { node: lines.whole(line, node)?, component: lines.component(line, component)? })
                };
                rows.push(([unknown(n, c)?, unknown(m, d)?], lines.number(line, value)?, line));
            }
            _ => {
                return Err(lines.wrong(
                    line,
                    "",
                    format!("found {} numbers, expected node, component, node, component and value", parts.len()),
                ));
            }
        }
    }
    if rows.is_empty() {
        return Ok(raw);
    }
    let mut unknowns: Vec<Unknown> = rows.iter().flat_map(|r| r.0).collect();
    unknowns.sort_unstable();
    unknowns.dedup();
    let place = |u: &Unknown| unknowns.binary_search(u).unwrap_or_default();
    raw.entries = rows.iter().map(|([a, b], value, line)| Entry { row: place(a), column: place(b), value: *value, line: *line }).collect();
    raw.unknowns = Some(unknowns);
    Ok(raw)
}
