//! Chains and pressures of other programs: what `hartog import` writes is read, and is the chain that was given.

use assert_cmd::Command;
use std::fs;
use std::path::Path;

fn import(folder: &Path, arguments: &[&str]) -> assert_cmd::assert::Assert {
    Command::cargo_bin("hartog").expect("built").current_dir(folder).arg("import").args(arguments).assert()
}

fn refused(folder: &Path, arguments: &[&str]) -> String {
    String::from_utf8_lossy(&import(folder, arguments).code(2).get_output().stderr).into_owned()
}

/// One chain as a spreadsheet of two countries saves it, with units of two sizes and our own columns: each is the same chain, with the same frequencies.
#[test]
fn a_table_is_read_as_it_was_saved() {
    let folder = tempfile::tempdir().expect("a folder");
    let files = [
        (
            "semicolons.csv",
            "No;Mass;Inertia [kg m²];Stiffness to next [MNm/rad]\n1;hub;0,0062;0,062\n2;throw 1;0,0081;0,41\n3;wheel;0,315;\n",
        ),
        ("tabs.csv", "Station\tJ (kg cm2)\tk (kN m/rad)\nhub\t62\t62\nthrow 1\t81\t410\nwheel\t3150\t-\n"),
        (
            "own.csv",
            "station,inertia_kg_m2,stiffness_to_next_n_m_per_rad,throws\nhub,0.0062,62000,\nthrow 1,0.0081,410000,1\nwheel,0.315,,\n",
        ),
    ];
    let mut found = Vec::new();
    for (name, text) in files {
        fs::write(folder.path().join(name), text).expect("written");
        let own = format!("{name}_study");
        let throws: &[&str] = if name == "own.csv" { &[] } else { &["--throws", "throw 1"] };
        import(folder.path(), &[&[name, &own], throws].concat()).success();
        let study = hartog::input::read(&folder.path().join(own).join("study.toml")).unwrap_or_else(|e| panic!("{name}: {e}"));
        let stations: Vec<(String, usize)> = study.chain.stations.iter().map(|s| (s.name.clone(), s.throws.len())).collect();
        assert_eq!(stations, [("hub".to_owned(), 0), ("throw 1".into(), 1), ("wheel".into(), 0)], "{name}");
        found.push(study.modes.frequencies_hz());
    }
    let study = hartog::input::read(&folder.path().join("own.csv_study/study.toml")).expect("a study");
    assert_eq!(study.designs.len(), 1, "no absorber is made up for an engine of one's own");
    for (a, b) in found.iter().flatten().zip(found[2].iter().cycle()) {
        assert!((a / b - 1.0).abs() < 1e-12, "{found:?}");
    }
}

