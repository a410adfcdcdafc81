//! `--set KEY=VALUE`: another value of a key for one command, checked as in its file, and recorded.

use assert_cmd::Command;
use std::fs;
use std::path::Path;

fn hartog(folder: &Path, arguments: &[&str]) -> std::process::Output {
    Command::cargo_bin("hartog").expect("built").current_dir(folder).args(arguments).output().expect("it ran")
}

/// A folder with a study and the engine file it names, as `hartog new` writes them.
fn example() -> tempfile::TempDir {
    let place = tempfile::tempdir().expect("folder");
    assert!(hartog(place.path(), &["new", "own"]).status.success());
    place
}

/// What is wrong with a value: the first line of the message, and where it is in the text of the option.
fn mistake(of: &str, set: &str) -> (String, String) {
    let study = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies").join(of);
    let found = hartog(Path::new("."), &["check", &study.to_string_lossy(), "--set", set]);
    assert_eq!(found.status.code(), Some(2), "{set}");
    let told = String::from_utf8(found.stderr).expect("text");
    let mut lines = told.lines();
    let message = lines.next().expect("a message").trim_start_matches("error: ").to_owned();
    (message, lines.next().expect("a place").trim_start().trim_start_matches("--> ").to_owned())
}

#[test]
fn mistakes_are_those_of_a_file_at_their_place_in_the_option() {
    let study = "villalva_i6.toml";
    // a wrong key, of the study and of its engine file
    let (message, place) = mistake(study, "load_frction=0.5");
    assert!(message.starts_with("found unknown key `load_frction`, expected `engine`"), "{message}");
    assert_eq!(place, "--set:1:1");
    let (message, place) = mistake(study, "engine.station.flywheel.inertia=1");
    assert!(message.starts_with("found unknown key `inertia`, expected"), "{message}");
    assert_eq!(place, "--set:1:25");
    // wrong types: number, list, file, table, element
    for (set, expected, at) in [
        ("order_limit=\"x\"", "found string \"x\", expected a number", 13),
        ("conditions=1", "found integer `1`, expected a list", 12),
        ("engine=1", "found integer `1`, expected a text in quotes", 8),
        ("optimise=1", "found integer `1`, expected a table", 10),
        ("design.0=5", "found integer `5`, expected a table", 10),
        // out of range, and files that are not there
        ("load_fraction=5", "found 5, expected a share of full load from 0 to 1.2", 15),
        ("engine=\"none.toml\"", "file not found", 8),
        ("engine.station.flywheel.inertia_kg_m2=-1", "found -1, expected a number above zero, from 1e-20 to 1e20", 39),
        ("optimise.absorber.0.types=[\"ruber\"]", "found `ruber`, expected `tuned`,", 28),
        ("optimise.prove={gap=1e-3, boxes=10, x=1}", "found unknown key `x`, expected `gap`, `boxes` or `file`", 37),
        // elements that are not there, and keys below a value that has none
        (
            "optimise.absorber.3.types=[\"rubber\"]",
            "found `3`, expected the number or the name of an element of `absorber`, which has one: 0",
            19,
        ),
        ("order_limit.x=1", "found a key below `order_limit`, which is a number and has none", 13),
        // no values of TOML, and no overrides at all
        ("load_fraction=0,5", "found the decimal comma of `0,5`, expected a point: `0.5`", 16),
        ("engine=own.toml", "found own.toml, expected a value as it stands in a file", 8),
        ("conditions=[\"misfire\"", "unclosed array, expected `]`", 22),
        ("load_fraction=", "found no value, expected one behind the `=`", 14),
        ("load_fraction", "found `load_fraction`, expected KEY=VALUE", 1),
        ("=1", "found no key, expected one with points between its parts, as `hartog keys` lists them", 1),
    ] {
        let (message, place) = mistake(study, set);
        assert!(message.starts_with(expected), "{set}: {message}");
        assert_eq!(place, format!("--set:1:{at}"), "{set}");
    }
}

