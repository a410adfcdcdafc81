//! Substructures of CalculiX and Abaqus: `*USER ELEMENT`, the nodes of its unknowns, their components, and the lower triangle by rows.

use super::lines::{Entry, Lines, Raw};
use crate::input::error::InputError;
use crate::rotor::structure::Unknown;

/// Which lines follow.
#[derive(PartialEq)]
enum Part {
    Head,
    Nodes,
    Components,
    Values,
    Other,
}

/// `wanted`: the matrix of it, STIFFNESS or MASS.
pub(super) fn read(lines: &Lines, wanted: &str) -> Result<Raw, InputError> {
    let (mut nodes, mut components, mut values): (Vec<u64>, Vec<u8>, Vec<(f64, usize)>) = (Vec::new(), Vec::new(), Vec::new());
    let mut part = Part::Head;
    for (line, text) in lines.all().filter(|l| !l.1.trim().is_empty()) {
        let upper = text.to_uppercase();
        if upper.starts_with("**") {
            if upper.contains("ELEMENT NODES") {
                part = Part::Nodes;
            } else if part == Part::Nodes {
                for number in text.trim_start_matches('*').split(',').filter(|n| !n.trim().is_empty()) {
                    nodes.push(lines.whole(line, number)?);
                }
            }
        } else if upper.starts_with("*USER ELEMENT") {
            part = Part::Nodes;
        } else if upper.starts_with("*MATRIX") {
            part = if upper.contains(wanted) && values.is_empty() { Part::Values } else { Part::Other };
        } else if upper.starts_with('*') {
            part = Part::Other;
        } else if part == Part::Nodes || part == Part::Components {
            part = Part::Components;
            // "k, component" of the k-th node; the first one alone
            let own = text.split(',').map(str::trim).rfind(|p| !p.is_empty()).unwrap_or("");
            components.push(lines.component(line, own)?);
        } else if part == Part::Values {
            for number in text.split(',').filter(|n| !n.trim().is_empty()) {
                values.push((lines.number(line, number)?, line));
            }
        }
    }
    let n = components.len();
    if nodes.len() != n {
        let found = format!("found {} nodes and {n} components, expected as many of the one as of the other", nodes.len());
        return Err(lines.wrong(1, "", found));
    }
    if values.len() != n * (n + 1) / 2 {
        let found =
            format!("found {} numbers of `TYPE={wanted}`, expected {}: the lower triangle of {n} unknowns", values.len(), n * (n + 1) / 2);
        return Err(lines.wrong(values.last().map_or(1, |v| v.1), "", found));
    }
    let rows = (0..n).flat_map(|row| (0..=row).map(move |column| (row, column)));
    let entries = rows.zip(values).map(|((row, column), (value, line))| Entry { row, column, value, line }).collect();
    let unknowns = nodes.into_iter().zip(components).map(|(node, component)| Unknown { node, component }).collect();
    Ok(Raw { entries, unknowns: Some(unknowns), ..Raw::default() })
}
