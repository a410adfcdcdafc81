//! The house: imports point one way between rooms, and no two files of a room import each other, however far round. The rooms and their order are read from the
//! map in `lib.rs`. Files and functions stay short.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::sync::LazyLock;

/// Longest file and longest function, in lines.
const LONGEST_FILE: usize = 400;
const LONGEST_FUNCTION: usize = 80;

/// Those of the map.
static ROOMS: LazyLock<Vec<String>> = LazyLock::new(rooms);

/// Module path of a file (from the crate) and its code without comments.
struct Source {
    module: Vec<String>,
    is_mod: bool,
    text: String,
}

fn without_comments(text: &str) -> String {
    text.lines().map(|l| l.split("//").next().unwrap_or("")).collect::<Vec<_>>().join("\n")
}

fn sources(folder: &Path, module: &mut Vec<String>, found: &mut Vec<Source>) {
    let mut entries: Vec<_> = fs::read_dir(folder).expect("readable sources").map(|e| e.expect("readable sources").path()).collect();
    entries.sort();
    for path in entries {
        let stem = path.file_stem().expect("a name").to_string_lossy().into_owned();
        if path.is_dir() {
            module.push(stem);
            sources(&path, module, found);
            module.pop();
        } else if path.extension().is_some_and(|e| e == "rs") && !(module.is_empty() && ["lib", "main"].contains(&stem.as_str())) {
            let is_mod = ["mod", "lib"].contains(&stem.as_str());
            let own = module.iter().cloned().chain((!is_mod).then_some(stem)).collect();
            found.push(Source { module: own, is_mod, text: without_comments(&fs::read_to_string(&path).expect("readable sources")) });
        }
    }
}

/// A folder with a manifest is a crate of the workspace: its modules are rooms, or it is a room itself.
fn all_sources() -> Vec<Source> {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = Vec::new();
    sources(&src, &mut Vec::new(), &mut found);
    for source in &mut found {
        let folder = &source.module[0];
        if src.join(folder).join("Cargo.toml").is_file() && !ROOMS.contains(folder) {
            source.module.remove(0);
        }
    }
    found.retain(|s| !s.module.is_empty());
    found
}

/// Rooms in the order of the map in `lib.rs`: rows that begin with a link to a module.
fn rooms() -> Vec<String> {
    let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src/lib.rs")).expect("lib.rs");
    let row = |l: &str| l.strip_prefix("//! | [`").and_then(|l| l.split('`').next()).map(str::to_owned);
    text.lines().filter_map(row).collect()
}

/// A tree of imports as single paths.
fn leaves(tree: &str) -> Vec<String> {
    let tree = tree.trim();
    let Some((before, group)) = tree.split_once('{') else {
        return vec![tree.split(" as ").next().unwrap_or("").trim().trim_end_matches("::self").to_owned()];
    };
    let group = group.strip_suffix('}').expect("a closed group");
    let (mut depth, mut parts) = (0, vec![String::new()]);
    for c in group.chars() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(String::new());
                continue;
            }
            _ => {}
        }
        parts.last_mut().expect("a part").push(c);
    }
    let join = |p: &String| if p.trim() == "self" { before.trim_end_matches("::").to_owned() } else { format!("{before}{}", p.trim()) };
    parts.iter().filter(|p| !p.trim().is_empty()).flat_map(|p| leaves(&join(p))).collect()
}

/// Every path that begins with `crate` or `super`, in imports (groups opened) and in the code, from the crate.
fn paths(source: &Source) -> Vec<Vec<String>> {
    let mut list = Vec::new();
    let mut put = |path: &str| {
        let mut parts: Vec<String> = path.split("::").map(|p| p.trim().to_owned()).collect();
        if parts[0] == "crate" {
            let path = parts.split_off(1);
            // the crate of the reports is a room itself
            let own = source.module.first().is_some_and(|m| m == "report") && path.first().is_some_and(|p| !ROOMS.contains(p));
            list.push(if own { std::iter::once("report".to_owned()).chain(path).collect() } else { path });
        } else if parts[0] == "super" {
            let up = parts.iter().take_while(|p| *p == "super").count();
            let above = source.module.len().saturating_sub(up);
            list.push(source.module[..above].iter().cloned().chain(parts.split_off(up)).collect());
        }
    };
    let mut rest = source.text.as_str();
    while let Some(at) = [rest.find("crate::"), rest.find("super::")].into_iter().flatten().min() {
        let (before, here) = (&rest[..at], &rest[at..]);
        let begins = !before.ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':');
        let is_use = before.trim_end().ends_with("use");
        let end = if is_use { here.find(';') } else { here.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':')) };
        let end = end.unwrap_or(here.len());
        if begins {
            leaves(here[..end].trim_end_matches(':')).iter().for_each(|p| put(p));
        }
        // the rest of a chain of `super` belongs to its head
        rest = &here[end.max(7)..];
    }
    list
}

