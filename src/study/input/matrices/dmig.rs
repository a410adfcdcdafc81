//! DMIG of Nastran's bulk data or punch file: fields of 8 or 16 characters, or free ones with commas.

use super::lines::{Entry, Lines, Raw};
use crate::input::error::InputError;
use crate::rotor::structure::Unknown;

/// A column that is being read, and what of it comes.
type Column = Unknown;

/// The fields of a line, its first one apart, and whether they are of 16 characters.
fn fields(text: &str) -> (String, Vec<String>, bool) {
    if text.contains(',') {
        let mut all = text.split(',').map(|f| f.trim().to_owned());
        let first = all.next().unwrap_or_default();
        let large = first.ends_with('*');
        return (first.trim_end_matches('*').to_owned(), all.collect(), large);
    }
    let cell = |from: usize, width: usize| text.chars().skip(from).take(width).collect::<String>().trim().to_owned();
    let first = cell(0, 8);
    let large = first.ends_with('*') || first.starts_with('*');
    let width = if large { 16 } else { 8 };
    let count = if large { 4 } else { 8 };
    let all = (0..count).map(|i| cell(8 + i * width, width)).collect();
    (first.trim_matches('*').to_owned(), all, large)
}

pub(super) fn read(lines: &Lines) -> Result<Raw, InputError> {
    let mut name: Option<String> = None;
    let mut rows: Vec<([Unknown; 2], f64, usize)> = Vec::new();
    let mut column: Option<Column> = None;
    let mut is_square = false;
    for (line, text) in lines.all().filter(|l| !l.1.trim().is_empty() && !l.1.starts_with('$')) {
        let (first, own, _) = fields(text);
        let field = |i: usize| own.get(i).map_or("", String::as_str);
        let unknown = |node: &str, component: &str| -> Result<Unknown, InputError> {
            let component = if component.is_empty() { "0" } else { component };
            Ok(Unknown { node: lines.whole(line, node)?, component: lines.component(line, component)? })
        };
        let mut terms: Vec<[String; 3]> = Vec::new();
        if first.eq_ignore_ascii_case("DMIG") {
            let is_header = field(1) == "0";
            match &name {
                Some(known) if !known.eq_ignore_ascii_case(field(0)) => {
                    let found = format!("found a second matrix `{}` after `{known}`, expected one a file", field(0));
                    return Err(lines.wrong(line, field(0), found));
                }
                None if !is_header => {
                    return Err(lines.wrong(line, "", "found a column, expected the header of its matrix first: `DMIG, name, 0, …`"));
                }
                _ => {}
            }
            name = Some(field(0).to_owned());
            if is_header {
                is_square = match field(2) {
                    "1" => true,
                    "6" => false,
                    other => return Err(lines.wrong(line, "", format!("found form {other}, expected 1 (square) or 6 (symmetric)"))),
                };
                if !["1", "2"].contains(&field(3)) {
                    return Err(lines.wrong(line, "", format!("found numbers of type {}, expected real ones (1 or 2)", field(3))));
                }
                continue;
            }
            column = Some(unknown(field(1), field(2))?);
            if !field(4).is_empty() {
                terms.push([field(4).into(), field(5).into(), field(6).into()]);
            }
        } else if name.is_some() && column.is_some() {
            terms.extend(own.chunks(4).filter(|c| !c[0].is_empty()).map(|c| {
                let cell = |i: usize| c.get(i).cloned().unwrap_or_default();
                [cell(0), cell(1), cell(2)]
            }));
        } else {
            continue;
        }
        let Some(own) = column else { continue };
        for [node, component, value] in terms {
            rows.push(([unknown(&node, &component)?, own], lines.number(line, &value)?, line));
        }
    }
    let mut unknowns: Vec<Unknown> = rows.iter().flat_map(|r| r.0).collect();
    unknowns.sort_unstable();
    unknowns.dedup();
    let place = |u: &Unknown| unknowns.binary_search(u).unwrap_or_default();
    let entries: Vec<Entry> =
        rows.iter().map(|([a, b], value, line)| Entry { row: place(a), column: place(b), value: *value, line: *line }).collect();
    Ok(Raw { entries, unknowns: Some(unknowns).filter(|u| !u.is_empty()), is_full: is_square, ..Raw::default() })
}