/// Three disks of openTorsion against the roots of their characteristic equation, omega⁴ - omega² (k1/J1 + (k1 + k2)/J2 + k2/J3) + k1 k2 (J1 + J2 + J3)/(J1 J2 J3) = 0;
/// a shaft of two halves in series is the same shaft; a continuous shaft is G I/L with half its inertia at each end.
#[test]
fn an_assembly_of_opentorsion_keeps_its_frequencies() {
    let folder = tempfile::tempdir().expect("a folder");
    let disk = |name: &str, inertia: f64| {
        format!("{{\"name\":\"{name}\",\"elements\":[{{\"name\":\"d\",\"type\":\"Disk\",\"inertia\":{inertia},\"damping\":0}}]}}")
    };
    let shaft = |name: &str, stiffness: f64| {
        format!(
            "{{\"name\":\"{name}\",\"elements\":[{{\"name\":\"s\",\"type\":\"ShaftDiscrete\",\"stiffness\":{stiffness},\"damping\":0}}]}}"
        )
    };
    let joined = |names: &[&str]| names.windows(2).map(|p| format!("[\"{}.x\",\"{}.x\"]", p[0], p[1])).collect::<Vec<_>>().join(",");
    let (j, k) = ([8.35e6, 4.03e3, 8.38e4], [2.1e8, 4.49e9]);
    let names = ["Turbine", "Half", "Other half", "Coupling", "Shaft", "Rotor"];
    let parts = [
        disk(names[0], j[0]),
        shaft(names[1], 2.0 * k[0]),
        shaft(names[2], 2.0 * k[0]),
        disk(names[3], j[1]),
        shaft(names[4], k[1]),
        disk(names[5], j[2]),
    ];
    let text = format!("{{\"components\":[{}],\"structure\":[{}]}}", parts.join(","), joined(&names));
    fs::write(folder.path().join("three.json"), text).expect("written");
    import(folder.path(), &["three.json", "three", "--throws", "Coupling"]).success();
    let study = hartog::input::read(&folder.path().join("three/study.toml")).unwrap_or_else(|e| panic!("{e}"));
    let sum = k[0] / j[0] + (k[0] + k[1]) / j[1] + k[1] / j[2];
    let product = k[0] * k[1] * j.iter().sum::<f64>() / j.iter().product::<f64>();
    let root = (sum * sum / 4.0 - product).sqrt();
    let squares = [product / (sum / 2.0 + root), sum / 2.0 + root];
    for (f, square) in study.modes.frequencies_hz().iter().zip(squares) {
        let expected = f64::sqrt(square) / std::f64::consts::TAU;
        assert!((f / expected - 1.0).abs() < 1e-9, "{f} {expected}");
    }
    let continuous = "{\"name\":\"Shaft\",\"elements\":[{\"type\":\"ShaftContinuous\",\"length\":500,\"innerDiameter\":0,\"outerDiameter\":60,\"damping\":0}]}";
    let text =
        format!("{{\"components\":[{},{continuous},{}],\"structure\":[{}]}}", disk("A", 0.1), disk("B", 0.2), joined(&["A", "Shaft", "B"]));
    fs::write(folder.path().join("shaft.json"), text).expect("written");
    import(folder.path(), &["shaft.json", "shaft", "--throws", "A"]).success();
    let study = hartog::input::read(&folder.path().join("shaft/study.toml")).unwrap_or_else(|e| panic!("{e}"));
    let polar = std::f64::consts::PI / 32.0 * 0.06f64.powi(4);
    let (stiffness, inertia) = (80e9 * polar / 0.5, 8000.0 * polar * 0.5);
    let stations = &study.chain.stations;
    assert!((stations[0].stiffness_to_next / stiffness - 1.0).abs() < 1e-12);
    assert!(
        (stations[0].inertia / (0.1 + inertia / 2.0) - 1.0).abs() < 1e-12
            && (stations[1].inertia / (0.2 + inertia / 2.0) - 1.0).abs() < 1e-12
    );
}

/// Traces of two speeds, in megapascal from -360 degrees, are the engine's pressure in bar.
#[test]
fn traces_are_taken_with_their_units() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(
        folder.path().join("chain.csv"),
        "Mass,Inertia [kg m2],Stiffness to next [N m/rad]\nhub,0.01,3e5\nthrow,0.02,9e5\nwheel,0.9,\n",
    )
    .expect("written");
    for (name, scale) in [("slow.csv", 1.0), ("fast.csv", 1.2)] {
        let peak = |deg: f64| 0.12 + scale * 8.0 * (-(deg / 40.0) * (deg / 40.0)).exp();
        let rows: String = (-360..360).map(|d| format!("{d};{:.5}\n", peak(f64::from(d)))).collect();
        fs::write(folder.path().join(name), format!("CA [deg];p cyl [MPa]\n{rows}")).expect("written");
    }
    import(folder.path(), &["chain.csv", "own", "--throws", "throw", "--trace", "1000=slow.csv", "--trace", "3000=fast.csv"]).success();
    let mut check = Command::cargo_bin("hartog").expect("built");
    let check = check.current_dir(folder.path()).args(["check", "own/study.toml"]).assert().success();
    let text = String::from_utf8_lossy(&check.get_output().stdout).into_owned();
    assert!(text.contains("measured, 2 speeds") && text.contains("81.2") && text.contains("97.2"), "{text}");
}

