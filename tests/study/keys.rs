//! Keys of input files and their JSON Schema: each key said, each example right, ranges those of the reader.

use super::grammar::written;
use hartog::input::FileKind;
use hartog::input::keys::{Key, keys};
use jsonschema::Validator;
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use serde_json::Value;
use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn validator(file: FileKind) -> Validator {
    jsonschema::draft202012::new(&file.json_schema()).unwrap_or_else(|e| panic!("{}: {e}", file.name()))
}

fn value(text: &str) -> Option<Value> {
    toml::from_str(text).ok()
}

fn files(folder: &str) -> Vec<PathBuf> {
    let all = fs::read_dir(root().join(folder)).expect("a folder").filter_map(|e| e.ok().map(|e| e.path()));
    let mut list: Vec<PathBuf> = all.filter(|p| p.extension().is_some_and(|e| e == "toml")).collect();
    list.sort();
    assert!(!list.is_empty(), "{folder}");
    list
}

fn read(path: &Path) -> Value {
    let text = fs::read_to_string(path).expect("text");
    value(&text).unwrap_or_else(|| panic!("{}", path.display()))
}

fn kind(path: &Path) -> FileKind {
    match path {
        p if p.parent().is_some_and(|f| f.ends_with("engines")) => FileKind::Engine,
        p if p.file_name().is_some_and(|n| n.to_string_lossy().starts_with("fialho")) => FileKind::Sizing,
        _ => FileKind::Study,
    }
}

/// What hartog ships, in a folder of its own.
fn copied() -> tempfile::TempDir {
    let place = tempfile::tempdir().expect("folder");
    for folder in ["studies", "studies/engines", "studies/published", "studies/absorbers"] {
        fs::create_dir_all(place.path().join(folder)).expect("made");
        for entry in fs::read_dir(root().join(folder)).expect("a folder").filter_map(Result::ok) {
            if entry.path().is_file() {
                fs::copy(entry.path(), place.path().join(folder).join(entry.file_name())).expect("copied");
            }
        }
    }
    place
}

fn all_keys() -> Vec<Key> {
    FileKind::ALL.into_iter().flat_map(keys).collect()
}

