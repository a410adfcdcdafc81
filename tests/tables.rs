//! Tables and `results.json` as other programs read them.

use crate::support::assert_close;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

fn hartog(arguments: &[&str]) -> std::process::Output {
    Command::new(env!("CARGO_BIN_EXE_hartog")).current_dir(env!("CARGO_MANIFEST_DIR")).args(arguments).output().expect("runs")
}

/// Rows of a table by the names of its columns.
fn rows(folder: &Path, name: &str) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_path(folder.join(name)).expect("a table");
    reader.deserialize().map(|row| row.expect("a row")).collect()
}

fn value(row: &BTreeMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column}: {:?}", row[column]))
}

/// One quantity at one speed: order, amplitude and phase (rad) of each order, and half the peak-to-peak of all.
#[derive(Default)]
struct Group {
    orders: Vec<[f64; 3]>,
    total: f64,
}

/// Amplitudes and phases of `response.csv` are those of a cos(n theta + phi): added up over a cycle, they have the half peak-to-peak of their row of totals.
///
/// Tolerance: phases are given to 1e-4 degrees (2e-6 rad) and sums are sampled 4000 times in two turns: (12 x 2 pi x 2 / 4000)²/8 of the highest order.
#[test]
fn orders_of_response_csv_add_up_to_its_totals() {
    let folder = tempfile::tempdir().expect("folder");
    assert!(hartog(&["run", "studies/mendes_mwm6.toml", "--quiet", "--out", &folder.path().to_string_lossy()]).status.success());
    let mut groups: BTreeMap<[String; 4], Group> = BTreeMap::new();
    let designs: Vec<String> = rows(folder.path(), "designs.csv").iter().map(|r| r["design"].clone()).collect();
    for row in rows(folder.path(), "response.csv").iter().filter(|r| r["design"] == designs[0] && value(r, "speed_rpm") % 250.0 == 0.0) {
        let group = groups.entry([&row["quantity"], &row["condition"], &row["where"], &row["speed_rpm"]].map(Clone::clone)).or_default();
        if row["kind"] == "order" {
            group.orders.push([value(row, "order"), value(row, "amplitude"), value(row, "phase_deg").to_radians()]);
        } else {
            assert_eq!((row["order"].as_str(), row["phase_deg"].as_str()), ("", ""));
            group.total = value(row, "amplitude");
        }
    }
    let mut looked_at = 0;
    for ([quantity, ..], Group { orders, total }) in groups.iter().filter(|g| !g.1.orders.is_empty()) {
        let at = |i: i32| {
            let theta = f64::from(i) / 4000.0 * 4.0 * std::f64::consts::PI;
            orders.iter().map(|[n, a, phi]| a * (n * theta + phi).cos()).sum::<f64>()
        };
        let sampled: Vec<f64> = (0..4000).map(at).collect();
        let (least, most) = sampled.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, m), v| (l.min(*v), m.max(*v)));
        assert_close(0.5 * (most - least), *total, 3e-4, 0.0, quantity);
        looked_at += 1;
    }
    assert!(looked_at >= 8, "{looked_at}");
}

/// A torque of 1 cos(theta) on Den Hartog's mass: its motion follows in phase far below resonance (-2 zeta r of a degree or two at most) and lags by half a turn above; a damper never lets it lead.
#[test]
fn phases_of_response_csv_are_lags() {
    let folder = tempfile::tempdir().expect("folder");
    assert!(hartog(&["run", "studies/den_hartog.toml", "--quiet", "--out", &folder.path().to_string_lossy()]).status.success());
    let all = rows(folder.path(), "response.csv");
    let own: Vec<(f64, f64)> = all
        .iter()
        .filter(|r| r["design"] == "den_hartog_brock" && r["quantity"] == "twist" && r["kind"] == "order")
        .map(|r| (value(r, "speed_rpm"), value(r, "phase_deg")))
        .collect();
    assert!(own.iter().all(|(_, phase)| (-180.0..=0.0).contains(phase)));
    assert!(own[0].1 > -0.01 && own.last().is_some_and(|l| l.1 < -177.0), "{:?}", (own[0], own.last()));
}

