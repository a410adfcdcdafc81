//! Bad input: each file of `bad_input/` beside the error it must give, word for word, with exit code 2.
//!
//! `crank/*.toml` are for `crank_study.toml` and `crank_engine.toml`, `engine/*.toml` are engine files for `study.toml`, `study/*.toml` are studies of `engine.toml`, `csv/pressure_*.csv` and
//! `csv/harmonics_*.csv` tables for `engine.toml`, the other tables published ones for `study.toml`. To write the expected messages anew, set HARTOG_WRITE_EXPECTED and read the change.

use assert_cmd::Command;
use std::fs;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_input")
}

/// Error of `hartog check study.toml` in a folder with these files; the exit code must be 2 and nothing may be printed.
fn error(files: &[(&str, &[u8])]) -> String {
    let place = tempfile::tempdir().expect("folder");
    for (name, text) in files {
        fs::write(place.path().join(name), text).expect("written");
    }
    let mut command = Command::cargo_bin("hartog").expect("built");
    let assert = command.current_dir(place.path()).args(["check", "study.toml"]).assert().code(2);
    assert!(assert.get_output().stdout.is_empty());
    String::from_utf8_lossy(&assert.get_output().stderr).into_owned()
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

fn cases(kind: &str, ending: &str) -> Vec<PathBuf> {
    let mut list: Vec<PathBuf> = fs::read_dir(folder().join(kind))
        .expect("cases")
        .filter_map(|e| e.ok().map(|e| e.path()))
        .filter(|p| p.extension().is_some_and(|e| e == ending))
        .collect();
    list.sort();
    assert!(!list.is_empty());
    list
}

fn compare(case: &Path, found: &str) {
    let expected = case.with_extension("stderr");
    if std::env::var_os("HARTOG_WRITE_EXPECTED").is_some() {
        fs::write(&expected, found).expect("written");
    }
    assert_eq!(read(&expected), found, "{}", case.display());
}

#[test]
fn good_input_is_accepted() {
    for kind in ["", "crank_"] {
        let place = tempfile::tempdir().expect("folder");
        for name in ["study.toml", "engine.toml"] {
            fs::copy(folder().join(format!("{kind}{name}")), place.path().join(name)).expect("copied");
        }
        Command::cargo_bin("hartog").expect("built").current_dir(place.path()).args(["check", "study.toml"]).assert().code(0);
    }
}

#[test]
fn engines() {
    let study = read(&folder().join("study.toml"));
    for case in cases("engine", "toml") {
        compare(&case, &error(&[("study.toml", study.as_bytes()), ("engine.toml", read(&case).as_bytes())]));
    }
}

#[test]
fn studies() {
    let (engine, amplitudes) = (read(&folder().join("engine.toml")), read(&folder().join("amplitudes.csv")));
    for case in cases("study", "toml") {
        let files = [("engine.toml", &engine), ("amplitudes.csv", &amplitudes), ("study.toml", &read(&case))];
        compare(&case, &error(&files.map(|(name, text)| (name, text.as_bytes()))));
    }
}

/// Cranks and fatigue: `crank/engine_*.toml` for `crank_study.toml`, `crank/study_*.toml` for `crank_engine.toml`.
#[test]
fn cranks() {
    let (study, engine) = (read(&folder().join("crank_study.toml")), read(&folder().join("crank_engine.toml")));
    let (units, unknown) = (read(&folder().join("units.csv")), read(&folder().join("unknown.csv")));
    for case in cases("crank", "toml") {
        let of_engine = case.file_name().is_some_and(|n| n.to_string_lossy().starts_with("engine"));
        let own = read(&case);
        let (engine, study) = if of_engine { (&own, &study) } else { (&engine, &own) };
        let files = [("engine.toml", engine), ("study.toml", study), ("units.csv", &units), ("unknown.csv", &unknown)];
        compare(&case, &error(&files.map(|(name, text)| (name, text.as_bytes()))));
    }
}

/// Stress histories and materials of `hartog fatigue`: `history/*.csv` with `material.toml`, `material/*.toml` with `history.csv`. Nothing is written.
#[test]
fn histories_and_materials() {
    let (history, material) = (read(&folder().join("history.csv")), read(&folder().join("material.toml")));
    let all = cases("history", "csv").into_iter().chain(cases("material", "toml"));
    for case in all {
        let of_history = case.extension().is_some_and(|e| e == "csv");
        let own = read(&case);
        let place = tempfile::tempdir().expect("folder");
        let (history, material) = if of_history { (&own, &material) } else { (&history, &own) };
        fs::write(place.path().join("history.csv"), history).expect("written");
        fs::write(place.path().join("material.toml"), material).expect("written");
        let mut command = Command::cargo_bin("hartog").expect("built");
        let assert = command.current_dir(place.path()).args(["fatigue", "history.csv", "--material", "material.toml"]).assert().code(2);
        assert!(assert.get_output().stdout.is_empty());
        compare(&case, &String::from_utf8_lossy(&assert.get_output().stderr));
        let written = fs::read_dir(place.path().join("out/history")).map_or(0, Iterator::count);
        assert_eq!(written, 0, "{}", case.display());
    }
}

/// Stresses per unit load and loads of `hartog fatigue`: `units/*.csv` with `loads.csv`, `loads/*.csv` with `units.csv`; the two together are right.
#[test]
fn unit_loads() {
    let all =
        [("units", "loads"), ("loads", "units")].map(|(kind, other)| cases(kind, "csv").into_iter().map(move |case| (case, kind, other)));
    for (case, kind, other) in all.into_iter().flatten().chain([(folder().join("units.csv"), "units", "loads")]) {
        let place = tempfile::tempdir().expect("folder");
        fs::copy(&case, place.path().join(format!("{kind}.csv"))).expect("copied");
        for name in [format!("{other}.csv"), "material.toml".into()] {
            fs::copy(folder().join(&name), place.path().join(&name)).expect("copied");
        }
        let arguments = ["fatigue", "--unit-loads", "units.csv", "--loads", "loads.csv", "--material", "material.toml"];
        let output = Command::cargo_bin("hartog").expect("built").current_dir(place.path()).args(arguments).output().expect("run");
        if case.parent() == Some(&folder()) {
            assert_eq!(output.status.code(), Some(0));
            continue;
        }
        assert_eq!(output.status.code(), Some(2), "{}", case.display());
        assert!(output.stdout.is_empty());
        compare(&case, &String::from_utf8_lossy(&output.stderr));
    }
}

#[test]
fn tables() {
    let (study, engine) = (read(&folder().join("study.toml")), read(&folder().join("engine.toml")));
    let (start, end) = (engine.find("[pressure.wiebe]").expect("a cycle"), engine.find("[[station]]").expect("a station"));
    let geometry = engine.find("[geometry]").expect("a geometry")..engine.find("[layout").expect("a layout");
    let published = [
        "amplitudes",
        "absorbers",
        "chain",
        "choices",
        "planes",
        "frequencies",
        "modes",
        "von_mises",
        "engines",
        "factors",
        "fatigue",
        "stresses",
        "multiaxial",
        "histories",
    ];
    for case in cases("csv", "csv") {
        let stem = case.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
        if let Some(kind) = published.iter().find(|k| stem.starts_with(*k)) {
            let with_table = format!("{study}[published]\nengine = \"two\"\n{kind} = \"table.csv\"\n");
            let table = fs::read(&case).expect("a table");
            let files = [("study.toml", with_table.as_bytes()), ("engine.toml", engine.as_bytes()), ("table.csv", &table)];
            compare(&case, &error(&files));
            continue;
        }
        let harmonics = case.file_stem().is_some_and(|s| s.to_string_lossy().starts_with("harmonics"));
        let kind = if harmonics { "harmonics" } else { "measured" };
        let mut with_table = format!("{}[pressure.{kind}]\nfile = \"table.csv\"\n{}", &engine[..start], &engine[end..]);
        if harmonics {
            with_table.replace_range(geometry.clone(), "");
        }
        compare(
            &case,
            &error(&[
                ("study.toml", study.as_bytes()),
                ("engine.toml", with_table.as_bytes()),
                ("table.csv", &fs::read(&case).expect("a table")),
            ]),
        );
    }
}

#[test]
fn files_that_are_not_there_or_not_text() {
    let place = tempfile::tempdir().expect("folder");
    fs::write(place.path().join("bytes.toml"), [0xff, 0xfe, 0x00]).expect("written");
    for (arguments, words) in [
        (["check", "nothing.toml"], "error: file not found\n  --> nothing.toml"),
        (["run", "nothing.toml"], "error: file not found\n  --> nothing.toml"),
        (["check", "bytes.toml"], "error: found bytes that are not text, expected UTF-8\n  --> bytes.toml:1:1"),
    ] {
        let assert = Command::cargo_bin("hartog").expect("built").current_dir(place.path()).args(arguments).assert().code(2);
        let text = String::from_utf8_lossy(&assert.get_output().stderr).into_owned();
        assert!(text.contains(words), "{text}");
    }
}

/// Sizing files of `hartog size`: `sizing/*.toml`; `sizing.toml` itself is right. Nothing is printed, and nothing is left behind but an empty folder.
#[test]
fn sizing_files() {
    for case in cases("sizing", "toml").into_iter().chain([folder().join("sizing.toml")]) {
        let place = tempfile::tempdir().expect("folder");
        fs::copy(&case, place.path().join("sizing.toml")).expect("copied");
        fs::copy(folder().join("rounds.csv"), place.path().join("rounds.csv")).expect("copied");
        let output =
            Command::cargo_bin("hartog").expect("built").current_dir(place.path()).args(["size", "sizing.toml"]).output().expect("run");
        if case.parent() == Some(&folder()) {
            assert_eq!(output.status.code(), Some(0));
            continue;
        }
        assert_eq!(output.status.code(), Some(2), "{}", case.display());
        assert!(output.stdout.is_empty());
        compare(&case, &String::from_utf8_lossy(&output.stderr));
        assert_eq!(fs::read_dir(place.path().join("out/sizing")).map_or(0, Iterator::count), 0, "{}", case.display());
    }
}

/// Catalogues: `catalogue/*.csv` for `catalogue_study.toml`.
#[test]
fn catalogues() {
    let (study, engine) = (read(&folder().join("catalogue_study.toml")), read(&folder().join("engine.toml")));
    for case in cases("catalogue", "csv") {
        let files = [("study.toml", &study), ("engine.toml", &engine), ("dampers.csv", &read(&case))];
        compare(&case, &error(&files.map(|(name, text)| (name, text.as_bytes()))));
    }
}

/// Tables of measured absorbers: `measured/*.csv` for `measured_study.toml`.
#[test]
fn measured_absorbers() {
    let (study, engine) = (read(&folder().join("measured_study.toml")), read(&folder().join("engine.toml")));
    for case in cases("measured", "csv") {
        let files = [("study.toml", &study), ("engine.toml", &engine), ("damper.csv", &read(&case))];
        compare(&case, &error(&files.map(|(name, text)| (name, text.as_bytes()))));
    }
}