/// What is not understood is named, with what was expected; nothing is written.
#[test]
fn what_is_not_understood_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = folder.path();
    let good = "Mass,Inertia [kg m2],Stiffness to next [N m/rad]\nhub,0.01,3e5\nthrow,0.02,9e5\nwheel,0.9,\n";
    fs::write(place.join("good.csv"), good).expect("written");
    let gear =
        "{\"components\":[{\"name\":\"A\",\"elements\":[{\"type\":\"Disk\",\"inertia\":1},{\"type\":\"GearElement\",\"inertia\":1}]}]}";
    let ring = "{\"components\":[{\"name\":\"A\",\"elements\":[]},{\"name\":\"B\",\"elements\":[]}],\"structure\":[[\"A.x\",\"B.x\"],[\"B.x\",\"A.x\"]]}";
    let tables = [
        ("no_unit.csv", good.replace(" [kg m2]", ""), "found no unit, expected one in the header, such as `Inertia [kg m2]`"),
        ("foot.csv", good.replace("[kg m2]", "[oz ft2]"), "found the unit `oz ft2`, expected one of kg m2"),
        ("milli.csv", good.replace("[N m/rad]", "[mN m/rad]"), "found the unit `mN m/rad`"),
        ("no_inertia.csv", good.replace("Inertia [kg m2]", "Weight [kg]"), "expected one like `Inertia [kg m2]`"),
        ("twice.csv", good.replace("throw,", "hub,"), "found station `hub` a second time"),
        ("massless.csv", good.replace("0.02", "0"), "expected an inertia above zero"),
        ("thousands.csv", good.replace("3e5", "\"300,000\""), "expected a number with one decimal point"),
        ("hole.csv", good.replace("9e5", ""), "found no stiffness from `throw` to the next station"),
        ("behind.csv", good.replace("0.9,", "0.9,5"), "found a stiffness behind the last station"),
        ("empty.csv", String::new(), "found an empty table, expected a column like `Station`"),
        ("gear.json", gear.into(), "found the gear `A`"),
        ("ring.json", ring.into(), "found components in a ring"),
        ("half.json", "{\"components\":[".into(), "found no assembly of openTorsion"),
    ];
    for (name, text, words) in tables {
        fs::write(place.join(name), text).expect("written");
        let told = refused(place, &[name, "own", "--throws", "throw"]);
        assert!(told.contains(words), "{name}: {told}");
    }
    let trace = |missing: i32| -> String { (-360..360).filter(|d| *d != missing).map(|d| format!("{d};1.0\n")).collect() };
    fs::write(place.join("row.csv"), format!("CA [deg];p cyl [bar]\n{}", trace(-7))).expect("written");
    for (arguments, words) in [
        (vec!["good.csv", "own", "--throws", "throw", "--trace", "2000=row.csv"], "found a step from -8 to -6 degrees among steps of 1"),
        (vec!["good.csv", "own"], "found no station with a throw, expected --throws with some of `hub`, `throw`, `wheel`"),
        (vec!["good.csv", "own", "--throws", "crank"], "found `crank` in --throws"),
        (vec!["good.csv", "own", "--throws", "throw", "--trace", "fast=good.csv"], "expected a speed in rpm and a file"),
        (vec!["good.csv", "own", "--throws", "throw", "--trace", "2000=good.csv"], "expected one like `Angle [deg]` among them"),
        (vec!["good.csv", "own", "--throws", "throw", "--trace", "2000=nowhere.csv"], "nowhere.csv"),
    ] {
        let told = refused(place, &arguments);
        assert!(told.contains(words), "{arguments:?}: {told}");
    }
    assert!(!place.join("own").exists(), "something was written");
}

const CHAIN: &str = "Mass,Inertia [kg m2],Stiffness to next [N m/rad]\nhub,0.01,3e5\nthrow,0.02,9e5\nwheel,0.9,\n";

/// What `hartog COMMAND study` prints to both of its outputs, with lines joined.
fn told(folder: &Path, arguments: &[&str]) -> String {
    let output = Command::cargo_bin("hartog").expect("built").current_dir(folder).args(arguments).output().expect("run");
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned()
}

