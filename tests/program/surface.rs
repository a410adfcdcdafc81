//! Nothing is public that no program uses; what is public for the tests alone is listed.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

fn rust_files(folder: &Path, list: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        if path.is_dir() {
            rust_files(&path, list);
        } else if path.extension().is_some_and(|e| e == "rs") {
            list.push(path);
        }
    }
}

fn texts(folder: &str) -> Vec<(PathBuf, String)> {
    let mut list = Vec::new();
    rust_files(&Path::new(env!("CARGO_MANIFEST_DIR")).join(folder), &mut list);
    list.into_iter().map(|p| (p.clone(), std::fs::read_to_string(&p).expect("UTF-8"))).collect()
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !(c.is_alphanumeric() || c == '_')).filter(|w| !w.is_empty())
}

/// The crate of the workspace that a file belongs to.
fn member(path: &Path) -> Option<String> {
    let within = path.strip_prefix(Path::new(env!("CARGO_MANIFEST_DIR")).join("src")).ok()?;
    let folder = within.components().next()?.as_os_str().to_string_lossy().into_owned();
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(&folder).join("Cargo.toml").is_file().then_some(folder)
}

/// The name that a line declares as public, and whether it is a type.
fn declared(line: &str) -> Option<(&str, bool)> {
    let rest = line.trim_start().strip_prefix("pub ")?;
    let rest = rest.strip_prefix("const fn ").map_or(rest, |_| &rest["const ".len()..]);
    let (kind, rest) = rest.split_once(' ')?;
    let name = words(rest).next()?;
    match kind {
        "fn" | "const" | "static" => Some((name, false)),
        "struct" | "enum" | "trait" | "type" => Some((name, true)),
        _ => None,
    }
}

/// Functions and constants are named by the command, another crate of the workspace, the guide or the examples; types are too, or stand in the signature of something public. Those that tests alone name, to hold a law against its source,
/// stand in `only_tests.txt`.
#[test]
fn every_public_name_is_used_outside() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |path: PathBuf| std::fs::read_to_string(path).expect("UTF-8");
    let library: Vec<_> = texts("src").into_iter().filter(|(path, _)| !path.ends_with("src/main.rs")).collect();
    let guide = std::fs::read_dir(root.join("src/guide")).expect("chapters").map(|e| e.expect("a chapter").path());
    let chapters = guide.filter(|p| p.extension().is_some_and(|e| e == "md")).map(read);
    let mut programs: String = texts("studies/examples").into_iter().map(|t| t.1).chain(chapters).collect();
    programs += &read(root.join("src/main.rs"));
    let tests: String = texts("tests").into_iter().map(|t| t.1).collect();
    let (used, tested): (BTreeSet<&str>, BTreeSet<&str>) = (words(&programs).collect(), words(&tests).collect());
    // what stands in a public signature or field, or between a public function's name and its body
    let mut signatures = BTreeSet::new();
    for (_, text) in &library {
        let mut open = false;
        for line in text.lines().filter(|l| !l.trim_start().starts_with("//")) {
            let starts = line.trim_start().starts_with("pub ") && !line.contains(" mod ") && !line.contains(" use ");
            let shown = starts || open || line.trim_start().starts_with("type ") || line.starts_with("impl");
            if shown {
                let own = declared(line).map(|d| d.0);
                signatures.extend(words(line).filter(|w| Some(*w) != own));
            }
            open = (open || starts && line.contains("fn ")) && !line.contains('{') && !line.contains(';');
            // variants carry types
            if line.starts_with("    ") && line.trim_end().ends_with("),") && !line.contains('=') {
                signatures.extend(words(line));
            }
        }
    }
    let (mut unused, mut of_tests) = (Vec::new(), Vec::new());
    // what the documentation hides is public for another crate of the workspace alone
    let of_members: BTreeMap<Option<String>, BTreeSet<&str>> = library.iter().fold(BTreeMap::new(), |mut all, (path, text)| {
        all.entry(member(path)).or_insert_with(BTreeSet::new).extend(words(text));
        all
    });
    for (path, text) in &library {
        let own = member(path);
        let elsewhere = |name: &str| of_members.iter().any(|(other, words)| *other != own && words.contains(name));
        let mut hidden = false;
        for line in text.lines() {
            if let Some((name, is_type)) = declared(line) {
                let place = || format!("{}: {name}\n", path.strip_prefix(root).expect("in the repository").display());
                let is_used = elsewhere(name) || !hidden && used.contains(name) || is_type && signatures.contains(name);
                if !is_used && !hidden && tested.contains(name) {
                    of_tests.push(place());
                } else if !is_used {
                    unused.push(place());
                }
            }
            hidden = line.trim() == "#[doc(hidden)]" || hidden && line.trim_start().starts_with('#');
        }
    }
    assert!(unused.is_empty(), "{unused:#?}");
    of_tests.sort();
    let list = root.join("tests/program/only_tests.txt");
    if std::env::var_os("HARTOG_WRITE_EXPECTED").is_some() {
        std::fs::write(&list, of_tests.concat()).expect("written");
    }
    assert_eq!(read(list), of_tests.concat(), "public for the tests alone");
    assert!(declared("    pub fn run(&self)") == Some(("run", false)) && declared("pub(crate) fn x()").is_none());
}