/// No key is without a sentence that says what it is; a number has an example; an example is what the key takes, and so is its default.
#[test]
fn every_key_is_explained_and_every_example_is_right() {
    let mut wrong = String::new();
    for key in all_keys() {
        let path = format!("{}: {}", key.file.name(), key.path);
        if key.about.len() < 6 || !key.about.ends_with('.') {
            wrong += &format!("{path}: {:?}\n", key.about);
        }
        let numeric = key.schema.get("type").is_some_and(|t| t == "number" || t == "integer");
        if numeric && key.example.is_none() {
            wrong += &format!("{path}: no example\n");
        }
        let own = jsonschema::draft202012::new(&key.schema).unwrap_or_else(|e| panic!("{path}: {e}"));
        for (what, value) in [("example", &key.example), ("default", &key.default)] {
            if let Some(error) = value.as_ref().and_then(|v| own.validate(v).err()) {
                wrong += &format!("{path}: {what}: {error}\n");
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

/// Units that end a key are units that are told.
#[test]
fn units_are_those_that_end_a_key() {
    let list = keys(FileKind::Engine);
    let unit = |path: &str| list.iter().find(|k| k.path == path).unwrap_or_else(|| panic!("{path}")).unit;
    assert_eq!(unit("geometry.bore_mm"), Some("mm"));
    assert_eq!(unit("station.inertia_kg_m2"), Some("kg m²"));
    assert_eq!(unit("station.name"), None);
}

/// Every file that hartog ships is accepted.
#[test]
fn shipped_files_are_accepted() {
    let accept = |kind: FileKind, path: &Path| {
        if let Err(error) = validator(kind).validate(&read(path)) {
            panic!("{}: {error} at {}", path.display(), error.instance_path());
        }
    };
    [files("studies"), files("studies/engines")].concat().iter().for_each(|path| accept(kind(path), path));
    files("studies/materials").iter().for_each(|path| accept(FileKind::Compounds, path));
    let bad = |name: &str| root().join("tests/bad_input").join(name);
    for (kind, name) in [(FileKind::Material, "material.toml"), (FileKind::Sizing, "sizing.toml"), (FileKind::Study, "study.toml")] {
        accept(kind, &bad(name));
    }
}

/// What `hartog check` accepts, the schema accepts: studies by the grammar of the input.
#[test]
fn the_schema_is_no_narrower_than_the_reader() {
    let (study, engine) = (validator(FileKind::Study), validator(FileKind::Engine));
    let mut accepted = 0;
    for seed in 0..400 {
        let input = written(&mut Xoshiro256PlusPlus::seed_from_u64(seed));
        let place = tempfile::tempdir().expect("folder");
        fs::write(place.path().join("study.toml"), &input.study).expect("written");
        fs::write(place.path().join("engine.toml"), &input.engine).expect("written");
        for (name, table) in &input.tables {
            fs::write(place.path().join(name), table).expect("written");
        }
        if hartog::input::read(&place.path().join("study.toml")).is_err() {
            continue;
        }
        accepted += 1;
        for (validator, text) in [(&study, &input.study), (&engine, &input.engine)] {
            let value = value(text).expect("a table");
            if let Err(error) = validator.validate(&value) {
                panic!("seed {seed}: {error} at {}\n{text}", error.instance_path());
            }
        }
    }
    assert!(accepted > 200, "{accepted}");
}

/// A number of a file is changed: what the schema then refuses, `hartog check` refuses, so that no range of the schema is narrower than that of the reader. And
/// what `hartog check` refuses by a range that depends on nothing else in the files, the schema refuses.
#[test]
fn ranges_of_the_schema_are_those_of_the_reader() {
    const VALUES: [&str; 12] = ["-1e19", "-200.5", "-1", "-0.01", "0", "0.001", "0.5", "1", "3", "150", "12345", "1e19"];
    let number = |c: char| c.is_ascii_digit() || "+-.eE_".contains(c);
    let place = copied();
    let (mut refused, mut seen, mut narrower, mut wider) = (0, HashSet::new(), String::new(), String::new());
    for (kind, path) in [files("studies"), files("studies/engines")].into_iter().flatten().map(|p| (kind(&p), p)) {
        let (own, text) = (validator(kind), fs::read_to_string(&path).expect("text"));
        let name = path.strip_prefix(root()).expect("in the repository");
        let study = place.path().join(match kind {
            // the study of an engine has its name
            FileKind::Engine => Path::new("studies").join(name.file_name().expect("a name")),
            _ => name.to_path_buf(),
        });
        // numbers after `=`, `[` or `,`, from the last to the first
        let starts = text.char_indices().filter(|(i, c)| {
            (c.is_ascii_digit() || *c == '-')
                && *i > 1
                && text[..*i].trim_end_matches(' ').ends_with(['=', '[', ','])
                && !text[..*i].ends_with(number)
        });
        for (i, (start, _)) in starts.enumerate() {
            let end = text[start..].find(|c| !number(c)).map_or(text.len(), |n| start + n);
            // one of the values, another at each number
            let value = VALUES[5 * i % VALUES.len()];
            let changed = format!("{}{value}{}", &text[..start], &text[end..]);
            let Some(is_valid) = self::value(&changed).map(|v| own.is_valid(&v)) else { continue };
            // a key with a value that the schema takes: once
            let line = text[..start].rsplit('\n').next().unwrap_or("");
            let key = line.rsplit(['{', ',']).find(|part| part.contains('=')).unwrap_or(line);
            if is_valid && !seen.insert((key.to_owned(), value)) {
                continue;
            }
            fs::write(place.path().join(name), &changed).expect("written");
            let mistakes = match kind {
                FileKind::Sizing => hartog::input::read_sizing(&study).err(),
                _ => hartog::input::read(&study).err(),
            }
            .map_or_else(Vec::new, |e| e.mistakes);
            let place = || format!("{}:{}: {value}", name.display(), text[..start].lines().count());
            refused += usize::from(!is_valid);
            if !is_valid && mistakes.is_empty() {
                narrower += &format!("{}\n", place());
            }
            // a parameter of a family has its own range in each type, and a process its own for each key
            let is_shared = ["fixed", "between", "each", "process"].iter().any(|word| line.contains(word));
            if let Some(mistake) = mistakes.iter().find(|m| is_valid && !is_shared && is_of_a_range(&m.message, value)) {
                wider += &format!("{}: {}\n", place(), mistake.message);
            }
        }
        fs::write(place.path().join(name), &text).expect("written");
    }
    assert!(narrower.is_empty(), "the schema refuses what the reader takes:\n{narrower}");
    assert!(wider.is_empty(), "the schema takes what the reader refuses by its range:\n{wider}");
    assert!(refused > 250, "{refused}");
}

/// Whether a message says that this value is out of a range, and of none that follows from other values.
fn is_of_a_range(message: &str, value: &str) -> bool {
    let Some(expected) = message.strip_prefix(&format!("found {value}, expected ")) else { return false };
    let follows = ["a speed of the study", "a main bearing"].iter().any(|words| expected.starts_with(words));
    !follows && [" from ", " above ", " of at least "].iter().any(|words| expected.contains(words))
}

/// Files of `tests/bad_input` that the schema of their kind refuses. What it cannot refuse stands in `beyond_the_schema.txt`: relations of
/// values with each other or with other files (a station that is not there, a list of another length than the cylinders, a range that ends
/// before it begins). `hartog check` refuses all.
#[test]
fn the_schema_refuses_what_one_file_shows() {
    let (mut beyond, mut refused) = (String::new(), 0);
    let folders =
        [(FileKind::Study, "study"), (FileKind::Engine, "engine"), (FileKind::Sizing, "sizing"), (FileKind::Material, "material")];
    for (kind, folder) in folders {
        let own = validator(kind);
        for path in files(&format!("tests/bad_input/{folder}")) {
            let text = fs::read_to_string(&path).expect("text");
            if value(&text).is_some_and(|v| own.is_valid(&v)) {
                beyond += &format!("{folder}/{}\n", path.file_name().expect("a name").to_string_lossy());
            } else {
                refused += 1;
            }
        }
    }
    let list = root().join("tests/bad_input/beyond_the_schema.txt");
    if std::env::var_os("HARTOG_WRITE_EXPECTED").is_some() {
        fs::write(&list, &beyond).expect("written");
    }
    assert_eq!(fs::read_to_string(list).expect("a list"), beyond);
    assert!(refused > beyond.lines().count(), "{refused}");
}

/// The page of all keys in the documentation is that of the types.
#[test]
fn the_page_of_keys_is_current() {
    let path = root().join("src/study/input/keys.md");
    let current = hartog::report::text::keys::page(&all_keys());
    if std::env::var_os("HARTOG_WRITE_EXPECTED").is_some() {
        fs::write(&path, &current).expect("written");
    }
    assert_eq!(fs::read_to_string(path).expect("a page"), current, "write it anew with HARTOG_WRITE_EXPECTED=1");
}

/// `hartog keys`: a key by its name or path, a hint where there is none, the schema as it is; no line is wider than 100 columns.
#[test]
fn keys_on_the_command_line() {
    let run = |arguments: &[&str]| {
        let output = assert_cmd::Command::cargo_bin("hartog").expect("built").args(arguments).output().expect("run");
        let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).expect("text");
        (output.status.code(), text(&output.stdout), text(&output.stderr))
    };
    let (code, out, _) = run(&["keys", "bore_to_stroke"]);
    assert_eq!(code, Some(0));
    assert_eq!(
        out,
        "mechanism.bore_to_stroke (sizing file)\n    Bore over stroke.\n    a number, at least 0.1, at most 10; required\n    bore_to_stroke = 1\n"
    );
    let (code, out, err) = run(&["keys", "borr_mm"]);
    assert_eq!((code, out.as_str()), (Some(2), ""));
    assert!(err.contains("found no key `borr_mm`; did you mean `bore_mm`?"), "{err}");
    let (_, all, _) = run(&["keys"]);
    assert!(all.lines().all(|line| line.chars().count() <= 100));
    assert!(all_keys().iter().all(|key| all.contains(&key.path)));
    let (_, schema, _) = run(&["keys", "--json-schema", "engine"]);
    assert_eq!(serde_json::from_str::<Value>(&schema).expect("JSON"), FileKind::Engine.json_schema());
}