/// Every value that an import has not replaced is named by `check` and `run` with what it is, and in `results.json`, until its name is deleted from the list in its file; a name of no key is refused. At
/// 19b2337 nothing tells a bore of the example from one of the engine.
#[test]
fn values_of_the_example_are_named_until_they_are_confirmed() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = folder.path();
    fs::write(place.join("chain.csv"), CHAIN).expect("written");
    import(place, &["chain.csv", "own", "--throws", "throw"]).success();
    let study = place.join("own/study.toml");
    // few speeds and no search are enough
    let text = fs::read_to_string(&study).expect("a study");
    let short = text.replace("step = 20", "step = 400").replace("order_limit = 12", "order_limit = 2");
    let until = short.find("[optimise]").expect("a search");
    fs::write(&study, short[..until].replace("  \"optimise.absorber.size\",\n", "")).expect("written");
    let named = [
        "geometry.bore_mm = 95",
        "geometry.crank_radius_mm = 50",
        "geometry.rod_length_mm = 160",
        "geometry.piston_mass_kg = 0.9",
        "geometry.rod_mass_kg = 1.1",
        "geometry.rod_rotating_fraction = 0.667",
        "layout.in_line.firing_order = [1]",
        "pressure.wiebe.boost_bar = 1.5",
        "damping.dynamic_magnifier = 25",
        "strokes = 4",
        "reciprocating_inertia = \"none\"",
        "speed_rpm = { from = 800,",
    ];
    for arguments in [vec!["check", "own/study.toml"], vec!["run", "own/study.toml", "--out", "out"]] {
        let text = told(place, &arguments);
        // `run` lists them below each other, `check` in a sentence
        let unbroken = text.split_whitespace().collect::<Vec<_>>().join(" ");
        for words in named {
            assert!(unbroken.contains(&format!(" {words}")), "{arguments:?}: {words} in {text}");
        }
        assert!(
            text.split_whitespace().collect::<Vec<_>>().join(" ").contains("engine.toml are those of an example, not of your engine"),
            "{text}"
        );
    }
    let results = fs::read_to_string(place.join("out/results.json")).expect("results");
    let results: serde_json::Value = serde_json::from_str(&results).expect("JSON");
    let keys: Vec<&str> = results["placeholders"].as_array().expect("a list").iter().filter_map(|p| p["key"].as_str()).collect();
    assert!(keys.contains(&"geometry.bore_mm") && keys.contains(&"speed_rpm"), "{keys:?}");
    let engine = place.join("own/engine.toml");
    let text = fs::read_to_string(&engine).expect("an engine");
    fs::write(&engine, text.replace("  \"geometry.bore_mm\",\n", "")).expect("written");
    let confirmed = told(place, &["check", "own/study.toml"]);
    assert!(!confirmed.contains("geometry.bore_mm") && confirmed.contains("geometry.piston_mass_kg = 0.9"), "{confirmed}");
    fs::write(&engine, text.replace("\"geometry.bore_mm\"", "\"bore_mm\"")).expect("written");
    let output = Command::cargo_bin("hartog").expect("built").current_dir(place).args(["check", "own/study.toml"]).assert().code(2);
    let refused = String::from_utf8_lossy(&output.get_output().stderr).into_owned();
    assert!(
        refused.contains("found `bore_mm`, expected the path of a key of this file")
            && refused.contains("did you mean `geometry.bore_mm`?"),
        "{refused}"
    );
    let list = |text: &str| {
        let (start, end) = (text.find("placeholder = [").expect("a list"), text.find("]\n").expect("its end") + 2);
        format!("{}{}", &text[..start], &text[end..])
    };
    fs::write(&engine, list(&text)).expect("written");
    let text = fs::read_to_string(&study).expect("a study");
    fs::write(&study, list(&text)).expect("written");
    assert!(!told(place, &["check", "own/study.toml"]).contains("of an example"));
}