#[test]
fn every_kind_of_key_is_as_in_its_file() {
    let place = example();
    let file = |name: &str| place.path().join("own").join(name);
    let study = fs::read_to_string(file("study.toml")).expect("study");
    let engine = fs::read_to_string(file("engine.toml")).expect("engine");
    fs::write(file("other.toml"), engine).expect("written");
    // a number, a table, a key of a table that is not there yet, a file, a list of tables
    let set = [
        "order_limit=6.5",
        "speed_rpm={from=900, to=2000, step=50}",
        "response.method=\"direct\"",
        "engine=\"other.toml\"",
        "objective=[{hub_amplitude={station=\"pulley\", over=\"orders\"}}]",
    ];
    let asked: Vec<&str> = set.iter().flat_map(|s| ["--set", s]).collect();
    let run = |of: &str, out: &str, more: &[&str]| {
        let found = hartog(place.path(), &[&["run", of, "--out", out, "--quiet"], more].concat());
        assert!(matches!(found.status.code(), Some(0 | 1)), "{}", String::from_utf8_lossy(&found.stderr));
    };
    run("own/study.toml", "set", &asked);
    // the same in a file
    let mut table: toml::Table = study.parse().expect("a study");
    for own in set {
        let mut given: toml::Table = own.parse().expect("a key");
        for (key, value) in std::mem::take(&mut given) {
            match (table.get_mut(&key), value) {
                (Some(toml::Value::Table(before)), toml::Value::Table(new)) if key == "response" => before.extend(new),
                (_, value) => _ = table.insert(key, value),
            }
        }
    }
    // what is given is no example any more
    if let Some(toml::Value::Array(list)) = table.get_mut("placeholder") {
        list.retain(|key| !set.iter().any(|own| own.split('=').next() == key.as_str()));
    }
    fs::write(file("study2.toml"), table.to_string()).expect("written");
    run("own/study2.toml", "file", &[]);
    for name in ["designs.csv", "optima.csv", "response.csv"] {
        let read = |folder: &str| fs::read(place.path().join(folder).join(name)).expect("a table");
        assert_eq!(read("set"), read("file"), "{name}");
    }
    let summary: serde_json::Value =
        serde_json::from_slice(&fs::read(place.path().join("set/summary.json")).expect("a summary")).expect("JSON");
    assert_eq!(summary["set"], serde_json::json!(set));
    let engine =
        summary["inputs"].as_array().expect("inputs").iter().any(|i| i["path"].as_str().is_some_and(|p| p.ends_with("other.toml")));
    assert!(engine, "the engine that was read is recorded");
}

#[test]
fn elements_are_told_by_number_or_name_and_values_of_examples_are_given() {
    let study = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/villalva_i6.toml");
    let check = |set: &str| {
        let found = hartog(Path::new("."), &["check", &study.to_string_lossy(), "--set", set]);
        assert!(found.status.success(), "{}", String::from_utf8_lossy(&found.stderr));
        String::from_utf8(found.stdout).expect("text").replace("7.inertia", "flywheel.inertia")
    };
    let by_name = check("engine.station.flywheel.inertia_kg_m2=2.5");
    assert_eq!(by_name, check("engine.station.7.inertia_kg_m2=2.5"), "the flywheel is the eighth station");
    assert!(by_name.contains("--set gives other values than the files have: engine.station.flywheel.inertia_kg_m2=2.5"), "{by_name}");

    let place = example();
    let told = |more: &[&str]| {
        let found = hartog(place.path(), &[&["check", "own/study.toml", "--verbose"], more].concat());
        String::from_utf8(found.stdout).expect("text")
    };
    let listed = |text: &str| text.contains("\n  speed_rpm = ");
    assert!(listed(&told(&[])) && !listed(&told(&["--set", "speed_rpm={from=900, to=2000, step=50}"])), "{}", told(&[]));
}

#[test]
fn a_run_goes_on_only_with_the_same_values() {
    let place = example();
    let out = place.path().join("out");
    let start = |set: &[&str], resume: bool| {
        let mut arguments = vec!["run", "own/study.toml", "--out", "out", "--quiet"];
        arguments.extend(set.iter().flat_map(|s| ["--set", *s]));
        arguments.extend(resume.then_some("--resume"));
        hartog(place.path(), &arguments)
    };
    // a run that was killed leaves a journal whose first line tells of its values
    let mut command = std::process::Command::new(assert_cmd::cargo::cargo_bin("hartog"));
    let mut child = command
        .current_dir(place.path())
        .args(["run", "own/study.toml", "--out", "out", "--quiet", "--set", "order_limit=7"])
        .spawn()
        .expect("started");
    while !fs::read_to_string(out.join("journal.log")).is_ok_and(|text| text.contains("order_limit=7")) {
        assert!(child.try_wait().expect("a child").is_none(), "it ended before its journal was seen");
    }
    child.kill().expect("killed");
    child.wait().expect("ended");
    let refused = start(&["order_limit=8"], true);
    let told = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert_eq!(refused.status.code(), Some(2), "{told}");
    assert!(told.contains("its --set was order_limit=7, that of this run is order_limit=8"), "{told}");
    let done = start(&["order_limit=7"], true);
    assert!(matches!(done.status.code(), Some(0 | 1)), "{}", String::from_utf8_lossy(&done.stderr));
}