/// Names that a `mod.rs` hands on, with the paths they come from (relative to it).
fn handed_on(source: &Source) -> BTreeMap<String, Vec<String>> {
    let mut names = BTreeMap::new();
    for part in source.text.split("pub use ").skip(1) {
        for leaf in leaves(part.split(';').next().unwrap_or("")) {
            let path: Vec<String> = leaf.split("::").map(str::to_owned).collect();
            names.insert(path.last().expect("a name").clone(), path);
        }
    }
    names
}

/// Index of the file that a path leads to.
fn target(all: &[Source], path: &[String]) -> Option<usize> {
    let depth = (1..=path.len()).rev().find(|n| all.iter().any(|s| s.module == path[..*n]))?;
    let found = all.iter().position(|s| s.module == path[..depth])?;
    let (source, name) = (&all[found], path.get(depth));
    if let (true, Some(inner)) = (source.is_mod, name.and_then(|n| handed_on(source).get(n).cloned())) {
        let full: Vec<String> = source.module.iter().cloned().chain(inner).collect();
        return target(all, &full);
    }
    Some(found)
}

fn violations(rooms: &[String], source: &Source) -> Vec<String> {
    let rank = |name: &str| rooms.iter().position(|r| r == name);
    let own = rank(&source.module[0]).unwrap_or_else(|| panic!("`{}` is not in the map of lib.rs", source.module[0]));
    let reached = paths(source).into_iter().filter_map(|p| p.first().cloned());
    reached.filter(|r| rank(r).is_none_or(|rank| rank > own)).map(|r| format!("{} reaches {r}", source.module.join("::"))).collect()
}

#[test]
fn imports_point_one_way() {
    let (rooms, all) = (&*ROOMS, all_sources());
    assert!(rooms.len() > 10, "{rooms:?}");
    let found: Vec<String> = all.iter().flat_map(|s| violations(rooms, s)).collect();
    assert!(found.is_empty(), "{found:#?}");
}

/// Files that import each other, however far round: each in the order of the circle.
fn circles(all: &[Source]) -> Vec<String> {
    let edges: Vec<BTreeSet<usize>> = all
        .iter()
        .enumerate()
        .map(|(i, s)| {
            let mut reached: BTreeSet<usize> = paths(s).iter().filter_map(|p| target(all, p)).collect();
            reached.remove(&i);
            // a folder's own file hands on what its files hold
            if s.is_mod { BTreeSet::new() } else { reached }
        })
        .collect();
    // leave out what reaches nothing that is left, until nothing changes
    let mut left: BTreeSet<usize> = (0..all.len()).collect();
    loop {
        let ends: Vec<usize> = left.iter().copied().filter(|i| edges[*i].is_disjoint(&left)).collect();
        if ends.is_empty() {
            break;
        }
        ends.iter().for_each(|e| {
            left.remove(e);
        });
    }
    let name = |i: usize| all[i].module.join("::");
    left.iter().map(|i| format!("{} -> {:?}", name(*i), edges[*i].intersection(&left).map(|j| name(*j)).collect::<Vec<_>>())).collect()
}

#[test]
fn no_circle_within_a_room() {
    let all = all_sources();
    let found = circles(&all);
    assert!(found.is_empty(), "{found:#?}");
    // a folder's own file holds no code that its files would have to import from it
    let code = |s: &&Source| {
        s.is_mod
            && ["fn ", "struct ", "enum ", "trait "]
                .iter()
                .any(|w| s.text.contains(&format!("\n{w}")) || s.text.contains(&format!("\npub {w}")))
    };
    let imported = |s: &Source| {
        all.iter().any(|o| {
            o.module != s.module
                && o.module.starts_with(&s.module)
                && paths(o).iter().any(|p| target(&all, p).is_some_and(|t| all[t].module == s.module))
        })
    };
    let mixed: Vec<String> = all.iter().filter(code).filter(|s| imported(s)).map(|s| s.module.join("::")).collect();
    assert!(mixed.is_empty(), "code in mod.rs that its own files import: {mixed:?}");
}

#[test]
fn planted_violations_are_caught() {
    let rooms: Vec<String> = ["units", "drivetrain", "response", "report"].map(str::to_owned).to_vec();
    let source = |module: &[&str], text: &str| Source {
        module: module.iter().map(|m| (*m).to_owned()).collect(),
        is_mod: false,
        text: without_comments(text),
    };
    let caught = |text: &str| violations(&rooms, &source(&["drivetrain", "modes"], text)).len();
    assert_eq!(caught("use crate::response::System;"), 1);
    assert_eq!(caught("fn f() { let x = crate::report::write(); }"), 1, "inside a function");
    assert_eq!(caught("use crate::{units, report::{self, Folder}};"), 2, "in a group");
    assert_eq!(caught("fn f() { super::super::report::say() }"), 1, "by super");
    assert_eq!(caught("use super::Chain; use crate::units::PA; // crate::report"), 0, "what is allowed, and comments");
    let three = |last: &str| vec![source(&["a"], "use crate::b::B;"), source(&["b"], "use crate::c::C;"), source(&["c"], last)];
    assert_eq!(circles(&three("use crate::a::A;")).len(), 3);
    assert!(circles(&three("use crate::units::A;")).is_empty());
}