/// Traces that `check` refuses are refused by `import` with the row, the column and the number of the user's own file, and nothing is left; the others are accepted by both. Mutations of one trace: rows
/// left out, doubled, swapped, cells that are zero, negative, no numbers, other units of the angle, short and long cycles. At 19b2337 `import` took 6 of these that `check` refuses.
#[test]
fn import_refuses_the_traces_that_check_refuses() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = folder.path();
    fs::write(place.join("chain.csv"), CHAIN).expect("written");
    let rows = |from: i32, to: i32, step: usize| -> Vec<[String; 2]> {
        (from..to).step_by(step).map(|d| [d.to_string(), format!("{:.2}", 120.0 + 8000.0 / f64::from(1 + d.abs()))]).collect()
    };
    let good = rows(-360, 360, 10);
    let with = |change: &dyn Fn(&mut Vec<[String; 2]>)| {
        let mut rows = good.clone();
        change(&mut rows);
        rows
    };
    let set = |row: usize, column: usize, cell: &str| with(&|rows| rows[row][column] = cell.to_owned());
    let cases = [
        ("good", good.clone(), None),
        ("as turned", rows(0, 720, 10), None),
        ("few rows", rows(0, 720, 45), Some("found 16 rows, expected at least 24 over a cycle")),
        (
            "a row twice",
            with(&|rows| rows.insert(5, rows[4].clone())),
            Some("found -320 after -320, expected ascending angles\n  --> t.csv, row 7, column `CA [deg]`"),
        ),
        ("swapped", with(&|rows| rows.swap(30, 31)), Some("found -60 after -50, expected ascending angles\n  --> t.csv, row 33")),
        ("reversed", with(&|rows| rows.reverse()), Some("expected ascending angles\n  --> t.csv, row 3")),
        ("a hole", with(&|rows| drop(rows.remove(20))), Some("expected no row to be missing\n  --> t.csv, row 22")),
        ("a turn", rows(0, 360, 10), Some("found a cycle of 350 degrees, expected 720")),
        ("two cycles", rows(0, 1440, 10), Some("found a cycle of 1430 degrees, expected 720")),
        ("zero", set(12, 1, "0"), Some("found 0, expected an absolute pressure above zero\n  --> t.csv, row 14, column `p [kPa]`")),
        ("gauge", set(12, 1, "-3.5"), Some("found -3.5, expected an absolute pressure above zero\n  --> t.csv, row 14, column `p [kPa]`")),
        ("a word", set(12, 1, "off"), Some("found `off`, expected a number up to 1e20\n  --> t.csv, row 14, column `p [kPa]`")),
        ("empty", set(12, 0, ""), Some("found an empty cell, expected a number\n  --> t.csv, row 14, column `CA [deg]`")),
        ("nan", set(12, 1, "nan"), Some("found `nan`")),
    ];
    for (i, (name, rows, refusal)) in cases.into_iter().enumerate() {
        let text: String = rows.iter().map(|[angle, pressure]| format!("{angle},{pressure}\n")).collect();
        fs::write(place.join("t.csv"), format!("CA [deg],p [kPa]\n{text}")).expect("written");
        let own = format!("own{i}");
        let arguments = ["chain.csv", &own, "--throws", "throw", "--trace", "2000=t.csv"];
        match refusal {
            None => {
                import(place, &arguments).success();
                told(place, &["check", &format!("{own}/study.toml")]);
            }
            Some(words) => {
                let told = refused(place, &arguments);
                assert!(told.contains(words) && !place.join(&own).exists(), "{name}: {told}");
            }
        }
    }
    let long = "x".repeat(101);
    fs::write(place.join("chain.csv"), CHAIN.replace("throw", &long)).expect("written");
    let told = refused(place, &["chain.csv", "no", "--throws", &long]);
    assert!(
        told.contains("more than 100 letters") && told.contains("chain.csv, row 3, column `Mass`") && !place.join("no").exists(),
        "{told}"
    );
}

/// The rows of a chain that the guide shows are those of the file that it names.
#[test]
fn the_guide_shows_rows_of_a_chain() {
    let read = |path: &str| std::fs::read_to_string(std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).expect("text");
    let guide = read("src/guide/own_engine.md");
    let shown = guide.split("```csv\nstation,").nth(1).and_then(|rest| rest.split("```").next()).expect("rows");
    assert!(read("studies/engines/mendes_mwm6_chain.csv").starts_with(&format!("station,{shown}")), "{shown}");
}