/// `results.json` of studies of every kind is what its schema says, what `--json` prints, and holds the numbers of `designs.csv`; `--quiet` prints nothing.
#[test]
fn results_for_a_script() {
    let schema: serde_json::Value = serde_json::from_slice(&hartog(&["keys", "--json-schema", "results"]).stdout).expect("a schema");
    let validator = jsonschema::validator_for(&schema).expect("a schema");
    for study in ["den_hartog", "minucci_i4", "villalva_i6_catalogue", "villalva_i6_laws", "villalva_i6_robust"] {
        let folder = tempfile::tempdir().expect("folder");
        let out = folder.path().to_string_lossy();
        let printed = hartog(&["run", &format!("studies/{study}.toml"), "--json", "--out", &out]).stdout;
        assert_eq!(printed, std::fs::read(folder.path().join("results.json")).expect("results"), "{study}");
        let results: serde_json::Value = serde_json::from_slice(&printed).expect("JSON");
        let mistakes: Vec<String> = validator.iter_errors(&results).map(|e| format!("{}: {e}", e.instance_path())).collect();
        assert!(mistakes.is_empty(), "{study}: {mistakes:?}");
        let designs = results["designs"].as_array().expect("designs");
        let table = rows(folder.path(), "designs.csv");
        assert_eq!(designs.len(), table.len(), "{study}");
        for (design, row) in designs.iter().zip(&table) {
            assert_eq!(design["name"], row["design"]);
            let named = |name: &str| {
                let values = design["values"].as_array().expect("values").iter();
                values.filter(|v| v["measure"] == name).find_map(|v| v["value"].as_f64())
            };
            for (measure, column) in [
                ("peak_twist", "peak_twist_deg"),
                ("peak_torque", "peak_torque_n_m"),
                ("objective", "objective_value"),
                ("natural_frequency", "f1_hz"),
            ] {
                assert_eq!(named(measure), row[column].parse().ok(), "{study}: {measure} of {}", row["design"]);
            }
        }
        let optima = results["optima"].as_array().expect("optima");
        assert_eq!(optima.len(), designs.iter().filter(|d| d["optimum"] == true).count());
        let values = rows(folder.path(), "values.csv");
        assert_eq!(values.len(), designs.iter().map(|d| d["values"].as_array().map_or(0, Vec::len)).sum::<usize>());
    }
    let folder = tempfile::tempdir().expect("folder");
    let quiet = hartog(&["run", "studies/den_hartog.toml", "--quiet", "--out", &folder.path().to_string_lossy()]);
    assert!(quiet.status.success() && quiet.stdout.is_empty() && quiet.stderr.is_empty());
}

/// Every example of the README that reads a table by pandas runs as printed and prints something, after the runs that it names by their folders; every table that they make has one.
#[test]
#[ignore = "needs python3 with pandas; a minute"]
fn examples_of_the_readme_read_every_table() {
    if !Command::new("python3").args(["-c", "import pandas"]).output().is_ok_and(|o| o.status.success()) {
        println!("skipped: no python3 with pandas here");
        return;
    }
    let folder = tempfile::tempdir().expect("folder");
    let readme = include_str!("../README.md");
    let examples: Vec<&str> = readme.lines().filter(|l| l.starts_with("python3 -c ")).collect();
    let mut made: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for example in &examples {
        let study = example.split("out/").nth(1).and_then(|rest| rest.split('/').next()).expect("a folder");
        if !made.contains_key(study) {
            let out = folder.path().join("out").join(study);
            let run = hartog(&["run", &format!("studies/{study}.toml"), "--quiet", "--out", &out.to_string_lossy()]);
            assert!(run.status.code().is_some_and(|c| c <= 1), "{study}");
            let tables =
                std::fs::read_dir(&out).expect("a folder").map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned());
            made.insert(study.to_owned(), tables.filter(|n| n.ends_with(".csv") || n == "results.json").collect());
        }
        let output = Command::new("bash").current_dir(folder.path()).args(["-c", example]).output().expect("runs");
        let printed = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success() && printed.lines().count() >= 1, "{example}\n{printed}{}", String::from_utf8_lossy(&output.stderr));
        println!("$ {example}\n{printed}");
    }
    let mut tables: Vec<&String> = made.values().flatten().collect();
    tables.sort();
    tables.dedup();
    let missing: Vec<_> = tables.iter().filter(|t| !examples.iter().any(|e| e.contains(t.as_str()))).collect();
    assert!(missing.is_empty(), "no example: {missing:?}");
}