/// Files and folders of the sources that the guide and the README name are there.
#[test]
fn files_that_the_guide_names_exist() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let chapters = fs::read_dir(root.join("src/guide")).expect("a guide").map(|e| e.expect("readable").path());
    let pages = chapters.filter(|p| p.extension().is_some_and(|e| e == "md")).chain([root.join("README.md")]);
    let (mut named, mut lost) = (0, Vec::new());
    for page in pages {
        let text = fs::read_to_string(&page).expect("UTF-8");
        let code = text
            .split('`')
            .skip(1)
            .step_by(2)
            .filter(|c| c.starts_with("src/") && !c.contains(|c: char| c.is_uppercase() || c.is_whitespace()));
        for path in code {
            named += 1;
            if !root.join(path).exists() {
                lost.push(format!("{}: {path}", page.display()));
            }
        }
    }
    assert!(named > 20 && lost.is_empty(), "{named} named, {lost:?}");
}

/// What sources cite as `\\[NAME YEAR\\]` is in the list of references, which has each once and in the order of the alphabet.
#[test]
fn references_are_listed_once_and_sorted() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let list = fs::read_to_string(root.join("src/guide/references.md")).expect("UTF-8");
    let listed: Vec<&str> = list.lines().filter_map(|l| l.strip_prefix("- \\[")?.split("\\]").next()).collect();
    let plain = |key: &str| key.to_lowercase().replace('ä', "a").replace('ö', "o").replace('ü', "u");
    let unsorted: Vec<_> = listed.windows(2).filter(|pair| plain(pair[0]) >= plain(pair[1])).collect();
    assert!(unsorted.is_empty(), "{unsorted:?}");
    let mut files = vec![root.join("src")];
    let (mut cited, mut lost) = (0, Vec::new());
    while let Some(path) = files.pop() {
        if path.is_dir() {
            files.extend(fs::read_dir(&path).expect("a folder").map(|e| e.expect("readable").path()));
        } else if path.extension().is_some_and(|e| e == "rs") {
            // lines of a comment joined
            let text = fs::read_to_string(&path)
                .expect("UTF-8")
                .lines()
                .map(|l| l.trim().trim_start_matches(['/', '!']).trim())
                .collect::<Vec<_>>()
                .join(" ");
            let in_brackets = text.split("\\[").skip(1).filter_map(|rest| rest.split("\\]").next());
            for key in in_brackets.flat_map(|keys| keys.split(';')).map(str::trim) {
                let year = |word: &str| word.parse::<u32>().is_ok_and(|y| (1800..2100).contains(&y));
                if key.starts_with(char::is_uppercase) && key.split([' ', ',']).any(year) {
                    cited += 1;
                    lost.extend((!listed.iter().any(|l| key.starts_with(l))).then(|| format!("{}: {key}", path.display())));
                }
            }
        }
    }
    assert!(cited > 40 && lost.is_empty(), "{cited} cited, {lost:?}");
}

/// Every file within 400 lines, every function within 80, and the README within 120: what it grows beyond belongs to the guide.
#[test]
fn files_and_functions_are_short() {
    let mut long = Vec::new();
    for folder in ["src", "tests", "studies/examples"] {
        let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)];
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(&folder).into_iter().flatten() {
                let path = entry.expect("readable sources").path();
                if path.is_dir() {
                    folders.push(path);
                } else if path.extension().is_some_and(|e| e == "rs") {
                    let text = fs::read_to_string(&path).expect("readable sources");
                    let lines: Vec<&str> = text.lines().collect();
                    if lines.len() > LONGEST_FILE {
                        long.push(format!("{}: {} lines", path.display(), lines.len()));
                    }
                    long.extend(long_functions(&lines).into_iter().map(|f| format!("{}: {f}", path.display())));
                }
            }
        }
    }
    assert!(long.is_empty(), "{long:#?}");
    assert!(include_str!("../../README.md").lines().count() <= 120, "README.md");
}

/// Functions above the longest, with their lengths: from the line of `fn` to the closing brace with the same indent.
fn long_functions(lines: &[&str]) -> Vec<String> {
    let mut found = Vec::new();
    for (i, line) in lines.iter().enumerate() {
        let indent = line.len() - line.trim_start().len();
        let is_fn = ["fn ", "pub fn ", "pub(crate) fn ", "pub(super) fn "].iter().any(|w| line.trim_start().starts_with(w));
        if is_fn && !line.trim_end().ends_with(';') && !line.trim_end().ends_with('}') {
            let end = lines[i..].iter().position(|l| l.len() - l.trim_start().len() == indent && l.trim_start().starts_with('}'));
            let length = end.map_or(0, |e| e + 1);
            if length > LONGEST_FUNCTION {
                found.push(format!("{} of {length} lines", line.trim()));
            }
        }
    }
    found
}
