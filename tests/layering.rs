//! Imports point one way: a row of the table imports only from rows above it.

use std::fs;
use std::path::Path;

/// The rows of `lib.rs`, from the top.
const ROWS: [&str; 14] = [
    "units", "numerics", "engine", "chain", "absorber", "response", "shaft", "fatigue", "design", "optimise", "study", "assess", "report",
    "command",
];

/// Paths `crate::a` and `super::…` of a file, wherever they stand (imports, function bodies, groups), as the row they reach.
/// `module`: the path of the file's own module, from the crate.
fn reached(module: &[&str], text: &str) -> Vec<String> {
    let code: String = text.lines().map(|l| l.split("//").next().unwrap_or("")).collect::<Vec<_>>().join("\n");
    let mut rows = Vec::new();
    let mut rest = code.as_str();
    while let Some(at) = rest.find("::") {
        let (before, after) = (&rest[..at], &rest[at + 2..]);
        let word = before.rsplit(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or("");
        let chained = before[..before.len() - word.len()].ends_with("::");
        match word {
            "crate" if !chained => rows.extend(names(after)),
            "super" if !chained => {
                // how far up the chain of `super` goes, then what follows it
                let (mut up, mut tail) = (1, after);
                while let Some(next) = tail.strip_prefix("super::") {
                    (up, tail) = (up + 1, next);
                }
                if up >= module.len() {
                    rows.extend(names(tail));
                } else {
                    rows.push(module[0].to_owned());
                }
            }
            _ => {}
        }
        rest = after;
    }
    rows
}

/// First names after `crate::`: one, or those of a group.
fn names(after: &str) -> Vec<String> {
    let ident = |s: &str| s.trim().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    match after.strip_prefix('{') {
        None => vec![ident(after)],
        Some(group) => {
            let (mut depth, mut start, mut list) = (0, 0, Vec::new());
            for (i, c) in group.char_indices() {
                match c {
                    '{' => depth += 1,
                    '}' if depth == 0 => {
                        list.push(ident(&group[start..i]));
                        return list;
                    }
                    '}' => depth -= 1,
                    ',' if depth == 0 => {
                        list.push(ident(&group[start..i]));
                        start = i + 1;
                    }
                    _ => {}
                }
            }
            list
        }
    }
}

fn violations(row: &str, module: &[&str], text: &str) -> Vec<String> {
    let rank = |name: &str| ROWS.iter().position(|r| *r == name);
    let own = rank(row).unwrap_or_else(|| panic!("`{row}` has no row"));
    reached(module, text).into_iter().filter(|r| rank(r).is_none_or(|rank| rank > own)).collect()
}

fn visit(folder: &Path, module: &mut Vec<String>, found: &mut Vec<String>) {
    for entry in fs::read_dir(folder).expect("readable sources") {
        let path = entry.expect("readable sources").path();
        let stem = path.file_stem().expect("a name").to_string_lossy().into_owned();
        if path.is_dir() {
            module.push(stem);
            visit(&path, module, found);
            module.pop();
        } else if path.extension().is_some_and(|e| e == "rs") {
            let mut own = module.clone();
            if stem != "mod" {
                own.push(stem);
            }
            if own.is_empty() || ["lib", "main"].contains(&own[0].as_str()) {
                continue;
            }
            let text = fs::read_to_string(&path).expect("readable sources");
            let names: Vec<&str> = own.iter().map(String::as_str).collect();
            found.extend(violations(names[0], &names, &text).into_iter().map(|v| format!("{} reaches {v}", path.display())));
        }
    }
}

#[test]
fn imports_point_up() {
    let mut found = Vec::new();
    visit(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut Vec::new(), &mut found);
    assert!(found.is_empty(), "{found:#?}");
}

#[test]
fn planted_violations_are_caught() {
    let caught = |text: &str| violations("chain", &["chain", "modes"], text);
    assert_eq!(caught("use crate::response::System;"), ["response"]);
    assert_eq!(caught("fn f() { let x = crate::optimise::search(); }"), ["optimise"], "inside a function");
    assert_eq!(caught("use crate::{units, study::{self, Study}};"), ["study"], "in a group");
    assert_eq!(caught("fn f() { super::super::report::say() }"), ["report"], "by super");
    assert_eq!(violations("chain", &["chain"], "use super::assess;"), ["assess"], "by one super from the row itself");
    assert!(caught("use super::Chain; use crate::engine::Order; // crate::report").is_empty(), "what is allowed, and comments");
}
